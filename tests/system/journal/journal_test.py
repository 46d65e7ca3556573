"""A run's journal replays bit for bit; a change, a loss, a cut or damage is found and named; the writer's death disturbs nobody."""
import json
import pathlib
import random
import re
import shutil
import struct
import tempfile
import zlib

from berm_command import ROOT, load, main, one_clear_line, run
from journal_records import CYCLE_HEAD, DECISION, STATE, cycles_in, records

SEED = 20240611  # of the damage below
scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-journal-"))
HEAD, FRAME = CYCLE_HEAD + STATE + DECISION, 16
seen = {}


def replay(path, *options):
    result = scratch / "replay.json"
    result.unlink(missing_ok=True)
    done = run("berm_replay", path, "--json", result, *options)
    print(done.stdout, done.stderr, flush=True)
    return done, json.loads(result.read_text()) if result.exists() else None


def repair(data):
    """Recomputes the CRCs of all chunks and of the data section."""
    for code, at, size in list(records(data)):
        if code == 6:
            struct.pack_into("<I", data, at + 24, zlib.crc32(data[at + 40:at + size]))
        elif code == 15:
            struct.pack_into("<I", data, at, zlib.crc32(data[:at - 9]))
            return


def a_run_replays():
    status, result, out, text = load("--scenario", "short", "--seed", 4)
    assert status == 0, text[-500:]
    assert result["journal_lost"] == 0
    seen["out"], seen["data"] = out, bytearray((out / "journal.mcap").read_bytes())
    assert not (out / "journal.mcap.part").exists()
    done, replayed = replay(out / "journal.mcap")
    assert done.returncode == 0, done.stdout + done.stderr
    assert replayed["cycles"] == replayed["decisions"] > 1000 and replayed["mismatches"] == 0 and replayed["lost"] == 0
    assert abs(replayed["cycles"] * 0.01 - result["simulated_seconds"]) < 0.5


def one_changed_byte_of_one_frame_is_found():
    data = bytearray(seen["data"])
    places = list(cycles_in(data))
    for place in places[len(places) // 2:]:  # a frame that matters: the front angle
        cycle, frames = struct.unpack_from("<Q", data, place + 24)[0], struct.unpack_from("<H", data, place + 48)[0]
        angle = [place + HEAD + FRAME * i for i in range(frames) if struct.unpack_from("<I", data, place + HEAD + FRAME * i)[0] == 0x18FF7DE8]
        if angle:
            data[angle[0] + 5] ^= 0x40
            break
    repair(data)
    changed = scratch / "changed.mcap"
    changed.write_bytes(data)
    done, replayed = replay(changed)
    assert done.returncode == 1
    assert replayed["mismatches"] >= 1 and replayed["first_mismatch_cycle"] == cycle, (replayed, cycle)
    assert replayed["first_mismatch_field"] in done.stdout and str(cycle) in done.stdout


def another_parameter_is_found():
    machine = (ROOT / "interface_spec/config/machines/zx200.toml").read_text()
    longer, changed = re.subn(r"(?m)^(command = )([0-9.]+)", lambda found: f"{found[1]}{float(found[2]) + 0.01:.3f}", machine)
    assert changed == 1, "the machine file has no command latency to change"
    other = scratch / "machine.toml"
    other.write_text(longer)
    site = ROOT / "interface_spec/config/sites/bench.toml"
    made = run("berm_params", other, site, "-o", scratch / "other.params")
    assert made.returncode == 0, made.stderr
    done, replayed = replay(seen["out"] / "journal.mcap", "--parameters", scratch / "other.params")
    assert done.returncode == 1 and replayed["mismatches"] > 0 and replayed["first_mismatch_field"], replayed


def a_result_that_cannot_be_written_is_told_before_the_work():
    path = seen["out"] / "journal.mcap"
    for wanted, why in ((scratch / "missing" / "r.json", "folder does not exist"), (scratch, "is a folder"), (path, "would be overwritten")):
        done = run("berm_replay", path, "--json", wanted)
        one_clear_line(done, "--json")
        assert done.returncode == 2 and why in done.stderr and done.stdout == "", (done.returncode, done.stderr, done.stdout)
    assert path.read_bytes() == seen["data"], "the journal was touched"


def cut_or_damaged_files_get_one_clear_line_or_are_called_incomplete():
    random_source = random.Random(SEED)
    print("seed", SEED)
    whole = seen["data"]
    path = scratch / "bad.mcap"
    small = [0, 7, 8, 9, 20, 200] + [random_source.randrange(1000, 60000) for _ in range(8)] + [len(whole) - 1, len(whole) - 30]
    for size in small:
        path.write_bytes(whole[:size])
        done, replayed = replay(path)
        assert done.returncode in (1, 2), f"cut at {size}: {done.returncode}"
        if done.returncode == 2:
            one_clear_line(done, path.name)
            assert replayed is None
        else:
            assert not replayed["complete"] and replayed["mismatches"] == 0, f"cut at {size}"
    for _ in range(12):
        data = bytearray(whole[:400000])  # damage near the begin, so that each try is short
        data[random_source.randrange(len(data))] ^= 1 << random_source.randrange(8)
        path.write_bytes(data)
        done, replayed = replay(path)
        assert done.returncode in (1, 2)


def the_writers_death_disturbs_nobody_and_is_seen():
    at = 6.0
    status, result, out, text = load("--scenario", "short", "--seed", 4, "--fault", f"kill-journal@{at}")
    assert status == 0, text[-800:]
    assert result["journal_lost"] > 0 and "LOST" in text
    assert (out / "trace.csv").read_bytes() == (seen["out"] / "trace.csv").read_bytes(), "the machine moved otherwise"
    assert not (out / "journal.mcap").exists()
    done, replayed = replay(out / "journal.mcap.part")
    assert done.returncode == 1 and not replayed["complete"]
    assert replayed["mismatches"] == 0 and replayed["decisions"] > 100 * (at - 2.5), "what was written before must replay"
    shutil.rmtree(out)


def a_run_with_a_dead_app_replays():
    _, result, out, text = load("--scenario", "short", "--seed", 4, "--fault", "kill-app@8")
    assert result is not None, text[-500:]
    done, replayed = replay(out / "journal.mcap")
    assert done.returncode == 0 and replayed["mismatches"] == 0 and replayed["lost"] == 0
    shutil.rmtree(out)


# verifies: SK-JO-2, SK-JO-4, SK-JO-10, SK-JO-11, SK-JO-20, SK-JO-21, IF-JR-10, IF-JR-12
main([a_run_replays, one_changed_byte_of_one_frame_is_found, another_parameter_is_found,
      a_result_that_cannot_be_written_is_told_before_the_work, cut_or_damaged_files_get_one_clear_line_or_are_called_incomplete,
      the_writers_death_disturbs_nobody_and_is_seen, a_run_with_a_dead_app_replays])
