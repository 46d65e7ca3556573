"""berm gather: made-up sweeps and real recordings into one cloud; refusals are one line."""
import json
import math
import os
import pathlib
import resource
import signal
import stat
import struct
import tempfile
import threading

from berm_command import REAL_DATA, main, one_clear_line, run

scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-gather-"))
KEYS = {"scans", "points_in", "points_kept", "deleted", "merged", "points_per_second"}


def sweep(name, distance, reverse=False, begin=0.0, lines=41):
    """A PCD of 41 upright scanlines of 51 points, all at one distance from the viewpoint; or of the first of them."""
    rows = []
    for line in range(lines):
        pan = math.radians(40 - line if reverse else line)
        for k in range(51):
            up = math.radians(k - 25)
            rows.append((distance * math.cos(up) * math.cos(pan), distance * math.cos(up) * math.sin(pan), 1 + distance * math.sin(up), line, begin + 0.02 * line))
    text = "\n".join(" ".join(f"{v:.6f}" if i != 3 else str(v) for i, v in enumerate(row)) for row in rows)
    path = scratch / name
    path.write_text(f"VERSION 0.7\nFIELDS x y z scanline time\nSIZE 4 4 4 4 8\nTYPE F F F U F\nCOUNT 1 1 1 1 1\nWIDTH {len(rows)}\nHEIGHT 1\n"
                    f"VIEWPOINT 0 0 1 1 0 0 0\nPOINTS {len(rows)}\nDATA ascii\n{text}\n")
    return path, len(rows)


def gather(*arguments):
    out = scratch / "result.json"
    out.unlink(missing_ok=True)
    done = run("berm_gather", *arguments, "--json", out)
    print(done.stdout, done.stderr)
    assert done.returncode == 0, done.stderr
    return json.loads(out.read_text())


def what_stood_before_the_wall_goes():
    near, count = sweep("near.pcd", 2.0)
    far, _ = sweep("far.pcd", 5.0, reverse=True)
    cloud, picture = scratch / "cloud.pcd", scratch / "cloud.png"
    result = gather(near, far, "--pcd", cloud, "--picture", picture)
    assert KEYS <= result.keys(), result.keys()
    assert result["scans"] == 82 and result["points_in"] == 2 * count
    assert result["deleted"] == count, f"{result['deleted']} of {count} deleted"
    assert result["points_kept"] == count and result["merged"] == 0
    assert picture.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    head, data = cloud.read_bytes().split(b"DATA binary\n", 1)
    assert f"POINTS {count}".encode() in head and len(data) == 24 * count
    for x, y, z, _, _ in struct.iter_unpack("<fffId", data):
        assert abs(math.hypot(x, y, z - 1) - 5.0) < 1e-3
    again = gather(cloud)  # what it writes it reads
    assert again["points_in"] == count


def what_is_seen_again_is_merged():
    near, count = sweep("once.pcd", 3.0)
    result = gather(near, near)
    assert result["merged"] == count and result["points_kept"] == count and result["deleted"] == 0
    few = gather(near, "--capacity", 500)
    assert few["points_kept"] <= 500 and few["overflowed"] == count - few["points_kept"]


def simultaneous_recordings_are_played_by_time():
    """One scanner sees something near during the first fifth of a sweep and nothing more; the other, a moment later, sees through where it was."""
    near, few = sweep("gone.pcd", 2.0, begin=7.0, lines=8)
    far, count = sweep("through.pcd", 5.0, begin=7.01)
    for files, options, kept, deleted in (((far, near), (), count, few), ((near, far), (), count, few), ((far, near), ("--clock", "one"), count, few),
                                          ((far, near), ("--clock", "own"), count + few, 0)):
        cloud = scratch / "by_time.pcd"
        result = gather(*files, *options, "--pcd", cloud)
        together = options != ("--clock", "own")
        assert result["played"] == ([[str(f) for f in files]] if together else [[str(f)] for f in files]), result["played"]
        # In time order the near ones' last scanline is seen through as well: the far ones' sweep goes on over it.
        assert result["deleted"] == deleted and result["points_kept"] == kept, result
    pipe = scratch / "pipe"  # cannot be read twice
    os.mkfifo(pipe)
    writer = threading.Thread(target=lambda: pipe.write_bytes(near.read_bytes()))
    writer.start()
    result = gather(far, pipe)
    writer.join()
    assert result["deleted"] == few and result["played"] == [[str(far), str(pipe)]]
    start, _ = sweep("start.pcd", 2.0)
    assert gather(start, far, start)["played"] == [[str(f)] for f in (start, far, start)], "those that begin at 0 have no common clock"
    one_clear_line(run("berm_gather", near, far, "--clock", "two"), "--clock")
    timeless = scratch / "timeless.pcd"
    timeless.write_text("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n")
    one_clear_line(run("berm_gather", near, timeless, "--clock", "one"), "timeless.pcd: time: the file has none")


def an_upright_scanner_is_mounted():
    """A planar scan in x and y, as an LMS gives it, of a scanner that stands upright at 1.5 m and looks to the left."""
    rows = [(4 * math.cos(math.radians(a)), 4 * math.sin(math.radians(a)), 0.0) for a in range(-60, 61)]
    flat = scratch / "flat.pcd"
    flat.write_text(f"FIELDS x y z scanline time\nSIZE 4 4 4 4 8\nTYPE F F F U F\nWIDTH {len(rows)}\nHEIGHT 1\nPOINTS {len(rows)}\nDATA ascii\n"
                    + "".join(f"{x:.6f} {y:.6f} {z} 0 1.0\n" for x, y, z in rows))
    cloud = scratch / "mounted.pcd"
    gather(flat, "--mount", "1,0,1.5,90,0,90", "--pcd", cloud)
    places = sorted(row[:3] for row in struct.iter_unpack("<fffId", cloud.read_bytes().split(b"DATA binary\n", 1)[1]))
    wanted = sorted((1.0, x, 1.5 + y) for x, y, _ in rows)
    assert len(places) == len(wanted)
    for place in places:
        assert min(math.dist(place, other) for other in wanted) < 1e-4, place
    assert "yaw,pitch,roll" in " ".join(run("berm_gather", "--help").stdout.split())


def short_of_memory(program, limit, *arguments):
    return run(program, *arguments, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))


def too_little_memory_names_the_file():
    """A million places, each alone in its part of the cloud: 16 MB to read, some 400 MB to gather."""
    if short_of_memory("berm_gather", 300 << 20, "--help").returncode != 0:
        print("SKIPPED part: this build does not start within 300 MB (sanitizers)")
        return
    wide = scratch / "wide.pcd"
    count = 1_000_000
    with wide.open("wb") as file:
        file.write(f"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH {count}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA binary\n".encode())
        file.write(struct.pack(f"<{3 * count}f", *(v for i in range(count) for v in (1 + i % 100, i // 100 % 100, i // 10000))))
    result = scratch / "no.json"
    for limit, words in ((40 << 20, "wide.pcd: memory: too little to read its 1200"), (220 << 20, "wide.pcd: memory: too little to gather point ")):
        done = short_of_memory("berm_gather", limit, wide, "--range-limit", 1000, "--json", result, "--pcd", scratch / "no.pcd")
        one_clear_line(done, words)
        assert done.returncode == 2 and not result.exists() and not (scratch / "no.pcd").exists()


def refusals():
    near, _ = sweep("good.pcd", 2.0)
    result = scratch / "none.json"
    empty, broken = scratch / "empty.pcd", scratch / "broken.pcd"
    empty.write_bytes(b"")
    broken.write_bytes(near.read_bytes()[:-40])
    for path in (empty, broken, scratch / "missing.pcd", scratch):
        done = run("berm_gather", path, "--json", result)
        one_clear_line(done, path.name)
        assert done.returncode == 2 and not result.exists()
    for options, word in (((), "FILE"), ((near, "--no-such-option"), "no-such-option"), ((near, "--capacity", "0"), "capacity"), ((near, "--mount", "1,2"), "mount"),
                          ((near, "--mount", "1,2,3,nan"), "mount"), ((near, "--mount", "1,2,3,4,5"), "mount"), ((near, "--pcd", scratch / "no/such/folder.pcd"), "no/such")):
        done = run("berm_gather", *options)
        one_clear_line(done, word)
        assert done.returncode == 2
    none = scratch / "none.pcd"
    none.write_text("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n")
    assert run("berm_gather", none).returncode == 1
    done = run("berm_gather", "--help")
    assert done.returncode == 0 and "--picture" in done.stdout


def a_picture_that_cannot_be_written_costs_nothing():
    near, _ = sweep("pictured.pcd", 2.0)
    device = scratch / "device"  # the full device's numbers: never the system's own node, which is not to be lost
    try:
        os.mknod(device, 0o600 | stat.S_IFCHR, os.makedev(1, 7))
    except PermissionError:
        print("SKIPPED part: only root makes device nodes")
    else:
        one_clear_line(run("berm_gather", near, "--picture", device), "device: cannot be written: No space left on device")
        assert stat.S_ISCHR(device.stat().st_mode), "the device is gone"
    old = scratch / "old.png"
    old.write_bytes(b"old")
    full = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))  # below the picture's size; the signal for it is ignored
    done = run("berm_gather", near, "--picture", old, preexec_fn=lambda: (signal.signal(signal.SIGXFSZ, signal.SIG_IGN), full()), restore_signals=False)
    one_clear_line(done, "old.png: cannot be written: File too large")
    assert old.read_bytes() == b"old" and not list(scratch.glob("old.png.*")), "the old picture is gone, or half a new one is left"


def real_recordings():
    if not REAL_DATA.exists():
        print(f"SKIPPED: no recordings at {REAL_DATA}")
        return
    result = gather(REAL_DATA / "lms111/20210302_lms111.pcapng.json", "--picture", scratch / "lms.png")
    assert result["scans"] == 175 and result["merged"] > 0.9 * result["points_in"]
    result = gather(REAL_DATA / "vlp16_dual_return/vlp16_dual_return.pcap", "--mount", "0,0,1.8,0", "--range-deviation", "0.03", "--pcd", scratch / "vlp.pcd")
    assert result["points_in"] > 50000 and result["merged"] > result["points_in"] / 2
    assert len((scratch / "vlp.pcd").read_bytes()) > 24 * result["points_kept"]


main([what_stood_before_the_wall_goes, what_is_seen_again_is_merged, simultaneous_recordings_are_played_by_time, an_upright_scanner_is_mounted, refusals, too_little_memory_names_the_file,
      a_picture_that_cannot_be_written_costs_nothing, real_recordings])
