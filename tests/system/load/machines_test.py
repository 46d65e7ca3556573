"""The shipped machines of 12 and 25 t each load a truck of their own size, untouched and without a stop of their own making."""
import csv
import shutil

from berm_command import load, main

# Round the tail of a machine that nothing watches the kernel has fenced so much, by its machine file (the ZX200's: 3600 mm).
FENCE_MM = {"12t": 2800, "25t": 3750}
# What a full bucket of the bench's soil weighs, 1340 kg/m3 loose, by the profiles' heaped volumes; the ZX200's weighs 1608.
BUCKET_KG = {"12t": 0.52 * 1340, "25t": 1.28 * 1340}
TARGET_KG = {"12t": 8000, "25t": 20000}


def loads_a_truck(size):
    status, result, out, text = load("--scenario", f"bench_{size}", "--trucks", 1, "--seed", 1)
    assert status == 0, f"exit status {status}: {text[-800:]}"
    assert f"fence it to {FENCE_MM[size]} mm" in text, f"the kernel was told another machine than that of {size}"
    with open(out / "trace.csv", newline="", encoding="utf-8") as trace:
        fullest = max(float(row["payload_kg"]) for row in csv.DictReader(trace))
    assert 0.97 * BUCKET_KG[size] < fullest < 1.001 * BUCKET_KG[size], f"the plant's bucket held up to {fullest:.0f} kg: not that of a {size} machine"
    assert result["trucks_loaded"] == 1 and result["target_kg"] == TARGET_KG[size], result
    assert all(0.98 * result["target_kg"] <= kg <= result["target_kg"] for kg in result["payload_kg"]) and len(result["payload_kg"]) == 1, result["payload_kg"]
    assert result["contacts"] == 0 and result["kernel_faults"] == 0 and result["own_motion_stops"] == {}, result
    print(f"{size}: {result['payload_kg'][0] / result['target_kg']:.4f} of the target, {result['passes']} passes, median {result['pass_seconds_median']:.1f} s, {result['wall_seconds']:.0f} s of wall clock")
    shutil.rmtree(out)


def loads_with_12_t():
    loads_a_truck("12t")


def loads_with_25_t():
    loads_a_truck("25t")


main([loads_with_12_t, loads_with_25_t])
