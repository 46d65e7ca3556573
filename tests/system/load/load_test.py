"""The main job: one truck, three processes, no contact; the same seed gives the same trace."""
import csv
import filecmp
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import threading
import time

from berm_command import BIN, ROOT, check_slowed, load, main

FIELDS = {"seed", "trucks_loaded", "passes", "pass_seconds", "target_kg", "payload_kg", "spill_fraction", "load_centre_offset_m",
          "load_height_stddev_m", "load_centre_offset_m_worst", "load_height_stddev_m_worst", "contacts", "closest_approach_m",
          "kernel_stops", "kernel_faults", "cycle_us_p50", "cycle_us_p99", "cycle_us_max", "simulated_seconds", "wall_seconds", "slowed_seconds", "slowed_spans", "recognition_error_m",
          "soil", "pass_seconds_median", "pass_seconds_p95", "kinematic_ratio_median", "own_motion_stops", "dig_surface_error_m", "plan_ms_max"}
TRACE = ["time_s", "swing_rad", "boom_rad", "stick_rad", "bucket_rad", "swing_rad_s", "boom_rad_s", "stick_rad_s", "bucket_rad_s", "stop_state"]
seen = {}


def children_of(pid):
    try:
        tasks = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:
        return []
    return [int(child) for child in tasks]


def watch_processes(pid, found):
    """Notes pid, name and open descriptors of the launcher's children while they run."""
    while pathlib.Path(f"/proc/{pid}").exists() and not found.get("stop"):
        for child in children_of(pid):
            try:
                name = pathlib.Path(f"/proc/{child}/comm").read_text().strip()
                links = {fd: os.readlink(f"/proc/{child}/fd/{fd}") for fd in os.listdir(f"/proc/{child}/fd")}
                uid = os.stat(f"/proc/{child}").st_uid
            except OSError:
                continue
            found.setdefault(name, {"pid": child, "links": [], "uid": uid})["links"].append(links)
        time.sleep(0.2)


def inet_sockets():
    inodes = set()
    for table in ("udp", "udp6", "tcp", "tcp6", "raw", "packet"):
        try:
            rows = pathlib.Path(f"/proc/net/{table}").read_text().splitlines()[1:]
        except OSError:
            continue
        for row in rows:
            inodes.update(word for word in row.split() if word.isdigit())
    return inodes


def loads_one_truck():
    status, result, out, text = load("--trucks", 1, "--seed", 1)
    assert status == 0, f"exit status {status}: {text[-500:]}"
    missing = FIELDS - result.keys()
    assert not missing, f"result lacks {missing}"
    assert result["trucks_loaded"] == 1 and result["payload_kg"][0] >= 0.95 * result["target_kg"], result["payload_kg"]
    assert 0.98 * result["target_kg"] <= result["payload_kg"][0] <= result["target_kg"], result["payload_kg"]
    assert result["load_centre_offset_m"] <= 0.15 and result["load_height_stddev_m"] <= 0.30, result
    assert result["contacts"] == 0 and result["kernel_faults"] == 0
    assert result["passes"] == len(result["pass_seconds"]) >= 6
    assert result["pass_seconds_median"] in result["pass_seconds"] and min(result["pass_seconds"]) <= result["pass_seconds_median"] <= result["pass_seconds_p95"]
    assert 1.0 < result["kinematic_ratio_median"] < 5.0, f"below the joints' limits, or far off them: {result['kinematic_ratio_median']}"
    assert 0.0 < result["dig_surface_error_m"] < 1.0, result["dig_surface_error_m"]
    assert result["own_motion_stops"] == result["kernel_stops"], "nobody is there and nothing breaks: every stop is by the app's own motion"
    assert result["soil"] is None
    assert result["journal_lost"] == 0
    assert len(result["recognition_error_m"]) == 1 and result["recognition_error_m"][0] < 0.05, result["recognition_error_m"]
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    (recognised,) = [event for event in events if event["event"] == "recognised"]
    dumps = [event for event in events if event["event"] == "dump"]
    assert len(dumps) == result["passes"] and max(event["plan_ms"] for event in dumps) < 50, dumps
    # The plant's truck of this scenario; none of it stands in the site file.
    assert recognised["class"] == "box" and abs(recognised["length_m"] - 4.88) < 0.05 and abs(recognised["height_m"] - 1.22) < 0.1, recognised
    check_slowed(result, out, text)
    assert len({result["pid_plant"], result["pid_kernel"], result["pid_app"]}) == 3
    with open(out / "trace.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0][:10] == TRACE, rows[0]
    times = [float(row[0]) for row in rows[1:]]
    assert abs(times[-1] - times[0] - 0.01 * (len(times) - 1)) < 1e-3, "the trace is not at 100 Hz"
    assert (out / "site.svg").stat().st_size > 10000 and (out / "journal.mcap").stat().st_size > 10000
    seen["first"] = out


def same_seed_same_trace():
    status, _, out, _ = load("--trucks", 1, "--seed", 1)
    assert status == 0
    assert filecmp.cmp(seen["first"] / "trace.csv", out / "trace.csv", shallow=False), "two runs of seed 1 differ"
    assert filecmp.cmp(seen["first"] / "journal.mcap", out / "journal.mcap", shallow=False), "two journals of seed 1 differ"
    shutil.rmtree(out)
    shutil.rmtree(seen["first"])


def trucks_that_stand_elsewhere_and_are_of_other_sizes_are_loaded():
    status, result, out, text = load("--scenario", "mixed_trucks", "--trucks", 3, "--seed", 1)
    assert status == 0, text[-800:]
    assert result["trucks_loaded"] == 3 and result["contacts"] == 0 and result["kernel_faults"] == 0, result
    assert len(result["recognition_error_m"]) == 3 and max(result["recognition_error_m"]) < 0.05, result["recognition_error_m"]
    assert result["spill_fraction"] < 0.02, result["spill_fraction"]
    assert all(0.97 * result["target_kg"] <= kg <= 1.01 * result["target_kg"] for kg in result["payload_kg"]), result["payload_kg"]
    shutil.rmtree(out)


def what_is_no_truck_is_not_loaded():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    scenario = folder / "pickup.toml"
    text = (ROOT / "fault_injection" / "scenarios" / "short.toml").read_text()
    for old, new in (("max_time_s = 1800.0", "max_time_s = 60.0"), ("length = 4.88", "length = 2.60"), ("width = 2.44", "width = 1.50")):
        assert old in text, old
        text = text.replace(old, new)
    scenario.write_text(text)
    status, result, out, said = load("--scenario", scenario, "--seed", 1)
    assert status != 0 and result["passes"] == 0 and result["recognition_error_m"] == [] and result["contacts"] == 0, result
    assert "no truck recognised" in said and "operator needed, no_truck" in said, said[-1500:]
    events = [json.loads(line)["event"] for line in (out / "app.jsonl").read_text().splitlines()]
    assert "dig" not in events and events.count("no_truck") >= 3 and events.count("operator_needed") == 1, events
    shutil.rmtree(folder)
    shutil.rmtree(out)


def app_holds_no_machine_descriptor():
    process = subprocess.Popen([str(BIN / "berm_load"), "--seed", "3", "--realtime", "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    found = {}
    watcher = threading.Thread(target=watch_processes, args=(process.pid, found))
    watcher.start()
    time.sleep(6)
    inet = inet_sockets()
    found["stop"] = True
    watcher.join()
    process.terminate()
    process.wait()
    del found["stop"]
    assert {"berm_kernel", "berm_plant", "berm_app"} <= found.keys(), f"processes seen: {sorted(found)}"
    app, kernel = found["berm_app"], found["berm_kernel"]
    assert app["pid"] != kernel["pid"]
    if os.geteuid() == 0:
        assert app["uid"] != kernel["uid"], "kernel and app share a uid though run as root"
    kernel_inet = [link for link in kernel["links"][-1].values() if link[8:-1] in inet]
    assert kernel_inet, "the check is blind: the kernel shows no network socket"
    for fd, link in app["links"][-1].items():
        inode = link[8:-1] if link.startswith("socket:[") else ""
        assert inode not in inet, f"the app holds a network socket: {fd} -> {link}"
        assert link.startswith(("socket:[", "pipe:[", "/dev/null", "/memfd:")) or fd in "012", f"the app holds {fd} -> {link}"


def real_time_gets_under_way():
    """The kernel's own clock: it must take the scanners' packets and leave INIT (how well it keeps time is the machine's matter)."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    scenario = folder / "short.toml"
    text = (ROOT / "fault_injection" / "scenarios" / "bench.toml").read_text()
    assert "max_time_s = 1800.0" in text
    scenario.write_text(text.replace("max_time_s = 1800.0", "max_time_s = 8.0"))
    _, result, out, _ = load("--scenario", scenario, "--realtime")
    assert result["end_reason"] == "time limit" and result["contacts"] == 0, result
    with open(out / "trace.csv", newline="") as file:
        states = {row["stop_state"] for row in csv.DictReader(file)}
    assert states - {"0"}, "the kernel never left INIT"
    shutil.rmtree(out)
    shutil.rmtree(folder)


main([loads_one_truck, same_seed_same_trace, trucks_that_stand_elsewhere_and_are_of_other_sizes_are_loaded, what_is_no_truck_is_not_loaded, app_holds_no_machine_descriptor, real_time_gets_under_way])
