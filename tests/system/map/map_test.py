"""The recorded VLP-16 capture through the running kernel: every last return of the origin's own decoding lies at or below its cell's height."""
import json
import math
import pathlib
import struct
import tempfile

from berm_command import REAL_DATA, main, run

FOLDER = REAL_DATA / "vlp16_dual_return"
MOUNT_Z = 1.8
LAST_TYPES = {5, 6, 10}  # the origin's codes: last weak, identical (one echo), last strongest
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
    last = [p for p in points if p["return_type"] in LAST_TYPES]
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


main([every_last_return_is_below_its_cell], None if FOLDER.exists() else f"no recording at {FOLDER}")
