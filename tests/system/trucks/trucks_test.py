"""berm truck_world, recognize and trucks: a drawn truck is found where it stands, none where there is none; keys, exit codes, refusals."""
import csv
import json
import math
import pathlib
import re
import tempfile

from berm_command import ROOT, interrupted, main, one_clear_line, run

scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-trucks-"))
SUMMARY = {"trucks", "recognised", "corner_error_m_p95", "yaw_error_deg_p95", "dimension_error_m_p95", "height_error_m_p95", "height_within_95", "nees_ratio", "non_trucks", "false_accepts",
           "ms_p50", "ms_max", "by_class"}
ANSWER = {"found", "reason", "corners_m", "yaw_deg", "length_m", "width_m", "height_m", "height_sd_m", "covariance", "milliseconds"}
ARRIVING = {"recognised", "false_accepts", "before_sweeps_end", "corner_error_m_p95", "answer_after_last_scanline_ms_p50", "answer_after_last_scanline_ms_p95",
            "answer_after_last_scanline_ms_max", "answer_within_50_ms", "scanline_ms_p50", "scanline_ms_max", "asks_p50", "asking_ms_p50"}
SEED = 3
SAMPLES = 72000  # of a sweep of berm_trucks; berm_truck_world's own are half as many


def a_drawn_truck_is_found_and_bare_ground_is_none():
    listed = run("berm_trucks", "--scenes", 12, "--seed", SEED, "--list", "--table", scratch / "trucks.csv", "--json", scratch / "trucks.json")
    rows = rows_of(scratch / "trucks.csv")
    assert len(rows) == 24 and any("," in row["reason"] or " " in row["reason"] for row in rows)
    print(listed.stdout, listed.stderr)
    summary = json.loads((scratch / "trucks.json").read_text())
    assert SUMMARY <= summary.keys(), summary.keys()
    assert summary["trucks"] == summary["non_trucks"] == 12
    assert summary["recognised"] >= 10, "five sixths of the trucks: far below what RECOGNITION.md measured"
    failed = summary["recognised"] < 12 or summary["false_accepts"] > 0
    assert listed.returncode == (1 if failed else 0), listed.returncode
    found = {int(line.split("--only ")[1].split()[0]) for line in listed.stdout.splitlines() if line.startswith("found ")}
    none = {int(line.split("--only ")[1].split()[0]) for line in listed.stdout.splitlines() if line.startswith("none ")}
    assert len(found) == summary["recognised"] and len(none) == 12 - summary["false_accepts"]
    for content, number, expected in (("truck", min(found), True), ("none", min(none), False)):
        answer, truth = offline(content, number)
        assert answer["found"] is expected, answer["reason"]
        if not expected:
            assert len(answer["reason"]) > 10 and all(answer[k] is None for k in ("corners_m", "yaw_deg", "covariance"))
            continue
        off = [math.dist(a, b) for a, b in zip(answer["corners_m"], truth["truck"]["corners"])]
        assert max(off) < 0.30, off
        assert abs(math.remainder(math.radians(answer["yaw_deg"]) - truth["truck"]["yaw"], 2 * math.pi)) < 0.02
        assert len(answer["covariance"]) == 12 and all(len(row) == 12 for row in answer["covariance"])
        assert all(answer["covariance"][i][i] > 0 for i in range(12))


def rows_of(table):
    """Of a table, by the names of its columns; each row has all of them and no more."""
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file, strict=True))
    assert all(None not in row and None not in row.values() for row in rows), rows
    return rows


def a_table_keeps_its_columns_whatever_a_class_is_called():
    classes, table, name = scratch / "classes.toml", scratch / "classes.csv", 'box, "long" one'
    text = (ROOT / "fault_injection/truck_world/truck_classes.toml").read_text()
    for known in re.findall(r'^name = "(\w+)"', text, re.MULTILINE):
        text = text.replace(f'name = "{known}"', f"name = '{name} {known}'")
    classes.write_text(text)
    run("berm_trucks", "--scenes", 2, "--seed", SEED, "--trucks", "--classes", classes, "--table", table)
    rows = rows_of(table)
    assert len(rows) == 2 and all(row["class"].startswith(name + " ") and float(row["milliseconds"]) > 0 for row in rows), rows


def the_height_is_known_as_well_as_it_says():
    """Of 80 trucks the errors lie within 1.96 of the recogniser's own deviations as often as RECOGNITION.md measured, less four of 80; and a wide
    deviation that would cover all errors is none."""
    out = scratch / "heights.json"
    run("berm_trucks", "--scenes", 80, "--seed", 71, "--trucks", "--table", scratch / "heights.csv", "--json", out)
    summary = json.loads(out.read_text())
    rows = [line.split(",") for line in (scratch / "heights.csv").read_text().splitlines()]
    of = {name: i for i, name in enumerate(rows[0])}
    deviations = sorted(float(row[of["height_deviation_m"]]) for row in rows[1:] if row[of["recognised"]] == "1")
    print(summary["height_error_m_p50"], summary["height_error_m_p95"], summary["height_within_95"], deviations[len(deviations) // 2])
    assert summary["height_within_95"] >= 0.89
    assert deviations[len(deviations) // 2] < 0.03 and summary["height_error_m_p50"] < 0.02 and summary["height_error_m_p95"] < 0.12
    assert {"load empty", "load part", "load heaped", "load uneven"} <= summary["by_class"].keys()


def drawn(seed, number, content):
    done = run("berm_trucks", "--scenes", number + 1, "--seed", seed, "--only", number, content, "--list")
    print(done.stdout, done.stderr)
    return done


def as_many_are_recognised_and_as_well_as_was_measured():
    """150 trucks and 150 scenes without one, a scanline a degree, as the app sweeps. Measured: 149 recognised, none falsely, corners 3.5 cm, yaw 0.15 degrees, sizes 3.3 cm, height 4.9 cm
    (95 %), within chi-square's 95 % bound 97 %. Less by a few trucks, by half of an error, is a loss that somebody must have wanted."""
    out = scratch / "rate.json"
    done = run("berm_trucks", "--scenes", 150, "--seed", 9104, "--points", 36000, "--jobs", 2, "--json", out)
    print(done.stdout, done.stderr)
    summary = json.loads(out.read_text())
    assert summary["trucks"] == summary["non_trucks"] == 150
    assert summary["recognised"] >= 146 and summary["false_accepts"] <= 1, summary
    assert summary["corner_error_m_p95"] < 0.05 and summary["yaw_error_deg_p95"] < 0.25, summary
    assert summary["dimension_error_m_p95"] < 0.05 and summary["height_error_m_p95"] < 0.065, summary
    assert summary["nees_within_95"] > 0.92 and 0.3 < summary["nees_ratio"] < 1.3, summary
    for name, of in summary["by_class"].items():
        assert of["recognised"] >= 0.9 * of["trucks"], (name, of)


def an_end_that_is_hidden_is_told_as_unsure():
    """Of trucks of which an occluder hides an end wall whole, where their place allows it, most are found, and the covariance says how badly."""
    out = scratch / "hidden.json"
    run("berm_trucks", "--scenes", 60, "--seed", 102, "--trucks", "--end-hidden", 1, "--jobs", 2, "--json", out)
    summary = json.loads(out.read_text())
    print(summary["recognised"], summary["corner_error_m_p95"], summary["nees_within_95"])
    assert summary["recognised"] >= 48 and summary["nees_within_95"] > 0.9, summary
    assert summary["corner_error_m_p95"] > 0.05, "nothing is hidden: the test shows nothing"


def what_tells_a_bed_from_a_pit():
    """Scenes that were once judged wrongly. A loader hides all but four returns of a bed's outer faces; its cab is seen well. Building pits have walls and
    an edge like a bed, but a dozen returns on far inner faces, or many rays through their walls."""
    hidden = drawn(601, 274, "--trucks")
    assert hidden.returncode == 0 and hidden.stdout.startswith("found "), hidden.stdout
    assert int(hidden.stdout.split("outer faces ")[1].split(",")[0]) < 12, "its outer faces are not hidden: the test shows nothing"
    for number in (278, 345, 449):
        pit = drawn(101, number, "--no-trucks")
        assert pit.returncode == 0 and pit.stdout.startswith("none building_pit"), pit.stdout


def as_scanlines_arrive():
    """An answer stands for nearly every truck that is found in whole sweeps, mostly before the sweep's end, and which does not depend on times."""
    def arriving():
        out = scratch / "arriving.json"
        done = run("berm_trucks", "--scenes", 6, "--seed", SEED, "--arriving", "--points", 36000, "--json", out)
        print(done.stdout, done.stderr)
        return json.loads(out.read_text())

    summary = arriving()
    a = summary["arriving"]
    assert ARRIVING <= a.keys(), a.keys()
    assert a["trucks"] == a["non_trucks"] == 6 and a["recognised"] >= summary["recognised"] - 1 and a["recognised"] >= 4
    assert a["false_accepts"] <= summary["false_accepts"]
    assert a["before_sweeps_end"] >= 2, "the rule waits for the end"
    assert a["answer_after_last_scanline_ms_p50"] < 500 and a["scanline_ms_p50"] < 1.0
    again = arriving()["arriving"]
    assert {k: v for k, v in a.items() if "_ms" not in k} == {k: v for k, v in again.items() if "_ms" not in k}


def several_jobs_judge_the_same():
    def judged(jobs):
        out = scratch / f"jobs{jobs}.json"
        done = run("berm_trucks", "--scenes", 4, "--seed", SEED, "--jobs", jobs, "--list", "--json", out)
        result = json.loads(out.read_text())
        scenes = [line.split(", nees")[0] for line in done.stdout.splitlines() if " --only " in line]  # behind it: CPU time
        assert len(scenes) == 8, done.stdout
        return done.returncode, scenes, {key: value for key, value in result.items() if not key.startswith("ms_")}

    assert judged(1) == judged(3)


def what_is_listed_can_be_repeated_with_all_that_it_depends_on():
    def listed(*options):
        lines = [line for line in run("berm_trucks", *options, "--list").stdout.splitlines() if " --only " in line]
        return [(line.split(", nees")[0].split(" [")[0], line.split(" [")[1].rstrip("]")) for line in lines]

    first = listed("--scenes", 2, "--only", 1, "--seed", SEED, "--trucks", "--points", 36000, "--noise", 0.2, "--jobs", 1)
    assert len(first) == 1 and first[0][1].endswith(" --points 36000 --noise 0.2"), first
    assert first[0][1].startswith("./berm trucks "), first
    assert listed(*first[0][1].split()[2:]) == first


def an_interrupt_ends_trucks_with_what_was_judged():
    out, rows = scratch / "interrupted.json", scratch / "interrupted.csv"
    process, words, errors, _ = interrupted("berm_trucks", "--scenes", 100000, "--seed", SEED, "--list", "--jobs", 2, "--json", out, "--table", rows, after="found ", of="stdout")
    assert process.returncode == 1, (process.returncode, errors)
    done = int(re.search(r"^berm trucks: interrupted \(Interrupt\) after ([0-9]+) of 100000 scenes\n", errors)[1])
    assert done > 0 and f"\n{done} of 100000 scenes: interrupted\n" in words, words
    result = json.loads(out.read_text())
    assert result["asked"] == 100000 and result["scenes"] == result["trucks"] == result["non_trucks"] == done, result
    scenes = {int(line.split(",")[0]) for line in rows.read_text().splitlines()[1:]}
    assert scenes == set(range(done)), scenes


def an_interrupt_ends_truck_world_with_whole_scenes():
    folder = scratch / "interrupted"
    process, words, errors, _ = interrupted("berm_truck_world", "--scenes", 100000, "--seed", SEED, "--points", 9200, "--out", folder, after="100 of")
    assert process.returncode == 1, (process.returncode, errors)
    done = int(re.search(r"^berm truck_world: interrupted \(Interrupt\) after ([0-9]+) of 100000 scenes\n", errors, re.MULTILINE)[1])
    assert done >= 100 and words.startswith(f"{done} of 100000 scenes in {folder} (interrupted): "), words
    expected = {f"scene_{number:06d}{ending}" for number in range(done) for ending in (".pcd", ".labels.csv", ".json")}
    assert {path.name for path in folder.iterdir()} == expected, "not the first scenes, each whole"


def a_folder_holds_scenes_of_one_run():
    folder = scratch / "one_run"
    done = run("berm_truck_world", "--scenes", 2, "--seed", SEED, "--points", 9200, "--out", folder)
    assert done.returncode == 0, done.stderr
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    one_clear_line(run("berm_truck_world", "--scenes", 1, "--seed", SEED, "--points", 9200, "--out", folder), folder, "earlier run")
    one_clear_line(run("berm_truck_world", "--scenes", 5, "--only", 4, "--seed", SEED + 1, "--points", 9200, "--out", folder), folder, f"not of seed {SEED + 1}")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    assert run("berm_truck_world", "--scenes", 2, "--only", 1, "--seed", SEED, "--points", 9200, "--out", folder, "--picture").returncode == 0
    assert {path.name for path in folder.iterdir()} == {*before, "scene_000001.svg"}


def offline(content, number):
    """The same scene through files: what berm_recognize answers, and the truth."""
    folder = scratch / content
    done = run("berm_truck_world", "--scenes", number + 1, "--only", number, "--seed", SEED, "--trucks" if content == "truck" else "--no-trucks", "--points", SAMPLES, "--out", folder)
    assert done.returncode == 0, done.stderr
    scene = folder / f"scene_{number:06d}.pcd"
    picture, out = scratch / "found.svg", scratch / "answer.json"
    done = run("berm_recognize", scene, "--json", out, "--picture", picture)
    answer = json.loads(out.read_text())
    assert ANSWER <= answer.keys(), answer.keys()
    assert done.returncode == (0 if answer["found"] else 1), done.stderr
    assert picture.read_text().rstrip().endswith("</svg>")
    return answer, json.loads(scene.with_suffix(".json").read_text())


def what_is_malformed_is_refused():
    short = scratch / "short.pcd"
    short.write_text("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 100000000\nHEIGHT 1\nPOINTS 100000000\nDATA ascii\n1 2 3\n")
    classes = scratch / "classes.toml"
    classes.write_text("schema = 1\nslack = 9.0\n")
    good = next((scratch / "truck").glob("*.pcd"))
    cases = (("berm_recognize", (scratch / "none.pcd",), "none.pcd"), ("berm_recognize", (short,), "short.pcd"), ("berm_recognize", (), "FILE"),
             ("berm_recognize", (good, "--classes", classes), "slack"), ("berm_trucks", (), "scenes"), ("berm_trucks", ("--scenes", 0), "scenes"),
             ("berm_trucks", ("--scenes", 3, "--only", 3), "--only: 3 is not below --scenes 3"),
             ("berm_trucks", ("--scenes", 1, "--ranges", classes), "slack"))
    for program, options, word in cases:
        out = scratch / "refused.json"
        done = run(program, *options, "--json", out)
        one_clear_line(done, word)
        assert done.returncode == 2 and not out.exists(), f"{program} {options}: {done.returncode}, or left a result"
    beyond = run("berm_truck_world", "--scenes", 3, "--only", 3, "--out", scratch / "beyond")
    one_clear_line(beyond, "--only: 3 is not below --scenes 3")
    assert beyond.returncode == 2 and not (scratch / "beyond").exists()
    for left, missing in (("time", "scanline"), ("scanline", "time")):  # else a cloud that is no sweep would be one without a truck
        lacking = scratch / "lacking.pcd"
        lacking.write_text(f"VERSION 0.7\nFIELDS x y z {left}\nSIZE 4 4 4 4\nTYPE F F F {'F' if left == 'time' else 'U'}\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3 0\n")
        done = run("berm_recognize", lacking, "--json", scratch / "refused.json")
        one_clear_line(done, f"lacking.pcd: {missing}: is missing")
        assert done.returncode == 2 and not (scratch / "refused.json").exists()
    nobody = scratch / "empty.pcd"
    nobody.write_text("VERSION 0.7\nFIELDS x y z scanline time\nSIZE 4 4 4 4 8\nTYPE F F F U F\nCOUNT 1 1 1 1 1\nWIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n")
    done = run("berm_recognize", nobody)
    assert done.returncode == 1 and "no truck: " in done.stdout, (done.returncode, done.stdout, done.stderr)


main([a_drawn_truck_is_found_and_bare_ground_is_none, a_table_keeps_its_columns_whatever_a_class_is_called, the_height_is_known_as_well_as_it_says, as_many_are_recognised_and_as_well_as_was_measured,
      an_end_that_is_hidden_is_told_as_unsure, what_tells_a_bed_from_a_pit, as_scanlines_arrive, several_jobs_judge_the_same, what_is_listed_can_be_repeated_with_all_that_it_depends_on,
      an_interrupt_ends_trucks_with_what_was_judged, an_interrupt_ends_truck_world_with_whole_scenes, a_folder_holds_scenes_of_one_run, what_is_malformed_is_refused])
