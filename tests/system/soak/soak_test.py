"""A few minutes of a shift end with a whole report and a scenario that runs again; and a bench that is soon dug out is moved back from, the work goes on."""
import csv
import json
import math
import pathlib
import shutil
import subprocess
import tempfile
import tomllib

from berm_command import BIN, ROOT, load, main, run

KEYS = ("hours", "trucks", "tonnes_per_hour", "needless_stops", "memory_growth_kib_per_hour", "realtime_factor", "kernel_stops", "own_motion_stops", "soil",
        "pass_seconds_median", "pass_seconds_p95", "kinematic_ratio_median", "dig_surface_error_m", "plan_ms_max", "closest_approach_m", "stuck")
INTO_DIG_S = 2.24  # of some 2.4 s: the bucket is deep in the face


def short_shift():
    out = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    done = run("berm_soak", "--hours", "0.05", "--seed", "1", "--out", out, "--json", out / "report.json", timeout=900)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-1000:]
    report = json.loads((out / "report.json").read_text())
    for key in KEYS:
        assert key in report, f"the report lacks {key}"
    assert abs(report["hours"] - 0.05) < 1e-3 and report["contacts"] == 0, report
    assert report["passes"] >= 3 and report["tonnes_per_hour"] > 10, report
    assert report["soil"] == tomllib.loads((out / "scenario.toml").read_text()).get("soil_change", []), report["soil"]
    checked = run("berm_plant", "--scenario", out / "scenario.toml", "--can", "udp:239.255.66.1:45000", "--scan-port", "45001", "--out", out / "again", "--check")
    assert checked.returncode == 0, checked.stderr
    shutil.rmtree(out)


def how_it_runs_again():
    """By the scenario that is left, or where none is, by the same draw."""
    for out in (None, pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))):
        command = [str(BIN / "berm_soak"), "--hours", "0.025", "--seed", "7", *(("--out", str(out)) if out else ())]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        again = process.stdout.readline().split("run again: ")[1].strip()
        process.terminate()
        process.communicate(timeout=120)
        if out is None:
            assert again == "./berm soak --hours 0.025 --seed 7", again
        else:
            assert again.startswith(f"./berm load --scenario {out}/scenario.toml --seed 7 --trucks ") and (out / "scenario.toml").exists(), again
            shutil.rmtree(out)


def bench_move():
    """A dig zone that reaches hardly beyond the crest holds a few buckets: the machine is moved, and a truck that was part filled is filled."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    text = (ROOT / "fault_injection/scenarios/shift.toml").read_text()
    assert "crest_x = 6.0" in text and "toe_x = 7.5" in text
    # The face begins farther in than the machine would want it: one truck's soil is hardly within reach.
    (folder / "near.toml").write_text(text.replace("crest_x = 6.0", "crest_x = 4.3").replace("toe_x = 7.5", "toe_x = 5.4"))
    status, result, out, words = load("--scenario", folder / "near.toml", "--seed", "1", "--trucks", "1", timeout=900)
    assert status == 0, words[-1500:]
    assert result["bench_moves"] >= 1 and result["contacts"] == 0 and result["trucks_loaded"] == 1, result
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    asked = next(e for e in events if e["event"] == "move_back")
    assert asked["why"] and asked["distance_m"] > 0
    truth = json.loads((out / "truth.json").read_text())
    assert truth["bench_moves"][0]["distance_m"] == asked["distance_m"], truth["bench_moves"]
    assert any(e["event"] == "moved" for e in events)
    moved_s = truth["bench_moves"][0]["from_s"]
    with open(out / "trace.csv", encoding="utf-8") as trace:
        swing_deg = next(math.degrees(float(row["swing_rad"])) for row in csv.DictReader(trace) if float(row["time_s"]) >= moved_s)
    assert 1.0 < abs(swing_deg) < 3.1, f"{swing_deg:.2f} degrees: straight ahead the implements' sides lie on the edges of the kernel's cells"
    shutil.rmtree(out)
    shutil.rmtree(folder)


def shift_until(folder, until_s, more=""):
    text = (ROOT / "fault_injection/scenarios/shift.toml").read_text()
    for old, new in (("max_time_s = 36000.0", f"max_time_s = {until_s}"), ("farthest_back_m = 84.0\n", f"farthest_back_m = 84.0\n{more}")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    path = folder / "until.toml"
    path.write_text(text)
    return path


def first_dig_s(folder):
    _, result, out, words = load("--scenario", shift_until(folder, 40.0), "--seed", "1", timeout=900)
    assert result is not None, words[-1500:]
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    shutil.rmtree(out)
    return next(e["time_s"] for e in events if e["event"] == "phase" and e["phase"] == "dig")


def by_hand():
    """The map is learned anew with the bucket in the face: nothing may move, the app says so, and the operator lifts the implements by hand."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    stop_s = first_dig_s(folder) + INTO_DIG_S
    scenario = shift_until(folder, 160.0, 'resets_after_s = [5.0, 10.0]\n\n'
                           f'[[panel]]\naction = "stop"\nat_s = {stop_s:.2f}\nfor_s = 0.5\n\n[[panel]]\naction = "relearn"\nat_s = {stop_s + 3.0:.2f}\nfor_s = 0.5\n')
    _, result, out, words = load("--scenario", scenario, "--seed", "1", timeout=900)
    truth = json.loads((out / "truth.json").read_text())
    assert len(truth["hand_lifts"]) == 1, (truth["hand_lifts"], words[-1500:])
    lift = truth["hand_lifts"][0]
    with open(out / "trace.csv", encoding="utf-8") as trace:
        states = {row["stop_state"] for row in csv.DictReader(trace) if lift["from_s"] < float(row["time_s"]) < lift["to_s"]}
    assert "5" in states and "2" not in states, f"the kernel, to which the lift is a fault, had the states {states}"
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    called = [e["reason"] for e in events if e["event"] == "operator_needed"]
    # The lift itself is a fault to the kernel, which latches: that a reset is needed is said, too. Which of SK-MS-1 and 4 sees it first, both beyond
    # two errors of the speed, is a matter of the noise of the reading in which it begins: of this seed, and this second.
    assert called == ["operator", "unknown ground", "uncommanded"], called
    assert result["passes"] >= 2 and result["contacts"] == 0 and result["own_motion_stops"] == {}, result
    shutil.rmtree(out)
    shutil.rmtree(folder)


main([short_shift, how_it_runs_again, bench_move, by_hand])
