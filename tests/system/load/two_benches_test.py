"""A face of two benches is dug from the top down, and nowhere under the site's goal: a truck is loaded from it, untouched and without a stop of the machine's own making."""
import json
import math
import shutil
import tomllib

from berm_command import ROOT, load, main

SITE = tomllib.loads((ROOT / "interface_spec" / "config" / "sites" / "two_benches.toml").read_text())


def goal_at(x, y):
    level = SITE["dig"]["floor"]
    for part in SITE["dig"]["goal"]:
        if part["x"][0] <= x <= part["x"][1] and part["y"][0] <= y <= part["y"][1]:
            level = part["level"]
    return level


def is_dug_from_the_top_down():
    status, result, out, text = load("--scenario", "two_benches", "--trucks", 1, "--seed", 1)
    assert status == 0, text[-800:]
    assert result["contacts"] == 0 and result["kernel_faults"] == 0 and result["own_motion_stops"] == {}, result
    assert result["trucks_loaded"] == 1 and 0.98 * result["target_kg"] <= result["payload_kg"][0] <= result["target_kg"], result["payload_kg"]
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    worked = [(event["reach"], event["bench"], event["why"]) for event in events if event["event"] == "region"]
    floors = {event["bench"]: event["floor_m"] for event in events if event["event"] == "region"}
    assert worked[:2] == [("site", 1, "begin"), ("site", 2, "dug out before it")], worked
    assert all(why == "yields again" for reach, bench, why in worked[2:] if (reach, bench) == ("site", 1)), worked
    assert floors[1] - floors[2] > 1.0, floors
    bench, digs = 0, {1: 0, 2: 0}
    for event in events:
        if event["event"] == "next_dig" or event["event"] == "region":
            bench = event["bench"]
        if event["event"] != "dig":
            continue
        digs[bench] += 1
        lowest = min(z for r, z in event["drag"])
        assert bench != 1 or lowest >= floors[1] - 0.01, f"a dig of the upper bench down to {lowest} m"
        bearing = math.radians(event["bearing_deg"])
        for r, z in event["drag"]:
            assert z >= goal_at(r * math.cos(bearing), r * math.sin(bearing)) - 0.01, f"{z} m at {r} m, {event['bearing_deg']} degrees: under the goal"
    assert digs[1] >= 2 and digs[2] >= 2, digs
    print(f"{result['payload_kg'][0] / result['target_kg']:.4f} of the target, {digs} digs, {result['passes']} passes, median {result['pass_seconds_median']:.1f} s")
    shutil.rmtree(out)


main([is_dug_from_the_top_down])
