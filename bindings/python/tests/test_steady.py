"""Steady states and branches."""

import motile
import numpy as np
import pandas as pd
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


def test_sensitivities_are_a_table() -> None:
    setup = motile.Setup(
        region=motile.box(5, 7), method=motile.integral(nodes=40, elements=160), droplets=[motile.droplet(-0.8)]
    )
    swimmer = motile.steady(setup)
    found = swimmer.sensitivities()
    table = pd.DataFrame(found)
    assert {"activity", "diffusion", "tension", "viscosity_in", "box_x"} <= set(table.index)
    assert {"speed", "stresslet", "aspect_ratio", "concentration_max"} <= set(table.columns)

    def speed(activity: float) -> float:
        return motile.steady(setup.replace({"droplets.0.particles.activity": activity})).speed

    slope = (speed(-0.79) - speed(-0.81)) / 0.02
    assert found["speed"]["activity"] == pytest.approx(slope, rel=1e-3)
    relative = swimmer.sensitivities(logarithmic=True, growth=True)
    expected = found["speed"]["activity"] * -0.8 / swimmer.speed
    assert relative["speed"]["activity"] == pytest.approx(expected, rel=1e-9) and "growth_rate" in relative


def test_a_branch_and_how_it_ends() -> None:
    start = motile.steady(motile.Setup(region=motile.plane(), method=motile.integral(nodes=72, elements=288)))
    seen: list[float] = []
    branch = motile.branch(start, "activity", -3, callback=seen.append)
    assert np.array_equal(seen, branch.values)
    assert branch.values[0] == -2 and branch.values[-1] == -3 and branch.end == "end of the range"
    assert np.all(np.diff(branch.speeds) > 0) and np.all(branch.unstable == 0)
    assert np.array_equal(branch.to_xarray()["speed"].sel(activity=-3), branch.speeds[-1])
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
