"""Fits to measurements."""

import dataclasses
import os
import pickle
import re
import sys
from collections.abc import Callable
from typing import Any

import motile
import numpy as np
import pytest
from motile import _fit
from motile._chi2 import chi2_below, chi2_quantile
from motile._curve import Curve
from motile._fit import _other_size
from motile._fit_model import COVERED, Free, Measurement, Model
from motile._least_squares import Minimum, least_squares
from motile._measured import Seen, eliminated

DROPLET, PARTICLES = "droplets.0.", "droplets.0.particles."
ACTIVITY, DIFFUSION, STRENGTH = PARTICLES + "activity", PARTICLES + "diffusion", PARTICLES + "excluded_volume.step"
TENSION, VISCOSITY = DROPLET + "tension", "viscosity"
FAST = {VISCOSITY: 90.0}


def swimmer(activity: float = -0.7, nodes: int = 32, region: Any = "plane", **more: Any) -> motile.Setup:
    method = motile.integral(nodes=nodes, elements=4 * nodes)
    return motile.Setup(region=region, method=method, droplets=[motile.droplet(activity, **more)])


def measured(setup: motile.Setup, names: list[str], error: float, **keywords: Any) -> list[Measurement]:
    found = motile.steady(setup.replace(keywords.get("changes", {}))).measured
    return [motile.Measured(name, found[name], error * abs(found[name]), **keywords) for name in names]


def shown(setup: motile.Setup, angles: Any) -> tuple[Any, Any]:
    state = motile.steady(setup)
    curve = Curve(state.positions, state.concentration)
    radii = curve.radii(angles)
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)]), curve.concentrations(angles)


def test_chi2() -> None:
    # Closed forms for one, two and four degrees of freedom, and the table of Abramowitz and Stegun (26.8).
    assert chi2_quantile(0.95, 1) == pytest.approx(3.841458820694124, rel=1e-10)
    assert chi2_quantile(0.95, 2) == pytest.approx(-2 * np.log(0.05), rel=1e-12)
    assert chi2_below(9.0, 4) == pytest.approx(1 - np.exp(-4.5) * (1 + 4.5), rel=1e-12)
    assert chi2_quantile(0.99, 10) == pytest.approx(23.2093, abs=1e-4)


def test_least_squares_within_bounds() -> None:
    # Rosenbrock's valley as squares: its minimum is (1, 1); with x <= 0.5 it is (0.5, 0.25).
    def residuals(x: Any) -> Any:
        return np.array([10 * (x[1] - x[0] ** 2), 1 - x[0]]) if x[0] > -1.3 else None

    def jacobian(x: Any) -> Any:
        return np.array([[-20 * x[0], 10.0], [-1.0, 0.0]])

    for upper, expected in ((2.0, (1, 1)), (0.5, (0.5, 0.25))):
        start, low, high = np.array([-1.2, 1.0]), np.array([-2.0, -2.0]), np.array([upper, 2.0])
        found = least_squares(residuals, jacobian, start, low, high, high - low)
        assert found.converged and found.values == pytest.approx(expected, abs=1e-9)


def test_least_squares_that_stall_have_not_converged() -> None:
    # With a derivative of the wrong sign no step lowers the sum, so that damping makes steps as small as round-off.
    def residuals(x: Any) -> Any:
        return np.array([x[0] - 1.0, 100.0])

    low, high = np.array([-2.0]), np.array([2.0])
    for sign in (1.0, -1.0):
        jacobian = np.array([[sign], [0.0]])
        found = least_squares(residuals, lambda _, slopes=jacobian: slopes, np.zeros(1), low, high, high - low)
        assert found.converged == (sign > 0) and found.values == pytest.approx([max(sign, 0.0)], abs=1e-6)


def test_the_best_place_of_an_outline_that_does_not_fit() -> None:
    # Residuals are not normal to the shifts unless the position is the best one.
    a = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    seen = Seen({}, Curve(np.column_stack([1.2 * np.cos(a), np.sin(a)]), 0 * a))
    angles = np.sort(np.random.default_rng(1).uniform(0, 2 * np.pi, 40))
    for size, said in ((10.0, "9.9.* times as large"), (0.72, "1.* times smaller"), (0.1, "much smaller")):
        points = size * np.column_stack([1.2 * np.cos(angles), np.sin(angles)]) + [5.0, 3.0]
        outline = motile.MeasuredOutline(points, 0.01)
        _, best, slopes = eliminated(lambda extra, of=outline: of.residuals(seen, extra), outline.start)
        assert np.max(np.abs(slopes.T @ best)) < 1e-6 * (best @ best)
        assert re.search(said, _other_size(outline, seen, "")[0])
    # Another size by 20 %, and a part of an outline that fits, may be real.
    some = np.column_stack([1.2 * np.cos(angles[:12]), np.sin(angles[:12])])
    assert not _other_size(motile.MeasuredOutline(1.2 * points / size, 0.01), seen, "")
    assert not _other_size(motile.MeasuredOutline(some, 0.01), seen, "")


def test_a_curve_between_its_nodes() -> None:
    # An ellipse off the origin: r(angle) about its centre is known.
    a = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    curve = Curve(np.column_stack([3 + 1.5 * np.cos(a), 1 + np.sin(a)]), 2 + np.cos(a))
    angles = np.array([0.1, 1.0, 3.0, -2.0, 9.0])
    radii = 1.5 / np.sqrt(np.cos(angles) ** 2 + 2.25 * np.sin(angles) ** 2)
    assert curve.centroid == pytest.approx(3 + 1j, abs=1e-13)
    assert curve.radii(angles) == pytest.approx(radii, abs=1e-12)
    assert curve.concentrations(angles) == pytest.approx(2 + radii * np.cos(angles) / 1.5, abs=1e-12)
    wavy = np.column_stack([np.cos(a), np.sin(a)]) * (1 + 0.4 * np.cos(2 * a))[:, None]
    many = 2 * np.pi * np.arange(4096) / 4096
    own = Curve(wavy, 0 * a)
    expected = 2 * np.mean(own.radii(many) * np.cos(2 * many)) / np.mean(own.radii(many))
    assert own.modes(4)[2] == pytest.approx(expected, abs=1e-10) and abs(expected - 0.4) < 1e-6


def test_truth_is_recovered_from_exact_numbers() -> None:
    true = swimmer(-0.7, nodes=64).replace({DIFFUSION: 0.105})
    data = measured(true, ["speed", "stresslet"], 0.01) + measured(true, ["speed"], 0.01, changes=FAST)
    start = swimmer(-0.65, nodes=64)
    result = motile.fit(start, {ACTIVITY: (-1.2, -0.5), DIFFUSION: (0.05, 0.2)}, data)
    assert result.values[ACTIVITY] == pytest.approx(-0.7, rel=1e-6)
    assert result.values[DIFFUSION] == pytest.approx(0.105, rel=1e-6)
    assert result.chi2 < 1e-8 and result.degrees_of_freedom == 1 and all(result.identified.values())
    assert not result.at_bounds and not result.remarks and len(result.combinations) == 2
    assert result.setup.to_dict()["droplets"][0]["particles"]["diffusion"] == result.values[DIFFUSION]
    assert result.correlation[0, 0] == pytest.approx(1) and abs(result.correlation[0, 1]) < 1
    assert result.errors[ACTIVITY] == pytest.approx(np.sqrt(result.covariance[0, 0]))
    again = pickle.loads(pickle.dumps(result))
    assert again.values == result.values and again.chi2_at(result.values) == pytest.approx(result.chi2, abs=1e-6)
    assert result.contains({ACTIVITY: -0.7, DIFFUSION: 0.105}) and not result.contains({ACTIVITY: -0.9})


@pytest.mark.slow
def test_truth_is_recovered_from_exact_shapes() -> None:
    # The outline is turned and moved, and the dye has a unit of its own.
    region = motile.channel(6, 3)
    true = swimmer(-0.7, nodes=48, region=region)
    angles = np.linspace(0, 2 * np.pi, 17, endpoint=False)
    points, concentrations = shown(true, angles)
    turn = np.array([[np.cos(0.4), np.sin(0.4)], [-np.sin(0.4), np.cos(0.4)]])
    modes = Curve(points, angles).modes(3)
    data: list[Measurement] = [
        motile.MeasuredOutline(points @ turn + [7.0, -2.0], 0.001, direction=0.4),
        motile.MeasuredConcentration(angles, 3e-4 * concentrations, 0.001),
        motile.MeasuredConcentration(angles, concentrations, 0.3, absolute=True),
        motile.MeasuredModes({2: float(modes[2]), 3: float(modes[3])}, 0.001),
    ]
    keys = {ACTIVITY: (-0.8, -0.6), TENSION: (5.0, 15.0)}
    result = motile.fit(swimmer(-0.65, nodes=48, region=region).replace({TENSION: 11.0}), keys, data)
    assert result.values[ACTIVITY] == pytest.approx(-0.7, rel=1e-4)
    assert result.values[TENSION] == pytest.approx(10, rel=1e-2) and result.chi2 < 0.01
    assert result.degrees_of_freedom == 17 - 2 + 17 - 1 + 17 + 2 - 2


@pytest.mark.slow
def test_jacobian_agrees_with_differences() -> None:
    setup = swimmer(region=motile.channel(6, 3))
    angles = np.linspace(0.1, 6.0, 9)
    _, concentrations = shown(setup, angles)
    data: list[Measurement] = [
        *measured(setup, ["speed", "stresslet", "aspect_ratio", "perimeter"], 0.01),
        *measured(setup, ["speed", "concentration_min"], 0.01, changes={"region.channel.width": 4.0}),
        motile.MeasuredConcentration(angles, concentrations, 1.0, absolute=True),
        motile.MeasuredModes({2: 0.01, 3: 0.01}, 0.01),
    ]
    # All have sensitivities, the viscosity in two parts, except for the friction of zero.
    keys = [ACTIVITY, DIFFUSION, STRENGTH, TENSION, VISCOSITY, "region.channel.width", DROPLET + "friction"]
    values = np.array([-0.7, 0.1, 10.0, 10.0, 100.0, 3.0, 0.0])
    free = {key: Free(value - 0.5 * abs(value), value + 0.5 * abs(value) + 1.0) for key, value in zip(keys, values)}
    model = Model(setup, free, data)
    found = model.jacobian(values)
    for k, step in enumerate(1e-4 * np.abs(values) + 1e-4 * (values == 0)):
        ends = []
        for move in (-step, step):
            moved = values.copy()
            moved[k] += max(move, 0.0) if keys[k].endswith("friction") else move
            ends.append(model.residuals(moved))
        slope = (ends[1] - ends[0]) / (step if keys[k].endswith("friction") else 2 * step)
        size = np.max(np.abs(slope))
        assert size > 0 and found[:, k] == pytest.approx(slope, abs=3e-3 * size), keys[k]
    assert not np.any(found[-2:, keys.index("region.channel.width")])


def test_shapes_are_compared_along_the_motion() -> None:
    # In the plane, a swimmer at any angle shows the same profile from behind to its front.
    angles = np.linspace(0.1, 6.0, 9)
    values, found = np.array([-0.7]), []
    _, concentrations = shown(swimmer(), angles)
    for angle in (0.0, 1.0, np.pi):
        setup = swimmer(angle=angle)
        data: list[Measurement] = [
            motile.MeasuredConcentration(angles, concentrations, 1.0, absolute=True),
            motile.MeasuredModes({2: 0.0, 3: 0.0}, 1.0),
        ]
        model = Model(setup, {ACTIVITY: Free(-1, -0.5)}, data)
        assert model.residuals(values) == pytest.approx(np.zeros(11), abs=1e-4)
        found.append(model.jacobian(values)[:, 0])
    assert found[1] == pytest.approx(found[0], abs=1e-4) and found[2] == pytest.approx(found[0], abs=1e-4)
    assert np.max(np.abs(found[0])) > 10


def test_covered_keys_are_those_of_sensitivities() -> None:
    from_core = set(motile.steady(swimmer(region=motile.channel(6, 3))).sensitivities()["speed"])
    own = {
        "activity",
        "excluded_volume",
        "diffusion",
        "concentration",
        "tension",
        "viscosity_in",
        "viscosity_out",
        "radius",
    }
    added = {"cortex", "friction", "width", "length"}
    assert from_core == own | added and own <= set(COVERED.values())


def draws(count: int) -> tuple[int, int]:
    """How often the true values lie in their joint region of 95 %, and the activity in its own interval."""
    true = {ACTIVITY: -0.7, DIFFUSION: 0.1}
    setup, random = swimmer(), np.random.default_rng(5)
    exact = measured(setup, ["speed", "concentration_max"], 0.01) + measured(setup, ["speed"], 0.01, changes=FAST)
    inside = alone = 0
    for _ in range(count):
        data = [
            motile.Measured(one.name, one.value + one.error * random.standard_normal(), one.error, changes=one.changes)
            for one in exact
            if isinstance(one, motile.Measured)
        ]
        result = motile.fit(setup, {ACTIVITY: (-0.9, -0.5), DIFFUSION: (0.05, 0.2)}, data)
        inside += result.contains(true)
        alone += abs(result.values[ACTIVITY] + 0.7) < 1.96 * result.errors[ACTIVITY]
    return inside, alone


@pytest.mark.slow
def test_coverage_of_few_draws() -> None:
    # Fewer than 8 of 10 have a probability of 1.2 % at 95 %.
    inside, alone = draws(10)
    assert inside >= 8 and alone >= 8


@pytest.mark.skipif("MOTILE_SLOW_TESTS" not in os.environ, reason="set MOTILE_SLOW_TESTS to run it")
def test_coverage() -> None:
    # The standard deviation of the number is sqrt(100 x 0.95 x 0.05) = 2.2, so 90 to 100 holds with 98.8 %.
    inside, alone = draws(100)
    assert 90 <= inside <= 100 and 90 <= alone <= 100, (inside, alone)


@pytest.mark.slow
def test_published_speeds() -> None:
    # Cowley's thesis prints |v| = A exp(-l/10) + c (figures 3.1 and 3.2) and D = 0.1 (table A.1), but no excluded volume.
    printed = {(-2, 100): (0.20, 0.016), (-4, 100): (0.34, 0.051), (-5, 100): (0.42, 0.061), (-4, 200): (0.22, 0.012)}
    data = []
    for (activity, viscosity), (a, c) in printed.items():
        speed = a * float(np.exp(-1.2)) + c
        changes = {ACTIVITY: float(activity), VISCOSITY: float(viscosity)}
        data.append(motile.Measured("speed", speed, 0.1 * speed, changes=changes))
    result = motile.fit(swimmer(-4, nodes=64, region=motile.channel(12, 2)), {DIFFUSION: (0.03, 0.3)}, data)
    assert result.values[DIFFUSION] == pytest.approx(0.106, abs=5e-4)
    assert result.errors[DIFFUSION] == pytest.approx(0.021, abs=5e-4)
    assert result.chi2 == pytest.approx(2.2, abs=0.05) and result.degrees_of_freedom == 3 and not result.remarks


@pytest.mark.slow
def test_only_ratios_of_stresses_are_identified() -> None:
    setup = swimmer(region=motile.channel(6, 3))
    data = [
        one
        for width in (3.0, 4.0)
        for one in measured(
            setup, ["speed", "aspect_ratio", "concentration_max"], 1e-3, changes={"region.channel.width": width}
        )
    ]
    keys: dict[str, Any] = {ACTIVITY: (-2, -0.5), STRENGTH: (5, 20), TENSION: (5, 20), VISCOSITY: (50, 200)}
    result = motile.fit(setup, keys, data)
    last = result.combinations[-1]
    assert not last.identified and np.isinf(last.error)
    assert np.abs(list(last.weights.values())) == pytest.approx(0.5, abs=2e-3)
    assert not any(result.identified.values()) and all(np.isinf(list(result.errors.values())))
    text = repr(result)
    assert "not identified" in text and "+10 %" in text and "prior" in text
    assert result.reasons[TENSION] in result._repr_html_()
    # With the viscosity known, the ratios have values.
    keys.pop(VISCOSITY)
    fixed = motile.fit(setup, keys, data)
    assert fixed.identified[ACTIVITY] and fixed.values[ACTIVITY] == pytest.approx(-0.7, rel=1e-3)
    # A prior gives a value, but is no measurement.
    keys[VISCOSITY] = motile.Free(50, 200, prior=(100, 5))
    known = motile.fit(setup, keys, data)
    assert known.errors[VISCOSITY] == pytest.approx(5, rel=1e-3) and not known.identified[VISCOSITY]
    assert "only its prior determines" in known.reasons[VISCOSITY]


def test_a_parameter_that_nothing_depends_on() -> None:
    setup = swimmer()
    data = measured(setup, ["speed", "concentration_max"], 0.01)
    result = motile.fit(setup, {ACTIVITY: (-1, -0.5), "least_gap": motile.Free(0.01, 0.1, start=0.05)}, data)
    assert result.identified == {ACTIVITY: True, "least_gap": False} and np.isinf(result.errors["least_gap"])
    assert result.reasons["least_gap"] == "no measurement depends on it" and result.errors[ACTIVITY] < 0.1


def test_a_change_of_a_whole_entry_replaces_what_is_varied_in_it() -> None:
    width = "region.channel.width"
    setup = swimmer(region=motile.channel(8, 4))
    data = [
        motile.Measured("speed", 0.05, 0.01, changes={"region": motile.channel(8, one)}) for one in (3.5, 5.0)
    ]
    result = motile.fit(setup, {width: (3.5, 5.0)}, data)
    assert not result.identified[width] and result.reasons[width] == "no measurement depends on it"
    # With a measurement that depends on it, the others do not.
    data.append(motile.Measured("speed", 0.05, 0.01))
    model = motile.fit(setup, {width: (3.5, 5.0)}, data)._model
    jacobian = model.jacobian(np.array([4.0]))
    assert not jacobian[:2].any() and abs(jacobian[2, 0]) > 1e-3, jacobian
    assert motile.MeasuredModes({np.int64(2): 0.01}, 0.01).count == 1


def test_profile_bounds_and_samples() -> None:
    setup = swimmer()
    data = measured(setup, ["speed"], 0.02)
    result = motile.fit(setup, {ACTIVITY: (-0.9, -0.5)}, data)
    profile = result.profile(ACTIVITY)
    # Nearly a parabola: 1 and 1.96 standard deviations.
    error = result.errors[ACTIVITY]
    assert profile.interval_68 == pytest.approx((-0.7 - error, -0.7 + error), abs=0.05 * error)
    assert profile.interval_95 == pytest.approx((-0.7 - 1.96 * error, -0.7 + 1.96 * error), abs=0.1 * error)
    assert profile.open == (False, False) and "95 % in" in repr(profile)
    for end, growth in zip((*profile.interval_68, *profile.interval_95), (1, 1, 3.841, 3.841)):
        assert result.chi2_at({ACTIVITY: end}) - result.chi2 == pytest.approx(growth, abs=2e-3)
    assert np.all(np.diff(profile.values) > 0) and np.min(profile.chi2) == result.chi2

    bound = motile.fit(setup, {ACTIVITY: motile.Free(-0.69, -0.5, start=-0.6)}, data)
    assert bound.at_bounds == {ACTIVITY: -0.69} and bound.values[ACTIVITY] == -0.69
    assert "ended at its bound" in repr(bound) and bound.profile(ACTIVITY).open == (True, False)


@pytest.mark.slow
def test_samples() -> None:
    pytest.importorskip("emcee")
    setup = swimmer()
    result = motile.fit(setup, {ACTIVITY: (-0.9, -0.5)}, measured(setup, ["speed"], 0.02))
    samples = result.sample(200, burn_in=10, walkers=10)
    error = result.errors[ACTIVITY]
    # 20 steps of 10 walkers, of an autocorrelation time of about 5: the mean is known to 0.2 and the width to 15 %.
    assert np.mean(samples[ACTIVITY]) == pytest.approx(-0.7, abs=0.6 * error)
    assert np.std(samples[ACTIVITY]) == pytest.approx(error, rel=0.4)
    assert len(samples[ACTIVITY]) == 200 and ACTIVITY in repr(samples) and 0 < samples.acceptance < 1
    few = [result.sample(10, burn_in=1, walkers=4, seed=3).as_array for _ in range(2)]
    assert few[0] == pytest.approx(few[1], rel=1e-6)


SPEEDS = [
    motile.Measured("speed", speed, 0.002, changes={"region.channel.width": width})
    for width, speed in ((3, 0.1059), (4, 0.1189), (6, 0.1211))
]


def test_an_outline_in_another_unit() -> None:
    # The search stayed at its start, because the position of such an outline was not the best one.
    setup = swimmer(-0.7)
    angles = np.sort(np.random.default_rng(6).uniform(0, 2 * np.pi, 40))
    points, _ = shown(setup, angles)
    data: list[Measurement] = [motile.MeasuredOutline(10 * points, 0.1), *measured(setup, ["speed"], 0.01)]
    result = motile.fit(setup, {ACTIVITY: Free(-0.9, -0.6, start=-0.8)}, data)
    assert result.values[ACTIVITY] == pytest.approx(-0.7, abs=0.05)
    assert re.search(r"outline is (9\.9|10).* times as large .*scale=", repr(result)), result
    for near in (-0.8, -0.75, -0.65):
        assert result.chi2_at({ACTIVITY: near}) > result.chi2


def test_a_search_that_stalls_goes_on_or_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    search, stalls = _fit._minimise, [1]

    def stalling(model: Model, start: Any, lower: Any, upper: Any) -> Minimum:
        stalls[0] -= 1
        return Minimum(start, model.residuals(start), 1, True) if stalls[0] >= 0 else search(model, start, lower, upper)

    monkeypatch.setattr(_fit, "_minimise", stalling)
    keys, data = {ACTIVITY: Free(-0.9, -0.5, start=-0.75)}, measured(swimmer(), ["speed"], 0.02)
    assert motile.fit(swimmer(), keys, data).values[ACTIVITY] == pytest.approx(-0.7, rel=1e-3)
    stalls[0] = 9
    result = motile.fit(swimmer(), keys, data)
    assert any("not reached a minimum" in remark for remark in result.remarks)


def test_identified_follows_the_errors() -> None:
    # The interval of 95 % of the profile is the whole range of the excluded volume.
    setup = swimmer(-1, 48, motile.channel(8, 3))
    result = motile.fit(setup, {ACTIVITY: (-3, -0.6), STRENGTH: (5, 30)}, SPEEDS)
    assert result.identified == {ACTIVITY: True, STRENGTH: False} and result.errors[STRENGTH] > 3
    assert re.search("2 errors .* beyond the bounds 5 and 30; look at profile", result.reasons[STRENGTH])
    assert result.reasons[STRENGTH] in repr(result)
    # All of the conditions.
    model, values = result._model, np.array([-1.5, 10.0])
    minimum = Minimum(values, model.residuals(values), 1, True)
    near = _fit._surroundings(model, minimum)
    for lower, upper, error, growth, said in (
        (5, 30, 1.0, 4.0, None),
        (5, 30, 2.4, 4.0, None),
        (5, 30, 2.6, 4.0, "beyond the bounds"),
        (1, 30, 2.6, 4.0, "more than half of the value"),
        (8, 12, 0.49, 4.0, None),
        (8, 12, 0.51, 4.0, "more than half of the distance"),
        (5, 30, 1.0, 1.0, "chi2 grows by only 1"),
        (-30, 30, 2.6, 4.0, None),
    ):
        slopes = np.zeros_like(near.slopes)
        slopes[0, 0], slopes[1, 1] = 1e3, 1 / error
        model.lower[1], model.upper[1] = lower, upper
        given = dataclasses.replace(near, slopes=slopes, growth={ACTIVITY: 4.0, STRENGTH: growth})
        combinations = _fit._combinations(model, slopes * near.scale, near.scale)
        reasons = _fit._reasons(model, values, given, combinations, {})
        assert ACTIVITY not in reasons and (STRENGTH in reasons) == (said is not None), (lower, upper, error)
        assert said is None or said in reasons[STRENGTH]


def test_unstable_swimmers_are_named() -> None:
    setup = swimmer(-0.6, 48, motile.channel(8, 3))
    result = motile.fit(setup, {ACTIVITY: (-0.9, -0.5)}, measured(setup, ["speed"], 0.02))
    assert any("the fitted swimmer is unstable" in remark for remark in result.remarks)
    # More nodes decide.
    coarse = motile.steady(swimmer(-4, 72, motile.channel(12, 5)))
    assert coarse.is_stable() is None and _fit._growth_rate(coarse) == pytest.approx(0.00667, rel=1e-2)


def test_data_that_no_values_reach() -> None:
    for speed in (1.2, -0.1):
        result = motile.fit(swimmer(), {ACTIVITY: (-0.9, -0.5)}, motile.Measured("speed", speed, 0.01))
        assert result.degrees_of_freedom == 0 and result.at_bounds and not result.identified[ACTIVITY]
        assert "bound" in result.reasons[ACTIVITY] and "profile" in result.reasons[ACTIVITY]
        assert any("does not describe the data" in remark for remark in result.remarks)


def test_a_single_measurement_and_progress(capsys: pytest.CaptureFixture[str]) -> None:
    (one,) = measured(swimmer(), ["speed"], 0.02)
    result = motile.fit(swimmer(), {ACTIVITY: (-0.9, -0.5)}, one)
    assert result.values == motile.fit(swimmer(), {ACTIVITY: (-0.9, -0.5)}, [one]).values
    result.profile(ACTIVITY)
    assert not capsys.readouterr().err
    assert motile.fit(swimmer(), {ACTIVITY: (-0.9, -0.5)}, one, progress=True).values == result.values
    last = re.findall(r"(\d+) evaluations, lowest chi2 = ([-+.\de]+)", capsys.readouterr().err)[-1]
    assert int(last[0]) > 2 and float(last[1]) == pytest.approx(result.chi2, abs=1e-3)
    result.profile(ACTIVITY, progress=True)
    shown = [float(part) for part in re.findall(r"percent = ([\d.]+) of 100", capsys.readouterr().err)]
    assert len(shown) > 1 and shown == sorted(shown) and shown[-1] == 100
    with pytest.raises(
        motile.Error, match=f"chi2 cannot be computed at {ACTIVITY} = -60: .* Use values closer"
    ) as said:
        result.chi2_at({ACTIVITY: -60})
    assert said.value.key == ACTIVITY and said.value.value == "-60"


def test_samples_need_emcee(monkeypatch: pytest.MonkeyPatch) -> None:
    setup = swimmer()
    result = motile.fit(setup, {ACTIVITY: (-0.9, -0.5)}, measured(setup, ["speed"], 0.02))
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(motile.Error, match="pip install emcee"):
        result.sample(10)


@pytest.mark.slow
def test_a_run() -> None:
    # Speeds of a start, with fixed steps: derivatives are differences.
    setup = swimmer(-0.8).replace({"step": {"fixed": 0.2}})
    scene = setup.build()
    times = [2.0, 4.0, 6.0]
    speeds = []
    for time in times:
        scene.run(time)
        speeds.append(scene.droplets[0].observe()["speed"])
    run = motile.MeasuredRun(times, np.array(speeds, dtype=float), 1e-3)
    result = motile.fit(setup.replace({ACTIVITY: -0.75}), {ACTIVITY: (-1.0, -0.6)}, [run])
    assert result.values[ACTIVITY] == pytest.approx(-0.8, rel=1e-6) and result.identified[ACTIVITY]
    with pytest.raises(motile.Error, match="no observable sped"):
        motile.fit(setup, {ACTIVITY: (-1.0, -0.6)}, [motile.MeasuredRun(times, [1, 2, 3], 0.1, name="sped")])


SPEED = [motile.Measured("speed", 0.06, 0.01)]
ELSEWHERE = motile.Measured("speed", 0.06, 0.01, changes={"region.channel.width": 3})


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (
            lambda: motile.fit(swimmer(), {PARTICLES + "activty": (-1, -0.5)}, SPEED),
            "Did you mean droplets.0.particles.activity",
        ),
        (lambda: motile.fit(swimmer(), {"activity": (-1, -0.5)}, SPEED), "Did you mean droplets.0.particles.activity"),
        (lambda: motile.fit(swimmer(), {ACTIVITY: (-0.5, -1)}, SPEED), "lower one first"),
        (lambda: motile.fit(swimmer(), {ACTIVITY: -1}, SPEED), "lower and an upper bound"),  # type: ignore[dict-item]
        (lambda: motile.fit(swimmer(), {ACTIVITY: Free(-1, -0.5, start=-2)}, SPEED), "start -2 is not between"),
        (lambda: motile.fit(swimmer(), {ACTIVITY: Free(-1, -0.5, prior=(-1, 0))}, SPEED), "standard deviation above 0"),
        (lambda: motile.fit(swimmer(), {ACTIVITY: Free(-1, -0.1, start=-0.2)}, SPEED), "does not swim at the start"),
        (lambda: motile.fit(swimmer(), {ACTIVITY: Free(-99, -0.1, start=-99)}, SPEED), "no steady state at the start"),
        (
            lambda: motile.fit(swimmer(), {ACTIVITY: (-1, -0.5), DIFFUSION: (0.1, 0.2)}, SPEED),
            "2 parameters, but only 1",
        ),
        (lambda: motile.fit(swimmer(), {ACTIVITY: (-1, -0.5)}, []), "no measurements"),
        (lambda: motile.fit(swimmer(), {ACTIVITY: (-1, -0.5)}, [ELSEWHERE]), "region.channel.width: "),
        (lambda: motile.fit(swimmer(), {}, SPEED), "no parameters"),
        (lambda: motile.fit(swimmer(), [(-1, -0.5)], SPEED), "no dictionary"),  # type: ignore[arg-type]
        (lambda: motile.fit(swimmer(), {ACTIVITY: (-1, -0.5)}, 0.06), "no list. Give a list"),  # type: ignore[arg-type]
        (lambda: motile.fit(swimmer(), {ACTIVITY: (1, 3)}, SPEED), "swims only if its activity is negative"),
        (
            lambda: motile.fit(swimmer(shape={"round": {"radius": 5e-6}}), {ACTIVITY: Free(-3e-12, -1e-12)}, SPEED),
            "same units: its radius is 5e-06",
        ),
        (lambda: motile.Measured("sped", 0.1, 0.01), "Did you mean speed"),
        (lambda: motile.Measured("speed", 0.1, 0), "error bar of 0"),
        (lambda: motile.Measured("speed", float("nan"), 1), "no numbers to compare"),
        (lambda: motile.MeasuredOutline([[0, 1], [1, 2]], 0.1), "at least three points"),
        (
            lambda: motile.MeasuredOutline([[0, 1], [1, 2], [1, float("nan")], [2, 2]], 0.1),
            r"row 2 .* is \[1.0, nan\]. Leave out",
        ),
        (lambda: motile.MeasuredModes({1: 0.1}, 0.1), "modes 2 to 64"),
        (lambda: motile.Measured("speed", [0.1, 0.2], 0.1), "a Measured for each"),  # type: ignore[arg-type]
        (lambda: motile.MeasuredConcentration([0, 1, 2], [-1, -2, -1], 0.1), "Subtract a smaller background"),
        (lambda: motile.MeasuredConcentration([0, 1], [1], 0.1), "one concentration for each angle"),
        (lambda: motile.MeasuredRun([1, 1], [1, 2], 0.1), "above 0 and grow"),
        (lambda: motile.MeasuredRun([1, 2], [1, 2], [0.1] * 3), "3 error bars for 2 values"),
    ],
)
def test_errors_say_what_to_do(wrong: Callable[[], object], said: str) -> None:
    with pytest.raises(motile.Error, match=said):
        wrong()
