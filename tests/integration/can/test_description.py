"""berm.dbc, as canmatrix reads it, against the codec: every message, both directions, extremes and random values.

usage: test_description.py PROBE FOLDER_OF_THE_DBC     BERM_SEED repeats a run
verifies: IF-CAN-1, IF-CAN-2 (all but the bit rate), IF-CAN-3, IF-CAN-4, IF-CAN-5, IF-CAN-8
"""
import logging
import os
import pathlib
import random
import re
import subprocess
import sys
from decimal import Decimal

logging.disable(logging.CRITICAL)  # canmatrix tells which formats it lacks
import canmatrix.formats  # noqa: E402

PROBE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
SEED = int(os.environ.get("BERM_SEED", "20261121"))
DRAWS = 300
INT32 = 2**31
# codec units in one SI unit
PER_UNIT = {"rad": Decimal(10**6), "rad/s": Decimal(10**6), "Pa": Decimal("0.001"), "kg": Decimal(1), "degC": Decimal(1), "1/min": Decimal("0.1"), "": Decimal(1)}

print(f"seed {SEED} (BERM_SEED={SEED} repeats it)", flush=True)
draw = random.Random(SEED)
failures = []


def check(good, what):
    if not good:
        failures.append(what)


def probe(lines):
    done = subprocess.run([PROBE], input="\n".join(lines) + "\n", capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout.split("\n")


matrix = canmatrix.formats.loadp_flat(str(FOLDER / "berm.dbc"))
frames = {f.name: f for f in matrix.frames}
fields = {words[0]: words[1:] for words in (line.split() for line in probe(["fields"]) if line)}
header = (FOLDER / "berm_can.h").read_text()
ids = {int(value, 16) for value in re.findall(r"^#define BERM_CAN_\w+ 0x([0-9A-F]{8})u", header, re.M)}

# The description has exactly the identifiers of the header, and the codec exactly its messages and signals.
check(len(ids) == 19, f"{len(ids)} identifiers read from berm_can.h")
check({f.arbitration_id.id for f in matrix.frames} == ids, "identifiers of berm.dbc and berm_can.h differ")
check(len(frames) == len(matrix.frames), "a message name twice")
check(set(frames) == set(fields), f"messages differ: {set(frames) ^ set(fields)}")
for name, f in frames.items():
    check(f.arbitration_id.extended and f.size == 8 and not f.is_fd, f"{name}: not a classic extended frame of eight bytes")
    check([s.name for s in f.signals] == fields[name], f"{name}: signals differ: {[s.name for s in f.signals]} {fields[name]}")
    check(len(f.transmitters) == 1 and f.receivers, f"{name}: sender or receiver is missing")
    check("Period" in (f.comment or ""), f"{name}: no comment with its period")
    check(f.cycle_time > 0 or name.startswith("Guard_"), f"{name}: no period")
    period = re.search(r"Period (\d+) ms", f.comment or "")
    check(name.startswith("Guard_") or (period and int(period.group(1)) == f.cycle_time), f"{name}: comment and period differ")
    used = set()
    for s in f.signals:
        bits = set(range(s.start_bit, s.start_bit + s.size))
        check(s.is_little_endian and not s.is_signed and not s.is_float, f"{name}.{s.name}: not little endian and unsigned")
        check(not bits & used and max(bits) < 64, f"{name}.{s.name}: overlaps")
        check(s.unit in PER_UNIT, f"{name}.{s.name}: unit '{s.unit}'")
        used |= bits
guarded = {name for name, f in frames.items() if re.search(r"(?<!Not )\bGuarded\.", f.comment)}
listed = set(re.findall(r"^#define BERM_CAN_(\w+) 0x[0-9A-F]+u +/\* [^*]*\bguarded", header, re.M))
check(len(guarded) == len(listed) == 9, f"guarded messages: {sorted(guarded)} {sorted(listed)}")


def names_and_codec_range(name, s):
    """Bounds of what the codec's field can be given, in codec units."""
    if name == "Machine_Setting_Cmd" and s.name == "Horn":
        return 0, 1  # a bool there: two of its four raw values
    low, high = s.offset * PER_UNIT[s.unit], (s.offset + s.factor * (2**s.size - 1)) * PER_UNIT[s.unit]
    return int(low), int(high)


def raw_draws(name, s):
    top = 1 if (name, s.name) == ("Machine_Setting_Cmd", "Horn") else 2**s.size - 1
    if name.startswith("Guard_") and s.name == "Padding":
        return [top] * (DRAWS + 2)
    return [0, top] + [draw.randint(0, top) for _ in range(DRAWS)]


# From the description to the codec: extremes, then random raw values.
questions, expected = [], []
for name, f in frames.items():
    columns = {s.name: raw_draws(name, s) for s in f.signals}
    for i in range(DRAWS + 2):
        raw = {signal: values[i] for signal, values in columns.items()}
        questions.append(f"decode {f.arbitration_id.id:08X} 8 {bytes(f.encode(raw)).hex()}")
        values = [(s.offset + s.factor * raw[s.name]) * PER_UNIT[s.unit] for s in f.signals]
        expected.append(" ".join([name] + [str(int(v)) for v in values]))
        check(all(v == int(v) for v in values), f"{name}: a raw step is no whole number of the codec's units")
for question, want, got in zip(questions, expected, probe(questions)):
    check(want == got, f"{question}: codec says '{got}', description says '{want}'")
decoded = len(questions)

# From the codec to the description: random physical values, beyond the fields as well; nearest step, saturated, all other bits as told.
questions, asked = [], []
for name, f in frames.items():
    for i in range(DRAWS):
        values = []
        for s in f.signals:
            low, high = names_and_codec_range(name, s)
            span = high - low
            wide = s.unit in ("rad", "rad/s", "Pa") and name != "Heartbeat" and i % 3 == 0
            v = draw.randint(low - span // 4, high + span // 4) if wide else draw.randint(low, high)
            v = {1: low, 2: high}.get(i, v)
            if wide and i % 30 == 0:
                v = draw.choice([-INT32, INT32 - 1])
            values.append(v)
        questions.append(f"encode {name} {' '.join(map(str, values))}")
        asked.append((f, values))
for question, (f, values), answer in zip(questions, asked, probe(questions)):
    can_id, length, data = answer.split()
    check(int(can_id, 16) == f.arbitration_id.id and length == "8", f"{question}: {answer}")
    signals = f.decode(bytes.fromhex(data))
    for s, value in zip(f.signals, values):
        raw, physical = signals[s.name].raw_value, signals[s.name].phys_value * PER_UNIT[s.unit]
        low, high = s.offset * PER_UNIT[s.unit], (s.offset + s.factor * (2**s.size - 1)) * PER_UNIT[s.unit]
        if s.name == "Padding":
            check(raw == 0xFFFF, f"{question}: padding {raw:04X}")
        elif value <= low or value >= high:
            check(physical == (low if value <= low else high), f"{question}: {s.name} is {physical}, not saturated")
        else:
            check(abs(physical - value) * 2 <= s.factor * PER_UNIT[s.unit], f"{question}: {s.name} is {physical}, not the nearest step")
    used = sum(((1 << s.size) - 1) << s.start_bit for s in f.signals)
    check(int.from_bytes(bytes.fromhex(data), "little") & ~used == 0, f"{question}: an unused bit is set: {data}")

print(f"{len(frames)} messages, {sum(len(f.signals) for f in matrix.frames)} signals, {decoded} frames decoded, {len(questions)} encoded, {len(failures)} failures")
for failure in failures[:20]:
    print("FAIL", failure)
sys.exit(1 if failures else 0)
