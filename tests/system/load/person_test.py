"""A person walks into the swing path: the machine stands still before the oracle sees a contact, and the summary says why."""
import shutil

from berm_command import load, main

MARGIN_M = 0.30


def stops_for_a_person():
    for seed in (1, 2, 3):
        status, result, out, text = load("--scenario", "person", "--seed", seed)
        assert result is not None, text[-500:]
        assert result["contacts"] == 0, f"seed {seed}: {result['contacts']} contacts"
        # Either the app saw the person first and held back, or the kernel stopped: what counts is the distance kept, the kernel's margin.
        assert result["closest_approach_m"] >= MARGIN_M, f"seed {seed}: only {result['closest_approach_m']:.2f} m"
        print(f"seed {seed}: closest {result['closest_approach_m']:.2f} m, kernel stops {result['kernel_stops']}")
        assert status == 0, f"seed {seed}: the truck was not loaded after the person had left"
        shutil.rmtree(out)


main([stops_for_a_person])
