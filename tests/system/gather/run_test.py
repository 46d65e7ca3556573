"""A run's journal gathered by the angles of swing and pan, against the plant's ground: what was dug away is forgotten."""
import json
import math
import pathlib
import shutil
import struct
import tempfile

from berm_command import load, main, one_clear_line, run

DUG_M, STALE_M, NEAR_M = 0.15, 0.1, 12.0
TRUCK_Y = (4.0, 9.0)  # short.toml's truck stands there: the ground's grid does not hold it


def heights(path):
    lines = path.read_text().splitlines()
    x, y, cell = (float(value) for value in lines[0].split(",")[:3])
    return x, y, cell, [[float(value) for value in line.split(",")] for line in lines[1:]]


def gathered(journal, folder, *options, says=""):
    cloud, out = folder / "cloud.pcd", folder / "gather.json"
    done = run("berm_gather", journal, "--pcd", cloud, "--json", out, "--picture", folder / "cloud.png", *options)
    assert done.returncode == 0, done.stderr
    assert says in done.stdout, done.stdout
    data = cloud.read_bytes().split(b"DATA binary\n", 1)[1]
    return json.loads(out.read_text()), [(x, y, z) for x, y, z, _, _ in struct.iter_unpack("<fffId", data)]


def what_was_dug_away_is_forgotten():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    status, result, out, text = load("--scenario", "short", "--seed", 1)
    assert status == 0, text[-500:]
    x_low, y_low, cell, start = heights(out / "terrain_start.csv")
    end = heights(out / "terrain_end.csv")[3]
    shot = {}
    for name, options in (("forgets", ()), ("keeps", ("--shrink", 10))):  # 10 m off every range: nothing is ever seen through
        figures, points = gathered(out / "journal.mcap", folder, *options)
        stale, off = 0, []
        for x, y, z in points:
            i, j = int((y - y_low) / cell), int((x - x_low) / cell)
            if not (0 <= i < len(end) and 0 <= j < len(end[0])):
                continue
            if start[i][j] - end[i][j] > DUG_M:
                stale += z > end[i][j] + STALE_M
            elif math.hypot(x, y) < NEAR_M and not TRUCK_Y[0] < y < TRUCK_Y[1]:
                off.append(abs(z - end[i][j]))
        off.sort()
        shot[name] = stale
        print(f"{name}: {figures['points_in']} points in, {figures['points_kept']} kept, {figures['merged']} merged, {figures['deleted']} deleted, {stale} stale over dug ground, "
              f"{1000 * off[len(off) // 2]:.0f} mm from the ground in the median, {1000 * off[int(0.95 * len(off))]:.0f} in 95 %")
        assert figures["ignored"] == 0 and figures["scans_without_plane"] == 0 and figures["cleared"] == 0, figures
        assert off[len(off) // 2] < 0.02 and off[int(0.95 * len(off))] < 0.08, "the ground is not where the plant has it"
    assert shot["keeps"] >= 50, f"only {shot['keeps']} points of what was dug away: the test shows nothing"
    assert shot["forgets"] <= 0.05 * shot["keeps"], shot
    shutil.copy(out / "journal.mcap", folder / "cut.mcap")
    whole = (folder / "cut.mcap").read_bytes()
    (folder / "cut.mcap").write_bytes(whole[: len(whole) // 2])
    figures, _ = gathered(folder / "cut.mcap", folder, says="cut.mcap breaks off after ")  # of a run that broke off
    assert figures["points_kept"] > 10000, figures
    spoilt = bytearray(whole)
    spoilt[len(spoilt) // 2] ^= 1
    (folder / "spoilt.mcap").write_bytes(spoilt)
    one_clear_line(run("berm_gather", folder / "spoilt.mcap"), "spoilt.mcap: byte ")
    one_clear_line(run("berm_gather", folder / "cut.mcap", folder / "cloud.pcd"), "cut.mcap: a journal has both scanners")
    shutil.rmtree(out)
    shutil.rmtree(folder)


main([what_was_dug_away_is_forgotten])
