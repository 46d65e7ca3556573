"""A person walks into the swing path: the machine stands still before the oracle sees a contact, and the summary says why."""
import shutil

from berm_command import load, main

GROUND_REASONS = {"collision_predicted", "unknown_ground", "stale_ground"}


def stops_for_a_person():
    for seed in (1, 2, 3):
        status, result, out, text = load("--scenario", "person", "--seed", seed)
        assert result is not None, text[-500:]
        assert result["contacts"] == 0, f"seed {seed}: {result['contacts']} contacts"
        assert GROUND_REASONS & result["kernel_stops"].keys(), f"seed {seed}: the person stopped nothing: {result['kernel_stops']}"
        assert "kernel stops" in text and any(reason in text for reason in GROUND_REASONS)
        assert status == 0, f"seed {seed}: the truck was not loaded after the person had left"
        shutil.rmtree(out)


main([stops_for_a_person])
