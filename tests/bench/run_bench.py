"""berm bench: runs the benchmark programs (one a map size), shows their tables, merges their JSON, and with --check judges the ratios."""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

PROGRAMS = ("berm_bench_600", "berm_bench_150", "berm_bench_gathering", "berm_bench_planes")
PLAIN_LOOP_TIMES = 1.5   # the certified check against the plain loop
INSERT_PLAIN_SHARE = 0.5  # insertion against the plain loop
INSERT_PEER_TIMES = 5.0   # insertion against updateNode
GATHER_PEER_TIMES = 5.0   # gathering against insertPointCloud with its ray casting
PLANES_PEER_TIMES = 8.0   # plane stage, and whole recognition, against every plane extraction of PCL and CGAL on the usual sweep and one four times as dense
SCALING_SLACK = 1.25      # of the points' own factor, as much as n log n would take from one density to the other
PLANES_MEASURES = ("recall", "angle_error", "offset_error")
PLANES_STAGES = ("planes", "recognition")
PLANES_SIZES = (36000, 144000)  # samples: some 9,400 returns, and 37,600


def arguments():
    p = argparse.ArgumentParser(prog="./berm bench", description="Speed of the kernel's certified check and map insertion, side by side with FCL, Bullet and OctoMap "
                                "as the distribution packages them and with plain loops, on the same workload in the same process; who decides grazing cases how; "
                                "and gathering, extraction of planes and truck recognition beside OctoMap, PCL and CGAL.")
    p.add_argument("name", nargs="?", default="", metavar="NAME", help="only workloads whose name contains this (--list names them)")
    p.add_argument("--json", metavar="FILE", help="list of workload, unit, ours, peer, peer_value, ratio (above 1: ours is so many times better), reference (plain loop or memory)")
    p.add_argument("--check", action="store_true", help="exit status 1 where a ratio to a plain loop or to a peer is missed, or ours decides a grazing case wrongly")
    p.add_argument("--list", action="store_true", help="names of the workloads, and stop")
    return p.parse_args()


def run(program, *options, **how):
    return subprocess.run([str(pathlib.Path(os.environ["BERM_BIN"]) / program), *options], **how)


def misses(rows):
    """What --check holds against the rows: ratios within one run only, never a time."""
    said = set()
    for r in rows:
        name, ours, reference = r["workload"], r["ours"], r["reference"]
        if name.startswith("certificate") and ours > PLAIN_LOOP_TIMES * reference:
            said.add(f"{name}: {ours / reference:.2f} times the plain loop, at most {PLAIN_LOOP_TIMES} wanted")
        if name.startswith("insert") and ours < INSERT_PLAIN_SHARE * reference:
            said.add(f"{name}: {ours / reference:.2f} of the plain loop, at least {INSERT_PLAIN_SHARE} wanted")
        if name.startswith("insert") and r["ratio"] < INSERT_PEER_TIMES:
            said.add(f"{name}: {r['ratio']:.1f} times {r['peer']}, at least {INSERT_PEER_TIMES:.0f} wanted")
        if name.startswith("gathering_speed") and r["ratio"] < GATHER_PEER_TIMES:
            said.add(f"{name}: {r['ratio']:.1f} times {r['peer']}, at least {GATHER_PEER_TIMES:.0f} wanted")
        if name.startswith("gathering_memory") and r["ratio"] < 1.0:
            said.add(f"{name}: {1 / r['ratio']:.2f} of the memory of {r['peer']}, less than 1 wanted")
        if name in [f"{stage}_speed_{size}" for stage in PLANES_STAGES for size in PLANES_SIZES] and r["ratio"] < PLANES_PEER_TIMES:
            said.add(f"{name}: {r['ratio']:.2f} times as fast as {r['peer']}, at least {PLANES_PEER_TIMES:.0f} wanted")
        if name in [f"{stage}_{what}_{size}" for stage in PLANES_STAGES for what in PLANES_MEASURES for size in PLANES_SIZES] and r["ratio"] < 1.0:
            said.add(f"{name}: {ours:.3g} against {r['peer_value']:.3g} {r['unit']} of {r['peer']}, no worse wanted")
        if name in ("planes_scaling", "recognition_scaling") and ours > SCALING_SLACK * reference:
            said.add(f"{name}: {ours:.1f} times the time for {reference:.1f} times the points, at most {SCALING_SLACK} times as many wanted")
        if name.startswith("grazing") and ours > 0:
            said.add(f"{name}: {ours:.0f} wrong decisions of ours")
    return sorted(said)


def write_whole(path, text):
    half = pathlib.Path(f"{path}.part")
    half.write_text(text)
    os.replace(half, path)


def main():
    a = arguments()
    names = {p: run(p, "--list", capture_output=True, text=True, check=True).stdout.split() for p in PROGRAMS}
    if a.list:
        print("\n".join(n for p in PROGRAMS for n in names[p]))
        return 0
    chosen = [p for p in PROGRAMS if any(a.name in n for n in names[p])]
    if not chosen:
        sys.stderr.write(f"berm bench: no workload's name contains '{a.name}'; ./berm bench --list names them\n")
        return 2
    rows = []
    with tempfile.TemporaryDirectory(prefix="berm-bench-") as folder:
        for program in chosen:
            part = pathlib.Path(folder) / f"{program}.json"
            if run(program, "--name", a.name, "--json", str(part)).returncode != 0:
                return 1
            rows += json.loads(part.read_text())
    if a.json:
        try:
            write_whole(a.json, json.dumps(rows, indent=1) + "\n")
        except OSError as error:
            sys.stderr.write(f"berm bench: {a.json}: {error.strerror}\n")
            return 1
    missed = misses(rows)
    for line in missed:
        print(f"missed: {line}")
    if a.check and not missed:
        print("every ratio holds")
    return 1 if a.check and missed else 0


if __name__ == "__main__":
    sys.exit(main())
