"""Loads trucks on measured ground, without a contact and without a stop of the kernel; along the levee the machine is moved back between them."""
from berm_command import REAL_DATA, load, main

CLOUD = REAL_DATA / "site_terrain" / "terrain_xyz.pcd"


def loads_a_truck():
    status, result, out, text = load("--scenario", "measured", "--seed", 1)
    assert status == 0, text[-500:]
    assert result["contacts"] == 0 and result["trucks_loaded"] == 1
    assert result["kernel_stops"] == {} and result["own_motion_stops"] == {}, result["kernel_stops"]
    heights = [float(h) for row in (out / "terrain_start.csv").read_text().splitlines()[1:] for h in row.split(",")]
    assert min(heights) < -4.0 and max(heights) > 0.4, "no levee"


def loads_trucks_along_the_levee():
    status, result, out, text = load("--scenario", "measured_shift", "--trucks", 2, "--seed", 1)
    assert status == 0, text[-500:]
    assert result["contacts"] == 0 and result["trucks_loaded"] == 2
    assert result["kernel_stops"] == {} and result["own_motion_stops"] == {}, result["kernel_stops"]
    assert "the operator trammed the machine back" in text, "one stand for two trucks"


main([loads_a_truck, loads_trucks_along_the_levee], None if CLOUD.exists() else f"no {CLOUD} (BERM_REAL_DATA)")
