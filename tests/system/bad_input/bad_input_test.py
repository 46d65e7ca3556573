"""Bad input gets one clear line and a non-zero exit, and leaves nothing half-written."""
import json
import os
import pathlib
import re
import shutil
import stat
import struct
import subprocess
import tempfile

from berm_command import BIN, REAL_DATA, ROOT, main, one_clear_line, run

CAPTURE = REAL_DATA / "vlp16_dual_return" / "vlp16_dual_return.pcap"
MACHINE = ROOT / "interface_spec/config/machines/zx200.toml"
SITE = ROOT / "interface_spec/config/sites/bench.toml"
scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-bad-"))


def unknown_options():
    needed = {"berm_load": (), "berm_journal": (), "berm_replay": (), "berm_map": ("x.pcap",), "berm_params": (), "berm_kernel": (),
              "berm_plant": ("--scenario", ROOT / "fault_injection/scenarios/bench.toml", "--can", "udp:239.255.66.250:1", "--scan-port", 1, "--out", scratch / "none"),
              "berm_app": ("--machine", MACHINE, "--site", SITE, "--truck-classes", ROOT / "interface_spec/config/truck_classes.toml",
                           "--scripts", ROOT / "planning_app/scripts", "--socket", "x")}
    for program, options in needed.items():
        one_clear_line(run(program, *options, "--no-such-option"), "no-such-option")


def names_are_not_empty():
    """A shell variable that was never set. Each option whose type in the help is a text or an output; empty text that has a meaning there says so in its type."""
    wanted = {"berm_load": {}, "berm_params": {"MACHINE": MACHINE, "SITE": SITE}, "berm_scripts": {}, "berm_echoes": {}, "berm_identify": {}, "berm_validate": {"--runs": 1}, "berm_watch": {"--intrusions": 1},
              "berm_soak": {"--hours": 0.01}, "berm_truck_world": {"--scenes": 1, "--out": scratch / "none"}, "berm_trucks": {"--scenes": 1}, "berm_map": {"FILE": scratch / "none.pcap"},
              "berm_gather": {"FILE": scratch / "none.pcd"}, "berm_recognize": {"FILE": scratch / "none.pcd"},
              "berm_plant": {"--scenario": ROOT / "fault_injection/scenarios/bench.toml", "--can": "udp:239.255.66.250:1", "--scan-port": 1, "--out": scratch / "none"},
              "berm_app": {"--machine": MACHINE, "--site": SITE, "--truck-classes": ROOT / "interface_spec/config/truck_classes.toml", "--scripts": ROOT / "planning_app/scripts", "--socket": "x"}}
    for program, options in wanted.items():
        named = re.findall(r"^  (?:-\w,)?(--[a-z-]+|[A-Za-z]+) (?:TEXT|OUTPUT)\b(?! or)", run(program, "--help").stdout, re.MULTILINE)
        assert named, f"{program}: no option with a text"
        for name in named:
            words = {**options, name: ""}.items()
            one_clear_line(run(program, *(word for option, value in words for word in ((option, value) if option.startswith("--") else (value,))), cwd=scratch, timeout=60), name)
    for program, name in (("berm_kernel", "--parameters"), ("berm_kernel", "--can"), ("berm_kernel", "--socket"), ("berm_journal", "--socket"), ("berm_journal", "--out"),
                          ("berm_replay", "--json"), ("berm_replay", "--parameters"), ("berm_params", "--show")):
        one_clear_line(run(program, name, ""), name, "must not be empty" if program != "berm_replay" else "wants a file")
    one_clear_line(run("berm_replay", "", scratch / "none.mcap"), "FILE")


def an_option_is_given_once():
    for program, name in (("berm_journal", "--socket"), ("berm_journal", "--out"), ("berm_replay", "--json"), ("berm_replay", "--parameters"), ("berm_load", "--json"), ("berm_load", "--seed")):
        one_clear_line(run(program, name, 1, name, 2, cwd=scratch), name)


def a_message_is_one_line_whatever_a_name_holds():
    name = "none\n\x1b[0mhere"
    for program in (("berm_recognize", scratch / name), ("berm_gather", scratch / name), ("berm_map", scratch / name), ("berm_load", "--scenario", scratch / name), ("berm_load", "--scenario", name),
                    ("berm_params", scratch / name, SITE, "-o", scratch / "x"), ("berm_scripts", scratch / name), ("berm_replay", scratch / name),
                    ("berm_kernel", "--parameters", scratch / name, "--can", "x", "--scan-port", 1, "--socket", "x"), ("berm_journal", "--socket", scratch / name, "--out", scratch / "x.mcap"),
                    ("berm_plant", "--scenario", scratch / name, "--can", "x", "--scan-port", 1, "--out", scratch / "x")):
        done = run(*program)
        one_clear_line(done, "none??[0mhere")
        assert "\x1b" not in done.stderr, program
    one_clear_line(run("berm_load", "--scenario", "x" * 300), "there is none of that name")


def a_message_quotes_little_of_a_file():
    big = scratch / "big.pcd"
    for head in ("", "VERSION 0.7\nFIELDS ", "VERSION 0.7\nFIELDS x y z\nTYPE F F F\nDATA "):
        big.write_text(head + "k" * 3_000_000 + "\n")
        for program in ("berm_recognize", "berm_gather"):
            done = run(program, big)
            one_clear_line(done, "big.pcd: ")
            assert len(done.stderr) < 400, (program, len(done.stderr))
    measured = scratch / "measured.toml"
    measured.write_text((ROOT / "fault_injection/scenarios/measured.toml").read_text().replace("site_terrain/terrain_xyz.pcd", str(big)))
    for command in (("berm_load", "--scenario", measured), ("berm_load", "--soil", big)):
        done = run(*command)
        one_clear_line(done, "big.pcd: ")
        assert len(done.stderr) < 400, (command, len(done.stderr))


def a_journal_that_cannot_be_written():
    """Told of before the kernel's ring is taken: there is no kernel here, and that would be the next to be told of."""
    folder = scratch / "journals"
    (folder / "begun.mcap.part").mkdir(parents=True)
    (folder / "file").write_text("x")
    os.mkfifo(folder / "pipe")
    for out, why in ((folder, "is a folder"), (folder / "none" / "x.mcap", "its folder does not exist"), (folder / "file" / "x.mcap", "its folder does not exist"),
                     (folder / "begun.mcap", "its .part file is a folder"), (folder / "pipe", "is no regular file, and would be replaced by one")):
        done = run("berm_journal", "--socket", scratch / "none.sock", "--out", out)
        one_clear_line(done, f"berm_journal: --out: {out}: {why}")
    one_clear_line(run("berm_journal", "--socket", scratch / "none.sock", "--out", folder / "x.mcap"), "none.sock")
    assert {path.name for path in folder.iterdir()} == {"begun.mcap.part", "file", "pipe"}, "left behind"


def help_is_no_error():
    for program in ("berm_load", "berm_journal", "berm_replay", "berm_map", "berm_params", "berm_plant", "berm_app", "berm_kernel"):
        done = run(program, "--help")
        assert done.returncode == 0 and len(done.stdout.splitlines()) > 3, f"{program} --help"


def a_full_standard_output_is_no_success():
    device = scratch / "full"  # the full device's numbers: the system's own node is nobody's to try things on
    try:
        os.mknod(device, 0o600 | stat.S_IFCHR, os.makedev(1, 7))
    except PermissionError:
        print("SKIPPED part: only root makes device nodes")
        return
    for program, name in (("berm_load", "berm load"), ("berm_journal", "berm_journal"), ("berm_replay", "berm replay"), ("berm_kernel", "berm_kernel"), ("berm_app", "berm_app")):
        with open(device, "w") as full:
            done = subprocess.run([str(BIN / program), "--help"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60, check=False)
        assert done.returncode == 2 and done.stderr == f"{name}: standard output: cannot be written: No space left on device\n", (program, done.returncode, done.stderr)


def a_standard_error_that_takes_nothing_changes_no_status():
    for program, options in {"berm_params": (scratch / "none.toml", SITE, "-o", scratch / "x"), "berm_gather": (scratch / "none.pcd",), "berm_recognize": (scratch / "none.pcd",),
                             "berm_scripts": (scratch / "none",), "berm_load": ("--scenario", "none"), "berm_map": (scratch / "none.pcap",), "berm_identify": ("--machine", "none"),
                             "berm_validate": ("--machine", "none"), "berm_watch": ("--scenario", "none"), "berm_soak": ("--machine", "none"),
                             "berm_truck_world": ("--scenes", 1, "--out", scratch / "scenes", "--classes", scratch / "none"), "berm_trucks": ("--scenes", 1, "--classes", scratch / "none")}.items():
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([str(BIN / program), *map(str, options)], stdout=subprocess.PIPE, stderr=full, timeout=60, check=False)
        expected = 1 if program == "berm_scripts" else 2
        assert done.returncode == expected, f"{program}: {done.returncode}, not {expected}"


def scenarios():
    one_clear_line(run("berm_load", "--scenario", "no-such-scenario"), "no-such-scenario")
    one_clear_line(run("berm_load", "--scenario", scratch / "missing.toml"), "missing.toml")
    for name, text in {"syntax": "schema = = 1\n", "empty": "", "foreign": "[package]\nname = 'x'\n"}.items():
        path = scratch / f"{name}.toml"
        path.write_text(text)
        out = scratch / f"out-{name}"
        one_clear_line(run("berm_load", "--scenario", path, "--out", out, "--json", scratch / "result.json"), path.name)
        assert not (scratch / "result.json").exists(), "a result for a run that never was"
        assert not out.exists() or not any(out.iterdir()), f"left behind: {list(out.iterdir())}"


def files_nested_too_deep():
    deep = scratch / "deep.toml"
    deep.write_text("a = " + "[" * 10000 + "]" * 10000 + "\n")
    for program in (("berm_params", deep, SITE, "-o", scratch / "never.params"), ("berm_load", "--scenario", deep), ("berm_load", "--soil", deep)):
        one_clear_line(run(*program), "deep.toml: line 1: nested more than 100 deep")


def scenario_fields():
    source = (ROOT / "fault_injection/scenarios/bench.toml").read_text()
    path = scratch / "field.toml"
    path.write_text(source + "\nno_such_key = 1\n")
    one_clear_line(run("berm_plant", "--scenario", path, "--seed", 1, "--trucks", 1, "--can", "udp:239.255.66.250:49999", "--scan-port", 49998,
                       "--out", scratch / "plant-out", "--realtime", timeout=60), "field.toml", "no_such_key")


def ground_without_its_recording():
    out = scratch / "measured-out"
    environment = {**os.environ, "BERM_REAL_DATA": str(scratch / "nowhere")}
    one_clear_line(run("berm_load", "--scenario", "measured", "--out", out, "--json", scratch / "result.json", env=environment), "measured.toml", "terrain.measured.file",
                   "nowhere/site_terrain/terrain_xyz.pcd")
    assert not out.exists() and not (scratch / "result.json").exists(), "left behind by a run that never was"


def no_result_goes_over_what_is_read_or_another():
    folder = scratch / "apart"
    folder.mkdir()
    machine, site, scenario, soil = (folder / name for name in ("machine.toml", "site.toml", "scenario.toml", "soil.toml"))
    machine.write_text(MACHINE.read_text())
    site.write_text(SITE.read_text())
    scenario.write_text((ROOT / "fault_injection/scenarios/bench.toml").read_text().replace('machine = "zx200"', f'machine = "{machine}"').replace('site = "bench"', f'site = "{site}"'))
    soil.write_text((ROOT / "fault_injection/soils/dry_sand.toml").read_text())
    capture = folder / "capture.pcap"
    capture.write_bytes(b"none")
    ring = ROOT / "interface_spec/config/machines/zx200_ring.toml"
    before = {path: path.read_bytes() for path in (*folder.iterdir(), MACHINE, ring)}
    out = folder / "out"
    out.mkdir()
    for command, words in ((("berm_load", "--scenario", scenario, "--json", machine), "the scenario's machine"), (("berm_load", "--scenario", scenario, "--json", site), "the scenario's site"),
                           (("berm_load", "--scenario", scenario, "--soil", soil, "--json", soil), "--soil"), (("berm_load", "--scenario", scenario, "--out", out, "--json", out / "trace.csv"), "trace.csv"),
                           (("berm_watch", "--scenario", scenario, "--json", machine), "the scenario's machine"), (("berm_watch", "--scenario", scenario, "--picture", site), "the scenario's site"),
                           (("berm_watch", "--intrusions", 1, "--machine", "zx200_ring", "--json", ring), "--machine"),
                           (("berm_validate", "--runs", 1, "--json", MACHINE), "--machine"), (("berm_map", capture, "--picture", MACHINE), "--machine"), (("berm_map", capture, "--json", capture), "FILE"),
                           (("berm_identify", "--scenario", scenario, "--json", site, "--out", out), "the scenario's site"), (("berm_identify", "--scenario", scenario, "--json", "braking_table.svg", "--out", out), "--json"),
                           (("berm_identify", "--out", "zx200.svg", "--picture", "./zx200.svg"), "--out"), (("berm_identify", "--json", "zx200_measured.toml"), "--out"),
                           (("berm_soak", "--hours", 0.01, "--out", out, "--json", out / "scenario.toml"), "scenario.toml")):
        done = run(*command, cwd=folder, timeout=60)
        lost = [path for path, content in before.items() if path.read_bytes() != content]
        for path in lost:
            path.write_bytes(before[path])
        one_clear_line(done, words, "too")
        assert not lost, lost


def load_numbers():
    one_clear_line(run("berm_load", "--trucks", "0"), "trucks")
    one_clear_line(run("berm_load", "--soil", "chocolate"), "soil 'chocolate'", "dry_sand", "frozen_crust", "sticky_clay")
    soil = scratch / "soil.toml"
    soil.write_text((ROOT / "fault_injection/soils/dry_sand.toml").read_text().replace("swell = 1.10", "swell = 0.5"))
    one_clear_line(run("berm_load", "--soil", soil), "soil.toml", "soil.swell", "0.5")
    one_clear_line(run("berm_load", "--seed", "many"), "seed")
    one_clear_line(run("berm_load", "--fault", "kill-all@3"), "kill-all")
    for never in ("kill-app", "kill-app@inf", "kill-app@nan", "kill-app@-1", "kill-app@1e400", "kill-app@5x"):
        one_clear_line(run("berm_load", "--fault", never, timeout=60), f"'{never}' wants a time")
    for never in ("pause-app", "pause-app@5", "pause-app@5+", "pause-app@+5", "pause-app@5+x", "pause-app@5+-1"):
        one_clear_line(run("berm_load", "--fault", never, timeout=60), f"'{never}' wants a time and how long")
        kernel = never.replace("app", "kernel")
        one_clear_line(run("berm_load", "--fault", kernel, timeout=60), f"'{kernel}' wants a time and how long")
    for never in ("pause-kernel@5+0", "pause-kernel@5+0.51"):
        one_clear_line(run("berm_load", "--fault", never, timeout=60), f"'{never}'", "at most 0.5 s")


def scripts():
    folder = scratch / "scripts"
    shutil.copytree(ROOT / "planning_app/scripts", folder)
    done = run("berm_scripts", folder)
    assert done.returncode == 0 and "carry_boom" in done.stdout, done.stderr
    good = (folder / "pass.script").read_text()
    (folder / "pass.script").write_text(good.replace("goal carry_boom", "goal carry_bom"))
    wrong = next(i for i, line in enumerate(good.splitlines(), 1) if "goal carry_boom" in line)
    for program in (("berm_scripts", folder), ("berm_load", "--scripts", folder, "--out", scratch / "no-run")):
        one_clear_line(run(*program), "pass.script", f"line {wrong}", "carry_bom", "carry_boom")
    assert not (scratch / "no-run").exists(), "left behind by a run that never was"
    one_clear_line(run("berm_load", "--scripts", scratch / "nowhere"), "nowhere/pass.script")


def parameter_block():
    good = scratch / "good.params"
    done = run("berm_params", MACHINE, SITE, "-o", good)
    assert done.returncode == 0, done.stderr
    block = good.read_bytes()
    kernel = ("--can", "udp:239.255.66.251:49997", "--scan-port", 49996, "--socket", scratch / "k.sock")
    for name, bytes_ in {"crc": block[:200] + bytes([block[200] ^ 1]) + block[201:], "short": block[:-4], "long": block + b"\0" * 4, "empty": b"",
                         "foreign": os.urandom(len(block))}.items():
        path = scratch / f"{name}.params"
        path.write_bytes(bytes_)
        one_clear_line(run("berm_kernel", "--parameters", path, *kernel, timeout=20), path.name)
    one_clear_line(run("berm_kernel", "--parameters", scratch / "none.params", *kernel, timeout=20), "none.params")


def compile_leaves_nothing():
    bad = scratch / "bad_machine.toml"
    bad.write_text(MACHINE.read_text().replace("boom = 5.648", "boom = -1.0"))
    target = scratch / "never.params"
    one_clear_line(run("berm_params", bad, SITE, "-o", target), "bad_machine.toml", "boom")
    assert not target.exists(), "a parameter block of a bad machine file"


def captures():
    foreign = scratch / "foreign.pcap"
    ethernet_udp = bytes(12) + b"\x08\x00" + b"\x45\x00" + struct.pack(">HHHBBH", 20 + 8 + 4, 0, 0, 64, 17, 0) + bytes(8) + struct.pack(">HHHH", 1, 2368, 12, 0) + b"none"
    foreign.write_bytes(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1) + struct.pack("<IIII", 1, 0, len(ethernet_udp), len(ethernet_udp)) + ethernet_udp)
    for port in ("0", "-1", "65536", "99999", "1.5"):
        one_clear_line(run("berm_map", foreign, "--port", port), "--port", port)
    noise = scratch / "noise.pcap"
    noise.write_bytes(os.urandom(4000))
    for path in (foreign, noise, scratch / "missing.pcap"):
        one_clear_line(run("berm_map", path, "--json", scratch / "map.json", "--picture", scratch / "map.svg"), path.name)
    ethernet = bytes(12) + b"\x08\x00" + b"\x45\x00" + struct.pack(">HHHBBH", 20 + 8 + 1206, 0, 0, 64, 17, 0) + bytes(8) + struct.pack(">HHHH", 1, 2368, 8 + 1206, 0) + bytes(1206)
    years = scratch / "years.pcap"
    years.write_bytes(foreign.read_bytes()[:24] + b"".join(struct.pack("<IIII", second, 0, len(ethernet), len(ethernet)) + ethernet for second in (1, 3601, 2000000000)))
    one_clear_line(run("berm_map", years, "--json", scratch / "map.json", "--picture", scratch / "map.svg", timeout=20), "years.pcap: packet 3: time: 1999996399 s", "3600")
    if CAPTURE.exists():
        truncated = scratch / "truncated.pcap"
        truncated.write_bytes(CAPTURE.read_bytes()[:100001])
        one_clear_line(run("berm_map", truncated, "--json", scratch / "map.json", "--picture", scratch / "map.svg"), "truncated.pcap")
    else:
        print(f"SKIPPED part: no recording at {CAPTURE}")
    assert not (scratch / "map.json").exists() and not (scratch / "map.svg").exists(), "a map of a bad capture"


def a_folder_that_cannot_be_written():
    sealed = scratch / "sealed"
    sealed.mkdir(mode=0o555)
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "ro,size=64k", "tmpfs", str(sealed)], capture_output=True, check=False).returncode == 0
    if not mounted and os.geteuid() == 0:
        print("SKIPPED part: root writes everywhere but on a disk that is read-only, and none can be mounted")
        return
    try:
        for command in (("berm_load", "--scenario", "short"), ("berm_watch", "--scenario", "short", "--max-time", 5), ("berm_soak", "--hours", 0.01), ("berm_truck_world", "--scenes", 1)):
            one_clear_line(run(*command, "--out", sealed, timeout=60), f"{sealed}: cannot be written: ")
        for command in (("berm_load", "--json"), ("berm_trucks", "--scenes", 1, "--table"), ("berm_echoes", "--picture"), ("berm_replay", scratch / "none.mcap", "--json"),
                        ("berm_journal", "--socket", scratch / "none.sock", "--out")):
            one_clear_line(run(*command, sealed / "x", timeout=60), f"{command[-1]}: {sealed / 'x'}: cannot be written: ")
    finally:
        if mounted:
            subprocess.run(["umount", str(sealed)], check=True)


def no_room_for_its_files():
    """A full disk: what fails is named with the reason, nothing half-written has a final name, and what can be read on is kept and told of."""
    for size, kept, missing in (("64k", {"app.jsonl.part"}, {"terrain_start.csv", "terrain_start.csv.truck"}), ("2m", {"journal.mcap.part", "terrain_start.csv"}, {"journal.mcap"})):
        disk = scratch / f"disk-{size}"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(disk)], capture_output=True, check=False).returncode != 0:
            print("SKIPPED part: no small disk can be mounted")
            return
        try:
            out = disk / "run"
            done = run("berm_load", "--seed", 1, "--out", out)
            failed = out / ("terrain_start.csv: cannot be written" if size == "64k" else "trace.csv")
            assert done.returncode == 2 and f"berm_plant: {failed}: No space left on device" in done.stderr, done.stderr
            assert f"berm load: the plant failed: exit 1; not complete, in {out}: " in done.stderr, done.stderr
            left = {path.name for path in out.iterdir()}
            assert kept <= left and not missing & left and not {"trace.csv", "truth.json", "result.json"} & left, left
            assert all(name in done.stderr.splitlines()[-1] for name in left if name.endswith(".part")), (left, done.stderr)
            if "journal.mcap.part" in left:
                assert f"berm_journal: {out}/journal.mcap.part: No space left on device" in done.stderr, done.stderr
                replayed = run("berm_replay", out / "journal.mcap.part", "--json", scratch / "replayed.json")
                assert replayed.returncode == 1 and json.loads((scratch / "replayed.json").read_text())["mismatches"] == 0, replayed.stderr
        finally:
            subprocess.run(["umount", str(disk)], check=True)


try:
    main([unknown_options, names_are_not_empty, an_option_is_given_once, a_message_is_one_line_whatever_a_name_holds, a_message_quotes_little_of_a_file, a_journal_that_cannot_be_written, help_is_no_error, a_full_standard_output_is_no_success, a_standard_error_that_takes_nothing_changes_no_status, scenarios, files_nested_too_deep, scenario_fields, ground_without_its_recording, no_result_goes_over_what_is_read_or_another, load_numbers, scripts, parameter_block, compile_leaves_nothing, captures, a_folder_that_cannot_be_written, no_room_for_its_files])
finally:
    shutil.rmtree(scratch)
