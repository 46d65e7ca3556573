"""Faults of the machine itself: the kernel removes power, the machine stands, nothing is touched.

A stuck valve and a joint that runs away move on until power is removed, so that they stand still shows stop category 0."""
import csv
import re
import shutil

from berm_command import ROOT, load, main

STATE_FAULT = 5
REASONS = {"state_frame": 7, "braking": 12, "uncommanded": 17}  # BERM_STOP_* of the contract
JOINTS = ("swing", "boom", "stick", "bucket")
SEED = 1
SWINGING = 0.55  # rad/s: nearly full speed


def scenario(folder, name, tables, time_s):
    """The bench with these tables at its end and this much time."""
    text = (ROOT / "fault_injection/scenarios/bench.toml").read_text()
    text = re.sub(r'(?m)^name = .*$', f'name = "{name}"', text)
    text = re.sub(r"(?m)^max_time_s = .*$", f"max_time_s = {time_s:.2f}", text)
    for table, keys in tables:
        text += f"\n[[{table}]]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items())
    path = folder / f"{name}.toml"
    path.write_text(text)
    return path


def rows_of(folder):
    with open(folder / "trace.csv", newline="") as file:
        return list(csv.DictReader(file))


_undisturbed = {}


def undisturbed():
    """A run without fault: same seed, same motion up to the fault. (rows, folder for scenario files)"""
    if not _undisturbed:
        status, result, out, text = load("--scenario", "short", "--seed", SEED)
        assert status == 0 and result["kernel_faults"] == 0, text[-500:]
        path = scenario(out, "undisturbed", [], 70.0)
        _, result, bench, text = load("--scenario", path, "--seed", SEED)
        assert result is not None and result["kernel_faults"] == 0, text[-500:]
        _undisturbed.update(rows=rows_of(bench), folder=out)
        shutil.rmtree(bench)
    return _undisturbed["rows"], _undisturbed["folder"]


def time_when(condition, after_s=0.0):
    rows, _ = undisturbed()
    for row in rows:
        if float(row["time_s"]) > after_s and condition(row):
            return float(row["time_s"])
    raise AssertionError("the undisturbed run never comes to that")


def check(name, tables, at_s, reason, stands_within_s):
    _, folder = undisturbed()
    status, result, out, text = load("--scenario", scenario(folder, name, tables, at_s + 12.0), "--seed", SEED)
    assert result is not None, text[-500:]
    rows = rows_of(out)
    faults = [row for row in rows if int(row["stop_state"]) == STATE_FAULT]
    assert faults, f"no fault: {result['kernel_stops']}"
    seen_s = float(faults[0]["time_s"])
    assert int(faults[0]["stop_reason"]) == REASONS[reason], f"reason {faults[0]['stop_reason']}"
    assert f"(first: {reason})" in text, text[-800:]
    assert result["contacts"] == 0, f"{result['contacts']} contacts"
    assert seen_s > at_s, f"a false alarm {at_s - seen_s:.2f} s before the fault"
    moving = [row for row in rows if any(abs(float(row[f"{joint}_rad_s"])) > 0.0087 for joint in JOINTS)]
    stood_s = float(moving[-1]["time_s"])
    assert stood_s < float(rows[-1]["time_s"]) - 2.0, "the machine still moves at the end"
    assert stood_s - seen_s < stands_within_s, f"it stood only {stood_s - seen_s:.2f} s after the fault was seen"
    assert status != 0, "a run with a kernel fault is no success"
    print(f"{name}: {reason} seen {seen_s - at_s:.2f} s after the fault began to act, standstill {stood_s - seen_s:.2f} s later, "
          f"closest {result['closest_approach_m']:.2f} m")
    shutil.rmtree(out)


def loaded_swing(row):
    return float(row["swing_rad_s"]) > SWINGING and float(row["payload_kg"]) > 1000.0


def weak_swing_brake_is_braking():
    at = time_when(lambda row: loaded_swing(row) and float(row["swing_rad_s"]) > 0.65)
    check("weak_swing_brake", [("machine_fault", {"kind": '"weak_brake"', "joint": '"swing"', "at_s": at, "factor": 0.5}),
                               ("panel", {"action": '"stop"', "at_s": at, "for_s": 1.0})], at, "braking", 3.0)


def stuck_boom_valve_goes_on_after_zero():
    """The operator stops a boom that goes up with a load: told zero, it goes on at its speed, which is no speed it was not told, but no braking."""
    at = time_when(lambda row: 0.3 < float(row["boom_rad_s"]) and float(row["boom_rad"]) < 0.5 and float(row["payload_kg"]) > 1000.0)
    check("stuck_boom_valve", [("machine_fault", {"kind": '"stuck_valve"', "joint": '"boom"', "at_s": at}),
                               ("panel", {"action": '"pause"', "at_s": at + 0.2, "for_s": 30.0})], at, "braking", 1.0)


def stuck_swing_valve_stands():
    at = time_when(lambda row: loaded_swing(row))
    check("stuck_swing_valve", [("machine_fault", {"kind": '"stuck_valve"', "joint": '"swing"', "at_s": at}),
                                ("panel", {"action": '"pause"', "at_s": at + 0.2, "for_s": 30.0})], at, "braking", 4.0)


def joints_that_move_untold_are_uncommanded():
    """The swing while it stands over the truck (it turns round before the bucket is empty), the others while it swings back."""
    dumping = time_when(lambda row: 900.0 < float(row["payload_kg"]) < 1300.0 and abs(float(row["swing_rad_s"])) < 0.001 and float(row["swing_rad"]) > 1.0)
    # Boom and stick wait there between folding and reaching out: what they do then nobody asked for.
    back = time_when(lambda row: float(row["swing_rad_s"]) < -0.8 * SWINGING and abs(float(row["boom_rad_s"])) < 0.001 and abs(float(row["stick_rad_s"])) < 0.001)
    for joint, factor, at in (("swing", -0.5, dumping), ("boom", -0.5, back), ("stick", 0.5, back), ("bucket", 1.0, back)):
        check(f"runaway_{joint}", [("machine_fault", {"kind": '"runaway"', "joint": f'"{joint}"', "at_s": at, "factor": factor})], at, "uncommanded", 3.0)


def stuck_angles_are_bad_state_frames():
    """The angle's sensor of a joint in full motion says what it said: the speed goes on, so one of the two lies."""
    swing = time_when(loaded_swing)
    boom = time_when(lambda row: abs(float(row["boom_rad_s"])) > 0.3 and abs(float(row["swing_rad_s"])) > 0.1)
    stick = time_when(lambda row: abs(float(row["stick_rad_s"])) > 0.3, swing)
    for joint, at in (("swing", swing), ("boom", boom), ("stick", stick)):
        check(f"stuck_angle_{joint}", [("machine_fault", {"kind": '"stuck_angle"', "joint": f'"{joint}"', "at_s": at})], at, "state_frame", 3.0)


main([stuck_angles_are_bad_state_frames, weak_swing_brake_is_braking, stuck_boom_valve_goes_on_after_zero, stuck_swing_valve_stands, joints_that_move_untold_are_uncommanded])
