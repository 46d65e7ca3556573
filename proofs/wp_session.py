"""One run of Frama-C/WP over one file of the core, and what it said. Used by run_proofs.py and run_mutants.py."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CORE = ROOT / "safety_kernel" / "core"
TOOLS = ("frama-c", "why3", "cvc4", "z3", "gcc")
READING = ["-machdep", "gcc_x86_64", "-c11"]
RULES = ["-wp", "-wp-rte", "-wp-prover", "cvc4,z3", "-wp-par", "1", "-wp-cache", "none", "-warn-unsigned-overflow", "-warn-signed-downcast"]
FILE_LIMIT_S = 3600
QUICK_S = 6  # nearly all goals take less than 2 s; a prover that cannot settle a goal then costs only this


@dataclass
class Outcome:
    """goals and proved are None when Frama-C did not finish the file."""
    unit: str
    goals: int | None = None
    proved: int | None = None
    seconds: float = 0.0
    functions: list = field(default_factory=list)  # {"name", "goals", "proved"}
    unproved: list = field(default_factory=list)   # goal names
    provers: dict = field(default_factory=dict)    # prover -> goals it proved
    errors: list = field(default_factory=list)


def missing_tools():
    return [t for t in TOOLS if shutil.which(t) is None]


def versions():
    def first_line(*command):
        return subprocess.run(command, capture_output=True, text=True).stdout.strip().splitlines()[0]
    return {
        "frama-c": first_line("frama-c", "-version"),
        "why3": first_line("why3", "--version").removeprefix("Why3 platform, version "),
        "cvc4": first_line("cvc4", "--version").split("version ")[-1].split()[0],
        "z3": first_line("z3", "--version").split("version ")[-1].split()[0],
    }


def environment(folder):
    """A Why3 configuration of this run's own, so that nobody's home decides which provers there are."""
    env = dict(os.environ, WHY3CONFIG=str(Path(folder) / "why3.conf"), LC_ALL="C.UTF-8", TMPDIR=str(folder))
    found = subprocess.run(["why3", "config", "detect"], env=env, capture_output=True, text=True)
    said = found.stdout + found.stderr
    for prover in ("CVC4", "Z3"):
        if not re.search(rf"Found prover {prover} version .*OK", said):
            raise RuntimeError(f"why3 finds no usable {prover}: {said.strip()}")
    return env


def at(core, env):
    """Frama-C takes the folder it is in from PWD."""
    return {"cwd": core, "env": dict(env, PWD=str(core)), "capture_output": True, "text": True}


def include_options(core):
    return [f"-cpp-extra-args=-I{core.parent} -I{ROOT / 'interface_spec'}"]


def parsed_source(core, unit, env):
    """The file as Frama-C understood it: one contract a function."""
    done = subprocess.run(["frama-c", *READING, *include_options(core), f"{unit}.c", "-print"], **at(core, env))
    if done.returncode != 0:
        raise RuntimeError(done.stdout.strip()[-400:])
    return done.stdout


def contracts(source):
    """Names of functions: defined with a contract, defined without, declared with a contract and not defined here."""
    with_contract, without, external = set(), set(), set()
    pattern = re.compile(r"^(?!/\*|\s|#|\}|\{|@|typedef|struct|enum)[^\n;{}=]*?\b(\w+)\([^;{}=]*?\)\s*(;|\n\{)", re.M)
    for match in pattern.finditer(source):
        name, end = match.group(1), match.group(2)
        before = source[:match.start()].rstrip()
        contract = ""
        if before.endswith("*/"):
            contract = before[before.rindex("/*@"):] if "/*@" in before else ""
        complete = "ensures" in contract and "assigns" in contract
        if end == ";":
            if complete:
                external.add(name)
        elif complete:
            with_contract.add(name)
        else:
            without.add(name)
    return with_contract, without, external - with_contract - without


def assumptions(core, unit):
    """Annotations that would be believed without proof."""
    bad = []
    for name in (f"{unit}.c", f"{unit}.h"):
        path = core / name
        if path.exists():
            for annotation in re.findall(r"/\*@.*?\*/|//@[^\n]*", path.read_text(), re.S):
                for word in re.findall(r"\b(axiom|axiomatic|admit)\b", annotation):
                    bad.append(f"{name}: '{word}' in an annotation is an assumption, not a proof")
    return bad


def prove_file(core, unit, env, timeout_s, folder):
    """First with a short limit a goal; then what holds an unproved goal (a hard one, a slow machine) once more with the whole limit."""
    out = prove(core, unit, env, min(QUICK_S, timeout_s), folder)
    if not out.unproved or out.errors or timeout_s <= QUICK_S:
        return out
    unproved = [f for f in out.functions if f["proved"] < f["goals"]]
    functions = [f["name"] for f in unproved if f["kind"] == "function"]
    lemmas = [f["name"] for f in unproved if f["kind"] != "function"]
    if functions:
        out = merged(out, prove(core, unit, env, timeout_s, folder, ["-wp-fct", ",".join(functions)]), functions)
    if lemmas:
        out = merged(out, prove(core, unit, env, timeout_s, folder, ["-wp-prop", "@lemma"]), lemmas)
    return out


def merged(first, again, functions):
    """The first outcome with these functions (or groups of lemmas) as they came out the second time."""
    second = {f["name"]: f for f in again.functions}
    out = Outcome(first.unit, seconds=first.seconds + again.seconds, provers=first.provers, errors=first.errors + again.errors, unproved=[])
    for f in first.functions:
        redone = second.get(f["name"]) if f["name"] in functions else f
        if redone is None or redone["goals"] != f["goals"]:
            out.errors.append(f"function {f['name']} has other goals when it is proved by itself")
            redone = f
        out.functions.append(redone)
    out.goals, out.proved = sum(f["goals"] for f in out.functions), sum(f["proved"] for f in out.functions)
    out.unproved = again.unproved if out.proved < out.goals else []
    for prover, count in again.provers.items():
        out.provers[prover] = out.provers.get(prover, 0) + count
    return out


def prove(core, unit, env, timeout_s, folder, restriction=()):
    out = Outcome(unit)
    report = Path(folder) / f"{unit}.json"
    command = ["frama-c", *READING, *include_options(core), f"{unit}.c", *RULES, "-wp-timeout", str(timeout_s), "-wp-report-json", str(report)]
    command += restriction
    begin = time.monotonic()
    try:
        done = subprocess.run(command, timeout=FILE_LIMIT_S, **at(core, env))
    except subprocess.TimeoutExpired:
        out.errors.append(f"not finished in {FILE_LIMIT_S} s")
        return out
    finally:
        out.seconds = time.monotonic() - begin
    text = done.stdout + done.stderr
    if done.returncode != 0:
        out.errors.append(f"frama-c ended with {done.returncode}: {text.strip()[-400:]}")
    out.errors += [f"frama-c warns: {line.strip()}" for line in text.splitlines() if re.search(r"\bWarning:", line)]
    total = re.findall(r"Proved goals:\s*(\d+)\s*/\s*(\d+)", text)
    if len(total) != 1 or not report.exists():
        out.errors.append(f"no result: {text.strip()[-400:]}")
        return out
    out.proved, out.goals = int(total[0][0]), int(total[0][1])
    out.unproved = re.findall(r"\[(?:Failed|Timeout|Unknown|Stepout)\] Goal (\S+)", text)
    read_report(json.loads(report.read_text()), out)
    return out


def read_report(report, out):
    """Per function, and the cross-check of the report against the printed total."""
    for section in report:
        if section not in ("wp:global", "wp:functions", "wp:axiomatics"):
            out.errors.append(f"unknown section {section} in the report")
    for group in ("wp:functions", "wp:axiomatics"):
        for name, goals in report.get(group, {}).items():
            entries = [g.get("wp:main", {}) for key, g in goals.items() if not key.startswith("wp:")]
            out.functions.append({"name": name, "kind": group.removeprefix("wp:").removesuffix("s"), "goals": sum(e.get("total", 0) for e in entries), "proved": sum(e.get("valid", 0) for e in entries)})
    for prover, counts in report.get("wp:global", {}).items():
        if prover != "wp:main":
            out.provers[prover] = counts.get("valid", 0)
    counted = (sum(f["proved"] for f in out.functions), sum(f["goals"] for f in out.functions))
    if counted != (out.proved, out.goals):
        out.errors.append(f"the report counts {counted[0]} / {counted[1]}, frama-c printed {out.proved} / {out.goals}")


def work_folder():
    return tempfile.TemporaryDirectory(prefix="berm_proofs_")
