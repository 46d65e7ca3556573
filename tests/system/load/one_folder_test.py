"""Two runs at the same time into one folder: the second is refused in one line before it writes anything, and the first does not notice."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

from berm_command import BIN, main, one_clear_line, run

PATIENCE_S = 120


def first_run(out, program="berm_load", *more):
    command = [str(BIN / program), *map(str, more), "--out", str(out)]
    print("$", " ".join(command), flush=True)
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    until = time.monotonic() + PATIENCE_S
    while not (out / "trace.csv.part").exists():
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < until, "nothing came of it"
        time.sleep(0.02)
    return process


def the_second_is_refused():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    out = folder / "out"
    first = first_run(out, "berm_load", "--scenario", "bench", "--seed", "2")
    ids = {path.name: path.stat().st_ino for path in out.iterdir()}
    for program, *more in (("berm_load", "--scenario", "bench"), ("berm_soak", "--hours", "0.02"), ("berm_watch", "--scenario", "person")):
        done = run(program, *more, "--out", out, timeout=60)
        one_clear_line(done, out, "in use")
        assert done.returncode == 2 and "Summary" not in done.stdout, (done.returncode, done.stdout)
    now = {path.name: path.stat().st_ino for path in out.iterdir()}
    assert {name: now.get(name) for name in ids} == ids and "scenario.toml" not in now, (ids, now)
    first.send_signal(signal.SIGTERM)
    errors = first.communicate(timeout=PATIENCE_S)[1]
    assert first.returncode == 1 and "interrupted" in errors, errors
    assert {"journal.mcap", "trace.csv", "truth.json", "app.jsonl", "result.json"} <= {path.name for path in out.iterdir()}
    shutil.rmtree(folder)


def a_killed_one_leaves_no_lock():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    first = first_run(folder, "berm_load", "--scenario", "bench")
    os.kill(first.pid, signal.SIGKILL)
    first.wait(timeout=PATIENCE_S)
    (folder / "trace.csv.part").unlink()
    second = first_run(folder, "berm_load", "--scenario", "bench")
    second.send_signal(signal.SIGTERM)
    second.communicate(timeout=PATIENCE_S)
    assert second.returncode == 1, second.returncode
    shutil.rmtree(folder)


def a_killed_one_leaves_no_file_of_a_former_one():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    for name in ("truth.json", "result.json", "journal.mcap", "notes.txt"):
        (folder / name).write_text("former")
    first = first_run(folder, "berm_load", "--scenario", "bench")
    os.kill(first.pid, signal.SIGKILL)
    first.wait(timeout=PATIENCE_S)
    left = {path.name for path in folder.iterdir()}
    assert "notes.txt" in left and not {"truth.json", "result.json", "journal.mcap"} & left, left
    shutil.rmtree(folder)


def a_soak_draws_over_no_scenario_of_somebodys_own():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    (folder / "scenario.toml").write_text("schema = 1\n")
    one_clear_line(run("berm_soak", "--hours", 0.01, "--out", folder, timeout=60), "scenario.toml: was not drawn by berm soak")
    assert (folder / "scenario.toml").read_text() == "schema = 1\n"
    shutil.rmtree(folder)


main([the_second_is_refused, a_killed_one_leaves_no_lock, a_killed_one_leaves_no_file_of_a_former_one, a_soak_draws_over_no_scenario_of_somebodys_own])
