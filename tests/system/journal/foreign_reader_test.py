"""The journal read by @mcap/core, the format's own implementation."""
import json
import pathlib
import shutil
import subprocess

from berm_command import BIN, load, main

VERSION = "2.2.2"  # of @mcap/core
folder = BIN.parent / "mcap_reader"


def install():
    """The reason why it cannot be had; None when it is there."""
    if (folder / "node_modules/@mcap/core/package.json").exists():
        return None
    if shutil.which("npm") is None or shutil.which("node") is None:
        return "node and npm are not installed"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.json").write_text('{"private": true}\n')
    done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", f"@mcap/core@{VERSION}"], cwd=folder, capture_output=True, text=True, timeout=120)
    return None if done.returncode == 0 else f"npm cannot get @mcap/core {VERSION}: {done.stderr.strip()[-200:]}"


def a_foreign_reader_counts_the_same_cycles():
    status, _, out, text = load("--scenario", "short", "--seed", 4)
    assert status == 0, text[-500:]
    script = folder / "read.mjs"
    script.write_text((pathlib.Path(__file__).parent / "read.mjs").read_text())
    done = subprocess.run(["node", str(script), str(out / "journal.mcap")], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-1000:]
    found = json.loads(done.stdout)
    print(found)
    end = found["metadata"]["berm_end"]
    assert found["counts"]["/kernel/cycle"] == found["counts"]["/kernel/decision"] == int(end["cycles"]) > 1000
    assert "/journal/lost" not in found["counts"]
    assert found["attachments"]["kernel.params"] > 100
    assert found["states"] and set(found["states"]) <= {"init", "standby", "run", "stopping", "stopped", "fault"}
    shutil.rmtree(out)


# verifies: SK-JO-13, IF-JR-10, IF-JR-13
main([a_foreign_reader_counts_the_same_cycles], install())
