"""Residuals of measurements and their derivatives by parameters of a setup."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _motile
from ._curve import Array, Curve
from ._error import Error
from ._measured import OBSERVABLES, Measured, MeasuredRun, Seen, Steady, eliminated
from ._progress import Search

Setup = _motile.Setup
Measurement = Steady | MeasuredRun

# Relative steps of differences between steady states, and between runs, whose steps in time differ.
_STEP, _STEP_OF_RUNS = 1e-4, 1e-3
# Relative step along sensitivities, in arithmetic alone.
_STEP_OF_SLOPES = 1e-5
# Part of its speed below which a droplet has stopped.
_STOPPED = 1e-3
# How often the way to values is halved.
_HALVINGS = 3
# States that are kept, to start searches from.
_KEPT = 32
# Speed below which a droplet has no direction.
_AT_REST = 1e-9
# Change of residuals below which states are the same.
_SAME = 1e-7

_DROPLET, _PARTICLES = "droplets.0.", "droplets.0.particles."
# Numbers of `SteadyState.sensitivities` by their keys.
COVERED = {
    _PARTICLES + "activity": "activity",
    _PARTICLES + "excluded_volume.step": "excluded_volume",
    _PARTICLES + "excluded_volume.step_at.strength": "excluded_volume",
    _PARTICLES + "excluded_volume.step_at.threshold": "excluded_volume_threshold",
    _PARTICLES + "excluded_volume.step_at.steepness": "excluded_volume_steepness",
    _PARTICLES + "excluded_volume.quadratic": "excluded_volume_quadratic",
    _PARTICLES + "diffusion": "diffusion",
    _PARTICLES + "concentration": "concentration",
    _PARTICLES + "exchange.binding": "binding",
    _PARTICLES + "exchange.unbinding": "unbinding",
    _PARTICLES + "exchange.diffusion_inside": "diffusion_inside",
    _PARTICLES + "exchange.number_inside": "number_inside",
    _DROPLET + "tension": "tension",
    _DROPLET + "viscosity": "viscosity_in",
    "viscosity": "viscosity_out",
    _DROPLET + "cortex.viscosity": "cortex",
    _DROPLET + "cortex.per_concentration": "cortex_per_concentration",
    _DROPLET + "cortex.shear_viscosity": "cortex_shear",
    _DROPLET + "friction": "friction",
    _DROPLET + "shape.round.radius": "radius",
    "region.channel.width": "width",
    "region.channel.length": "length",
    "region.box.lengths.0": "box_x",
    "region.box.lengths.1": "box_y",
    "region.tube.radius": "tube_radius",
    "region.tube.drive.gradient": "pressure_gradient",
    "region.channel.drive.gradient": "pressure_gradient",
    "region.tube.drive.flux": "flux",
    "region.channel.drive.flux": "flux",
    "flow.shear": "shear",
    "flow.extension": "extension",
}


@dataclass(frozen=True)
class Free:
    """Parameter of a fit: its bounds and, if you like, the value that the search starts from and a prior.

    `prior` is what you know of it from elsewhere: the mean and standard deviation of a Gaussian distribution.
    """

    lower: float
    upper: float
    start: float | None = field(default=None, kw_only=True)
    prior: tuple[float, float] | None = field(default=None, kw_only=True)


@dataclass
class Group:
    """Measurements of one steady state."""

    changes: dict[str, Any]
    items: list[Steady]


class Model:
    """Residuals of all measurements and priors, in error bars, and their derivatives."""

    def __init__(self, setup: Setup, free: dict[str, Free], data: Sequence[Measurement]) -> None:
        self.setup, self.free, self.keys = setup, free, tuple(free)
        self.runs = [item for item in data if isinstance(item, MeasuredRun)]
        groups: dict[str, Group] = {}
        for item in data:
            if not isinstance(item, MeasuredRun):
                changes = {key.replace("-", "_"): value for key, value in item.changes.items()}
                group = groups.setdefault(json.dumps(changes, sort_keys=True, default=repr), Group(changes, []))
                group.items.append(item)
        self.groups = list(groups.values())
        self.lower = np.array([float(entry.lower) for entry in free.values()])
        self.upper = np.array([float(entry.upper) for entry in free.values()])
        self.count = sum(item.count for item in data)
        self.eliminated = sum(len(item.start) for group in self.groups for item in group.items)
        self.priors = [k for k, entry in enumerate(free.values()) if entry.prior]
        self.remarks: set[str] = set()
        self.progress: Search | None = None
        self._known: dict[bytes, tuple[Array, list[_motile.SteadyState]]] = {}
        self._first: list[_motile.SteadyState] = []
        self.failure = ""
        of_steady = [
            k for group in self.groups for k, item in enumerate(data) if any(item is one for one in group.items)
        ]
        numbers = [*of_steady, *(k for k, item in enumerate(data) if isinstance(item, MeasuredRun))]
        given = np.repeat(numbers, [data[k].count for k in numbers])
        self.order = np.argsort(given, kind="stable")

    def __getstate__(self) -> dict[str, Any]:
        # Steady states cannot be pickled: they are found anew.
        return {**self.__dict__, "_known": {}, "_first": [], "progress": None}

    def at(self, values: Array, changes: Mapping[str, Any]) -> Setup:
        """Setup of values of the parameters under the conditions of a measurement."""
        return self.setup.replace({**dict(zip(self.keys, values.tolist())), **changes})

    def states(self, values: Array, halvings: int = _HALVINGS) -> list[_motile.SteadyState]:
        """Steady states of all conditions.

        They are searched from the same states each time, so that they depend on nothing but the values.
        """
        return self._search(values, halvings)

    def _search(self, values: Array, halvings: int) -> list[_motile.SteadyState]:
        """States of values, by way of values between these and the nearest known ones if that is too far."""
        name = values.tobytes()
        if name in self._known:
            return self._known[name][1]
        known = list(self._known.values())
        far = [np.max(np.abs(at - values) / (self.upper - self.lower)) for at, _ in known]
        place, nearest = known[int(np.argmin(far))] if known else (values, [])
        setups = [self.at(values, group.changes) for group in self.groups]
        starts = [[states[k] for states in (self._first, nearest) if states] for k in range(len(setups))]
        found: list[_motile.SteadyState] = []
        try:
            found = [_near(setup, *states) for setup, states in zip(setups, starts)]
        except Error:
            if not halvings or not nearest:
                raise
        if setups and not found:
            self._search(0.5 * (place + values), halvings - 1)
            return self._search(values, halvings - 1)
        self._known[name] = (values.copy(), found)
        self._first = self._first or found
        if len(self._known) > _KEPT:
            self._known.pop(next(iter(self._known)))
        return found

    def start_from(self, values: Array) -> bool:
        """Searches from the states of these values from now on, and returns true if that changes the residuals."""
        before = self.residuals(values)
        self._first = self.states(values)
        self._known = {}
        after = self.tried(values)
        return after is not None and bool(np.any(np.abs(after - before) > _SAME))

    def residuals(self, values: Array, halvings: int = _HALVINGS) -> Array:
        """Residuals of data, then of priors."""
        parts = [
            eliminated(lambda extra: item.residuals(seen, extra), item.start)[1]
            for group, state in zip(self.groups, self.states(values, halvings))
            for seen in [seen_of(state, group)]
            for item in group.items
        ]
        parts += [run.residuals(self.at(values, run.changes)) for run in self.runs]
        parts.append(self._of_priors(values))
        found = np.concatenate(parts)
        if not np.all(np.isfinite(found)):
            raise Error("a measured number has no value at these parameters. Use narrower bounds")
        if self.progress:
            self.progress(float(found @ found))
        return found

    def near(self, values: Array) -> Array | None:
        """Residuals close to known ones, or None where there is no steady state that is found at once."""
        try:
            return self.residuals(values, 0)
        except Error:
            return None

    def tried(self, values: Array) -> Array | None:
        """Residuals, or None where there is no steady state or no run."""
        try:
            return self.residuals(values)
        except Error as error:
            self.failure = str(error)
            return None

    def _of_priors(self, values: Array) -> Array:
        priors = [(k, entry.prior) for k, entry in enumerate(self.free.values()) if entry.prior]
        return np.array([(values[k] - prior[0]) / prior[1] for k, prior in priors])

    def jacobian(self, values: Array) -> Array:
        """Derivatives of the residuals by the parameters: by sensitivities, and by differences where there are none."""
        self.remarks.clear()
        parts = []
        for group, state in zip(self.groups, self.states(values)):
            parts += self._of_group(values, group, state)
        for run in self.runs:
            columns = [
                self._difference(values, k, lambda moved: run.residuals(self.at(moved, run.changes)), _STEP_OF_RUNS)
                for k in range(len(self.keys))
            ]
            parts.append(np.column_stack(columns))
        rows = np.zeros((len(self.priors), len(self.keys)))
        for row, (k, entry) in enumerate((k, e.prior) for k, e in enumerate(self.free.values()) if e.prior):
            rows[row, k] = 1.0 / entry[1]
        return np.concatenate([*parts, rows])

    def _of_group(self, values: Array, group: Group, state: _motile.SteadyState) -> list[Array]:
        """Derivatives of the residuals of each measurement of a condition."""
        seen = seen_of(state, group)
        found = [eliminated(lambda extra: item.residuals(seen, extra), item.start) for item in group.items]

        def residuals(other: Seen) -> Array:
            return np.concatenate([item.residuals(other, extra) for item, (extra, _, _) in zip(group.items, found)])

        def anew(at: Array) -> Array:
            return residuals(seen_of(_near(self.at(at, group.changes), state), group))

        slopes, columns = self._slopes(values, group, state), []
        for k, key in enumerate(self.keys):
            slope = slopes[k]
            # A change of an entry replaces all that is in it, also what is varied.
            if any(key == changed or key.startswith(f"{changed}.") for changed in group.changes):
                columns.append(np.zeros(sum(len(best) for _, best, _ in found)))
            elif slope:
                by = _STEP_OF_SLOPES * float(self.scale(values)[k])
                columns.append((residuals(slope(by)) - residuals(slope(-by))) / (2 * by))
            else:
                columns.append(self._difference(values, k, anew, _STEP))
        ends = np.cumsum([len(best) for _, best, _ in found])[:-1]
        parts = np.split(np.column_stack(columns), ends)
        # What a change of the eliminated numbers makes up for does not count.
        return [
            part - by_extra @ np.linalg.lstsq(by_extra, part, rcond=None)[0] if by_extra.shape[1] else part
            for part, (_, _, by_extra) in zip(parts, found)
        ]

    def scale(self, values: Array) -> Array:
        """Usual size of each parameter."""
        scale: Array = np.minimum(np.where(values != 0, np.abs(values), np.inf), self.upper - self.lower)
        return scale

    def _slopes(self, values: Array, group: Group, state: _motile.SteadyState) -> list[Callable[[float], Seen] | None]:
        """For each parameter, what is seen after a small change of it, to first order; None without sensitivities."""
        own = own_viscosity(state.setup)
        names = [_names(key, own) for key in self.keys]
        wanted = sorted({name for some in names for name in some})
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            table, shapes = _tables(state, wanted, needs_curve(group))
        self.remarks |= {str(warning.message) for warning in heard}
        measured, places, amounts = state.measured, state.positions, state.concentration

        def slope(of: tuple[str, ...]) -> Callable[[float], Seen] | None:
            if not of or not set(of) <= set(table.get("speed", {})):
                return None

            def moved(by: float) -> Seen:
                seen = {name: measured[name] + by * sum(table[name][one] for one in of) for name in OBSERVABLES}
                if not needs_curve(group):
                    return Seen(seen, None)
                change = np.sum([shapes[one] for one in of], axis=0)
                return Seen(seen, _curve(state, places + by * change[:, :2], amounts + by * change[:, 2]))

            return moved

        return [slope(of) for of in names]

    def _difference(self, values: Array, k: int, function: Callable[[Array], Array], step: float) -> Array:
        """Derivative of a function by a parameter, by central differences, one-sided at bounds and where there is no
        state on the other side."""
        step *= float(self.scale(values)[k])
        ends: list[tuple[float, Array]] = []
        for move in (-step, step, 0.0):
            moved = values.copy()
            moved[k] = min(max(values[k] + move, self.lower[k]), self.upper[k])
            if len(ends) < 2 and all(moved[k] != at for at, _ in ends):
                try:
                    ends.append((float(moved[k]), function(moved)))
                except Error:
                    if move == 0.0:
                        raise
        if len(ends) < 2:
            key = self.keys[k]
            raise Error(f"there is no steady state next to {key} = {values[k]:g}. Use narrower bounds", key=key)
        change: Array = (ends[1][1] - ends[0][1]) / (ends[1][0] - ends[0][0])
        return change


def _near(setup: Setup, *starts: _motile.SteadyState) -> _motile.SteadyState:
    """Steady state on the branch of others, or found anew if there are none or the droplet has stopped."""
    failure = None
    for state in starts:
        try:
            found = _motile.steady(setup, near=state)
        except Error as error:
            failure = error
            continue
        if abs(found.speed) >= _STOPPED * abs(state.speed):
            return found
        failure = None
    if failure:
        raise failure
    return _motile.steady(setup)


def _tables(
    state: _motile.SteadyState, names: list[str], shape: bool
) -> tuple[dict[str, dict[str, float]], dict[str, Array]]:
    """Sensitivities of what is measured, and of the nodes if they are needed, by those parameters that have some."""
    try:
        table = state.sensitivities(parameters=names) if names else {}
        return table, state.profile_sensitivities(names) if shape else {}
    except Error:
        if len(names) < 2:
            return {}, {}
    # A friction of zero, for example, has none.
    parts = [_tables(state, [name], shape) for name in names]
    observables = {observable for table, _ in parts for observable in table}
    tables = {
        one: {name: value for table, _ in parts if table for name, value in table[one].items()} for one in observables
    }
    return tables, {name: change for _, shapes in parts for name, change in shapes.items()}


def own_viscosity(setup: Setup) -> bool:
    """True if the droplet has a viscosity of its own."""
    droplets = setup.to_dict().get("droplets") or [{}]
    return droplets[0].get("viscosity") is not None


def _names(key: str, own: bool) -> tuple[str, ...]:
    """Numbers in the table of sensitivities that a key changes."""
    if key == "viscosity" and not own:
        return ("viscosity_out", "viscosity_in")
    return (COVERED[key],) if key in COVERED else ()


def needs_curve(group: Group) -> bool:
    return any(not isinstance(item, Measured) for item in group.items)


def seen_of(state: _motile.SteadyState, group: Group) -> Seen:
    return Seen(state.measured, _curve(state, state.positions, state.concentration) if needs_curve(group) else None)


def _curve(state: _motile.SteadyState, positions: Array, concentration: Array) -> Curve:
    """Curve of a state with its motion along x."""
    velocity = np.array(state.velocity)
    speed = np.hypot(*velocity)
    x, y = velocity / speed if speed > _AT_REST else np.array([1.0, 0.0])
    return Curve(positions @ np.array([[x, -y], [y, x]]), concentration)
