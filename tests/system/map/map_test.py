"""The recorded VLP-16 capture through the running kernel: every last return of the origin's own decoding lies at or below its cell's height."""
import json
import math
import pathlib
import struct
import tempfile

from berm_command import REAL_DATA, main, run

FOLDER = REAL_DATA / "vlp16_dual_return"
MOUNT_Z = 1.8
# The origin's codes. It names the farther return of a pair "first" (4 weak, 9 strongest) and the nearer one "last" (5, 10); the packets say
# otherwise, and this test holds both against them. 6: one echo only.
ONE_ECHO, FARTHER, NEARER = {6}, {4, 9}, {5, 10}
LASER_OF_CHANNEL = [0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15]  # firing order of the elevations, lowest first (VLP-16 manual)
RANGE_MIN = 0.4  # nearer returns are the sensor's own housing: the kernel drops them


def read_pcd(path):
    """Rows of a PCD file as dicts; ascii and binary."""
    raw = path.read_bytes()
    head, at = {}, 0
    while "DATA" not in head:
        end = raw.index(b"\n", at)
        words = raw[at:end].decode().split()
        at = end + 1
        if words and not words[0].startswith("#"):
            head[words[0]] = words[1:]
    names, sizes, types = head["FIELDS"], list(map(int, head["SIZE"])), head["TYPE"]
    if head["DATA"] == ["ascii"]:
        return [dict(zip(names, map(float, line.split()))) for line in raw[at:].decode().splitlines() if line]
    assert head["DATA"] == ["binary"], head["DATA"]
    codes = {("F", 4): "f", ("F", 8): "d", ("U", 1): "B", ("U", 2): "H", ("U", 4): "I", ("I", 1): "b", ("I", 2): "h", ("I", 4): "i"}
    row = struct.Struct("<" + "".join(codes[kind, size] for kind, size in zip(types, sizes)))
    return [dict(zip(names, row.unpack_from(raw, at + i * row.size))) for i in range(int(head["POINTS"][0]))]


def pairs_with_two_echoes(path):
    """(laser, near, far) in steps of 2 mm -> azimuths in degrees, of every firing of the capture with two different returns."""
    raw, at, found = path.read_bytes(), 24, {}
    while at < len(raw):
        size = struct.unpack_from("<I", raw, at + 8)[0]
        data = raw[at + 16 + size - 1206:at + 16 + size]
        at += 16 + size
        for block in range(0, 1200, 200):
            azimuth = struct.unpack_from("<H", data, block + 2)[0] / 100
            for shot in range(32):
                pair = [struct.unpack_from("<H", data, block + b + 4 + 3 * shot)[0] for b in (0, 100)]
                if pair[0] != pair[1] and min(pair) > 0:
                    found.setdefault(shot % 16, []).append((min(pair), max(pair), azimuth))
    return found


def the_origins_codes_mean_what_the_packets_say():
    pairs = pairs_with_two_echoes(FOLDER / "vlp16_dual_return.pcap")
    wrong = checked = 0
    for p in read_pcd(FOLDER / "reference_sweep.pcd"):
        if p["return_type"] not in FARTHER | NEARER:
            continue
        step, azimuth = p["distance"] / 0.002, math.degrees(p["azimuth"])
        beside = [(abs(near - step) < 1.5, abs(far - step) < 1.5) for near, far, a in pairs.get(LASER_OF_CHANNEL[int(p["channel"])], [])
                  if abs((a - azimuth + 180) % 360 - 180) < 0.45]
        is_near, is_far = any(b[0] for b in beside), any(b[1] for b in beside)
        if is_near == is_far:
            continue  # another echo of a neighbouring firing has the same range
        checked += 1
        wrong += is_far != (p["return_type"] in FARTHER)
    print(f"{checked} returns of pairs: {wrong} are not the farther (codes 4, 9) or nearer (5, 10) of their pair")
    assert checked > 300 and wrong == 0


def every_last_return_is_below_its_cell():
    out = pathlib.Path(tempfile.mkdtemp(prefix="berm-map-"))
    done = run("berm_map", FOLDER / "vlp16_dual_return.pcap", "--json", out / "map.json", "--picture", out / "map.svg", "--mount", f"0,0,{MOUNT_Z},0")
    assert done.returncode == 0, done.stdout + done.stderr
    print(done.stdout)
    result = json.loads((out / "map.json").read_text())
    assert result["packets"] == 603 and result["rejected"] == 0, (result["packets"], result["rejected"])
    assert (out / "map.svg").stat().st_size > 5000
    cell = result["cell_m"]
    cells = {(math.floor(c["x_m"] / cell), math.floor(c["y_m"] / cell)): c["height_m"] for c in result["cells"]}
    points = read_pcd(FOLDER / "reference_sweep.pcd")
    print("fields:", sorted(points[0]), "points:", len(points), "return types:", sorted({p["return_type"] for p in points}))
    last = [p for p in points if p["return_type"] in ONE_ECHO | FARTHER]
    half = 15.6
    checked = above = missing = 0
    for p in last:
        if math.sqrt(p["x"] ** 2 + p["y"] ** 2 + p["z"] ** 2) < RANGE_MIN or max(abs(p["x"]), abs(p["y"])) >= half:
            continue
        checked += 1
        height = cells.get((math.floor(p["x"] / cell), math.floor(p["y"] / cell)))
        if height is None:
            missing += 1
        elif p["z"] + MOUNT_Z > height + 1e-4:
            above += 1
    print(f"{checked} last returns checked of {len(points)} points: {above} above their cell, {missing} in a cell never observed")
    assert checked > 5000, "too few points were checked"
    assert above == 0 and missing == 0


main([the_origins_codes_mean_what_the_packets_say, every_last_return_is_below_its_cell], None if FOLDER.exists() else f"no recording at {FOLDER}")
