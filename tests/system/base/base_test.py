"""The machine's base tilts, its tracks turn, or slip without a turn, in the swing: the kernel stops within the stated time, and after the reset
work goes on: the truck is looked at anew where it is now.

verifies: SK-BM-10, SK-BM-12, SK-BM-20, SK-BM-24"""
import csv
import json
import math
import shutil

from berm_command import load, main

STOPPED = 4
WHY = "base_moved"
REASON = 16
RUN = 2
STILL_RAD_S = 0.009
JOINTS = ("swing", "boom", "stick", "bucket")


def rows(trace):
    with open(trace, newline="") as file:
        yield from csv.DictReader(file)


def looks_anew(out, who, motion, reset_s):
    """After the reset the truck is recognised once more, where the base's motion (x, y, yaw in degrees) has left it in the base frame."""
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    assert len([e for e in events if e["event"] == "base_moved"]) == 1, f"{who}: no word that all is looked at anew"
    first, again = [e for e in events if e["event"] == "recognised"]
    assert first["time_s"] < reset_s < again["time_s"], f"{who}: recognised at {first['time_s']} and {again['time_s']} s"
    x, y, yaw = first["x_m"] - motion[0], first["y_m"] - motion[1], math.radians(-motion[2])
    off = math.hypot(again["x_m"] - x * math.cos(yaw) + y * math.sin(yaw), again["y_m"] - x * math.sin(yaw) - y * math.cos(yaw))
    assert off < 0.05, f"{who}: the truck is seen {off:.3f} m from where it is after the slip"


def stops_and_goes_on(scenario, seed, found_within_s, motion, moves_from_s=5.0, reset_s=45.0):
    status, result, out, text = load("--scenario", scenario, "--seed", seed)
    assert result is not None, text[-500:]
    who = f"{scenario}, seed {seed}"
    assert result["contacts"] == 0, f"{who}: {result['contacts']} contacts"
    assert result["kernel_stops"].get(WHY, 0) == 1, f"{who}: kernel stops {result['kernel_stops']}"
    began = found = stood = moved_again = None
    swing_speed = spilled = spilled_by_then = 0.0
    for row in rows(out / "trace.csv"):
        t = float(row["time_s"])
        spilled = float(row["spilled_kg"])
        if t <= reset_s:
            spilled_by_then = spilled
        speed = max(abs(float(row[f"{joint}_rad_s"])) for joint in JOINTS)
        if began is None and t >= moves_from_s and float(row["swing_rad"]) > 0.7854:
            began, swing_speed = t, abs(float(row["swing_rad_s"]))
        if int(row["stop_reason"]) == REASON and found is None:
            assert began is not None, f"{who}: called moved at {t:.2f} s, before it did"
            found = t
        if found is not None and stood is None and speed < STILL_RAD_S:
            stood = t
        if stood is not None and t < reset_s:
            assert speed < STILL_RAD_S, f"{who}: moves at {t:.2f} s, before the reset"
        if t > reset_s and moved_again is None and speed > 0.1:
            moved_again = t
    assert began is not None and swing_speed > 0.1, f"{who}: the base moved while the swing went at {swing_speed:.2f} rad/s"
    assert found is not None and found - began <= found_within_s, f"{who}: base moves at {began}, found at {found}"
    assert stood is not None and stood - found < 3.0, f"{who}: found at {found}, stood at {stood}"
    assert moved_again is not None, f"{who}: does not move again after the reset"
    print(f"{who}: found after {found - began:.2f} s, stood after {stood - began:.2f} s, moves again at {moved_again:.2f} s, loaded: {status == 0}")
    looks_anew(out, who, motion, reset_s)
    # What was poured beside the truck before the slip was found is in the books as loaded; from the reset on nothing is.
    target, loaded = result["target_kg"], result["payload_kg"][0]
    assert "truck 1 is full" in text and 0.95 * target <= loaded + spilled_by_then <= 1.03 * target, f"{who}: {loaded:.0f} kg in the truck"
    assert spilled - spilled_by_then < 0.015 * target, f"{who}: {spilled - spilled_by_then:.0f} kg are spilled after the reset"
    assert max(result["app_hold_seconds"], default=0.0) < 5.0, f"{who}: the app holds itself back for {result['app_hold_seconds']}"
    shutil.rmtree(out)


def tilt():
    # 1 degree in 0.5 s passes the limit after 0.25 s, at the latest 0.32 s with the sensor's error; then 15 frames of 20 ms.
    stops_and_goes_on("base_tilts", 1, 0.70, (0.0, 0.0, 0.0))


def turn():
    # 1.5 degrees in 0.5 s passes it after 0.17 s; then 3 frames of 100 ms.
    stops_and_goes_on("base_slips", 1, 0.60, (0.05, -0.10, -1.5))


def slip():
    # Half a metre in 0.5 s, which no frame shows: found by the terrain that is seen in the next seconds, with the whole window of 4 s at the latest.
    for seed in (1, 2):
        stops_and_goes_on("base_shifts", seed, 8.0, (0.40, -0.30, 0.0), moves_from_s=52.0, reset_s=100.0)


main([tilt, turn, slip])
