"""A run switch that is left on through a reset: the kernel's process stands by, and the machine goes on only when the switch was switched off and on. So at the start.

verifies: SK-CY-3, SK-ST-6"""
import csv
import json
import pathlib
import shutil
import tempfile

from berm_command import ROOT, load, main, run

STANDBY, RUN, LATCHED = "1", "2", ("4", "5")
STILL_RAD_S = 0.009
# Switched on before the ground that the standing implements hide is 20 s old: that is a reason of its own to stand by.
STOP_S, RESET_S, OFF_S, ON_S, END_S = 25.0, 32.0, 38.0, 39.0, 80.0
JOINTS = ("swing", "boom", "stick", "bucket")
KEYS = (("stop", STOP_S, 0.5), ("reset", RESET_S, 0.5), ("pause", OFF_S, ON_S - OFF_S))


def left_on(folder, stop):
    """short.toml with a stop, a reset that nobody pauses for, and much later a pause."""
    text = (ROOT / "fault_injection/scenarios/short.toml").read_text()
    assert text.count("max_time_s = 1800.0") == 1
    text = text.replace("max_time_s = 1800.0", f"max_time_s = {END_S}")
    for action, at_s, for_s in KEYS:
        text += f'\n[[panel]]\naction = "{stop if action == "stop" else action}"\nat_s = {at_s}\nfor_s = {for_s}\n'
    path = folder / "left_on.toml"
    path.write_text(text)
    return path


def stands_by_until_it_is_switched_off_and_on(stop, reason):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    _, result, out, text = load("--scenario", left_on(folder, stop), "--seed", 1)
    assert result is not None, text[-500:]
    assert result["contacts"] == 0 and result["kernel_stops"].get(reason, 0) == 1, result
    with open(out / "trace.csv", newline="") as file:
        rows = [(float(row["time_s"]), row["stop_state"], max(abs(float(row[f"{joint}_rad_s"])) for joint in JOINTS)) for row in csv.DictReader(file)]
    before = {state for t, state, _ in rows if RESET_S - 1.0 < t < RESET_S}
    assert before and before <= set(LATCHED), f"not latched before the reset: {before}"
    assert max(speed for t, _, speed in rows if STOP_S - 10.0 < t < STOP_S) > 0.1, "it stood before it was stopped"
    between = [(t, state, speed) for t, state, speed in rows if RESET_S + 0.3 < t < ON_S]
    assert {state for _, state, _ in between} == {STANDBY}, f"states after the reset: {sorted({state for _, state, _ in between})}"
    moving = [t for t, _, speed in between if speed > STILL_RAD_S]
    assert not moving, f"moves at {moving[:3]} s with a run switch that was left on"
    after = [(t, speed) for t, state, speed in rows if t > ON_S and state == RUN]
    assert after and after[0][0] < ON_S + 1.0, "does not run when it was switched off and on"
    assert max(speed for _, speed in after) > 0.1, "runs, and does not move"
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    told = [e["time_s"] for e in events if e["event"] == "operator_needed" and e["reason"] == "run switch left on"]
    assert len(told) == 1 and RESET_S < told[0] < OFF_S, f"the operator was told at {told}"
    replayed = run("berm_replay", out / "journal.mcap")
    assert replayed.returncode == 0, replayed.stdout[-500:]
    shutil.rmtree(out)
    shutil.rmtree(folder)


def operator_stop():
    stands_by_until_it_is_switched_off_and_on("stop", "operator")


def emergency_stop():
    stands_by_until_it_is_switched_off_and_on("emergency", "emergency")


def who_starts_it_looks_at_the_panel_first():
    """A scenario in which the run switch is to be on from the first moment: the operator waits until the kernel stands by, or it would never run."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    text = (ROOT / "fault_injection/scenarios/short.toml").read_text()
    for old, new in (("max_time_s = 1800.0", "max_time_s = 12.0"), ("operator_run_from_s = 0.5", "operator_run_from_s = 0.0")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    (folder / "at_once.toml").write_text(text)
    _, result, out, text = load("--scenario", folder / "at_once.toml", "--seed", 1)
    assert result is not None, text[-500:]
    with open(out / "trace.csv", newline="") as file:
        states = [row["stop_state"] for row in csv.DictReader(file)]
    assert RUN in states, f"never runs: {sorted(set(states))}"
    shutil.rmtree(out)
    shutil.rmtree(folder)


main([operator_stop, emergency_stop, who_starts_it_looks_at_the_panel_first])
