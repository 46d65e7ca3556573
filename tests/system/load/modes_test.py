"""As root, kernel and app run as users of their own: they start whatever the umask and the modes of the files that they are given copies of. The app has no network."""
import os
import pathlib
import shutil
import stat
import subprocess
import tempfile

from berm_command import BIN, ROOT, main, one_clear_line, run

scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-modes-"))
scratch.chmod(0o755)


def private(path, text):
    path.write_text(text)
    path.chmod(0o600)
    return path


def a_second():
    """A scenario that ends after a second, its machine and its scripts readable by root alone."""
    folder = scratch / "own"
    folder.mkdir(exist_ok=True)
    for name in ("machines/zx200.toml", "sites/bench_small.toml"):
        private(folder / pathlib.Path(name).name, (ROOT / "interface_spec/config" / name).read_text())
    scripts = folder / "scripts"
    scripts.mkdir(mode=0o700, exist_ok=True)
    for name in ("pass.script", "approach.script"):
        private(scripts / name, (ROOT / "planning_app/scripts" / name).read_text())
    text = (ROOT / "fault_injection/scenarios/short.toml").read_text()
    for old, new in (('machine = "zx200"', f'machine = "{folder}/zx200.toml"'), ('site = "bench_small"', f'site = "{folder}/bench_small.toml"'), ("max_time_s = 1800.0", "max_time_s = 1.0")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return private(folder / "second.toml", text), scripts


def whatever_the_umask_and_the_modes():
    scenario, scripts = a_second()
    for mask in (0o077, 0o027):
        done = run("berm_load", "--scenario", scenario, "--scripts", scripts, "--quiet", timeout=120, umask=mask)
        assert done.returncode == 1 and "Summary (" in done.stdout, (oct(mask), done.returncode, done.stderr)


def a_folder_for_temporary_files_that_they_cannot_enter():
    scenario, _ = a_second()
    closed = scratch / "closed"
    (closed / "tmp").mkdir(parents=True)
    closed.chmod(stat.S_IRWXU)
    done = run("berm_load", "--scenario", scenario, "--out", scratch / "never", env={**os.environ, "TMPDIR": str(closed / "tmp")}, timeout=60)
    one_clear_line(done, f"TMPDIR: {closed}: mode 0700")
    assert not (scratch / "never").exists() and not any((closed / "tmp").iterdir()), "left behind by a run that never was"


def the_app_has_no_network():
    """Neither the bus nor the scanners' ports are to be reached from where it is."""
    scenario = ROOT / "fault_injection/scenarios/short.toml"
    load = subprocess.Popen([str(BIN / "berm_load"), "--scenario", str(scenario)], stdout=subprocess.PIPE, text=True)
    try:
        line = next(line for line in load.stdout if " app " in line)
        app = line.split(" app ")[1].split()[0]
        assert os.readlink(f"/proc/{app}/ns/net") != os.readlink("/proc/self/ns/net"), "the app has the computer's network"
        up = pathlib.Path(f"/proc/{app}/net/route").read_text().splitlines()[1:]
        assert not up, up
    finally:
        load.terminate()
        load.wait()
        load.stdout.close()


try:
    main([whatever_the_umask_and_the_modes, the_app_has_no_network, a_folder_for_temporary_files_that_they_cannot_enter], "only root gives them users of their own" if os.geteuid() != 0 else None)
finally:
    shutil.rmtree(scratch)
