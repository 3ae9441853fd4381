"""Steady states and branches."""

import motile
import numpy as np
import pytest


def test_a_swimmer_in_a_channel() -> None:
    # Values of the reference of the crate steady-states.
    setup = motile.Setup(region=motile.channel(12, 5), method=motile.integral(nodes=72, elements=288))
    swimmer = motile.steady(setup)
    assert swimmer.speed == pytest.approx(0.137444855, abs=3e-6)
    assert swimmer.measured["speed"] == swimmer.speed and swimmer.residual < 1e-6
    assert swimmer.setup == setup and swimmer.positions.shape == (72, 2)
    values, symmetries = swimmer.spectrum()
    assert symmetries[0] == "antisymmetric" and values[0].imag == pytest.approx(0.0336, abs=2e-4)
    # The rate of the leading mode is within its error, so that nothing is decided.
    error = swimmer.growth_rate_error()
    assert swimmer.is_stable() is None and abs(values[0].real) < error < 1e-2 and "0.137" in repr(swimmer)


def test_a_branch_and_how_it_ends() -> None:
    start = motile.steady(motile.Setup(region=motile.plane(), method=motile.integral(nodes=72, elements=288)))
    seen: list[float] = []
    branch = motile.branch(start, "activity", -3, callback=seen.append)
    assert np.array_equal(seen, branch.values)
    assert branch.values[0] == -2 and branch.values[-1] == -3 and branch.end == "end of the range"
    assert np.all(np.diff(branch.speeds) > 0) and np.all(branch.unstable == 0)
    other = start.setup.replace({"droplets.0.particles.activity": -3})
    assert motile.steady(other).speed == pytest.approx(branch.speeds[-1], rel=1e-5)
    with pytest.raises(motile.Error, match="viscosity_ratio") as raised:
        motile.branch(start, "activty", -3)
    assert raised.value.key == "parameter"

    for step in (-1.0, 0.0, float("nan")):
        with pytest.raises(motile.Error, match="largest step"):
            motile.branch(start, "activity", -3, largest_step=step)

    def stop(value: float) -> None:
        raise LookupError(value)

    with pytest.raises(LookupError):
        motile.branch(start, "activity", -3, callback=stop)
    with pytest.raises(motile.Error):
        motile.steady(motile.Setup(droplets=[]))
