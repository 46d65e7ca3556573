"""A cloud of dust about the truck, as samples with a waveform see it: the kernel stops the machine, for the dust or for its front, which is taken for
something that stands there; when it has settled the machine goes on by itself and fills its truck."""
import csv
import json
import pathlib
import shutil
import tempfile

from berm_command import ROOT, load, main

JOINTS = ("swing", "boom", "stick", "bucket")
CLOUD_S = 8.0
GOES_ON_WITHIN_S = 30.0  # of its end; what its front has left in the map is looked at again


def scenario(folder, at_s, ranging):
    text = (ROOT / "fault_injection/scenarios/short.toml").read_text()
    for old, new in (("max_time_s = 1800.0", "max_time_s = 250.0"), ("window_percent = 98.0", f'window_percent = 98.0\nwaveform_share = 1.0\nranging = "{ranging}"')):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    text += f"\n[[cloud]]\ncentre = [-0.7, 7.2]\nz = [-2.2, 2.5]\nlength = 9.0\nwidth = 5.0\nyaw_deg = 0.0\nextinction = 0.4\nat_s = {at_s}\nfor_s = {CLOUD_S}\n"
    path = folder / "cloud.toml"
    path.write_text(text)
    return path


def goes_on_by_itself(at_s, ranging, reason):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="berm-test-"))
    status, result, out, text = load("--scenario", scenario(folder, at_s, ranging), "--seed", 1)
    who = f"{ranging} at {at_s} s"
    assert status == 0, text[-800:]
    assert result["contacts"] == 0 and 0.96 <= result["payload_kg"][0] / result["target_kg"] <= 1.01, result
    assert result["kernel_stops"].get(reason, 0) >= 1, f"{who}: the cloud stopped nothing for {reason}: {result['kernel_stops']}"
    events = [json.loads(line) for line in (out / "app.jsonl").read_text().splitlines()]
    stopped = [e["time_s"] for e in events if e["event"] == "stopped" and at_s < e["time_s"] < at_s + CLOUD_S + 2.0]
    assert stopped, f"{who}: not stopped in the cloud"
    with open(out / "trace.csv", newline="") as file:
        fast = [float(row["time_s"]) for row in csv.DictReader(file) if max(abs(float(row[f"{joint}_rad_s"])) for joint in JOINTS) > 0.3]
    again = next((t for t in fast if t > at_s + CLOUD_S), None)
    assert again is not None and again < at_s + CLOUD_S + GOES_ON_WITHIN_S, f"{who}: at full speed again at {again} s"
    print(f"{who}: stopped at {stopped[0]:.1f} s, at full speed again {again - at_s - CLOUD_S:.1f} s after the cloud's end, {result['kernel_stops']}")
    shutil.rmtree(out)
    shutil.rmtree(folder)


def dust_is_told():
    goes_on_by_itself(38.0, "trailing_edge", "dust")


def its_front_is_too_high_to_pass_over():
    goes_on_by_itself(28.0, "trailing_edge", "overpass")


main([dust_is_told, its_front_is_too_high_to_pass_over])
