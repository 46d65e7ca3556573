"""One run of Why3 over one file of theorems (theorems/*.mlw), and what it said. Used by run_proofs.py."""

import re
import subprocess
import time

from wp_session import ROOT, Outcome

FOLDER = ROOT / "proofs" / "theorems"
PROVERS = {"z3": "Z3", "cvc4": "CVC4"}  # Why3's name, and the report's
RESULT = re.compile(r"^Prover result is: (.*)$", re.M)


def assumptions(text):
    """What would be believed without proof: premises belong into the statements. Of Why3's library, the integers alone."""
    code = re.sub(r"\(\*.*?\*\)", "", text, flags=re.S)
    bad = [f"'{word}' is an assumption, not a proof" for word in re.findall(r"\b(axiom|assume|admit|val|any)\b", code)]
    return bad + [f"uses {name}" for name in re.findall(r"\buse\s+(?:import\s+)?(\S+)", code) if name != "int.Int"]


def results(path, env, prover, timeout_s):
    done = subprocess.run(["why3", "prove", "-a", "split_vc", "-P", prover, "-t", str(timeout_s), path.name], cwd=path.parent, env=env, capture_output=True, text=True)
    said = done.stdout + done.stderr
    found = [result.startswith("Valid") for result in RESULT.findall(said)]
    goals = [" ".join(goal.split()) for goal in re.findall(r"^(?:Sub-goal|Goal)\s([^.]*)\.$", said, re.M)]
    if not found or len(found) != len(goals):
        raise RuntimeError(f"no result: {said.strip()[-400:]}")
    return goals, found


def prove_file(unit, env, timeout_s, tools):
    """Each goal by the first prover; what that leaves, by the next. tools: the provers' versions."""
    out = Outcome(unit)
    path = FOLDER / f"{unit}.mlw"
    begin = time.monotonic()
    proved = []
    out.errors += [f"{path.name}: {bad}" for bad in assumptions(path.read_text())]
    try:
        for prover, reported in PROVERS.items():
            goals, found = results(path, env, prover, timeout_s)
            if proved and len(found) != len(proved):
                raise RuntimeError(f"{prover} is asked other goals than the prover before")
            before = proved or [False] * len(found)
            out.provers[f"{reported}:{tools[prover]}"] = sum(now and not was for now, was in zip(found, before))
            proved = [now or was for now, was in zip(found, before)]
            if all(proved):
                break
    except RuntimeError as e:
        out.errors.append(str(e))
        return out
    finally:
        out.seconds = time.monotonic() - begin
    out.goals, out.proved = len(proved), sum(proved)
    out.unproved = [goal for goal, valid in zip(goals, proved) if not valid]
    out.functions = [{"name": unit, "kind": "theorem", "goals": out.goals, "proved": out.proved}]
    return out
