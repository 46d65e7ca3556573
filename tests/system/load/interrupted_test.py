"""A run that is ended by a signal ends with the report of what ran until then, and leaves nothing half-written."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

from berm_command import BIN, main

PATIENCE_S = 240


def started(program, *arguments):
    """The program in a process group of its own, its --out folder; SIGINT is not ignored whatever this test's own shell does."""
    out = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    command = [str(BIN / program), *map(str, arguments), "--out", str(out), "--json", str(out / "report.json")]
    print("$", " ".join(command), flush=True)
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    return process, out


def wait_for(condition, process):
    until = time.monotonic() + PATIENCE_S
    while not condition():
        assert process.poll() is None, f"ended by itself with {process.returncode}"
        assert time.monotonic() < until, "nothing came of it"
        time.sleep(0.05)


def passes(out):
    events = out / "app.jsonl.part"
    return events.read_text().count('"event":"pass"') if events.exists() else 0


def children(process):
    """Name and pid of each child, from /proc."""
    found = {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            pid, rest = stat.read_text().split(" (", 1)
        except OSError:  # it has ended
            continue
        name, fields = rest.rsplit(") ", 1)
        if int(fields.split()[1]) == process.pid:
            found[name] = int(pid)
    return found


def check_whole(out, *names):
    left = {path.name for path in out.iterdir()}
    assert not [name for name in left if name.endswith(".part")], left
    assert set(names) <= left, left


def shift_by_sigterm():
    process, out = started("berm_soak", "--hours", "1", "--seed", "3")
    wait_for(lambda: passes(out) >= 2, process)
    process.send_signal(signal.SIGTERM)
    words, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 1, (process.returncode, errors)
    assert "Report of the shift" in words and "the shift ended early: terminated" in errors, words[-1500:] + errors
    report = json.loads((out / "report.json").read_text())
    assert report["passes"] >= 2 and report["contacts"] == 0 and report["end_reason"] == "terminated" and 0 < report["hours"] < 1, report
    check_whole(out, "trace.csv", "truth.json", "app.jsonl", "result.json", "scenario.toml")
    shutil.rmtree(out)


def load_by_the_terminal():
    """The terminal's interrupt goes to every process of the group at once."""
    process, out = started("berm_load", "--scenario", "bench", "--seed", "2")
    wait_for(lambda: passes(out) >= 1, process)
    os.killpg(process.pid, signal.SIGINT)
    words, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 1 and "Summary (bench, seed 2" in words, (process.returncode, words[-1500:], errors)
    assert "berm load: interrupted (Interrupt) after " in errors, errors
    report = json.loads((out / "report.json").read_text())
    assert report["passes"] >= 1 and report["journal_lost"] == 0 and report["contacts"] == 0 and report["kernel_faults"] == 0, report
    check_whole(out, "trace.csv", "truth.json", "app.jsonl", "result.json", "journal.mcap", "site.svg")
    replayed = subprocess.run([BIN / "berm_replay", out / "journal.mcap"], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert replayed.returncode == 0, replayed.stdout[-500:] + replayed.stderr[-500:]
    shutil.rmtree(out)


def twice_ends_at_once():
    """A plant that hangs would keep the report for ever: whoever asks again gets out, and no process is left."""
    process, out = started("berm_load", "--scenario", "bench", "--seed", "2")
    wait_for(lambda: passes(out) >= 1, process)
    pids = children(process)
    os.kill(pids["berm_plant"], signal.SIGSTOP)
    process.send_signal(signal.SIGTERM)
    time.sleep(1.0)
    assert process.poll() is None, "ended though the plant hangs"
    process.send_signal(signal.SIGINT)  # another one: two of the same that wait are one
    words, errors = process.communicate(timeout=30)
    assert process.returncode == 2 and "berm load: interrupted (Interrupt): there is no report" in errors and "Summary" not in words, (process.returncode, errors)
    for comm, pid in pids.items():
        assert not pathlib.Path(f"/proc/{pid}").exists(), f"{comm} is left"
    shutil.rmtree(out)


main([shift_by_sigterm, load_by_the_terminal, twice_ends_at_once])
