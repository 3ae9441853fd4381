"""Scenes and what is recorded of them."""

from __future__ import annotations

import html
import os
import warnings
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _html, _motile
from ._error import Error
from ._optional import needed, write_parquet
from ._progress import Bar

if TYPE_CHECKING:
    import pandas
    import xarray

Array = npt.NDArray[np.float64]
FilePath = str | os.PathLike[str]

_MOST_REPORTS = 1e7


class Track(Mapping[str, Array]):
    """Table of a run: `track["speed"]` is an array, an entry for each record.

    With one droplet arrays have one dimension, with more droplets two, times by droplets; `track.time` always has one.
    Centroids `x`, `y` are not wrapped: a droplet that leaves a periodic region on one side goes on beyond it. Values
    that do not exist are not a number. `as_array` has everything, times by droplets by `names`. `origin` says where the
    numbers come from: the version of motile and the fingerprint of the setup.
    """

    def __init__(self, names: list[str], values: Array, origin: Mapping[str, str] | None = None) -> None:
        self.names = names
        self.as_array = values
        self.origin = dict(origin or {})

    @property
    def time(self) -> Array:
        """Times of the records."""
        return self.as_array[:, 0, self.names.index("time")] if self.as_array.shape[1] else np.empty(0)

    def __getitem__(self, name: str) -> Array:
        if name not in self.names:
            raise KeyError(f"the table has no column {name}. Use one of {', '.join(self.names)}")
        if name == "time":
            return self.time
        column = self.as_array[:, :, self.names.index(name)]
        return column[:, 0] if column.shape[1] == 1 else column

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        times, droplets, names = self.as_array.shape
        return f"<track: {times} records of {droplets} droplets, {names} columns>"

    def to_pandas(self) -> pandas.DataFrame:
        """Table as a DataFrame; with more than one droplet its index is (time, droplet)."""
        _, droplets, names = self.as_array.shape
        rows = self.as_array.reshape(-1, names)
        frame: pandas.DataFrame = needed("pandas", "a DataFrame").DataFrame(rows, columns=self.names)
        frame.attrs.update(self.origin)
        if droplets == 1:
            return frame.set_index("time")
        frame.insert(1, "droplet", np.tile(np.arange(droplets), len(self.as_array)))
        return frame.set_index(["time", "droplet"])

    def to_parquet(self, path: FilePath) -> None:
        """Writes the table of `to_pandas` as a parquet file, with its origin."""
        write_parquet(self.to_pandas(), path)

    def to_xarray(self) -> xarray.Dataset:
        """Table as a Dataset with the dimensions time and droplet."""
        places = {"time": self.time, "droplet": np.arange(self.as_array.shape[1])}
        columns = {
            name: (("time", "droplet"), self.as_array[:, :, k]) for k, name in enumerate(self.names) if name != "time"
        }
        dataset: xarray.Dataset = needed("xarray", "a Dataset").Dataset(columns, places, attrs=self.origin)
        return dataset

    def _repr_html_(self) -> str:
        """First and last record of the first droplet, for notebooks."""
        times, droplets, _ = self.as_array.shape
        rows: dict[str, tuple[float, float]] = {}
        if times and droplets:
            first, last = self.as_array[0, 0], self.as_array[-1, 0]
            rows = {name: (float(first[k]), float(last[k])) for k, name in enumerate(self.names)}
        return f"<div>{html.escape(repr(self)[1:-1])}{_html.table(rows, ('column', 'first', 'last'))}</div>"


def origin_of(setup: _motile.Setup) -> dict[str, str]:
    """Where the numbers of a setup come from."""
    return {"motile": _motile.VERSION, "fingerprint": setup.fingerprint}


def _numbers(given: npt.ArrayLike, key: str) -> Array:
    """Array of real numbers, or an error that names the key."""
    try:
        found = np.asarray(given)
        return found.astype(float, casting="unsafe" if found.dtype == object else "same_kind", copy=False)
    except (TypeError, ValueError) as error:
        remedy = "Use an array of real numbers"
        raise Error(f"{key}: {error}. {remedy}", key=key, remedy=remedy) from error


class Droplet:
    """One of the droplets of a scene, as it is when asked. Arrays are copies."""

    def __init__(self, scene: _motile.Scene, index: int) -> None:
        self._scene = scene
        self.index = index

    @property
    def positions(self) -> Array:
        """Markers of the interface (length), counter-clockwise, of shape (n, 2)."""
        return self._scene.positions(self.index)

    @property
    def concentration(self) -> Array:
        """Concentrations of the segments that follow the markers (particles per length); empty without particles."""
        return self._scene.concentration(self.index)

    @property
    def velocities(self) -> Array:
        """Velocities of the fluid at the markers (length per time), of shape (n, 2)."""
        return self._scene.velocities(self.index)

    def observe(self) -> dict[str, float | None]:
        """All observables of the droplet by name; None where there is no value."""
        return self._scene.observe(self.index)

    def set_tension(
        self,
        law: Callable[[Array], npt.ArrayLike] | tuple[npt.ArrayLike, npt.ArrayLike],
        up_to: float | None = None,
        points: int = 8001,
    ) -> None:
        """Gives the interface a tension law of its own: a table (c, gamma) or a function of an array of c.

        Concentrations c are numbers per length, tensions gamma forces. A table is joined by monotone cubic polynomials
        and goes on straight beyond its ends. A function is tabulated at so many `points` from 0 to `up_to`, by default
        8 times the largest concentration now (if there are no particles on the interface yet, give it), and joined by
        cubic polynomials: where it is smooth the error falls with the fourth power of their distance.
        """
        if smooth := callable(law):
            if up_to is None:
                largest = float(np.max(self.concentration, initial=0.0))
                if self.concentration.size and not largest > 0:
                    remedy = "Set up_to, the largest concentration of the table"
                    what = "there are no particles on the interface yet, so the table needs a range"
                    raise Error(f"{what}. {remedy}", key="up_to", remedy=remedy)
                up_to = 8.0 * largest or 1.0
            c = np.linspace(0.0, up_to, points)
            gamma = _numbers(law(c), "tension")
            if gamma.shape not in ((), c.shape):
                remedy = "Return one tension for each concentration"
                what = f"the law returns an array of shape {gamma.shape} for concentrations of shape {c.shape}"
                raise Error(f"{what}. {remedy}", key="tension", remedy=remedy)
            gamma = np.broadcast_to(gamma, c.shape)
        else:
            parts = [_numbers(part, "tension").ravel() for part in law]
            if len(parts) != 2:
                remedy = "Use two: concentrations and tensions"
                raise Error(f"the table of a tension has {len(parts)} parts. {remedy}", key="tension", remedy=remedy)
            c, gamma = parts
        self._scene.set_tension(self.index, c.tolist(), gamma.tolist(), smooth)

    def __repr__(self) -> str:
        return f"<droplet {self.index}: {len(self.positions)} markers>"


class SpaceDroplet:
    """One of the droplets of a scene in three dimensions without symmetry, as it is when asked. Arrays are copies."""

    def __init__(self, scene: _motile.Scene, index: int) -> None:
        self._scene = scene
        self.index = index

    @property
    def points(self) -> Array:
        """Points of the surface (length), of shape (n, 3)."""
        return self._scene.mesh(self.index)[0]

    @property
    def triangles(self) -> npt.NDArray[np.int64]:
        """Numbers of the corners of the triangles between the points, of shape (m, 3), counter-clockwise from outside."""
        return self._scene.mesh(self.index)[1]

    @property
    def concentration(self) -> Array:
        """Concentrations at the points (particles per area); zero without particles."""
        return self._scene.mesh(self.index)[2]

    @property
    def tension(self) -> Array:
        """Tensions at the points (force per length)."""
        return self._scene.mesh(self.index)[3]

    @property
    def velocities(self) -> Array:
        """Velocities of the fluid at the points (length per time), of shape (n, 3)."""
        return self._scene.mesh(self.index)[4]

    @property
    def position(self) -> Array:
        """Centroid (length), of shape (3,)."""
        seen = self.observe()
        return np.array([seen[name] for name in ("x", "y", "z")], dtype=float)

    @property
    def heading(self) -> Array:
        """Unit vector along the velocity, of shape (3,); zero at rest."""
        seen = self.observe()
        return np.array([seen[f"heading_{name}"] for name in "xyz"], dtype=float)

    def observe(self) -> dict[str, float | None]:
        """All observables of the droplet by name; None where there is no value."""
        return self._scene.observe(self.index)

    def __repr__(self) -> str:
        return f"<droplet {self.index} in three dimensions: {len(self.points)} points>"


class Scene:
    """Bodies in a fluid with their state: what `Setup.build` makes.

    After an error, Ctrl-C, or an exception in a callback a scene holds the last good state, and `track` all that was
    recorded up to there.
    """

    def __init__(self, scene: _motile.Scene) -> None:
        self._scene = scene

    @property
    def setup(self) -> _motile.Setup:
        """Setup that the scene was built from."""
        return self._scene.setup

    @property
    def time(self) -> float:
        """Time of the present state."""
        return self._scene.time

    @property
    def steps(self) -> int:
        """Number of steps up to the present state."""
        return self._scene.steps

    @property
    def droplets(self) -> list[Droplet]:
        """Droplets in the order of the setup; none in three dimensions without symmetry."""
        count = 0 if self._scene.lacks_symmetry else self._scene.droplet_count
        return [Droplet(self._scene, k) for k in range(count)]

    @property
    def space_droplets(self) -> list[SpaceDroplet]:
        """Droplets in three dimensions without symmetry, in the order of the setup; none in other scenes."""
        count = self._scene.droplet_count if self._scene.lacks_symmetry else 0
        return [SpaceDroplet(self._scene, k) for k in range(count)]

    def velocity_at(self, points: npt.ArrayLike, error: float = 1e-6) -> Array:
        """Velocities of the fluid (length per time) in three dimensions without symmetry, at points of shape (..., 3).

        Next to a surface, a slower rule keeps the relative error below about `error`.
        """
        places = _numbers(points, "points")
        if places.ndim == 0 or places.shape[-1] != 3:
            remedy = "Use an array whose last dimension is 3"
            raise Error(f"points have shape {places.shape}. {remedy}", key="points", remedy=remedy)
        found = self._scene.velocities_in_space(np.ascontiguousarray(places.reshape(-1, 3)), error)
        return found.reshape(places.shape)

    @property
    def bodies(self) -> list[tuple[str, Array]]:
        """Names and markers (length) of all bodies, solids and walls of their own among them."""
        return self._scene.bodies()

    @property
    def warnings(self) -> list[str]:
        """Warnings of all that was recorded so far, the worst of each kind."""
        return self._scene.warnings

    @property
    def minimum_gap(self) -> float | None:
        """Smallest gap between an interface and another one or a wall (length); None where there is neither."""
        return self._scene.minimum_gap

    @property
    def body_forces(self) -> list[tuple[str, Array, float | None]]:
        """Names, forces and torques of the fluid on all bodies, in the order of `bodies`.

        Forces are arrays [x, y] (force): drag and lift of a held body, minus the weight of a droplet that sinks.
        Torques are about the centroid (force times length) for rigid bodies, and None for others.
        """
        return [(name, np.array(force), torque) for name, force, torque in self._scene.body_forces()]

    @property
    def channel_forces(self) -> dict[str, float | None] | None:
        """Forces of the fluid along a channel over one period; None without straight walls.

        `pressure_drop` (stress), its part that bodies cause at a given flux, `extra_pressure_drop`, and the forces on
        the walls along x, `force_lower` and `force_upper`, on all bodies, `force_bodies_x` and `force_bodies_y`, on all
        obstacles, `force_obstacles_x` and `force_obstacles_y`, and on plates that the fluid rubs on, `force_plates`.
        """
        return self._scene.channel_forces()

    def wall_shear(self, count: int = 128) -> tuple[Array, Array, Array] | None:
        """Places x and the shear stress there on the lower and upper wall along x (stress); None without walls."""
        return self._scene.wall_shear(count)

    @property
    def track(self) -> Track:
        """Everything that was recorded since the scene was built."""
        return Track(self._scene.names, self._scene.records(), self._origin())

    def run(
        self,
        until: float,
        every: float | None = None,
        *,
        step: Mapping[str, Any] | None = None,
        progress: bool = False,
        callback: Callable[[Scene], object] | None = None,
        checkpoint: FilePath | None = None,
    ) -> Track:
        """Runs up to the time `until` and returns what was recorded on the way.

        All observables of all droplets are recorded at multiples of `every` (time), after every step if None.
        `callback` is called with the scene at the same times (at the end alone if `every` is None), the start among
        them, and may look at everything; what it raises ends the run. `step` is a step size as in a setup
        (`{"fixed": 0.01}`), the setup's by default. With `progress` there is a bar in the terminal or notebook.
        Each new entry of `scene.warnings` is also given to Python's `warnings.warn`.
        `checkpoint` is saved after each call of the callback, except at the start, and at the end.
        """
        first, start, known = len(self._scene.records()), self.time, len(self.warnings)
        bar = Bar(self.time, until) if progress else None
        try:
            for stop in self._stops(until, every if callback or checkpoint else None):
                self._scene.advance(stop, every, dict(step) if step else None, bar)
                if callback:
                    callback(self)
                if checkpoint and self.time > start:
                    self.save(checkpoint)
        finally:
            if bar:
                bar.close(self.time)
        for text in self.warnings[known:]:
            warnings.warn(text, stacklevel=2)
        return Track(self._scene.names, self._without_repeats(first), self._origin())

    def _origin(self) -> dict[str, str]:
        return origin_of(self.setup)

    def _stops(self, until: float, every: float | None) -> Iterator[float]:
        if every is not None:
            start = self.time
            if not every > 0 or until - start > _MOST_REPORTS * every:
                remedy = f"Use a time above 0 that fits into the run at most {_MOST_REPORTS:.0e} times"
                raise Error(f"every = {every}. {remedy}", key="every", value=str(every), remedy=remedy)
            reached = int(np.floor(start / every + 1e-9))
            if abs(start - reached * every) <= 1e-9 * every and start < until:
                yield start
            while (stop := (reached + 1) * every) < until - 1e-9 * abs(until):
                yield stop
                reached += 1
        yield until

    def _without_repeats(self, first: int) -> Array:
        """Records from one on, of several at one time the last."""
        values = self._scene.records()[first:]
        if not values.size:
            return values
        times = values[:, 0, 0]
        kept: Array = values[np.append(times[1:] != times[:-1], True)]
        return kept

    def sample(self, points: npt.ArrayLike) -> tuple[Array, Array]:
        """Velocities (length per time, shape (..., 2)) and pressures (stress) at points of shape (..., 2).

        Pressures include the mean pressure gradient along a channel, relative to x = 0. Apart from it, the mean of the
        pressure is zero over a box, over both straight walls of a channel, and far away in unbounded fluid.
        """
        velocity, pressure, _ = self._sample(points)
        return velocity, pressure

    def velocity_gradient(self, points: npt.ArrayLike) -> Array:
        """Velocity gradients [[du/dx, du/dy], [dv/dx, dv/dy]] (1/time) at points of shape (..., 2)."""
        gradient: Array = self._sample(points)[2]
        return gradient

    def _sample(self, points: npt.ArrayLike) -> tuple[Array, Array, Array]:
        if self._scene.lacks_symmetry:
            remedy = "Use velocity_at with points of shape (..., 3)"
            raise Error(f"points of a plane have no flow in three dimensions. {remedy}", key="points", remedy=remedy)
        places = _numbers(points, "points")
        if places.ndim == 0 or places.shape[-1] != 2:
            remedy = "Use an array whose last dimension is 2"
            raise Error(f"points have shape {places.shape}. {remedy}", key="points", remedy=remedy)
        shape = places.shape[:-1]
        velocity, pressure, gradient = self._scene.sample(np.ascontiguousarray(places.reshape(-1, 2)))
        return velocity.reshape(*shape, 2), pressure.reshape(shape), gradient.reshape(*shape, 2, 2)

    def picture(
        self,
        path: FilePath | None = None,
        *,
        spacing: float | None = None,
        width: float = 16.0,
        caption: str = "",
        panel: str = "",
        font_size: float = 8.0,
        resolution: float = 75.0,
        pressure_range: tuple[float, float] | None = None,
        concentration: float | None = None,
        length_unit: str | None = None,
        streamlines: bool = True,
        streamline_spacing: float | None = None,
        scale_bar: bool = True,
        colour_bars: bool = True,
        solids: str = "plain",
    ) -> str | None:
        """Picture of the present state: text of an SVG file, or a file if a path is given, whose name ends in .svg or
        .png.

        `spacing` is the distance of the samples of the flow (length), by default a tenth of the radius of the first
        droplet. On paper, `width` is in cm, `font_size` in pt,
        and PNG files have `resolution` pixels per cm. `panel` is a label at the upper left, such as "a)".
        `pressure_range` holds the lowest and highest pressure that colours show (force per length), `concentration`
        the unit of concentrations, `length_unit` the text of the unit of length (by default R0 if the radius of the
        first droplet is 1), `solids` what the colour of elastic
        solids shows: "plain", "displacement", "stress" or "internal-stress".
        """
        look: dict[str, Any] = {
            "width": width,
            "caption": caption,
            "panel": panel,
            "font_size": font_size,
            "resolution": resolution,
            "pressure_range": pressure_range,
            "concentration": concentration,
            "streamlines": streamlines,
            "streamline_spacing": streamline_spacing,
            "scale_bar": scale_bar,
            "colour_bars": colour_bars,
            "solids": solids,
        }
        if length_unit is not None:
            look["length_unit"] = length_unit
        if path is None:
            return self._scene.svg(spacing, **look)
        self._scene.write_picture(os.fspath(path), spacing, **look)
        return None

    def _repr_svg_(self) -> str:
        return self._scene.svg()

    def _repr_html_(self) -> str:
        """Picture and key numbers, for notebooks."""
        rows: dict[str, Any] = {"time": self.time, "steps": self.steps, "warnings": len(self.warnings)}
        if self.droplets or self.space_droplets:
            seen = (self.droplets or self.space_droplets)[0].observe()
            names = ("speed", "aspect_ratio_moments", "stresslet_xx", "deformation", "stresslet")
            rows.update({name: value for name in names if (value := seen.get(name)) is not None})
        return f"<div>{self._scene.svg()}{_html.table(rows)}</div>"

    def __reduce__(self) -> tuple[object, ...]:
        return _unpickled, (self.setup, *self._scene.packed())

    def write_paraview(self, folder: FilePath, spacing: float | None = None) -> None:
        """Writes the flow on a raster of that spacing (length; by default a tenth of the radius of the first droplet)
        and all bodies as files for ParaView."""
        self._scene.write_paraview(os.fspath(folder), spacing)

    def __copy__(self) -> Scene:
        return Scene(self._scene.copy())

    def __deepcopy__(self, memo: object) -> Scene:
        return Scene(self._scene.copy())

    def save(self, path: FilePath) -> None:
        """Saves the state to a file, in place of an earlier one once it is complete."""
        self._scene.save(os.fspath(path))

    def load(self, path: FilePath) -> None:
        """Goes on from a saved state of the same setup: the steps that follow are, bit for bit, those that would have
        followed there. An error names the key if the state was saved with another setup. You may change `step`,
        `integrator`, `tolerance`, `least_gap`, the grid's spacing, kernel, correction and solver, and the particles'
        `flux`."""
        self._scene.load(os.fspath(path))

    def __repr__(self) -> str:
        return f"<scene at time {self.time:g}: {len(self.bodies)} bodies>"


def _unpickled(setup: _motile.Setup, state: bytes, records: Array) -> Scene:
    """Scene of a setup in a pickled state."""
    scene: Scene = setup.build()
    scene._scene.unpack(state, records)
    return scene
