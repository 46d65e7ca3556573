#!/usr/bin/python3
"""Proves every file of the safety kernel's core with Frama-C/WP, and the theorems of the safety argument with Why3.

A line each: goals, proved, seconds; then the totals and the tools' versions. Exit 0 only when every goal of every file is proved, every
file has exactly the number of goals recorded in goals.json (so a contract that vanished is noticed), every function has a contract, no
annotation is assumed, and no file was skipped."""

import argparse
import json
import os
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import theorem_session
import wp_session

RECORD = Path(__file__).resolve().parent / "goals.json"
FILES_AT_A_TIME = 2


def arguments():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--only", metavar="UNIT", action="append", help="prove this file of the core or of theorems only (its name without ending; may be repeated)")
    p.add_argument("--json", metavar="FILE", help='write {"goals","proved","skipped","seconds","functions":[{"name","goals","proved"}]}')
    p.add_argument("--record", action="store_true", help="write the goal counts to goals.json; refused when anything is unproved")
    p.add_argument("--timeout", metavar="S", type=int, default=60, help="seconds for each prover and goal (default 60)")
    a = p.parse_args()
    if not 1 <= a.timeout <= 600:
        p.error("--timeout: 1 to 600 seconds")
    return a


def chosen_units(only):
    every = sorted(path.stem for path in wp_session.CORE.glob("*.c"))
    theorems = sorted(path.stem for path in theorem_session.FOLDER.glob("*.mlw"))
    for files, folder in ((every, wp_session.CORE), (theorems, theorem_session.FOLDER)):
        if not files:
            raise SystemExit(f"run_proofs: no files in {folder}")
    for unit in only or []:
        if unit not in every + theorems:
            sys.stderr.write(f"run_proofs: --only {unit}: no such file; there are {', '.join(every + theorems)}\n")
            raise SystemExit(2)
    return every, theorems, sorted(set(only)) if only else every + theorems


def check_sources(every, units, env, outcomes):
    """Contracts: every function defined has one, and every contract relied on is that of a function proved here."""
    defined, relied_on = set(), {}
    for unit in every:
        try:
            complete, without, external = wp_session.contracts(wp_session.parsed_source(wp_session.CORE, unit, env))
        except RuntimeError as e:
            outcomes[unit].errors.append(f"not parsed: {e}")
            continue
        defined |= complete
        if unit not in units:
            continue
        relied_on[unit] = external
        outcomes[unit].errors += [f"function {name} has no contract (assigns and ensures)" for name in sorted(without)]
        proved_functions = {f["name"] for f in outcomes[unit].functions}
        if outcomes[unit].goals is not None:
            outcomes[unit].errors += [f"function {name} has no goal" for name in sorted(complete - proved_functions)]
        outcomes[unit].errors += wp_session.assumptions(wp_session.CORE, unit)
    for unit, names in relied_on.items():
        outcomes[unit].errors += [f"contract of {name} is nobody's: no file of the core defines it" for name in sorted(names - defined)]


def check_counts(every, units, recorded, outcomes):
    for unit in units:
        expected = recorded.get(unit)
        if expected is None:
            outcomes[unit].errors.append("no recorded goal count in goals.json (run with --record when the change is meant)")
        elif outcomes[unit].goals is not None and outcomes[unit].goals != expected:
            outcomes[unit].errors.append(f"{outcomes[unit].goals} goals, but {expected} are recorded in goals.json (run with --record when the change is meant)")
    return [f"goals.json records {unit}, which is no file" for unit in sorted(set(recorded) - set(every))]


def write_whole(path, text):
    half = Path(f"{path}.part")
    half.write_text(text)
    os.replace(half, path)


def headers_without_file():
    """Headers of the core with assumptions, beside no .c file."""
    stems = {p.stem for p in wp_session.CORE.glob("*.c")}
    return [e for p in sorted(wp_session.CORE.glob("*.h")) if p.stem not in stems for e in wp_session.assumptions(wp_session.CORE, p.stem)]


def main():
    a = arguments()
    missing = wp_session.missing_tools()
    if missing:
        sys.stderr.write(f"run_proofs: not installed: {', '.join(missing)} (Debian: frama-c-base why3 cvc4 z3 gcc)\n")
        return 2
    core, theorems, units = chosen_units(a.only)
    every = core + theorems
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {"versions": {}, "units": {}}
    recorded = record["units"]
    versions = wp_session.versions()
    begin = time.monotonic()
    with wp_session.work_folder() as folder:
        env = wp_session.environment(folder)
        outcomes = {unit: wp_session.Outcome(unit) for unit in every}

        def one(unit):
            out = theorem_session.prove_file(unit, env, a.timeout, versions) if unit in theorems else wp_session.prove_file(wp_session.CORE, unit, env, a.timeout, folder)
            print(f"{unit:<20} {out.goals if out.goals is not None else '-':>5} goals {out.proved if out.proved is not None else '-':>5} proved {out.seconds:7.1f} s", flush=True)
            return unit, out

        longest_first = sorted(units, key=lambda u: -recorded.get(u, 1 << 20))
        with ThreadPoolExecutor(FILES_AT_A_TIME) as pool:
            outcomes.update(dict(pool.map(one, longest_first)))
        check_sources(core, units, env, outcomes)
    seconds = time.monotonic() - begin

    done = [outcomes[u] for u in units]
    goals, proved = sum(o.goals or 0 for o in done), sum(o.proved or 0 for o in done)
    skipped = sum(o.goals is None for o in done)
    sound = goals == proved and skipped == 0 and not any(o.errors for o in outcomes.values())
    if a.record and sound:
        recorded.update({o.unit: o.goals for o in done})
        for unit in set(recorded) - set(every):
            del recorded[unit]
        write_whole(RECORD, json.dumps({"versions": versions, "units": dict(sorted(recorded.items()))}, indent=2) + "\n")
    general = check_counts(every, units, recorded, outcomes) + headers_without_file()

    for o in outcomes.values():
        for goal in o.unproved:
            print(f"UNPROVED {o.unit}: {goal}")
        for error in o.errors:
            print(f"ERROR {o.unit}: {error}")
    for error in general:
        print(f"ERROR {error}")
    by_prover = {}
    for o in done:
        for prover, count in o.provers.items():
            by_prover[prover] = by_prover.get(prover, 0) + count
    print(f"total {proved} of {goals} goals proved, {len(units)} files, {skipped} skipped, {seconds:.0f} s")
    print("proved by " + ", ".join(f"{name} {count}" for name, count in sorted(by_prover.items())))
    print("tools " + ", ".join(f"{name} {version}" for name, version in versions.items()))
    if record["versions"] and record["versions"] != versions:
        print("note: goals.json was recorded with " + ", ".join(f"{n} {v}" for n, v in record["versions"].items()))
    if a.json:
        functions = [f for o in done for f in o.functions]
        write_whole(a.json, json.dumps({"goals": goals, "proved": proved, "skipped": skipped, "seconds": round(seconds, 1), "functions": functions}, indent=1) + "\n")
    ok = goals == proved and goals > 0 and skipped == 0 and not general and not any(o.errors for o in outcomes.values())
    if a.record and not sound:
        sys.stderr.write("run_proofs: --record refused: not everything is proved\n")
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
