"""A reduced identification: its bounds hold the plant's true stops, the same seed gives the same bytes, and what it writes is a good machine file; joint models from
step responses are those of the plant.

The command sees the bus alone; this test judges it by what was true (trace.csv of the plant).

verifies: IF-CF-6, IF-CF-7, IF-CF-23
"""
import csv
import json
import pathlib
import shutil
import struct
import tempfile
import tomllib
import zlib

from berm_command import ROOT, interrupted, main, one_clear_line, run

MACHINE = ROOT / "interface_spec/config/machines/zx200.toml"
SITE = ROOT / "interface_spec/config/sites/bench.toml"
SCENARIO = ROOT / "fault_injection/scenarios/identify.toml"
DEGREE = 57.29577951308232
JOINT = "stick"
REDUCED = ("--joint", JOINT, "--columns", 3, 6, 7, "--repetitions", 1, "--seed", 5)
LEAST_FALL_RAD_S = 0.02  # in one cycle: a stop; the slowing down between two tests is gentler
scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-identify-"))
seen = {}


def identify(name, *more):
    files = {kind: scratch / f"{name}.{kind}" for kind in ("toml", "json", "svg")}
    done = run("berm_identify", *REDUCED, "--out", files["toml"], "--json", files["json"], "--picture", files["svg"], *more, timeout=120)
    print(done.stdout[-2500:], done.stderr, flush=True)
    assert done.returncode == 0, done.stderr
    return files


def true_stops(trace):
    """(speed, angle, seconds) of every stop in a trace: from the last moment at the held speed to standstill."""
    with open(trace, newline="") as file:
        rows = [(float(r[f"{JOINT}_rad"]), float(r[f"{JOINT}_rad_s"])) for r in csv.DictReader(file)]
    stops, begin = [], None
    for i in range(1, len(rows)):
        before, now = abs(rows[i - 1][1]), abs(rows[i][1])
        if before - now >= LEAST_FALL_RAD_S and begin is None:
            begin = i - 1
        elif begin is not None and now > 0.0 and before - now < LEAST_FALL_RAD_S:
            begin = None
        if begin is not None and now == 0.0:
            stops.append((abs(rows[begin][1]), abs(rows[i][0] - rows[begin][0]), 0.01 * (i - begin)))
            begin = None
    return stops


def bounds_hold_the_true_stops():
    files = identify("first", "--plant-out", scratch / "plant")
    seen["files"] = files
    table = tomllib.loads(files["toml"].read_text())
    angle_deg, time_s = table["braking"][JOINT]["angle_deg"], table["braking"][JOINT]["time_s"]
    fastest = table["joint"][JOINT]["velocity_max_deg_s"]
    result = json.loads(files["json"].read_text())
    stops = [stop for run_ in ("seed5_loaded", "seed5_empty") for stop in true_stops(scratch / "plant" / run_ / "trace.csv")]
    assert len(stops) >= result["stops"] >= 50, f"{len(stops)} stops in the traces, {result['stops']} were measured"
    longest = {}
    for speed, angle, seconds in stops:
        column = next(k for k in range(8) if speed * DEGREE <= fastest * k / 7 + 0.01)
        for row in range(4):
            assert angle * DEGREE <= angle_deg[row][column], f"true stop of {angle * DEGREE:.2f} deg at {speed * DEGREE:.1f} deg/s, bound {angle_deg[row][column]}"
            low, high = angle_deg[row][column - 1], angle_deg[row][column]  # the kernel takes the chord between two columns
            chord = low + (high - low) * (speed * DEGREE * 7 / fastest - (column - 1)) + 0.01
            assert angle * DEGREE <= chord, f"true stop of {angle * DEGREE:.2f} deg at {speed * DEGREE:.1f} deg/s, chord {chord:.2f}"
            assert seconds <= time_s[row][column], f"true stop of {seconds:.2f} s at {speed * DEGREE:.1f} deg/s, bound {time_s[row][column]}"
        longest[column] = max(longest.get(column, 0.0), angle * DEGREE)
    print("true longest by column, deg:", {k: round(v, 2) for k, v in sorted(longest.items())}, "bounds:", angle_deg[0])
    for column in (3, 6, 7):
        assert angle_deg[0][column] <= 1.4 * longest[column] + 1.0, "the bound is no measurement"


def entries_say_what_was_measured():
    result = json.loads(seen["files"]["json"].read_text())
    entries = result["entries"]
    assert len(entries) == 4 * 7 and {e["joint"] for e in entries} == {JOINT}
    for e in entries:
        if e["column"] in (3, 6, 7):
            assert e["runs"] > 0 and e["bound_deg"] > e["measured_deg"] > 0 and e["bound_s"] > e["measured_s"] > 0, e
            assert not e["extrapolated"]
            assert e["between_share"] > 0.3, e
        else:
            assert e["runs"] == 0 and e["measured_deg"] is None, e
    assert 0.05 <= result["command_obeyed_after_s"] <= 0.08 and 1750 <= result["weighed_kg"] <= 1850
    for word in ("<svg", JOINT, "deg/s"):
        assert word in seen["files"]["svg"].read_text()


def only_what_was_measured_changes():
    before, after = MACHINE.read_text().splitlines(), seen["files"]["toml"].read_text().splitlines()
    assert len(before) == len(after)
    changed = [i for i, (a, b) in enumerate(zip(before, after)) if a != b]
    first = next(i for i, line in enumerate(before) if line == f"[braking.{JOINT}]")
    last = next((i for i, line in enumerate(before) if i > first and line.startswith("[")), len(before))
    for i in changed:
        table = first < i < last and before[i].startswith("    [")
        assert table or before[i].startswith(("provenance =", "acceleration_max_rad_s2 =")), f"line {i + 1}: {before[i]} -> {after[i]}"
    assert sum(before[i].startswith("provenance =") for i in changed) == 1
    assert "--seed 5 --repetitions 1" in after[next(i for i in changed if after[i].startswith("provenance ="))]


def same_seed_same_bytes():
    again = identify("second")
    for kind, path in seen["files"].items():
        assert path.read_bytes() == again[kind].read_bytes(), f"two runs of seed 5 differ in {kind}"


def from_its_own_result_the_same_table():
    """What is measured does not depend on the table that was believed before."""
    again = identify("third", "--machine", seen["files"]["toml"])
    assert again["toml"].read_bytes() == seen["files"]["toml"].read_bytes()


def params(machine, out):
    return run("berm_params", machine, SITE, "-o", out)


def the_result_is_a_good_machine_file():
    done = params(seen["files"]["toml"], scratch / "good.params")
    assert done.returncode == 0, done.stderr


def a_table_that_falls_or_has_holes_is_refused():
    text = seen["files"]["toml"].read_text()
    table = tomllib.loads(text)["braking"][JOINT]["angle_deg"]
    row = "    [" + ", ".join(f"{x:g}" for x in table[0]) + "],"
    at = text.index(row, text.index(f"[braking.{JOINT}]"))
    numbers = row.strip(" [],").split(", ")

    def edited(new):
        path = scratch / "bad.toml"
        path.write_text(text[:at] + new + text[at + len(row):])
        return path

    falls = list(numbers)
    falls[4] = "0.5"
    cases = {f"    [{', '.join(falls)}],": ("angle_deg", "falls with growing speed"), f"    [{', '.join(numbers[:7])}],": ("angle_deg", "8 numbers"),
             "": ("angle_deg", "4 rows"), f"    [{', '.join(numbers[:7])}, 400],": ("angle_deg", "0 .. 360"),
             f"    [{', '.join(numbers[:7])}, {float(numbers[7]) + 1}],": ("angle_deg", "falls with growing reach")}
    for new, words in cases.items():
        one_clear_line(params(edited(new), scratch / "never.params"), "bad.toml", f"braking.{JOINT}.{words[0]}", words[1])
        assert not (scratch / "never.params").exists()


def the_kernel_refuses_such_a_block():
    """A block whose CRC is right and whose table falls: the kernel's own check, whatever compiled it."""
    block = (scratch / "good.params").read_bytes()
    machine = tomllib.loads(seen["files"]["toml"].read_text())
    row = machine["braking"][JOINT]["angle_deg"][0]
    urad = struct.pack("<3i", *(-int(-(x / DEGREE * 1e6 - 1e-6) // 1) for x in row[:3]))
    at = block.index(urad)
    for value, words in ((2**31 - 1, "brake_angle_urad: within"), (0, "brake_angle_urad: must not fall with speed")):
        bad = block[:at + 8] + struct.pack("<i", value) + block[at + 12:-4]
        path = scratch / "falls.params"
        path.write_bytes(bad + struct.pack("<I", zlib.crc32(bad)))
        one_clear_line(run("berm_kernel", "--parameters", path, "--can", "udp:239.255.66.251:49993", "--scan-port", 49992, "--socket", scratch / "k.sock",
                           timeout=20), "falls.params", words)


TRUE = tomllib.loads((ROOT / "fault_injection/plant/profiles/zx200_plant.toml").read_text())


def identify_steps(name, machine):
    files = {kind: scratch / f"{name}.{kind}" for kind in ("toml", "json", "svg")}
    done = run("berm_identify", "--steps", "--repetitions", 1, "--seed", 3, "--quiet", "--machine", machine, "--out", files["toml"], "--json", files["json"],
               "--picture", files["svg"], timeout=200)
    print(done.stdout[-4000:], done.stderr, flush=True)
    assert done.returncode == 0, done.stderr
    return files


def step_responses_find_the_true_joints():
    """Dead time, lag, gain and rates of the plant's profile, which the command does not see. A machine file that has no models gets some."""
    bare = scratch / "bare.toml"
    bare.write_text(MACHINE.read_text().split("[response]")[0])
    seen["steps"] = identify_steps("steps", bare)
    fitted = tomllib.loads(seen["steps"]["toml"].read_text())["response"]
    assert seen["steps"]["toml"].read_text().startswith(bare.read_text()), "something else in the file changed"
    for joint in ("swing", "boom", "stick", "bucket"):
        true = TRUE["joint"][joint]
        for direction in ("up", "down"):
            model = fitted[joint][direction]
            assert abs(model["dead_time_s"] - true["dead_time_s"]) < 0.003, (joint, direction, model)
            assert abs(model["lag_s"] - true["lag_s"]) < 0.01, (joint, direction, model)
            assert abs(model["gain"] - 1.0) < 0.01, (joint, direction, model)
            assert abs(model["speeding_rad_s2"][0][0] / true["acceleration_rad_s2"] - 1.0) < 0.03, (joint, direction, model)
            if joint != "swing":
                brake = TRUE["dynamics"]["boom_lower_brake_loaded_rad_s2"] if (joint, direction) == ("boom", "down") else true["brake_rad_s2"]
                assert abs(model["slowing_rad_s2"][0][0] / true["brake_rad_s2"] - 1.0) < 0.05, (joint, direction, model)
                assert abs(model["slowing_rad_s2"][1][0] / brake - 1.0) < 0.05, (joint, direction, model)
    slowing = fitted["swing"]["up"]["slowing_rad_s2"]
    assert all(empty > 1.4 * loaded for empty, loaded in zip(*slowing)) and slowing[0] == sorted(slowing[0], reverse=True), slowing


def step_fits_say_how_surely():
    result = json.loads(seen["steps"]["json"].read_text())
    assert len(result["fits"]) == 8 and result["step_responses"] >= 140 and 1750 <= result["weighed_kg"] <= 1850
    for fit in result["fits"]:
        assert 0.0 < fit["residual_deg_s"] < 0.3 and fit["worst_residual_deg_s"] >= fit["residual_deg_s"], fit
        assert 0.0 < fit["dead_time_s"]["confidence"] < 0.005 and 0.0 < fit["lag_s"]["confidence"] < 0.02, fit
        assert {(rate["load"]) for rate in fit["slowing_rad_s2"]} == {"empty", "loaded"}
    assert seen["steps"]["svg"].read_text().count("<polyline") >= 2 * 8 * 6


def steps_again_are_the_same_bytes():
    """From a file that has models already: they are replaced, once."""
    again = identify_steps("steps_again", seen["steps"]["toml"])
    assert again["toml"].read_bytes() == seen["steps"]["toml"].read_bytes()


def bad_input():
    out = scratch / "none.toml"
    broken = scratch / "broken.toml"
    broken.write_text(MACHINE.read_text().replace("boom = 5.648", "boom = -1.0"))
    huge = scratch / "huge.toml"
    huge.write_text(MACHINE.read_text().replace("boom = 5.648", "boom = 99999999999999999999"))
    inline = scratch / "inline.toml"
    inline.write_text(MACHINE.read_text().replace("[latency]", "latency = {command = 0.10, state = 0.02}\n[elsewhere]", 1).replace("[elsewhere]", "[kernel_unused]"))
    heavy = scratch / "heavy.toml"
    heavy.write_text(SCENARIO.read_text().replace("ballast_kg = 1800.0", "ballast_kg = 1800.5"))
    for arguments, words in (
            (("--no-such-option",), ("no-such-option",)), (("--columns", 8), ("columns",)), (("--columns", 0), ("columns",)), (("--joint", "arm"), ("joint",)),
            (("--repetitions", 0), ("repetitions",)), (("--allowance", -0.1), ("allowance",)), (("--seed", "many"), ("seed",)),
            (("--machine", "no-such-machine"), ("no-such-machine",)), (("--machine", scratch / "missing.toml"), ("missing.toml",)),
            (("--machine", broken), ("broken.toml", "kinematics.boom", "1 .. 12")), (("--machine", huge), ("huge.toml: kinematics.boom: 99999999999999999999 is outside",)),
            (("--machine", inline), ("inline.toml",)),
            (("--scenario", "no-such-scenario"), ("no-such-scenario",)), (("--scenario", heavy), ("heavy.toml", "start.ballast_kg", "1800")),
            (("--json", scratch / "no" / "x.json"), ("x.json", "folder"))):
        one_clear_line(run("berm_identify", *REDUCED, "--out", out, "--picture", "", *arguments, timeout=60), *words)
        assert not out.exists(), f"a machine file after {arguments}"
    one_clear_line(run("berm_identify", "--out", scratch / "no" / "x.toml"), "x.toml", "folder")
    apart = scratch / "apart.toml"
    apart.write_text(MACHINE.read_text().replace("[response.boom.up]", "[response.boom]\nup.gain = 1.0\n[response.boom.up]"))
    for arguments, words in ((("--joint", "boom"), ("--steps", "--joint")), (("--allowance", 0.2), ("--steps", "--allowance")), (("--repetitions", 0), ("repetitions",)),
                             (("--machine", apart), ("apart.toml",)), (("--json", scratch / "no" / "x.json"), ("x.json", "folder"))):
        one_clear_line(run("berm_identify", "--steps", "--out", out, "--picture", "", *arguments, timeout=60), *words)
        assert not out.exists(), f"a machine file after --steps {arguments}"


def models_that_stand_apart_are_refused_before_the_measurement():
    apart = scratch / "stands_apart.toml"
    lines = MACHINE.read_text().splitlines(keepends=True)
    first = lines.index("[response.boom.up]\n")
    last = next(i for i in range(first + 1, len(lines)) if lines[i].startswith("["))
    at = next(i for i, line in enumerate(lines) if line.startswith("[latency]"))
    apart.write_text("".join(lines[:at] + lines[first:last] + lines[at:first] + lines[last:]))
    assert params(apart, scratch / "apart.params").returncode == 0, "no good machine file"
    done = run("berm_identify", "--steps", "--machine", apart, "--out", scratch / "none.toml", "--picture", "", timeout=60)
    one_clear_line(done, "stands_apart.toml: [response]: its tables must stand together")
    assert done.stdout == "", f"measured before it was refused: {done.stdout}"


def a_machine_of_any_name():
    """Its name goes into the new file: with quotes and backslashes, and as long as a name may be."""
    name = 'the "long" one \\o/ ' + "x" * 180
    named = scratch / "named.toml"
    named.write_text(MACHINE.read_text().replace('name = "zx200"', f"name = '{name}'", 1))
    files = identify("of_any_name", "--machine", named)
    table = tomllib.loads(files["toml"].read_text())
    assert table["name"] == name and len(table["braking"]["provenance"]) <= 200 and table["braking"]["provenance"].startswith("measured in simulation: berm identify"), table["braking"]


def a_terminals_interrupt_ends_it_at_once():
    """It goes to the simulated machine as well, which ends and says nothing any more: that must not be waited out."""
    out = scratch / "interrupted.toml"
    process, _, errors, took = interrupted("berm_identify", "--out", out, "--picture", "", after="seed", of="stdout")
    assert process.returncode == 2 and errors == "berm identify: interrupted: nothing is written\n" and not out.exists(), (process.returncode, errors)
    assert took < 2.5, f"{took:.1f} s"


def help_is_no_error():
    done = run("berm_identify", "--help")
    assert done.returncode == 0 and "--allowance" in done.stdout


try:
    main([bounds_hold_the_true_stops, entries_say_what_was_measured, only_what_was_measured_changes, same_seed_same_bytes, from_its_own_result_the_same_table,
          the_result_is_a_good_machine_file, step_responses_find_the_true_joints, step_fits_say_how_surely, steps_again_are_the_same_bytes,
          a_table_that_falls_or_has_holes_is_refused, the_kernel_refuses_such_a_block, bad_input, models_that_stand_apart_are_refused_before_the_measurement, a_machine_of_any_name, a_terminals_interrupt_ends_it_at_once, help_is_no_error])
finally:
    shutil.rmtree(scratch)
