"""A person walks into the swing path: the machine stands still before the oracle sees a contact, and the summary says why. What the
kernel only slowed is counted (of dust: sight_test.py)."""
import csv
import shutil

from berm_command import check_slowed, load, main

MARGIN_M = 0.30
STILL_RAD_S = 0.005
STOPPED = 4
WHY = ("collision_predicted", "overpass")  # whichever the map knew first: his head at the bucket's height, or that he may not be passed over


def seconds_of_standstill(trace):
    """Longest standstill with the person on the bench (x below 6 m) in which the kernel was STOPPED: what the app does not ask for while it waits is no motion to stop."""
    longest = since = 0.0
    stopped = False
    with open(trace, newline="") as file:
        for row in csv.DictReader(file):
            stands = all(abs(float(row[f"{joint}_rad_s"])) < STILL_RAD_S for joint in ("swing", "boom", "stick", "bucket"))
            held = stands and float(row["person_x_m"]) < 6.0
            since = since + 0.01 if held else 0.0
            stopped = held and (stopped or int(row["stop_state"]) == STOPPED)
            longest = max(longest, since if stopped else 0.0)
    return longest


def stands_for_a_person():
    for seed in (1, 2, 3):
        status, result, out, text = load("--scenario", "person", "--seed", seed)
        assert result is not None, text[-500:]
        assert result["contacts"] == 0, f"seed {seed}: {result['contacts']} contacts"
        assert result["closest_approach_m"] >= MARGIN_M, f"seed {seed}: only {result['closest_approach_m']:.2f} m"
        assert sum(result["kernel_stops"].get(why, 0) for why in WHY) >= 1, f"seed {seed}: the kernel did not stop for the person: {result['kernel_stops']}"
        check_slowed(result, out, text)  # nothing, as a rule: the app stands by itself before what is too high
        own = sum(result["own_motion_stops"].values())
        assert own < sum(result["kernel_stops"].values()), f"seed {seed}: the stop for the person counts as the app's own: {result['own_motion_stops']}"
        line = [row for row in text.splitlines() if row.strip().startswith("kernel stops")]
        assert len(line) == 1 and any(why in line[0] for why in WHY), f"seed {seed}: the summary does not say why: {line}"
        stood = seconds_of_standstill(out / "trace.csv")
        assert stood >= 2.0, f"seed {seed}: stood still for only {stood:.1f} s while the person was there"
        print(f"seed {seed}: closest {result['closest_approach_m']:.2f} m, stood {stood:.1f} s, kernel stops {result['kernel_stops']}")
        assert status == 0, f"seed {seed}: the truck was not loaded after the person had left"
        shutil.rmtree(out)


main([stands_for_a_person])
