"""Somebody walks up to the upper body's tail during loading, and the machine stands before the tail is within reach of him; and a lidar whose window is
covered, that falls silent, or whose head no longer turns, holds the machine. Judged by the plant's oracle and its trace.

verifies: SK-TS-1, SK-TS-5, SK-TS-6, SK-LI-2, SK-LI-3, SK-LI-9"""
import csv
import math
import pathlib
import shutil
import tempfile

from berm_command import ROOT, load, main, run

STILL_RAD_S = 0.009
RESET_S = 85.0
TAIL_RADIUS = 2.907  # m: of the plant's upper body, [-2.60, 1.30]
PERSON_RADIUS = 0.25
SCENARIOS = ROOT / "fault_injection" / "scenarios"
STOPPING = 3
SWING_STANDS_WITHIN_S = 1.5
JOINTS = ("swing", "boom", "stick", "bucket")


def rows(trace):
    with open(trace, newline="") as file:
        yield from csv.DictReader(file)


def speed(row):
    return max(abs(float(row[f"{joint}_rad_s"])) for joint in JOINTS)


def stopped(trace):
    """The row in which the kernel first begins to stop the machine."""
    return next(row for row in trace if int(row["stop_state"]) == STOPPING)


def moves(trace, from_s, until_s):
    return [row["time_s"] for row in trace if from_s < float(row["time_s"]) < until_s and speed(row) > STILL_RAD_S]


def gap(row):
    return math.hypot(float(row["person_x_m"]), float(row["person_y_m"])) - PERSON_RADIUS - TAIL_RADIUS


def person_behind():
    for seed in (1, 2):
        status, result, out, text = load("--scenario", "person_behind", "--seed", seed)
        assert result is not None, text[-500:]
        assert result["contacts"] == 0, f"seed {seed}: {result['contacts']} contacts"
        assert result["tail_watched"] is True
        assert result["kernel_stops"].get("tail", 0) >= 1, f"seed {seed}: kernel stops {result['kernel_stops']}"
        trace = list(rows(out / "trace.csv"))
        stop = stopped(trace)
        stopped_s = float(stop["time_s"])
        assert stopped_s < 40.0 and 0.6 < gap(stop) < 2.0, f"seed {seed}: stopped at {stopped_s:.2f} s with the person {gap(stop):.2f} m from the tail's circle: not for him"
        late = moves(trace, stopped_s + SWING_STANDS_WITHIN_S, RESET_S)
        assert not late, f"seed {seed}: moves at {late[:3]} s, stopped at {stopped_s:.2f} s, before the reset"
        near = [row["time_s"] for row in trace if gap(row) < 0.35 and speed(row) >= STILL_RAD_S]  # as near as he comes, and he stays there
        assert not near, f"seed {seed}: moves at {near[:3]} s with the person there"
        moved_again = next((float(row["time_s"]) for row in trace if float(row["time_s"]) > RESET_S and speed(row) > 0.1), None)
        assert moved_again is not None, f"seed {seed}: does not go on after the reset"
        assert result["closest_approach_m"] > 0.3, f"seed {seed}: closest approach {result['closest_approach_m']}"
        assert status == 0, f"seed {seed}: the truck was not loaded after the reset"
        print(f"seed {seed}: stopped at {stopped_s:.2f} s, person within {min(map(gap, trace)):.2f} m of the tail's circle, "
              f"closest approach {result['closest_approach_m']:.2f} m, moves again at {moved_again:.2f} s")
        replayed = run("berm_replay", out / "journal.mcap")
        assert replayed.returncode == 0, replayed.stdout[-500:]
        shutil.rmtree(out)


def person_behind_a_swing():
    """He comes while it swings to the truck, and on its way back, as fast as it does: it stands before the tail has reached him."""
    text = (SCENARIOS / "person_behind.toml").read_text()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    for way, start, wait in (("there", 20.0, 7.2), ("back", 36.0, 0.0)):
        scenario = folder / f"behind_a_swing_{way}.toml"
        changed = text
        for old, new in (("start_s = 20.0", f"start_s = {start}"), ("wait_s = 4.7", f"wait_s = {wait}"), ("max_time_s = 1800.0", "max_time_s = 55.0")):
            assert changed.count(old) == 1, old
            changed = changed.replace(old, new)
        scenario.write_text(changed)
        for seed in (1, 2):
            _, result, out, output = load("--scenario", scenario, "--seed", seed)
            assert result is not None, output[-500:]
            assert result["contacts"] == 0 and result["kernel_stops"] == {"tail": 1}, f"{way}, seed {seed}: {result['contacts']} contacts, kernel stops {result['kernel_stops']}"
            trace = list(rows(out / "trace.csv"))
            stop = stopped(trace)
            stopped_s, swing = float(stop["time_s"]), abs(float(stop["swing_rad_s"]))
            assert swing > 0.4, f"{way}, seed {seed}: stopped from {swing:.2f} rad/s: the test asks for a swing"
            late = moves(trace, stopped_s + SWING_STANDS_WITHIN_S, math.inf)
            assert not late, f"{way}, seed {seed}: moves at {late[:3]} s, stopped at {stopped_s:.2f} s"
            assert result["closest_approach_m"] > 0.3, f"{way}, seed {seed}: closest approach {result['closest_approach_m']}"
            print(f"{way}, seed {seed}: stopped from {swing:.2f} rad/s at {stopped_s:.2f} s, closest approach {result['closest_approach_m']:.2f} m")
            shutil.rmtree(out)
    shutil.rmtree(folder)


def held_while(scenario, reasons, from_s, until_s, within_s):
    status, result, out, text = load("--scenario", scenario, "--seed", 1)
    assert result is not None, text[-500:]
    assert result["contacts"] == 0
    assert any(result["kernel_stops"].get(reason, 0) >= 1 for reason in reasons), f"kernel stops {result['kernel_stops']}"
    late = [float(row["time_s"]) for row in rows(out / "trace.csv") if from_s + within_s < float(row["time_s"]) < until_s and speed(row) > STILL_RAD_S]
    assert not late, f"moves at {late[:3]} s while the lidar sees nothing"
    replayed = run("berm_replay", out / "journal.mcap")
    assert replayed.returncode == 0, replayed.stdout[-500:]
    shutil.rmtree(out)
    return status, result


def blocked_lidar():
    # The swing needs up to 3 s to stand.
    _, result = held_while("lidar_blocked", ("sensor_blocked",), 30.0, 55.0, 3.5)
    assert result["kernel_faults"] >= 1, result
    assert result["trucks_loaded"] == 1, "the truck was not loaded after the reset"


def other_lidar_fault(kind, max_time_s, until_s):
    text = (SCENARIOS / "lidar_blocked.toml").read_text()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    scenario = folder / f"lidar_{kind}.toml"
    scenario.write_text(text.replace('kind = "blocked"', f'kind = "{kind}"').replace("max_time_s = 1800.0", f"max_time_s = {max_time_s}"))
    _, result = held_while(scenario, ("scanner_silent",), 30.0, until_s, 3.5)
    assert result["kernel_faults"] >= 1, result
    shutil.rmtree(folder)
    return result


def silent_lidar():
    result = other_lidar_fault("silent", 300.0, 55.0)
    assert result["trucks_loaded"] == 1 and result["end_reason"] == "finished", "the truck was not loaded after the reset"


def stalled_lidar():
    other_lidar_fault("stalled", 45.0, 45.0)


main([person_behind, person_behind_a_swing, blocked_lidar, silent_lidar, stalled_lidar])
