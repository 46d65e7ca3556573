"""Death and hang of processes in mid-swing: the machine stands within the contract's time, untouched."""
import csv
import math
import shutil

from berm_command import load, main

SWINGING = 0.3  # rad/s: mid-swing


def mid_swing(seed):
    """The time of the second full-speed swing in a run of this seed, read from a run without fault up to the same point (same seed, same trace)."""
    status, _, out, text = load("--scenario", "short", "--seed", seed)
    assert status == 0, text[-500:]
    with open(out / "trace.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    shutil.rmtree(out)
    fast = [float(row["time_s"]) for row in rows if abs(float(row["swing_rad_s"])) > SWINGING]
    assert fast, "the machine never swings"
    later = [t for t in fast if t > fast[0] + 3.0]
    return (later or fast)[0] + 0.2


def check(fault, silence_s):
    at = mid_swing(4)
    status, result, out, text = load("--scenario", "short", "--seed", 4, "--fault", f"{fault}@{at:.2f}")
    assert result is not None, text[-500:]
    assert result["contacts"] == 0
    standstill = result["standstill_after_fault_s"]
    assert standstill is not None, "the machine did not stand still"
    with open(out / "trace.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    speed = max(abs(float(row["swing_rad_s"])) for row in rows if abs(float(row["time_s"]) - at) < 0.15)
    assert speed > SWINGING / 2, f"the fault did not strike in mid-swing ({speed:.2f} rad/s)"
    print(f"{fault}: struck at {math.degrees(speed):.0f} deg/s, standstill {standstill:.2f} s later (silence is noticed after {silence_s} s)")
    assert status == 0, text[-500:]
    shutil.rmtree(out)
    return result


def killed_app_stops_the_machine():
    result = check("kill-app", 0.05)
    assert {"request_hold", "app_silent"} & result["kernel_stops"].keys(), result["kernel_stops"]


def stopped_app_stops_the_machine():
    result = check("stop-app", 0.05)
    assert {"request_hold", "app_silent"} & result["kernel_stops"].keys(), result["kernel_stops"]


def killed_kernel_stops_the_machine():
    check("kill-kernel", 0.05)


def a_fault_after_the_end_is_said_to_be_one():
    status, result, out, text = load("--scenario", "short", "--seed", 4, "--fault", "kill-app@99999")
    assert status == 1 and result["standstill_after_fault_s"] is None, text[-500:]
    assert "berm load: the run ended before the fault (99999 s)" in text and "did not come to a standstill" not in text, text[-500:]
    shutil.rmtree(out)


main([killed_app_stops_the_machine, stopped_app_stops_the_machine, killed_kernel_stops_the_machine, a_fault_after_the_end_is_said_to_be_one])
