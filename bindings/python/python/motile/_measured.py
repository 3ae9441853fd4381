"""Measurements that parameters are fitted to."""

from __future__ import annotations

import difflib
import numbers
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _motile
from ._curve import Array, Curve
from ._error import Error
from ._scene import _numbers

OBSERVABLES = ("speed", "stresslet", "aspect_ratio", "concentration_max", "concentration_min", "perimeter")

_STEP = 1e-6
# Step of second derivatives, and steps of Gauss and Newton before these are used.
_WIDE_STEP, _GAUSS_NEWTON = 1e-3, 4


@dataclass(frozen=True)
class Seen:
    """Everything of a steady state that measurements are compared with."""

    measured: dict[str, float]
    curve: Curve | None


def errors_of(given: npt.ArrayLike, shape: tuple[int, ...], what: str) -> Array:
    """Error bars in the shape of the values; an error if one is not above zero."""
    error = _numbers(given, "error")
    try:
        error = np.broadcast_to(error, shape)
    except ValueError:
        remedy = "Give one error bar, or one for each value"
        raise Error(f"{what} has {error.size} error bars for {shape[0]} values. {remedy}", key="error") from None
    if not np.all((error > 0) & np.isfinite(error)):
        bad = float(error[~((error > 0) & np.isfinite(error))].flat[0])
        remedy = "Give the standard deviation of the measurement, a finite number above 0"
        message = f"{what} has an error bar of {bad:g}: it would outweigh all other data. {remedy}"
        raise Error(message, key="error", value=f"{bad:g}", remedy=remedy)
    return error


def _finite(given: npt.ArrayLike, key: str, what: str) -> Array:
    values = np.atleast_1d(_numbers(given, key))
    if values.ndim != 1 or not values.size or not np.all(np.isfinite(values)):
        remedy = "Give a list of finite numbers, and leave out what was not measured"
        raise Error(f"{key} of {what}: these are no numbers to compare with. {remedy}", key=key, remedy=remedy)
    return values


@dataclass(frozen=True)
class Measured:
    """One measured number of a steady swimmer, with its error.

    `name` is `speed` (length per time), `stresslet` (force times length), `aspect_ratio`, `concentration_max` or
    `concentration_min` (over the mean c0), or `perimeter` (length). `error` is the standard deviation, in the unit of
    the value. `changes` are the entries of the setup that differ in this measurement, by their keys.
    """

    name: str
    value: float
    error: float
    changes: Mapping[str, Any] = field(default_factory=dict, kw_only=True)

    def __post_init__(self) -> None:
        if self.name not in OBSERVABLES:
            near = difflib.get_close_matches(self.name, OBSERVABLES, 1)
            hint = f"Did you mean {near[0]}? " if near else ""
            remedy = f"{hint}Use one of {', '.join(OBSERVABLES)}"
            message = f"{self.name} is not measured of steady states. {remedy}"
            raise Error(message, key="name", value=self.name, remedy=remedy)
        if np.ndim(self.value) or np.ndim(self.error):
            remedy = "Give one number, and a Measured for each further one"
            raise Error(f"the measured {self.name} and its error are lists. {remedy}", key="value", remedy=remedy)
        _finite(self.value, "value", self.name)
        errors_of(self.error, (1,), f"the measured {self.name}")

    @property
    def count(self) -> int:
        """Number of data."""
        return 1

    @property
    def start(self) -> Array:
        """Start values of numbers that are found with the best fit, such as a position."""
        return np.empty(0)

    def residuals(self, seen: Seen, extra: Array) -> Array:
        """Measured minus computed values, in error bars."""
        return np.array([(self.value - seen.measured[self.name]) / self.error])


@dataclass(frozen=True)
class MeasuredOutline:
    """Measured outline of a steady swimmer: points (length, shape (n, 2)) in any order.

    `error` is the standard deviation of a point across the outline (length), one for all or one for each.
    `direction` is the angle of the motion against the x axis of the picture (radians, counter-clockwise). The position
    of the outline does not matter: the one that fits best is found. So it counts as n - 2 data.
    """

    points: npt.ArrayLike
    error: npt.ArrayLike
    direction: float = field(default=0.0, kw_only=True)
    changes: Mapping[str, Any] = field(default_factory=dict, kw_only=True)
    _places: Any = field(init=False, repr=False, compare=False)
    _errors: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        points = _numbers(self.points, "points")
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3:
            remedy = "Give an array of shape (n, 2) of at least three points"
            raise Error(f"points of an outline have shape {points.shape}. {remedy}", key="points", remedy=remedy)
        bad = np.flatnonzero(~np.all(np.isfinite(points), axis=1))
        if len(bad):
            remedy = "Leave out points that were not measured"
            named = f"row {bad[0]} of the points of an outline (counted from 0) is {points[bad[0]].tolist()}"
            more = f", and {len(bad) - 1} more rows have no finite numbers either" if len(bad) > 1 else ""
            raise Error(f"{named}{more}. {remedy}", key="points", value=str(points[bad[0]].tolist()), remedy=remedy)
        places = (points[:, 0] + 1j * points[:, 1]) * np.exp(-1j * self.direction)
        object.__setattr__(self, "_places", places - places.mean())
        object.__setattr__(self, "_errors", errors_of(self.error, (len(points),), "the outline"))

    @property
    def count(self) -> int:
        """Number of data."""
        return len(self._places)

    @property
    def start(self) -> Array:
        """Start values of the position of the centroid over the mean radius."""
        return np.zeros(2)

    def compared(self, seen: Seen) -> tuple[float, float, float]:
        """Mean distance of the points from the centroid over the computed distance in the same directions, the angle
        that the points cover around it (radians), and the mean square of the residuals."""
        assert seen.curve is not None
        extra, residuals, _ = eliminated(lambda extra: self.residuals(seen, extra), self.start)
        around = self._around(extra)
        angles = np.sort(np.angle(around))
        gap = np.max(np.diff(angles, append=angles[0] + 2 * np.pi))
        ratio = np.mean(np.abs(around)) / np.mean(seen.curve.radii(angles))
        return float(ratio), float(2 * np.pi - gap), float(np.mean(residuals**2))

    def _around(self, extra: Array) -> npt.NDArray[np.complex128]:
        # Shifts in units of the size, so that they are small numbers.
        around: npt.NDArray[np.complex128]
        around = self._places - np.mean(np.abs(self._places)) * complex(extra[0], extra[1])
        return around

    def residuals(self, seen: Seen, extra: Array) -> Array:
        """Distances of the points beyond the computed outline, in error bars."""
        assert seen.curve is not None
        around = self._around(extra)
        residuals: Array = (np.abs(around) - seen.curve.radii(np.angle(around))) / self._errors
        return residuals


@dataclass(frozen=True)
class MeasuredModes:
    """Measured Fourier modes of the outline of a steady swimmer.

    `modes` holds the amplitudes by their number m >= 2: the distance from the centroid, at an angle to the motion, is
    R (1 + sum of amplitude times cos(m angle)). `error` is the standard deviation, one for all or one for each.
    """

    modes: Mapping[int, float]
    error: npt.ArrayLike
    changes: Mapping[str, Any] = field(default_factory=dict, kw_only=True)
    _errors: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for mode, value in self.modes.items():
            if not (isinstance(mode, numbers.Integral) and 2 <= mode <= 64) or not np.isfinite(value):
                remedy = "Give finite amplitudes of modes 2 to 64, such as {2: 0.03, 3: -0.01}"
                raise Error(f"modes: {mode!r}: {value!r}. {remedy}", key="modes", value=repr(value), remedy=remedy)
        object.__setattr__(self, "_errors", errors_of(self.error, (len(self.modes),), "the outline's modes"))

    @property
    def count(self) -> int:
        """Number of data."""
        return len(self.modes)

    @property
    def start(self) -> Array:
        """Start values of numbers that are found with the best fit: none."""
        return np.empty(0)

    def residuals(self, seen: Seen, extra: Array) -> Array:
        """Measured minus computed amplitudes, in error bars."""
        assert seen.curve is not None
        computed = seen.curve.modes(max(self.modes, default=0))[list(self.modes)]
        residuals: Array = (np.array(list(self.modes.values())) - computed) / self._errors
        return residuals


@dataclass(frozen=True)
class MeasuredConcentration:
    """Measured concentration around a steady swimmer.

    `angles` are directions from the centroid against the motion (radians), `values` the concentrations there, `error`
    their standard deviation, one for all or one for each. Values may have any unit, as the brightness of a dye: the
    factor that fits best is found, and counts as one datum less. With `absolute=True`, they are particles per length.
    """

    angles: npt.ArrayLike
    values: npt.ArrayLike
    error: npt.ArrayLike
    absolute: bool = field(default=False, kw_only=True)
    changes: Mapping[str, Any] = field(default_factory=dict, kw_only=True)
    _data: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        angles = _finite(self.angles, "angles", "a concentration")
        values = _finite(self.values, "values", "a concentration")
        if len(angles) != len(values):
            remedy = "Give one concentration for each angle"
            raise Error(f"there are {len(angles)} angles and {len(values)} concentrations. {remedy}", key="values")
        if np.mean(values) <= 0 and not self.absolute:
            remedy = "Subtract a smaller background, so that particles are bright"
            raise Error(f"the mean of the concentrations is {np.mean(values):g}. {remedy}", key="values", remedy=remedy)
        errors = errors_of(self.error, values.shape, "the concentration")
        object.__setattr__(self, "_data", (angles, values, errors))

    @property
    def count(self) -> int:
        """Number of data."""
        return len(self._data[0])

    @property
    def start(self) -> Array:
        """Start value of the factor between the units of concentration, over the mean of the values."""
        return np.empty(0) if self.absolute else np.ones(1)

    def residuals(self, seen: Seen, extra: Array) -> Array:
        """Measured minus computed concentrations, in error bars."""
        assert seen.curve is not None
        angles, values, errors = self._data
        computed = seen.curve.concentrations(angles)
        if len(extra):
            # The unit is that of the measured mean, so that the factor is about 1.
            computed = extra[0] * computed * np.mean(values)
        residuals: Array = (values - computed) / errors
        return residuals


@dataclass(frozen=True)
class MeasuredRun:
    """Measured trajectory: an observable of the first droplet over time, from the start of a run.

    `times` are above zero and grow, `values` are what was measured at them, `error` is their standard deviation, one
    for all or one for each. `name` is any observable of a run, such as `speed`, `x` or `aspect_ratio_moments`. Runs
    have no sensitivities, so derivatives are differences between runs: give the setup a fixed step, or a small
    tolerance.
    """

    times: npt.ArrayLike
    values: npt.ArrayLike
    error: npt.ArrayLike
    name: str = field(default="speed", kw_only=True)
    changes: Mapping[str, Any] = field(default_factory=dict, kw_only=True)
    _data: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        times, values = _finite(self.times, "times", "a run"), _finite(self.values, "values", "a run")
        if len(times) != len(values):
            remedy = "Give one value for each time"
            raise Error(f"there are {len(times)} times and {len(values)} values. {remedy}", key="values")
        if times[0] <= 0 or np.any(np.diff(times) <= 0):
            remedy = "Count times from the start of the run, and sort them"
            raise Error(f"times of a run must be above 0 and grow. {remedy}", key="times", remedy=remedy)
        object.__setattr__(self, "_data", (times, values, errors_of(self.error, values.shape, "the run")))

    @property
    def count(self) -> int:
        """Number of data."""
        return len(self._data[0])

    def residuals(self, setup: _motile.Setup) -> Array:
        """Measured minus computed values of a run, in error bars."""
        times, values, errors = self._data
        scene = setup.build()
        computed = []
        for time in times:
            scene._scene.advance(float(time))
            seen = scene.droplets[0].observe()
            if self.name not in seen:
                near = difflib.get_close_matches(self.name, seen, 3)
                remedy = f"Use one of {', '.join(near or seen)}"
                raise Error(f"a run has no observable {self.name}. {remedy}", key="name", value=self.name)
            value = seen[self.name]
            computed.append(np.nan if value is None else value)
        residuals: Array = (values - np.array(computed)) / errors
        return residuals


Steady = Measured | MeasuredOutline | MeasuredModes | MeasuredConcentration


def eliminated(residuals: Callable[[Array], Array], start: Array) -> tuple[Array, Array, Array]:
    """Numbers such as a position that make the residuals least, the residuals, and their derivatives by the numbers."""
    extra, count = start.copy(), len(start)
    best = residuals(extra)
    slopes = np.empty((len(best), count))
    for iteration in range(30):
        for k in range(count):
            step = np.zeros(count)
            step[k] = _STEP
            slopes[:, k] = (residuals(extra + step) - residuals(extra - step)) / (2 * _STEP)
        if not count:
            break
        change = np.linalg.lstsq(slopes, -best, rcond=None)[0]
        if iteration >= _GAUSS_NEWTON:
            # With large residuals, Gauss-Newton steps are too long or too short.
            whole = slopes.T @ slopes + _curvature(residuals, best, extra)
            if np.all(np.linalg.eigvalsh(whole) > 0):
                change = np.linalg.solve(whole, -slopes.T @ best)
        moved = residuals(extra + change)
        while moved @ moved > best @ best * (1 + 1e-12) and np.max(np.abs(change)) > 1e-10:
            change = 0.5 * change
            moved = residuals(extra + change)
        extra, best = np.asarray(extra + change, dtype=np.float64), moved
        if np.max(np.abs(change), initial=0.0) < 1e-10:
            break
    return extra, best, slopes


def _curvature(residuals: Callable[[Array], Array], best: Array, extra: Array) -> Array:
    """Sum of the residuals times their second derivatives."""
    steps = _WIDE_STEP * np.eye(len(extra))
    at = {
        (k, m): float(best @ (residuals(extra + a + b) + residuals(extra - a - b)))
        for k, a in enumerate(steps)
        for m, b in enumerate(steps)
        if k <= m
    }
    single = [float(best @ (residuals(extra + a) + residuals(extra - a))) for a in steps]
    centre = 2.0 * float(best @ best)
    return np.array(
        [
            [
                (at[min(k, m), max(k, m)] - single[k] - single[m] + centre) / (2 * _WIDE_STEP**2)
                for m in range(len(extra))
            ]
            for k in range(len(extra))
        ]
    )
