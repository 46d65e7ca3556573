"""A person edits a copy of the scripts as planning_app/scripts/SCRIPTS.md says: the machine moves as edited and fills its truck, and a mistake is one line
with its file and line, before anything moves."""
import csv
import json
import math
import pathlib
import shutil
import tempfile

from berm_command import ROOT, load, main, one_clear_line, run

SWING_MOST_RAD_S = 0.8727  # of the machine file
# Half as fast to the truck, the bucket less curled on the way back.
EDITS = ((": goal truck_bearing mark leaves", ": goal truck_bearing pace 0.5 mark leaves"), (": goal back_bucket pace 0.7", ": goal back_bucket + 8 deg pace 0.7"))
scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-scripts-"))


def edited(name, *edits):
    folder = scratch / name
    shutil.copytree(ROOT / "planning_app/scripts", folder)
    text = (folder / "pass.script").read_text()
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    (folder / "pass.script").write_text(text)
    return folder


def motion(out):
    """Of the whole passes but the last, which may pour a part only: the fastest swing to the truck and back, rad/s, and the most curled bucket on the way back, degrees."""
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    assert all(e["clear"] for e in events if e["event"] == "script"), "the search found no pass that is clear"
    phases = [(e["time_s"], e["phase"], e["pass"]) for e in events if e["event"] == "phase"]
    with open(out / "trace.csv", newline="") as file:
        rows = [(float(row["time_s"]), abs(float(row["swing_rad_s"])), math.degrees(float(row["bucket_rad"]))) for row in csv.DictReader(file)]
    last = max(number for *_, number in phases)
    there, back, curled = [], [], []
    dumped = False
    for (begin, phase, number), (end, *_) in zip(phases, phases[1:]):
        inside = [row for row in rows if begin < row[0] < end]
        if phase == "swing to truck" and number < last - 1:
            there.append(max(row[1] for row in inside))
        if phase == "swing to dig" and dumped and number < last - 1:
            back.append(max(row[1] for row in inside))
            curled.append(min(row[2] for row in inside))
        dumped = phase == "dump"
    assert len(there) >= 2 and len(back) >= 2, phases
    return there, back, curled


def moves_as_edited():
    seen = {}
    for name, scripts in (("shipped", ()), ("edited", ("--scripts", edited("edited", *EDITS)))):
        if scripts:
            checked = run("berm_scripts", scripts[1])
            assert checked.returncode == 0, checked.stderr
        status, result, out, text = load("--scenario", "short", "--seed", 1, *scripts)
        assert status == 0, text[-500:]
        share = result["payload_kg"][0] / result["target_kg"]
        assert 0.97 <= share <= 1.01, f"{name}: {100 * share:.1f} % of the target"
        seen[name] = motion(out)
        print(f"{name}: {100 * share:.1f} % of the target, {result['pass_seconds_median']:.1f} s a pass; {seen[name]}")
        shutil.rmtree(out)
    (there, _, curled), (there_edited, back_edited, curled_edited) = seen["shipped"], seen["edited"]
    assert min(there) > 0.6 * SWING_MOST_RAD_S, f"to the truck at {there}: the edit would not be seen"
    assert max(there_edited) < 0.52 * SWING_MOST_RAD_S, f"to the truck at {there_edited} rad/s"
    assert min(back_edited) > 0.6 * SWING_MOST_RAD_S, f"back at {back_edited} rad/s: that rule was not edited"
    assert curled_edited[0] - curled[0] > 5.0, f"the bucket came back curled to {curled_edited[0]:.1f} deg, without the edit to {curled[0]:.1f}"


def a_mistake_is_told_with_its_line():
    for name, (old, new), words in (("too_fast", (EDITS[0][0], ": goal truck_bearing pace 1.5 mark leaves"), ("pace", "1.5", "0.05")),
                                    ("no_unit", (EDITS[1][0], ": goal back_bucket + 8 pace 0.7"), ("deg",)),
                                    ("other_joint", (EDITS[1][0], ": goal back_boom pace 0.7"), ("back_boom",))):
        folder = edited(name, (old, new))
        line = next(i for i, text in enumerate((folder / "pass.script").read_text().splitlines(), 1) if new in text)
        for program in (("berm_scripts", folder), ("berm_load", "--scenario", "short", "--scripts", folder, "--out", scratch / "no-run")):
            one_clear_line(run(*program), "pass.script", f"line {line}", *words)
        assert not (scratch / "no-run").exists(), "left behind by a run that never was"


try:
    main([moves_as_edited, a_mistake_is_told_with_its_line])
finally:
    shutil.rmtree(scratch)
