"""Somebody comes while the bucket is in the dig, and leaves: the machine stands for him, and then goes on by itself, with no other stop. By then the bucket
has hidden the ground under it for longer than it counts as seen: one such visit was up to eight stops more."""
import json
import pathlib
import re
import shutil
import tempfile

from berm_command import ROOT, load, main

LEARNED_S = 70.0         # by then the Workspace Monitor has learned the ground
INTO_DIG_S = (0.6, 1.9)  # of some 2.5 s
COMES_IN_S = 0.5         # from setting out to the machine's stop, or less
STANDS_S = 22.0          # longer than kernel.fresh


def scenario(folder, start_s, until_s):
    """person_ring.toml with a truck that takes a dozen buckets; the person stays at the region's rim."""
    path = folder / "in_dig.toml"
    text = (ROOT / "fault_injection" / "scenarios" / "person_ring.toml").read_text()
    for old, new in ((r"(?m)^target_kg = .*$", "target_kg = 18000.0"), (r"(?m)^max_time_s = .*$", f"max_time_s = {until_s:.2f}"),
                     (r"(?m)^start_s = .*$", f"start_s = {start_s:.2f}"), (r"at = \[-5\.0, -0\.5\]\nwait_s = 10\.0", f"at = [-9.0, -2.0]\nwait_s = {STANDS_S}")):
        text, changed = re.subn(old, new, text)
        assert changed == 1, f"{changed} times {old}"
    path.write_text(text)
    return path


def run_with(start_s, until_s):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    try:
        _, result, out, text = load("--scenario", scenario(folder, start_s, until_s), "--seed", 1)
        assert result is not None, text[-500:]
        return result, [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    finally:
        shutil.rmtree(folder)
        if "out" in locals():
            shutil.rmtree(out)


def phases(events):
    return [(event["time_s"], event["phase"]) for event in events if event["event"] == "phase"]


def goes_on_after_somebody_came_during_a_dig():
    _, events = run_with(1000.0, LEARNED_S + 25.0)
    dig_s = next(time_s for time_s, phase in phases(events) if phase == "dig" and time_s > LEARNED_S)
    for into_dig_s in INTO_DIG_S:
        came_s = dig_s + into_dig_s
        result, events = run_with(came_s - COMES_IN_S, came_s + 65.0)
        stops = [event for event in events if event["event"] == "stopped" and event["time_s"] > LEARNED_S]
        assert stops and stops[0]["reason"] == "intruder", f"{into_dig_s} s into the dig: {stops}"
        began_s, phase = [p for p in phases(events) if p[0] <= stops[0]["time_s"]][-1]
        assert phase == "dig", f"stopped in '{phase}', {stops[0]['time_s'] - began_s:.1f} s after its begin: the test asks for a dig"
        assert result["kernel_stops"] == {"intruder": 1}, f"{into_dig_s} s into the dig: {result['kernel_stops']}"
        assert result["contacts"] == 0
        calls = [event for event in events if event["event"] == "operator_needed"]
        assert not calls, f"{into_dig_s} s into the dig the operator was called: {calls}"
        stood_s = next(event["time_s"] for event in events if event["event"] == "resumed" and event["time_s"] > stops[0]["time_s"]) - stops[0]["time_s"]
        assert stood_s > STANDS_S, f"it went on after {stood_s:.1f} s"
        dumps = [time_s for time_s, phase in phases(events) if phase == "dump" and time_s > stops[0]["time_s"]]
        assert dumps, f"{into_dig_s} s into the dig: nothing was dumped after the visit"
        print(f"{into_dig_s} s into the dig: the plan is in charge again {stood_s:.1f} s after the stop, a bucket is dumped at {dumps[0] - stops[0]['time_s']:.1f} s")


main([goes_on_after_somebody_came_during_a_dig])
