#!/usr/bin/python3
"""Shows that the proofs can fail: each mutant of mutants/mutants.json changes the body of one function of the core, and the proof of that
function must then leave a goal unproved. As a control the unchanged function is proved first, with the same time limit.

A line each: killed (a goal is unproved), SURVIVED, or NOT RUN (with the reason; never counted as killed). Exit 0 when all are killed."""

import argparse
import json
import os
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import wp_session

LIST = Path(__file__).resolve().parent / "mutants" / "mutants.json"
FIELDS = {"id", "file", "function", "old", "new", "what"}  # and "unit", a C file that includes `file`, where that is a header
AT_A_TIME = 2


def arguments():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--only", metavar="ID", action="append", help="this mutant only (may be repeated)")
    p.add_argument("--texts", action="store_true", help="prove nothing: only whether the text that each changes stands in the core, once")
    p.add_argument("--json", metavar="FILE", help='write {"mutants","killed","survived","not_run","results":[{"id","outcome","unproved"}]}')
    p.add_argument("--timeout", metavar="S", type=int, default=10, help="seconds for each prover and goal (default 10)")
    a = p.parse_args()
    if not 1 <= a.timeout <= 600:
        p.error("--timeout: 1 to 600 seconds")
    return a


def load(only):
    mutants = json.loads(LIST.read_text())["mutants"]
    ids = [m["id"] for m in mutants]
    for m in mutants:
        if set(m) - {"unit"} != FIELDS or ("unit" in m) != m["file"].endswith(".h"):
            raise SystemExit(f"run_mutants: {LIST.name}: {m.get('id')}: needs exactly {', '.join(sorted(FIELDS))}, and unit for a header")
        m.setdefault("unit", m["file"])
    if len(set(ids)) != len(ids):
        raise SystemExit(f"run_mutants: {LIST.name}: an id stands twice")
    for name in only or []:
        if name not in ids:
            sys.stderr.write(f"run_mutants: --only {name}: no such mutant\n")
            raise SystemExit(2)
    return [m for m in mutants if not only or m["id"] in only]


def copy_of_core(folder, name):
    core = Path(folder) / name / "core"
    shutil.copytree(wp_session.CORE, core)
    return core


def prove_function(core, unit, function, env, timeout_s):
    return wp_session.prove(core, Path(unit).stem, env, timeout_s, core.parent, ["-wp-fct", function])


def places(m, core):
    """How often the text that the mutant changes stands in the core."""
    path = core / m["file"]
    return path.read_text().count(m["old"]) if path.exists() else 0


def run_control(pair, env, timeout_s, folder):
    unit, function = pair
    out = prove_function(copy_of_core(folder, f"control-{Path(unit).stem}-{function}"), unit, function, env, timeout_s)
    sound = not out.errors and out.goals and out.goals == out.proved
    return pair, None if sound else f"the unchanged function is not proved ({out.proved} of {out.goals}) {' '.join(out.errors)}".strip()


def run_mutant(m, controls, env, timeout_s, folder):
    """Outcome and the unproved goals."""
    if controls[(m["unit"], m["function"])]:
        return "NOT RUN", [controls[(m["unit"], m["function"])]]
    core = copy_of_core(folder, f"mutant-{m['id']}")
    if places(m, core) != 1 or m["old"] == m["new"]:
        return "NOT RUN", [f"the text to change stands {places(m, core)} times in {m['file']}"]
    path = core / m["file"]
    path.write_text(path.read_text().replace(m["old"], m["new"]))
    out = prove_function(core, m["unit"], m["function"], env, timeout_s)
    if out.goals is None or out.errors:
        return "NOT RUN", out.errors
    return ("killed" if out.proved < out.goals else "SURVIVED"), out.unproved


def main():
    a = arguments()
    if a.texts:
        lost = [m for m in load(a.only) if places(m, wp_session.CORE) != 1]
        for m in lost:
            print(f"{m['id']}: its text stands {places(m, wp_session.CORE)} times in {m['file']}")
        return 1 if lost else 0
    missing = wp_session.missing_tools()
    if missing:
        sys.stderr.write(f"run_mutants: not installed: {', '.join(missing)}\n")
        return 2
    mutants = load(a.only)
    results = []
    with wp_session.work_folder() as folder, ThreadPoolExecutor(AT_A_TIME) as pool:
        env = wp_session.environment(folder)
        pairs = sorted({(m["unit"], m["function"]) for m in mutants})
        controls = dict(pool.map(lambda pair: run_control(pair, env, a.timeout, folder), pairs))
        print(f"control: {sum(c is None for c in controls.values())} of {len(pairs)} unchanged functions proved", flush=True)
        for m, (outcome, goals) in zip(mutants, pool.map(lambda x: run_mutant(x, controls, env, a.timeout, folder), mutants)):
            results.append({"id": m["id"], "outcome": outcome, "unproved": goals})
            print(f"{outcome:<9} {m['id']:<22} {m['file']}:{m['function']}: {m['what']}; {', '.join(goals[:3])}{' ...' if len(goals) > 3 else ''}", flush=True)
    count = {o: sum(r["outcome"] == o for r in results) for o in ("killed", "SURVIVED", "NOT RUN")}
    print(f"{count['killed']} of {len(results)} mutants killed, {count['SURVIVED']} survived, {count['NOT RUN']} not run")
    if a.json:
        half = Path(f"{a.json}.part")
        half.write_text(json.dumps({"mutants": len(results), "killed": count["killed"], "survived": count["SURVIVED"], "not_run": count["NOT RUN"],
                                    "results": results}, indent=1) + "\n")
        os.replace(half, a.json)
    return 0 if results and count["killed"] == len(results) else 1


if __name__ == "__main__":
    sys.exit(main())
