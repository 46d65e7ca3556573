"""A truck is loaded by scanners of whose samples a quarter have a simulated waveform: the same site as short's, other echoes."""
from berm_command import load, main


def loads_by_echoes_of_simulated_returns():
    status, result, out, text = load("--scenario", "waveforms", "--seed", 1)
    assert status == 0 and result is not None, text[-500:]
    assert result["contacts"] == 0 and not result["own_motion_stops"], text[-500:]
    payload = [kg / result["target_kg"] for kg in result["payload_kg"]]
    assert len(payload) == 1 and 0.98 <= payload[0] <= 1.0, payload
    assert max(result["recognition_error_m"]) < 0.05, result["recognition_error_m"]
    _, _, drawn, _ = load("--scenario", "short", "--seed", 1)
    assert (out / "trace.csv").read_bytes() != (drawn / "trace.csv").read_bytes(), "the echoes are drawn, not computed"


main([loads_by_echoes_of_simulated_returns])
