"""It rains, or dries, while a truck is loaded: the app learns the new soil, and the truck comes full all the same."""
import csv
import json
import pathlib
import shutil
import tempfile

from berm_command import ROOT, check_slowed, load, main

WET = {"repose_deg": 42.0, "bank_slope_deg": 60.0, "resistance": 0.6, "stick_fraction": 0.06}  # the wettest that a shift draws
CHANGE_S = 80.0  # amid a truck: some 3 of its 12 passes are over


def scenario_with(folder, *changes):
    text = (ROOT / "fault_injection" / "scenarios" / "bench.toml").read_text()
    added = "".join(f"\n[[soil_change]]\nat_s = {at_s}\n" + "".join(f"{key} = {value}\n" for key, value in soil.items()) for at_s, soil in changes)
    path = folder / "rain.toml"
    path.write_text(text + added)
    return path


def a_truck_is_full_though_it_rains():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    status, result, out, text = load("--scenario", scenario_with(folder, (CHANGE_S, WET)), "--trucks", 1, "--seed", 1)
    assert status == 0, f"exit status {status}: {text[-800:]}"
    assert 0.98 * result["target_kg"] <= result["payload_kg"][0] <= result["target_kg"], result["payload_kg"]
    assert result["contacts"] == 0 and result["kernel_faults"] == 0, result
    check_slowed(result, out, text)
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    passes = [event["time_s"] for event in events if event["event"] == "pass"]
    assert passes[1] < CHANGE_S < passes[-3], f"no rain amid the truck: passes end at {passes}"
    # What is in the bucket when the next dig is to begin: nothing of dry soil; of wet what has stuck.
    with open(out / "trace.csv", newline="", encoding="utf-8") as trace:
        held = {round(float(row["time_s"]), 2): float(row["payload_kg"]) for row in csv.DictReader(trace)}
    dry = [held[round(t, 2)] for t in passes if t < CHANGE_S]
    assert max(dry) < 5.0, f"dry soil sticks: {dry}"
    sticking = [event for event in events if event["event"] == "sticking"]
    assert sticking and all(event["time_s"] > CHANGE_S for event in sticking), sticking
    print(f"{result['payload_kg'][0] / result['target_kg']:.4f} of the target, {result['passes']} passes, stops {result['kernel_stops']}, spilt {result['spill_fraction']:.4f}, {result['wall_seconds']:.0f} s of wall clock")
    shutil.rmtree(out)
    shutil.rmtree(folder)


main([a_truck_is_full_though_it_rains])
