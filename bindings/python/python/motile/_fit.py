"""Fits of the numbers of a setup to measurements."""

from __future__ import annotations

import difflib
import html
import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _motile
from ._chi2 import chi2_above, chi2_quantile
from ._curve import Array
from ._error import Error
from ._fit_model import COVERED, Free, Group, Measurement, Model, seen_of
from ._least_squares import Minimum, least_squares
from ._measured import Measured, MeasuredConcentration, MeasuredModes, MeasuredOutline, MeasuredRun, Seen
from ._optional import needed, write_parquet
from ._progress import Bar, Search
from ._scene import FilePath

if TYPE_CHECKING:
    import pandas

Setup = _motile.Setup

# Relative sizes of singular values below which a combination does not matter: derivatives are not more exact.
_ROUND_OFF = 1e-6
# Part of a combination of parameters below which it does not name the parameter.
_NAMED = 0.1
# Words of the remark and of the reason for a parameter at a bound.
_AT_BOUND = "ended at its bound"
# Reason for a parameter alone in a combination that the bounds determine.
_LOOSE = "the data narrow it down less than its bounds do"
# Levels of chi2 above its minimum that end intervals of 68.3 and 95 % of one parameter.
_LEVELS = (1.0, 3.841)
# Decrease of chi2 at one error from its minimum that is more than round-off, as a number and over chi2.
_LOWER, _LOWER_PART = 0.01, 1e-8
# How often a search continues from a lower chi2 that was found next to its end.
_RESTARTS = 2
# Growth of chi2 at two errors, instead of 4, below which the errors are too small.
_LEAST_GROWTH = 2.0
# Ratio of sizes of a measured and a computed outline that points to another unit.
_OTHER_SIZE = 1.3
# Mean square of the residuals of an outline that does not fit.
_POOR = 9.0
# Keys that are doubled if the stability of a state is not decided, and the most nodes for this.
_RESOLUTION, _MOST_NODES = ("method.integral.nodes", "method.integral.elements"), 256
# Radii for which the other default numbers of a droplet may be meant.
_USUAL_RADII = (0.1, 10.0)


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
    """For each parameter, True if data determine it, without priors.

    Its error from the data alone must satisfy four conditions. Its value +- 2 errors stays within the bounds, and takes
    up less than half of the distance between them. If the bounds have the same sign, 2 errors are less than half of the
    value. At both of these ends, chi2 has grown by at least 2, where a parabola grows by 4. In addition, no combination
    that the data do not determine changes the parameter. If a value is False, look at `profile`."""
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
        """Sum of the squares of (measured - computed)/error at values of all parameters.

        Raises `motile.Error` if there is no steady state at these values, or none that the search finds.
        """
        moved = dict(self.values)
        given = {self._known(key): float(value) for key, value in values.items()}
        moved.update(given)
        try:
            residuals = self._model.residuals(np.array([moved[key] for key in self.keys]))
        except Error as error:
            where = ", ".join(f"{key} = {value:g}" for key, value in given.items()) or "the best fit"
            remedy = f"Use values closer to the fit, {', '.join(f'{key} = {self.values[key]:g}' for key in self.keys)}"
            raise Error(
                f"chi2 cannot be computed at {where}: {error}. {remedy}",
                key=", ".join(given) or None,
                value=", ".join(f"{value:g}" for value in given.values()) or None,
                remedy=remedy,
            ) from None
        return float(residuals @ residuals)

    def contains(self, values: Mapping[str, float], level: float = 0.95) -> bool:
        """True if values of all parameters lie in their joint region of confidence: where chi2 exceeds its minimum by
        less than the quantile at this level of chi2 with as many degrees of freedom as there are parameters."""
        if not 0 < level < 1:
            raise Error(f"level = {level:g}. Use a probability between 0 and 1", key="level", value=f"{level:g}")
        return self.chi2_at(values) - self.chi2 <= chi2_quantile(level, len(self.keys))

    def profile(self, key: str, *, points: int = 8, progress: bool = False) -> Profile:
        """Profile likelihood of a parameter: for each of its values, all others are fitted anew.

        It steps from the best value to both sides, about `points` times each, to where chi2 has grown by 3.84 or to a
        bound. It is right where chi2 is no parabola, so use it for parameters that are badly determined or at a bound.

        It takes about 3 `points` fits of the other parameters. If you fitted one parameter, there are no others, and it
        takes about as long as the fit. If you fitted several, it may take 20 to 100 times as long as the fit. Then use
        fewer points, and `progress=True` for a bar.
        """
        k = self.keys.index(self._known(key))
        if points < 2:
            raise Error(f"points = {points}. Use at least 2", key="points", value=str(points))
        model = self._model
        best, low, high = np.array(list(self.values.values())), float(model.lower[k]), float(model.upper[k])
        error = self.errors[self.keys[k]]
        step = min(error, 0.25 * (high - low)) if error > 0 else 0.25 * (high - low)
        bar = Bar(0.0, 100.0, "percent") if progress else None
        sides = []
        for side, end in enumerate((low, high)):

            def tell(part: float, before: int = side) -> None:
                if bar:
                    bar(50.0 * (before + part))

            sides.append(_side(model, best, self.chi2, k, end, step, points, tell))
        if bar:
            bar.close(100.0)
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
        for reason in dict.fromkeys(reason for reason in self.reasons.values() if _AT_BOUND not in reason):
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
    model: Model,
    best: Array,
    least: float,
    k: int,
    end: float,
    step: float,
    points: int,
    tell: Callable[[float], None],
) -> tuple[dict[float, float], tuple[float, float], bool]:
    """Profile from the best value to one bound: chi2 by value, and where it has grown by each level; the bound where it
    has not; and true if it ends there because of a bound or because there is no steady state beyond. `tell` is called
    with the fraction that is done."""
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
        tell(0.6 * min(1.0, max(path[-1][1] / math.sqrt(_LEVELS[1]), abs((value - best[k]) / (end - best[k])))))
    crossings: list[float] = []
    blocked = False
    for level in _LEVELS:
        root = math.sqrt(level)
        tell(0.6 + 0.2 * len(crossings))
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


def _searched(model: Model, start: Array) -> Minimum:
    """Minimum of a search whose states, at its end, are those found from the minimum itself."""
    best = _minimise(model, start, model.lower, model.upper)
    if model.start_from(best.values):
        best = _minimise(model, best.values, model.lower, model.upper)
    return best


def fit(
    setup: Setup,
    parameters: Mapping[str, Free | tuple[float, float]],
    measurements: Sequence[Measurement] | Measurement,
    *,
    progress: bool = False,
) -> FitResult:
    """Fits numbers of a setup to measurements, by least squares.

    `parameters` holds the bounds of each number that is fitted, by its key, such as
    `{"droplets.0.particles.activity": (-6, -1)}`; a `Free` also has a start value and a prior. Without a start value,
    the search starts from the setup's value if that is within the bounds, otherwise from their middle.

    `measurements` are `Measured`, `MeasuredOutline`, `MeasuredModes` and `MeasuredConcentration` of steady swimmers,
    and `MeasuredRun`, in a list if there are several. Each may change other entries of the setup, such as the width of
    the channel it was done in.

    The fit minimises the sum of the squares of (measured - computed)/error, of data and priors, with the sensitivities
    of steady states as derivatives. Keys without sensitivities, and runs, are differentiated by differences. Then it
    looks for a lower chi2 at 1 error from the best values. It continues from there if it finds one. In narrow channels
    or with several parameters, that can take minutes: with `progress=True`, you see evaluations and the lowest chi2.

    `remarks` of the result say, for example, if the search did not reach a minimum, if the setup does not describe the
    data, if an outline has another size than the droplet, or if the fitted swimmer is unstable.

    Raises `motile.Error` for an unknown key, bounds or errors that make no sense, more parameters than data and priors,
    or a start value without a steady swimmer.
    """
    free = _checked(setup, parameters)
    known = Measured | MeasuredOutline | MeasuredModes | MeasuredConcentration | MeasuredRun
    if isinstance(measurements, known):
        measurements = [measurements]
    elif not isinstance(measurements, Iterable):
        remedy = "Give a list of them"
        what = f"the measurements are {measurements!r}, which is no list"
        raise Error(f"{what}. {remedy}", key="measurements", value=repr(measurements), remedy=remedy)
    measurements = list(measurements)
    if not measurements:
        remedy = 'Give at least one, such as motile.Measured("speed", 0.21, 0.01)'
        raise Error(f"there are no measurements. {remedy}", key="measurements", remedy=remedy)
    for item in measurements:
        if not isinstance(item, known):
            remedy = "Use motile.Measured, MeasuredOutline, MeasuredModes, MeasuredConcentration or MeasuredRun"
            raise Error(f"{item!r} is no measurement. {remedy}", key="measurements", value=repr(item), remedy=remedy)
    model = Model(setup, free, measurements)
    model.progress = Search() if progress else None
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
    best = _searched(model, start)
    near = _surroundings(model, best)
    for _ in range(_RESTARTS):
        if near.lower is None:
            break
        best = _searched(model, near.lower)
        near = _surroundings(model, best)
    if model.progress:
        model.progress.close(0.0)
        model.progress = None
    return _result(model, best, near)


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
    if not isinstance(parameters, Mapping):
        remedy = 'Give a dictionary, such as {"droplets.0.particles.activity": (-6, -1)}'
        what = f"the parameters are {parameters!r}, which is no dictionary"
        raise Error(f"{what}. {remedy}", key="parameters", value=repr(parameters), remedy=remedy)
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
        remedy = _why_not(model.at(start, {})) or "Choose another start: motile.Free(lower, upper, start=...)"
        raise Error(f"there is no steady state at the start, {where}: {error}. {remedy}", remedy=remedy) from error
    for group, state in zip(model.groups, states):
        speeds = [
            item for item in group.items if isinstance(item, Measured) and item.name == "speed" and item.value > 0
        ]
        if speeds and abs(state.speed) < 1e-6 * speeds[0].value:
            remedy = _why_not(model.at(start, group.changes)) or (
                "Choose a start where it swims, such as a stronger activity: motile.Free(lower, upper, start=...)"
            )
            what = f"the droplet does not swim at the start, {where}, but you measured a speed of {speeds[0].value:g}"
            raise Error(f"{what}: its speed would not change with the parameters. {remedy}", remedy=remedy)
    try:
        model.residuals(start)
    except Error as error:
        remedy = "Choose another start: motile.Free(lower, upper, start=...)"
        raise Error(
            f"measurements cannot be computed at the start, {where}: {error}. {remedy}", remedy=remedy
        ) from error


def _why_not(setup: Setup) -> str:
    """What to change if a droplet does not swim because of its sign of activity or its units; empty otherwise."""
    numbers = dict(_numbers_of(setup.to_dict()))
    if numbers.get("droplets.0.particles.activity", -1.0) >= 0:
        return "A droplet swims only if its activity is negative. Use bounds below 0, such as (-3, -0.6)"
    radius = numbers.get("droplets.0.shape.round.radius", 1.0)
    if _USUAL_RADII[0] <= radius <= _USUAL_RADII[1]:
        return ""
    usual = dict(_numbers_of(Setup(droplets=[{"particles": {"activity": -1.0}}]).to_dict()))
    keys = [key for key in COVERED if key in usual and key.startswith("droplets.0.particles")]
    kept = [key for key in (*keys, "droplets.0.tension", "viscosity") if numbers.get(key) == usual.get(key)]
    if not kept:
        return ""
    same = f"its radius is {radius:g}, but these numbers have their defaults for a radius of about 1: {', '.join(kept)}"
    return f"Give all numbers of the setup and of the data in the same units: {same}"


@dataclass(frozen=True)
class _Surroundings:
    """What was found around the end of a search."""

    slopes: Array
    """Derivatives of the residuals by the parameters."""
    scale: Array
    """Values, or distances of bounds for values of 0."""
    covariance: Array
    growth: dict[str, float]
    """For each parameter, the smaller growth of chi2 at 2 errors to both sides, with the others adapted."""
    lower: Array | None
    """Values at 1 error from the end with a lower chi2."""
    least: float
    """chi2 there, otherwise at the end."""


def _surroundings(model: Model, minimum: Minimum) -> _Surroundings:
    values, chi2 = minimum.values, float(minimum.residuals @ minimum.residuals)
    slopes = model.jacobian(values)
    scale = np.where(values != 0, values, model.upper - model.lower)
    covariance = _covariance(slopes * scale, scale)
    growth, lower, least = {}, None, chi2
    for k, key in enumerate(model.keys):
        error = math.sqrt(covariance[k, k])
        growth[key] = math.inf
        if not 0 < error < math.inf:
            continue
        direction = np.nan_to_num(covariance[:, k] / error)
        # The states at 1 error are starts of searches at 2 errors.
        for count in (-1, -2, 1, 2):
            moved = np.clip(values + count * direction, model.lower, model.upper)
            outside = not model.lower[k] <= values[k] + count * error <= model.upper[k]
            if moved[k] == values[k] or outside and abs(count) == 2:
                continue
            residuals = model.near(moved)
            if residuals is None:
                continue
            at = float(residuals @ residuals)
            if abs(count) == 2:
                growth[key] = min(growth[key], at - chi2)
            elif at < min(least, chi2 - _LOWER - _LOWER_PART * chi2):
                lower, least = moved, at
    return _Surroundings(slopes, scale, covariance, growth, lower, least)


def _result(model: Model, minimum: Minimum, near: _Surroundings) -> FitResult:
    values, keys = minimum.values, model.keys
    combinations = _combinations(model, near.slopes[: model.count] * near.scale, near.scale)
    at_bounds = {
        key: float(bound)
        for k, key in enumerate(keys)
        for bound in (model.lower[k], model.upper[k])
        if abs(values[k] - bound) < 1e-9 * (model.upper[k] - model.lower[k])
    }
    reasons = _reasons(model, values, near, combinations, at_bounds)
    chi2 = float(minimum.residuals @ minimum.residuals)
    freedom = model.count + len(model.priors) - model.eliminated - len(keys)
    return FitResult(
        keys=keys,
        values=dict(zip(keys, values.tolist())),
        errors=dict(zip(keys, np.sqrt(np.diag(near.covariance)).tolist())),
        covariance=near.covariance,
        chi2=chi2,
        degrees_of_freedom=freedom,
        residuals=minimum.residuals[: model.count][model.order],
        identified={key: key not in reasons for key in keys},
        reasons=reasons,
        combinations=combinations,
        at_bounds=at_bounds,
        remarks=_remarks(model, minimum, near, at_bounds, chi2, freedom),
        setup=model.at(values, {}),
        _model=model,
    )


def _remarks(
    model: Model, minimum: Minimum, near: _Surroundings, at_bounds: Mapping[str, float], chi2: float, freedom: int
) -> list[str]:
    """What a user should know before using the result."""
    remarks = [
        f"{key} {_AT_BOUND} {bound:g}: its error holds only inside, so look at its profile, or move the bound"
        for key, bound in at_bounds.items()
    ]
    if near.lower is not None:
        where = ", ".join(f"{key} = {value:.6g}" for key, value in zip(model.keys, near.lower))
        remarks.append(
            f"the search has not reached a minimum: chi2 is lower at {where}, {near.least:.6g} instead of {chi2:.6g}. "
            "Start from there: motile.Free(lower, upper, start=...)"
        )
    elif not minimum.converged:
        beyond = f" Beyond these values: {model.failure}." if model.failure else ""
        remarks.append(f"the search has not converged: start it nearer to the solution, or give more data.{beyond}")
    if freedom > 0 and chi2_above(chi2, freedom) < 1e-3:
        remarks.append(
            "the setup does not describe the data within their errors: "
            f"chi2 = {chi2:.4g} for {freedom} degrees of freedom"
        )
    if freedom == 0 and chi2 > _LEVELS[1]:
        remarks.append(
            f"the setup does not describe the data: no values within the bounds reach them, as chi2 = {chi2:.4g} "
            "instead of 0 for as many parameters as data"
        )
    states = list(zip(model.groups, model.states(minimum.values)))
    for group, state in states:
        for item in group.items:
            if isinstance(item, MeasuredOutline):
                remarks += _other_size(item, seen_of(state, group), _where(group))
    return [*remarks, *_unstable(states), *sorted(model.remarks)]


def _where(group: Group) -> str:
    """Conditions of measurements, such as ` at region.channel.width = 3`, or nothing."""
    changes = ", ".join(f"{key} = {value}" for key, value in group.changes.items())
    return f" at {changes}" if changes else ""


def _other_size(item: MeasuredOutline, seen: Seen, where: str) -> list[str]:
    """A remark if an outline seems to have another unit than the setup."""
    ratio, covered, square = item.compared(seen)
    remedy = "Check its unit: read_outline(file, scale=...) converts it to the unit of the setup"
    if covered < math.pi and square > _POOR:
        # The best place of a small outline is at the rim of the droplet.
        return [f"the measured outline{where} is an arc, or much smaller than the computed one. {remedy}"]
    if 1 / _OTHER_SIZE < ratio < _OTHER_SIZE:
        return []
    size = f"{ratio:.3g} times as large as" if ratio > 1 else f"{1 / ratio:.3g} times smaller than"
    return [f"the measured outline{where} is {size} the computed one. {remedy}"]


def _unstable(states: Sequence[tuple[Group, _motile.SteadyState]]) -> list[str]:
    """A remark if a state is known to be unstable."""
    found = []
    for group, state in states:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                rate = _growth_rate(state)
        except Error:
            continue
        if rate is not None:
            found.append(f"{rate:.2g} (1/time){_where(group)}")
    if not found:
        return []
    why = f"small disturbances grow, at a rate of {', '.join(found)}, so such a droplet would not swim on like this"
    return [f"the fitted swimmer is unstable: {why}. Check it with more nodes, and with a run"]


def _growth_rate(state: _motile.SteadyState) -> float | None:
    """Largest growth rate of a state that is known to be unstable, if need be with more nodes."""
    stable, rate = state.is_stable(), float(np.max(state.spectrum()[0].real))
    if stable is None and rate > 0:
        numbers = dict(_numbers_of(state.setup.to_dict()))
        finer = {key: int(2 * numbers[key]) for key in _RESOLUTION if key in numbers}
        if len(finer) < len(_RESOLUTION) or finer[_RESOLUTION[0]] > _MOST_NODES:
            return None
        state = _motile.steady(state.setup.replace(finer), near=state)
        stable, rate = state.is_stable(), float(np.max(state.spectrum()[0].real))
    return rate if stable is False else None


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


def _reasons(
    model: Model,
    values: Array,
    near: _Surroundings,
    combinations: list[Combination],
    at_bounds: Mapping[str, float],
) -> dict[str, str]:
    """For each parameter that data do not determine, the reason. `FitResult.identified` has the rule."""
    unknown = [list(one.weights.values()) for one in combinations if not one.identified]
    weights = np.sum(np.array(unknown).reshape(-1, len(values)) ** 2, axis=0)
    errors = np.sqrt(np.diag(_covariance(near.slopes[: model.count] * near.scale, near.scale)))
    reasons = {}
    for k, key in enumerate(model.keys):
        value, lower, upper, error = values[k], model.lower[k], model.upper[k], 2.0 * errors[k]
        look = f'look at profile("{key}")'
        if weights[k] >= _NAMED**2:
            reason = _reason(k, model, near.slopes, combinations)
            if reason != _LOOSE:
                reasons[key] = reason
                continue
        ends = f"its value +- 2 errors from the data, {value - error:.3g} to {value + error:.3g},"
        if key in at_bounds:
            reasons[key] = f"it {_AT_BOUND} {at_bounds[key]:g}, so the data give at most a limit; {look}"
        elif value - error < lower or value + error > upper:
            reasons[key] = f"{ends} reaches beyond the bounds {lower:g} and {upper:g}; {look}"
        elif 2 * error >= 0.5 * (upper - lower):
            reasons[key] = f"{ends} takes up more than half of the distance of its bounds; {look}"
        elif lower * upper >= 0 and error >= 0.5 * abs(value):
            reasons[key] = f"{ends} is too wide: 2 errors are more than half of the value; {look}"
        elif weights[k] >= _NAMED**2:
            reasons[key] = f"{_LOOSE}; {look}"
        elif near.growth[key] < _LEAST_GROWTH:
            grown = f"chi2 grows by only {near.growth[key]:.2g} at 2 errors instead of by 4"
            reasons[key] = f"its error is too small, because {grown}; {look}"
    return reasons


def _reason(k: int, model: Model, slopes: Array, combinations: list[Combination]) -> str:
    key = model.keys[k]
    if not np.any(slopes[: model.count, k]):
        return "no measurement depends on it"
    one = max((one for one in combinations if not one.identified), key=lambda one: abs(one.weights[key]))
    among = [other for other, weight in one.weights.items() if abs(weight) > _NAMED]
    if among == [key]:
        return _LOOSE
    effect = "nothing that was measured changes" if math.isinf(one.error) else "the data hardly change"
    change = f"{effect} if you change {one}"
    held = [model.keys[k] for k in model.priors if model.keys[k] in among]
    if held:
        return (
            f"{change}, so only {'its prior' if held == [key] else 'the prior of ' + ' and '.join(held)} determines it"
        )
    return f"{change}; fix one of them, or give it a prior"
