"""Running Berm's programs from system tests. Standard library only."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time

from journal_records import slowed_time

BIN = pathlib.Path(os.environ["BERM_BIN"])
ROOT = pathlib.Path(os.environ["BERM_ROOT"])
REAL_DATA = pathlib.Path(os.environ.get("BERM_REAL_DATA") or ROOT.parent / "shared" / "real_data")
SKIPPED = 77  # ctest's SKIP_RETURN_CODE


def run(program, *arguments, timeout=600, **options):
    """Runs a program to its end; the command is printed so that a failure can be repeated."""
    command = [str(BIN / program), *map(str, arguments)]
    print("$", " ".join(command), flush=True)
    return subprocess.run(command, capture_output=True, text=True, timeout=timeout, **options)


def interrupted(program, *arguments, after, of="stderr", patience=120):
    """A terminal's interrupt, which goes to every process of the group, as soon as a line that begins so was said: the process, what it said on standard
    output and error after that line, and how many seconds later it ended."""
    command = [str(BIN / program), *map(str, arguments)]
    print("$", " ".join(command), flush=True)
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    line = next((line for line in getattr(process, of) if line.startswith(after)), None)
    assert line is not None, f"it ended without '{after}'"
    begin = time.monotonic()
    os.killpg(process.pid, signal.SIGINT)
    words, errors = process.communicate(timeout=patience)
    return process, words, errors, time.monotonic() - begin


def load(*arguments, timeout=600):
    """berm load into a fresh folder: (exit status, result.json's object, folder, output)."""
    out = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    done = run("berm_load", *arguments, "--out", out, "--json", out / "again.json", timeout=timeout)
    print(done.stdout[-3000:], done.stderr[-2000:], flush=True)
    result = out / "again.json"
    return done.returncode, json.loads(result.read_text()) if result.exists() else None, out, done.stdout + done.stderr


def check_slowed(result, out, text):
    """What the app counted of the kernel's cuts is what the kernel's own record says; the summary has it. Returns the spans."""
    seconds, spans = slowed_time((out / "journal.mcap").read_bytes())
    assert result["slowed_spans"] == spans, f"{result['slowed_spans']} spans by the app, {spans} by the journal"
    assert abs(result["slowed_seconds"] - seconds) < 0.005, f"{result['slowed_seconds']} s by the app, {seconds} s by the journal"
    row = [line.split("slowed by the kernel")[1].strip() for line in text.splitlines() if line.strip().startswith("slowed by the kernel")]
    expected = f"{result['slowed_seconds']:.1f} s in {spans} span" if spans else "never"
    assert len(row) == 1 and row[0].startswith(expected), f"the summary says {row}, not {expected}"
    return spans


def one_clear_line(done, *words):
    """A refusal: non-zero exit, one line on standard error with these words, nothing on standard output that looks like a result."""
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    assert done.returncode != 0, "exit status 0 for bad input"
    assert done.returncode > 0, f"died by signal {-done.returncode}"
    assert len(lines) == 1, f"not one line: {lines}"
    for word in words:
        assert str(word) in lines[0], f"'{word}' is not in: {lines[0]}"


def main(tests, skip_reason=None):
    """Runs test functions by name; prints each; non-zero when one fails."""
    if skip_reason:
        print(f"SKIPPED: {skip_reason}")
        raise SystemExit(SKIPPED)
    failures = 0
    for test in tests:
        try:
            test()
            print(f"ok   {test.__name__}", flush=True)
        except AssertionError as error:
            failures += 1
            print(f"FAIL {test.__name__}: {error}", flush=True)
    raise SystemExit(1 if failures else 0)
