"""Fits of the numbers of a setup to measurements."""

from __future__ import annotations

import difflib
import html
import math
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _motile
from ._chi2 import chi2_above, chi2_quantile
from ._curve import Array
from ._error import Error
from ._fit_model import COVERED, Free, Measurement, Model
from ._least_squares import Minimum, least_squares
from ._measured import Measured, MeasuredConcentration, MeasuredModes, MeasuredOutline, MeasuredRun
from ._optional import needed, write_parquet
from ._progress import Bar
from ._scene import FilePath

if TYPE_CHECKING:
    import pandas

Setup = _motile.Setup

# Relative sizes of singular values below which a combination does not matter: derivatives are not more exact.
_ROUND_OFF = 1e-6
# Part of a combination of parameters below which it does not name the parameter.
_NAMED = 0.1
# Levels of chi2 above its minimum that end intervals of 68.3 and 95 % of one parameter.
_LEVELS = (1.0, 3.841)


@dataclass(frozen=True)
class Combination:
    """Combination of parameters that data determine, or do not."""

    weights: dict[str, float]
    """Relative changes of the parameters, of length 1 together. A change from 0 is over the distance of the bounds."""
    error: float
    """Standard deviation of the relative change along it, from the data alone; infinite if they do not depend on it."""
    identified: bool
    """True if the data narrow it down more than the bounds do."""

    def __str__(self) -> str:
        largest = max(self.weights.values(), key=abs)
        named = {key: weight / largest for key, weight in self.weights.items() if abs(weight) > _NAMED * abs(largest)}
        return " and ".join(f"{key} by {10 * weight:+.3g} %" for key, weight in named.items())


@dataclass(frozen=True)
class Profile:
    """Profile likelihood of a parameter: the least chi2 of all other parameters, for each of its values."""

    key: str
    """Key of the parameter."""
    values: Array
    """Values of the parameter, growing."""
    chi2: Array
    """Least chi2 at these values."""
    interval_68: tuple[float, float]
    """Interval in which chi2 is less than 1 above its minimum."""
    interval_95: tuple[float, float]
    """Interval in which chi2 is less than 3.84 above its minimum."""
    open: tuple[bool, bool]
    """True if the lower, or the upper, end of the 95 % interval is where it is because of a bound of the fit, of this
    parameter or of another one, or because no steady state was found beyond: data alone allow values beyond."""

    def __repr__(self) -> str:
        (a, b), (c, d) = self.interval_68, self.interval_95
        ends = [end for end, at in zip(("lower", "upper"), self.open) if at]
        note = f"; {' and '.join(ends)} end at a bound or at the last steady state" if ends else ""
        return f"<profile of {self.key}: 68 % in [{a:.5g}, {b:.5g}], 95 % in [{c:.5g}, {d:.5g}]{note}>"


@dataclass(frozen=True)
class Samples(Mapping[str, Array]):
    """Samples of the probability of the parameters, given the data: `samples[key]` is an array."""

    keys_of: tuple[str, ...]
    """Keys of the parameters."""
    as_array: Array
    """Samples, of shape (n, parameters)."""
    acceptance: float
    """Fraction of proposals that were accepted: usually 0.2 to 0.5."""

    def __getitem__(self, key: str) -> Array:
        if key not in self.keys_of:
            raise KeyError(f"there are no samples of {key}. Use one of {', '.join(self.keys_of)}")
        return self.as_array[:, self.keys_of.index(key)]

    def __iter__(self) -> Any:
        return iter(self.keys_of)

    def __len__(self) -> int:
        return len(self.keys_of)

    def __repr__(self) -> str:
        rows = [f"{key} = {np.mean(self[key]):.5g} +- {np.std(self[key]):.2g}" for key in self.keys_of]
        return f"<{len(self.as_array)} samples: {', '.join(rows)}>"

    def to_pandas(self) -> pandas.DataFrame:
        """Table of the samples, a column for each parameter."""
        frame: pandas.DataFrame = needed("pandas", "a DataFrame").DataFrame(self.as_array, columns=list(self.keys_of))
        frame.attrs["motile"] = _motile.VERSION
        return frame

    def to_parquet(self, path: FilePath) -> None:
        """Writes the table of `to_pandas` as a parquet file."""
        write_parquet(self.to_pandas(), path)


@dataclass(frozen=True)
class FitResult:
    """Best fit of parameters to measurements."""

    keys: tuple[str, ...]
    """Keys of the parameters."""
    values: dict[str, float]
    """Values at the least chi2."""
    errors: dict[str, float]
    """Standard deviations, from the derivatives at the minimum; infinite where the fit determines no value."""
    covariance: Array
    """Covariance of the values, in the order of the keys; a parameter without a value has an infinite variance."""
    chi2: float
    """Least sum of the squares of (measured - computed)/error, of data and priors."""
    degrees_of_freedom: int
    """Data and priors without parameters and without what is found for each outline and concentration."""
    residuals: Array
    """(measured - computed)/error of each datum, in the order of the measurements."""
    identified: dict[str, bool]
    """For each parameter, True if data determine it, without priors."""
    reasons: dict[str, str]
    """For each parameter that data do not determine, the reason."""
    combinations: list[Combination]
    """Independent combinations of parameters, the best known first."""
    at_bounds: dict[str, float]
    """Parameters that ended at a bound, and the bound. Their errors hold only inside of it: look at `profile`."""
    remarks: list[str]
    """What you should know before you use the result."""
    setup: Setup
    """Setup with the values, under the conditions of the given setup."""
    _model: Model = field(repr=False, compare=False)

    @property
    def correlation(self) -> Array:
        """Correlations of the values, in the order of the keys; not a number without a value."""
        errors = np.sqrt(np.diag(self.covariance))
        with np.errstate(invalid="ignore"):
            correlation: Array = self.covariance / np.outer(errors, errors)
        return correlation

    @property
    def probability(self) -> float:
        """Probability of a larger chi2 if the model and the error bars are right; not a number without degrees of
        freedom."""
        return chi2_above(self.chi2, self.degrees_of_freedom) if self.degrees_of_freedom > 0 else math.nan

    def chi2_at(self, values: Mapping[str, float]) -> float:
        """Sum of the squares of (measured - computed)/error at values of all parameters."""
        moved = dict(self.values)
        moved.update({self._known(key): float(value) for key, value in values.items()})
        residuals = self._model.residuals(np.array([moved[key] for key in self.keys]))
        return float(residuals @ residuals)

    def contains(self, values: Mapping[str, float], level: float = 0.95) -> bool:
        """True if values of all parameters lie in their joint region of confidence: where chi2 exceeds its minimum by
        less than the quantile at this level of chi2 with as many degrees of freedom as there are parameters."""
        if not 0 < level < 1:
            raise Error(f"level = {level:g}. Use a probability between 0 and 1", key="level", value=f"{level:g}")
        return self.chi2_at(values) - self.chi2 <= chi2_quantile(level, len(self.keys))

    def profile(self, key: str, *, points: int = 8) -> Profile:
        """Profile likelihood of a parameter: for each of its values, all others are fitted anew.

        It steps from the best value to both sides, about `points` times each, to where chi2 has grown by 3.84 or to a
        bound. It is right where chi2 is no parabola, so use it for parameters that are badly determined or at a bound.
        """
        k = self.keys.index(self._known(key))
        if points < 2:
            raise Error(f"points = {points}. Use at least 2", key="points", value=str(points))
        model = self._model
        best, low, high = np.array(list(self.values.values())), float(model.lower[k]), float(model.upper[k])
        error = self.errors[self.keys[k]]
        step = min(error, 0.25 * (high - low)) if error > 0 else 0.25 * (high - low)
        sides = [_side(model, best, self.chi2, k, end, step, points) for end in (low, high)]
        known = {best[k]: self.chi2, **sides[0][0], **sides[1][0]}
        values = np.array(sorted(known))
        better = min(known, key=lambda value: known[value])
        if known[better] < self.chi2 - 0.01:
            what = f"the profile found a better fit, chi2 = {known[better]:.4g} at {self.keys[k]} = {better:.6g}"
            warnings.warn(f"{what}. Fit again with this start: motile.Free(lower, upper, start=...)", stacklevel=2)
        (_, below, open_below), (_, above, open_above) = sides
        return Profile(
            self.keys[k],
            values,
            np.array([known[value] for value in values]),
            (below[0], above[0]),
            (below[1], above[1]),
            (open_below, open_above),
        )

    def sample(
        self, n: int = 2000, *, walkers: int | None = None, burn_in: int = 100, seed: int = 0, progress: bool = False
    ) -> Samples:
        """At least `n` samples of the probability of the parameters given the data, by the package emcee
        (Foreman-Mackey et al. 2013), with constant probability within bounds where there is no prior.

        Each sample needs the steady state of all conditions. The first `burn_in` steps of each walker are left out.
        With `progress`, a bar counts the steps.
        """
        emcee = needed("emcee", "drawing samples")
        model, count = self._model, len(self.keys)
        walkers = max(2 * count + 2, 8) if walkers is None else walkers
        if n < 1 or burn_in < 0 or walkers < 2 * count:
            remedy = f"Use n of at least 1, burn_in of at least 0 and at least {2 * count} walkers"
            raise Error(f"n = {n}, burn_in = {burn_in}, walkers = {walkers}. {remedy}", key="n", remedy=remedy)

        def logarithm(values: Array) -> float:
            if np.any(values < model.lower) or np.any(values > model.upper):
                return -math.inf
            residuals = model.tried(np.array(values))
            return -math.inf if residuals is None else -0.5 * float(residuals @ residuals)

        random = np.random.default_rng(seed)
        best = np.array(list(self.values.values()))
        width = model.upper - model.lower
        spread = np.minimum(np.array([self.errors[key] for key in self.keys]), 0.1 * width)
        start = best + spread * random.standard_normal((walkers, count))
        # Walkers beyond a bound are reflected.
        start = np.where(start < model.lower, 2 * model.lower - start, start)
        start = np.clip(np.where(start > model.upper, 2 * model.upper - start, start), model.lower, model.upper)
        sampler = emcee.EnsembleSampler(walkers, count, logarithm)
        sampler.random_state = np.random.RandomState(seed).get_state()
        steps = burn_in + -(-n // walkers)
        bar = Bar(0, steps, "step") if progress else None
        for done, _ in enumerate(sampler.sample(start, iterations=steps), 1):
            if bar:
                bar(done)
        if bar:
            bar.close(steps)
        return Samples(
            self.keys, sampler.get_chain(discard=burn_in, flat=True), float(np.mean(sampler.acceptance_fraction))
        )

    def _known(self, key: str) -> str:
        name = key.replace("-", "_")
        if name not in self.keys:
            remedy = f"Use one of {', '.join(self.keys)}"
            raise Error(f"{key} is no parameter of this fit. {remedy}", key="key", value=key, remedy=remedy)
        return name

    def _summary(self) -> str:
        fit = f"chi2 = {self.chi2:.4g} for {self.degrees_of_freedom} degrees of freedom"
        return fit + (f", probability {self.probability:.2g}" if self.degrees_of_freedom > 0 else "")

    def _notes(self) -> list[str]:
        notes = []
        for reason in dict.fromkeys(self.reasons.values()):
            keys = [key for key, one in self.reasons.items() if one == reason]
            notes.append(f"{', '.join(keys)} {'are' if len(keys) > 1 else 'is'} not identified: {reason}")
        return [*notes, *self.remarks]

    def _row(self, key: str) -> tuple[str, str, str]:
        state = "yes" if self.identified[key] else "no"
        return f"{self.values[key]:.6g}", f"{self.errors[key]:.2g}", state

    def __repr__(self) -> str:
        width = max(map(len, self.keys))
        lines = [f"{'parameter':<{width}} {'value':>12} {'error':>9}  identified"]
        for key in self.keys:
            value, error, state = self._row(key)
            lines.append(f"{key:<{width}} {value:>12} {error:>9}  {state}")
        return "\n".join([*lines, self._summary(), *self._notes()])

    def _repr_html_(self) -> str:
        """Table for notebooks."""
        head = "".join(f"<th>{name}</th>" for name in ("parameter", "value", "error", "identified"))
        rows = "".join(
            "<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in (key, *self._row(key))) + "</tr>"
            for key in self.keys
        )
        notes = "".join(f"<li>{html.escape(note)}</li>" for note in self._notes())
        return f"<table><tr>{head}</tr>{rows}</table><p>{html.escape(self._summary())}</p><ul>{notes}</ul>"


def _side(
    model: Model, best: Array, least: float, k: int, end: float, step: float, points: int
) -> tuple[dict[float, float], tuple[float, float], bool]:
    """Profile from the best value to one bound: chi2 by value, and where it has grown by each level; the bound where it
    has not; and true if it ends there because of a bound or because there is no steady state beyond."""
    sign = math.copysign(1.0, end - best[k])
    found: dict[float, float] = {}
    start = best.copy()

    def at(value: float) -> float:
        nonlocal start
        start = start.copy()
        start[k] = value
        lower, upper = model.lower.copy(), model.upper.copy()
        lower[k] = upper[k] = value
        if model.tried(start) is None:
            return math.inf
        minimum = _minimise(model, start, lower, upper)
        start = minimum.values
        return float(minimum.residuals @ minimum.residuals)

    # Roots of the growth of chi2 are nearly linear in the value.
    path = [(float(best[k]), 0.0)]
    stride = step * 2.2 / points
    while path[-1][0] != end and path[-1][1] <= math.sqrt(_LEVELS[1]) and len(path) < 10 * points:
        value = path[-1][0] + sign * stride
        value = end if (end - value) * sign <= 0 else value
        chi2 = at(value)
        found[value] = chi2
        path.append((value, math.sqrt(max(chi2 - least, 0.0))))
        if path[-1][1] - path[-2][1] < 1.0 / points:
            stride *= 2
    crossings, blocked = [], False
    for level in _LEVELS:
        root = math.sqrt(level)
        place = next((i for i in range(1, len(path)) if path[i][1] > root), None)
        if place is None:
            crossings.append(end)
            continue
        (a, low), (b, high) = path[place - 1], path[place]
        for _ in range(30):
            inner = a + (b - a) * ((root - low) / (high - low) if math.isfinite(high) else 0.5)
            if abs(b - a) < 1e-6 * step:
                break
            start = best.copy()
            chi2 = at(inner)
            found[inner] = chi2
            grown = math.sqrt(max(chi2 - least, 0.0))
            if abs(grown - root) < 1e-4:
                break
            (a, low), (b, high) = ((inner, grown), (b, high)) if grown < root else ((a, low), (inner, grown))
        crossings.append(inner)
        blocked = not math.isfinite(high)
    finite = {value: chi2 for value, chi2 in found.items() if math.isfinite(chi2)}
    held = np.delete((start <= model.lower) | (start >= model.upper), k)
    return finite, (crossings[0], crossings[1]), bool(crossings[1] == end or blocked or np.any(held))


def _minimise(model: Model, start: Array, lower: Array, upper: Array) -> Minimum:
    return least_squares(model.tried, model.jacobian, start, lower, upper, model.upper - model.lower)


def fit(
    setup: Setup, parameters: Mapping[str, Free | tuple[float, float]], measurements: Sequence[Measurement]
) -> FitResult:
    """Fits numbers of a setup to measurements, by least squares.

    `parameters` holds the bounds of each number that is fitted, by its key, such as
    `{"droplets.0.particles.activity": (-6, -1)}`; a `Free` also has a start value and a prior. Without a start value,
    the search starts from the setup's value if that is within the bounds, otherwise from their middle.

    `measurements` are `Measured`, `MeasuredOutline`, `MeasuredModes` and `MeasuredConcentration` of steady swimmers,
    and `MeasuredRun`. Each may change other entries of the setup, such as the width of the channel it was done in.

    The fit minimises the sum of the squares of (measured - computed)/error, of data and priors, with the sensitivities
    of steady states as derivatives. Keys without sensitivities, and runs, are differentiated by differences.

    Raises `motile.Error` for an unknown key, bounds or errors that make no sense, more parameters than data and priors,
    or a start value without a steady swimmer.
    """
    free = _checked(setup, parameters)
    if not measurements:
        remedy = 'Give at least one, such as motile.Measured("speed", 0.21, 0.01)'
        raise Error(f"there are no measurements. {remedy}", key="measurements", remedy=remedy)
    for item in measurements:
        if not isinstance(item, Measured | MeasuredOutline | MeasuredModes | MeasuredConcentration | MeasuredRun):
            remedy = "Use motile.Measured, MeasuredOutline, MeasuredModes, MeasuredConcentration or MeasuredRun"
            raise Error(f"{item!r} is no measurement. {remedy}", key="measurements", value=repr(item), remedy=remedy)
    model = Model(setup, free, measurements)
    count, data = len(free), model.count - model.eliminated
    if count > data + len(model.priors):
        remedy = "Measure more, fit fewer parameters, or give priors: motile.Free(lower, upper, prior=(mean, error))"
        priors = f"{len(model.priors)} priors" if model.priors else "no priors"
        what = f"{count} parameters, but only {data} measured numbers and {priors}"
        raise Error(f"there are {what}. {remedy}", key="parameters", value=str(count), remedy=remedy)
    start = np.array([_start(setup, key, entry) for key, entry in free.items()])
    for item in measurements:
        model.at(start, item.changes)
    _check_start(model, start)
    best = _minimise(model, start, model.lower, model.upper)
    if model.start_from(best.values):
        best = _minimise(model, best.values, model.lower, model.upper)
    return _result(model, best)


def _numbers_of(entry: Any, place: str = "") -> Iterator[tuple[str, float]]:
    """Keys and values of all numbers of a setup."""
    if isinstance(entry, dict):
        for key, value in entry.items():
            yield from _numbers_of(value, f"{place}.{key}" if place else key)
    elif isinstance(entry, list):
        for k, value in enumerate(entry):
            yield from _numbers_of(value, f"{place}.{k}")
    elif isinstance(entry, float | int) and not isinstance(entry, bool):
        yield place.replace("-", "_"), float(entry)


def _checked(setup: Setup, parameters: Mapping[str, Free | tuple[float, float]]) -> dict[str, Free]:
    """Parameters by their keys with underscores, with bounds that make sense."""
    if not parameters:
        remedy = 'Give bounds of at least one, such as {"droplets.0.particles.activity": (-6, -1)}'
        raise Error(f"there are no parameters to fit. {remedy}", key="parameters", remedy=remedy)
    known, free = dict(_numbers_of(setup.to_dict())), {}
    for given, entry in parameters.items():
        key = given.replace("-", "_")
        if not isinstance(entry, Free):
            try:
                lower, upper = entry
            except (TypeError, ValueError):
                remedy = "Give a lower and an upper bound, such as (-6, -1)"
                raise Error(f"{key}: {entry!r}. {remedy}", key=key, value=repr(entry), remedy=remedy) from None
            entry = Free(lower, upper)
        if not (math.isfinite(entry.lower) and math.isfinite(entry.upper) and entry.lower < entry.upper):
            remedy = "Give two finite numbers, the lower one first"
            raise Error(f"{key}: bounds {entry.lower:g} and {entry.upper:g}. {remedy}", key=key, remedy=remedy)
        if entry.start is not None and not entry.lower <= entry.start <= entry.upper:
            remedy = "Choose a start within the bounds, or move them"
            what = f"the start {entry.start:g} is not between the bounds {entry.lower:g} and {entry.upper:g}"
            raise Error(f"{key}: {what}. {remedy}", key=key, value=f"{entry.start:g}", remedy=remedy)
        if entry.prior and not (math.isfinite(entry.prior[0]) and 0 < entry.prior[1] < math.inf):
            remedy = "Give a finite mean and a standard deviation above 0"
            raise Error(f"{key}: prior {entry.prior}. {remedy}", key=key, value=str(entry.prior), remedy=remedy)
        if key not in known:
            _check_key(setup, key, entry, known)
        free[key] = entry
    return free


def _check_key(setup: Setup, key: str, entry: Free, known: Mapping[str, float]) -> None:
    """Refuses a key that the setup has not and cannot have, with the nearest ones that it has."""
    try:
        setup.replace({key: entry.lower if entry.start is None else entry.start})
        return
    except Error as error:
        names = list(known) + [name for name in COVERED if name not in known]
        ends = {name.rsplit(".", 1)[-1]: name for name in reversed(names)}
        near = difflib.get_close_matches(key, names, 3, 0.7)
        near += [
            ends[end]
            for end in difflib.get_close_matches(key.rsplit(".", 1)[-1], list(ends), 2)
            if ends[end] not in near
        ]
        hint = f"Did you mean {' or '.join(near)}?" if near else f"Use one of {', '.join(known)}"
        message = f"the setup has no number at {key} that can be fitted ({error}). {hint}"
        raise Error(message, key=key, remedy=hint) from error


def _start(setup: Setup, key: str, entry: Free) -> float:
    if entry.start is not None:
        return entry.start
    now = dict(_numbers_of(setup.to_dict())).get(key)
    return now if now is not None and entry.lower <= now <= entry.upper else 0.5 * (entry.lower + entry.upper)


def _check_start(model: Model, start: Array) -> None:
    where = ", ".join(f"{key} = {value:g}" for key, value in zip(model.keys, start))
    try:
        states = model.states(start)
    except Error as error:
        remedy = "Choose another start: motile.Free(lower, upper, start=...)"
        raise Error(f"there is no steady state at the start, {where}: {error}. {remedy}", remedy=remedy) from error
    for group, state in zip(model.groups, states):
        speeds = [
            item for item in group.items if isinstance(item, Measured) and item.name == "speed" and item.value > 0
        ]
        if speeds and abs(state.speed) < 1e-6 * speeds[0].value:
            remedy = "Choose a start where it swims, such as a stronger activity: motile.Free(lower, upper, start=...)"
            what = f"the droplet does not swim at the start, {where}, but you measured a speed of {speeds[0].value:g}"
            raise Error(f"{what}: its speed would not change with the parameters. {remedy}", remedy=remedy)
    try:
        model.residuals(start)
    except Error as error:
        remedy = "Choose another start: motile.Free(lower, upper, start=...)"
        raise Error(
            f"measurements cannot be computed at the start, {where}: {error}. {remedy}", remedy=remedy
        ) from error


def _result(model: Model, minimum: Minimum) -> FitResult:
    values, keys = minimum.values, model.keys
    slopes = model.jacobian(values)
    scale = np.where(values != 0, values, model.upper - model.lower)
    combinations = _combinations(model, slopes[: model.count] * scale, scale)
    unknown = np.array([list(one.weights.values()) for one in combinations if not one.identified]).reshape(
        -1, len(keys)
    )
    identified = {key: bool(np.sum(unknown[:, k] ** 2) < _NAMED**2) for k, key in enumerate(keys)}
    covariance = _covariance(slopes * scale, scale)
    errors = dict(zip(keys, np.sqrt(np.diag(covariance)).tolist()))
    at_bounds = {
        key: float(bound)
        for k, key in enumerate(keys)
        for bound in (model.lower[k], model.upper[k])
        if abs(values[k] - bound) < 1e-9 * (model.upper[k] - model.lower[k])
    }
    chi2 = float(minimum.residuals @ minimum.residuals)
    freedom = model.count + len(model.priors) - model.eliminated - len(keys)
    remarks = [
        f"{key} ended at its bound {bound:g}: its error holds only inside, so look at its profile, or move the bound"
        for key, bound in at_bounds.items()
    ]
    if not minimum.converged:
        beyond = f" Beyond these values: {model.failure}." if model.failure else ""
        remarks.append(f"the search has not converged: start it nearer to the solution, or give more data.{beyond}")
    if freedom > 0 and chi2_above(chi2, freedom) < 1e-3:
        remarks.append(
            "the setup does not describe the data within their errors: "
            f"chi2 = {chi2:.4g} for {freedom} degrees of freedom"
        )
    remarks += sorted(model.remarks)
    return FitResult(
        keys=keys,
        values=dict(zip(keys, values.tolist())),
        errors=errors,
        covariance=covariance,
        chi2=chi2,
        degrees_of_freedom=freedom,
        residuals=minimum.residuals[: model.count][model.order],
        identified=identified,
        reasons={key: _reason(k, model, slopes, combinations) for k, key in enumerate(keys) if not identified[key]},
        combinations=combinations,
        at_bounds=at_bounds,
        remarks=remarks,
        setup=model.at(values, {}),
        _model=model,
    )


def _combinations(model: Model, slopes: Array, scale: Array) -> list[Combination]:
    """Singular vectors of the derivatives of data by relative changes."""
    _, sizes, directions = np.linalg.svd(slopes, full_matrices=True)
    sizes = np.append(sizes, np.zeros(len(directions) - len(sizes)))
    found = []
    for size, direction in zip(sizes, directions):
        weights = dict(zip(model.keys, direction.tolist()))
        error = float(1 / size) if size > _ROUND_OFF * sizes[0] else math.inf
        with np.errstate(divide="ignore"):
            room = np.min((model.upper - model.lower) / np.abs(scale * direction))
        # A constant probability between bounds has this standard deviation.
        found.append(Combination(weights, error, bool(error < room / math.sqrt(12))))
    return found


def _covariance(slopes: Array, scale: Array) -> Array:
    """Inverse of J^T J; infinite variances of parameters that it does not determine."""
    _, sizes, directions = np.linalg.svd(slopes, full_matrices=True)
    sizes = np.append(sizes, np.zeros(len(directions) - len(sizes)))
    known = sizes > _ROUND_OFF * sizes[0]
    part = directions[known] / sizes[known, None]
    covariance: Array = (part.T @ part) * np.outer(scale, scale)
    lost = np.sum(directions[~known] ** 2, axis=0) > _NAMED**2
    covariance[lost, :] = covariance[:, lost] = np.nan
    covariance[lost, lost] = np.inf
    return covariance


def _reason(k: int, model: Model, slopes: Array, combinations: list[Combination]) -> str:
    key = model.keys[k]
    if not np.any(slopes[: model.count, k]):
        return "no measurement depends on it"
    one = max((one for one in combinations if not one.identified), key=lambda one: abs(one.weights[key]))
    among = [other for other, weight in one.weights.items() if abs(weight) > _NAMED]
    if among == [key]:
        return "the data narrow it down less than its bounds do"
    effect = "nothing that was measured changes" if math.isinf(one.error) else "the data hardly change"
    change = f"{effect} if you change {one}"
    held = [model.keys[k] for k in model.priors if model.keys[k] in among]
    if held:
        return (
            f"{change}, so only {'its prior' if held == [key] else 'the prior of ' + ' and '.join(held)} determines it"
        )
    return f"{change}; fix one of them, or give it a prior"
