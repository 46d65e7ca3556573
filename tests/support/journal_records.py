"""Reading a run's journal (MCAP, as interface_spec/journal/JOURNAL.md has it) in system tests. Standard library only."""
import pathlib
import re
import struct

SPEC = pathlib.Path(__file__).resolve().parents[2] / "interface_spec"


def stated(header, text):
    """A size that a header asserts, so that this reader needs no figure of its own."""
    return int(re.search(text + r"(\d+)", (SPEC / header).read_text()).group(1))


# Bytes of a cycle's record before its frames.
CYCLE_HEAD = stated("journal/journal_record.h", r"sizeof\(berm_journal_cycle\) == ")
STATE = stated("contract/berm_contract.h", r"sizeof\(berm_state\) == ")
DECISION = stated("contract/berm_contract.h", r"sizeof\(berm_decision\) == ")
RUN = 2  # BERM_STATE_RUN


def records(data):
    """(opcode, offset of the content, length) of every top-level record."""
    at = 8
    while at + 9 <= len(data) - 8:
        code, size = data[at], struct.unpack_from("<Q", data, at + 1)[0]
        yield code, at + 9, size
        at += 9 + size


def cycles_in(data):
    """Offset of the record of every cycle."""
    for code, at, size in records(data):
        if code != 6:
            continue
        end, at = at + size, at + 40
        while at < end:
            length, channel = struct.unpack_from("<Q", data, at + 1)[0], struct.unpack_from("<H", data, at + 9)[0]
            if data[at] == 5 and channel == 1:
                yield at + 9 + 22
            at += 9 + length


def decisions(data):
    """(time in us, kernel state, requested, commanded in urad/s) of every cycle."""
    for place in cycles_in(data):
        place += CYCLE_HEAD + STATE
        time_us = struct.unpack_from("<q", data, place + 8)[0]
        requested, commanded = struct.unpack_from("<4i", data, place + 48), struct.unpack_from("<4i", data, place + 64)
        yield time_us, data[place + 149], requested, commanded


def slowed_time(data):
    """What the kernel's own record says of its cuts: (seconds, spans). A joint's cut by more than the bus's step, but not to nothing."""
    seconds, spans, last_us = 0.0, 0, None
    for time_us, state, requested, commanded in decisions(data):
        if last_us is not None and (state != RUN or time_us - last_us > 300000):
            last_us = None
        if state != RUN or not any(c != 0 and abs(r - c) > 500 for r, c in zip(requested, commanded)):
            continue
        if last_us is None:
            spans, last_us = spans + 1, time_us - 10000
        seconds += (time_us - last_us) * 1e-6
        last_us = time_us
    return seconds, spans
