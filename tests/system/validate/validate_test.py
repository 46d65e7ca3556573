"""A short validation sweep: no contact where the nominal motion has some, what it finds is named so that it can be repeated, bad input is refused.

verifies: SK-CY-20, SK-TS-1
"""
import json
import os
import pathlib
import re
import subprocess
import tempfile

from berm_command import BIN, ROOT, interrupted, main, one_clear_line, run

RUNS, SEED = 40, 11
STOP_TAIL = 19  # BERM_STOP_TAIL
scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-validate-"))


def sweep(name, *more):
    out = scratch / f"{name}.json"
    done = run("berm_validate", "--runs", RUNS, "--seed", SEED, "--json", out, *more, timeout=200)
    print(done.stdout[-3000:], done.stderr, flush=True)
    assert done.returncode in (0, 1), done.stderr
    result = json.loads(out.read_text())
    held = result["misses"] == 0 and result["needless_stops"] <= 0.005 * RUNS
    assert done.returncode == (0 if held else 1), "the exit status does not say what the result says"
    return result


def no_obstacle_is_touched_that_the_nominal_motion_touches():
    picture = scratch / "sweep.svg"
    result = sweep("first", "--picture", picture)
    assert result["runs"] == RUNS and result["seed"] == SEED
    assert result["misses"] == 0
    assert result["nominal_contacts"] > 0, "no obstacle was in the way: nothing was shown"
    assert result["stopped_runs"] >= result["nominal_contacts"] - result["governed_runs"]
    assert result["closest_approach_m"] > 0.0
    assert len(result["failures"]) == result["misses"] + result["needless_stops"]
    assert 0 <= result["needless_past_hidden_space"] <= result["needless_stops"]
    assert "<svg" in picture.read_text()
    again = sweep("again", "--jobs", 1)
    for moment in ("wall_seconds",):
        del result[moment], again[moment]
    assert again == result, "the same seed gave another result"


def a_failure_names_the_run_that_repeats_it():
    result = json.loads((scratch / "first.json").read_text())
    for failure in result["failures"][:2]:
        done = run("berm_validate", "--seed", SEED, "--only", failure["run"], timeout=60)
        assert done.returncode == 1 and failure["scenario"] in done.stdout, done.stdout
    right = next(i for i in range(RUNS) if i not in {f["run"] for f in result["failures"]})
    trace, one, picture = scratch / "one.csv", scratch / "one.json", scratch / "one.svg"
    trace.write_text("former\n")
    os.link(trace, scratch / "former.csv")
    done = run("berm_validate", "--seed", SEED, "--only", right, "--trace", trace, "--json", one, "--picture", picture, timeout=60)
    assert done.returncode == 0, done.stdout
    told = json.loads(one.read_text())
    assert (told["asked"], told["runs"], told["misses"], told["seed"]) == (1, 1, 0, SEED) and "<svg" in picture.read_text(), told
    assert (scratch / "former.csv").read_text() == "former\n", "written in place: a run that fails would leave half of it"
    lines = trace.read_text().splitlines()
    assert len(lines) > 300 and all(line.count(",") == lines[0].count(",") for line in lines)


def a_name_that_is_no_utf8_loses_no_result():
    machine, out = os.fsencode(scratch) + b"/caf\xe9.toml", scratch / "name.json"
    pathlib.Path(os.fsdecode(machine)).write_text((ROOT / "interface_spec/config/machines/zx200.toml").read_text())
    done = subprocess.run([str(BIN / "berm_validate"), "--runs", "1", "--machine", machine, "--json", str(out)], capture_output=True, timeout=60, check=False)
    assert done.returncode in (0, 1), done.stderr
    assert json.loads(out.read_text())["machine"].endswith("/caf\ufffd.toml")


def what_the_bucket_hides_is_not_forgotten():
    # The bucket stands beside the box and hides its top from both scanners; the ground round the box's foot is seen for fifteen seconds.
    done = run("berm_validate", "--seed", 2, "--only", 25, timeout=60)
    assert done.returncode == 0 and "MISS" not in done.stdout, done.stdout
    kept = float(re.search(r"kernel .*?([0-9.]+) m from the obstacle", done.stdout)[1])
    assert kept > 0.25, f"only {kept} m kept"


def a_stop_past_hidden_space_is_told_from_others():
    # Needless both by the definition; behind the first one's obstacle nothing was seen, round the second's something was.
    for number, hidden in ((95, True), (165, False)):
        done = run("berm_validate", "--seed", 1, "--only", number, timeout=60)
        line = [row for row in done.stdout.splitlines() if "needless stop" in row]
        assert done.returncode == 1 and len(line) == 1, done.stdout
        assert ("space that the obstacle hid" in line[0]) == hidden, f"run {number}: {line[0]}"


def the_tail_stops_short_of_what_it_would_touch_where_it_is_watched():
    # The implements swing away from the box; the upper body's tail would meet it.
    for seed, number in ((11, 3823), (12, 1881)):
        done = run("berm_validate", "--machine", "zx200_rear", "--seed", seed, "--only", number, timeout=120)
        kernel, nominal = (next(row for row in done.stdout.splitlines() if row.startswith(f"  {name} ")) for name in ("kernel", "nominal"))
        assert "CONTACT: obstacle, with the upper body" in nominal, nominal
        assert done.returncode == 0 and "CONTACT" not in kernel and f"stopped (reason {STOP_TAIL})" in kernel, kernel


def an_interrupt_ends_it_with_what_was_done():
    """The terminal's, which goes to every process of the group."""
    out = scratch / "interrupted.json"
    process, words, errors, _ = interrupted("berm_validate", "--runs", 100000, "--seed", SEED, "--json", out, after="500 of")
    assert process.returncode == 1, (process.returncode, errors)
    done = int(re.search(r"berm validate: interrupted \(Interrupt\) after ([0-9]+) of 100000 runs\n", errors)[1])
    assert done > 0
    result = json.loads(out.read_text())
    assert result["asked"] == 100000 and result["runs"] == done, result
    assert f"{done} of 100000: interrupted" in words, words


def bad_input_is_one_line():
    one_clear_line(run("berm_validate", "--runs", 0), "--runs")
    one_clear_line(run("berm_validate", "--trace", "t.csv"), "--only")
    beyond = run("berm_validate", "--runs", 3, "--only", 3)
    one_clear_line(beyond, "--only: 3 is not below --runs 3")
    assert beyond.returncode == 2, beyond.returncode
    one_clear_line(run("berm_validate", "--machine", "no_such"), "no_such")
    one_clear_line(run("berm_validate", "--surprise"), "--surprise")


main([no_obstacle_is_touched_that_the_nominal_motion_touches, a_failure_names_the_run_that_repeats_it, a_name_that_is_no_utf8_loses_no_result, what_the_bucket_hides_is_not_forgotten,
      a_stop_past_hidden_space_is_told_from_others, the_tail_stops_short_of_what_it_would_touch_where_it_is_watched,
      an_interrupt_ends_it_with_what_was_done, bad_input_is_one_line])
