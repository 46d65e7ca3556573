"""berm echoes: what its table says of a truck in dust, the same for the same seed; the picture; exit codes and refusals."""
import json
import pathlib
import tempfile

from berm_command import main, one_clear_line, run

scratch = pathlib.Path(tempfile.mkdtemp(prefix="berm-echoes-"))
SMALL = ("--scanlines", 10, "--pulses", 300, "--extinction", 0.5, 3.0)


def table(seed, name):
    done = run("berm_echoes", *SMALL, "--seed", seed, "--json", scratch / name)
    assert done.returncode == 0, done.stderr
    return json.loads((scratch / name).read_text())


def row(result, cloud, extinction, receiver):
    rows = [r for r in result["rows"] if (r["cloud"], r["extinction_per_m"], r["receiver"]) == (cloud, extinction, receiver)]
    assert len(rows) == 1, (cloud, extinction, receiver)
    return rows[0]


def trailing_edge_sees_the_truck_in_dust_and_last_pulse_the_cloud():
    result = table(5, "a.json")
    for receiver in ("last pulse", "trailing edge"):
        assert row(result, "none", 0.0, receiver)["rear_share"] == 1.0
        assert row(result, "before the truck", 0.5, receiver)["rear_share"] == 1.0
        assert row(result, "about the truck", 3.0, receiver)["rear_share"] == 0.0, "no light comes back from there"
    last, trailing = row(result, "about the truck", 0.5, "last pulse"), row(result, "about the truck", 0.5, "trailing edge")
    assert last["front_share"] > 0.99 and last["median_error_m"] < -2.0, last
    assert trailing["rear_share"] > 0.99 and abs(trailing["median_error_m"]) < 0.02, trailing
    assert last["dust_share"] == trailing["dust_share"] == 1.0
    far = {r["receiver"]: r["rms_error_m"] for r in result["clear_air"] if (r["range_m"], r["reflectivity"]) == (40.0, 0.1)}
    assert 0.0 < far["last pulse"] < far["trailing edge"] < 0.07, far


def the_seed_decides():
    first = table(5, "b.json")
    assert first == table(5, "c.json")
    other = table(6, "d.json")
    assert first["clear_air"] != other["clear_air"]


def the_picture_is_written():
    done = run("berm_echoes", *SMALL, "--picture", scratch / "echoes.svg")
    assert done.returncode == 0, done.stderr
    text = (scratch / "echoes.svg").read_text()
    assert text.startswith("<svg") and text.rstrip().endswith("</svg>") and text.count("<circle") > 200


def bad_input_is_one_line():
    one_clear_line(run("berm_echoes", "--no-such-option"), "no-such-option")
    one_clear_line(run("berm_echoes", "--extinction", 50), "--extinction", "50")
    one_clear_line(run("berm_echoes", "--reflectivity", 0), "--reflectivity")
    one_clear_line(run("berm_echoes", *SMALL, "--json", scratch / "none" / "a.json"), "none/a.json")
    help_text = run("berm_echoes", "--help")
    assert help_text.returncode == 0 and "--picture" in help_text.stdout


main([trailing_edge_sees_the_truck_in_dust_and_last_pulse_the_cloud, the_seed_decides, the_picture_is_written, bad_input_is_one_line])
