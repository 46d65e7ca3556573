"""Another soil than the scenario's: result and summary name it, and the dig is another."""
from berm_command import load, main


def digs_the_soil_that_was_asked_for():
    dug = {}
    for soil in ("sandy_clay", "sticky_clay"):
        _, result, out, text = load("--scenario", "short", "--soil", soil, "--seed", 1)
        assert result is not None, text[-500:]
        assert result["soil"] == soil and f"soil {soil}" in text, result["soil"]
        assert result["contacts"] == 0 and result["passes"] >= 3, text[-500:]
        dug[soil] = (out / "trace.csv").read_bytes()
    assert dug["sandy_clay"] != dug["sticky_clay"], "the same run whatever the soil"
    _, result, out, _ = load("--scenario", "short", "--seed", 1)
    assert result["soil"] is None
    assert (out / "trace.csv").read_bytes() == dug["sandy_clay"], "the scenario's own soil by its name is another run"


main([digs_the_soil_that_was_asked_for])
