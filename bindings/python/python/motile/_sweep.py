"""Sweeps: one run for each combination of values."""

from __future__ import annotations

import hashlib
import itertools
import multiprocessing
import os
import warnings
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _html
from ._error import Error
from ._motile import VERSION, Setup
from ._optional import needed, write_parquet
from ._progress import Bar
from ._scene import FilePath, Track, origin_of

if TYPE_CHECKING:
    import pandas
    import xarray

# Names and values of the table of a run, and what ended it early.
_Result = tuple[tuple[list[str], Any], str | None]


@dataclass(frozen=True)
class SweepRun:
    """One run of a sweep."""

    values: dict[str, Any]
    """Values of the places that the sweep changes."""
    setup: Setup
    """Setup of the run."""
    track: Track
    """What was recorded, up to its end."""
    error: str | None
    """What ended the run early; None for one that reached its end."""


@dataclass(frozen=True)
class Sweep(Sequence[SweepRun]):
    """Runs of a sweep, the last place changing fastest."""

    runs: list[SweepRun]

    def __getitem__(self, index: Any) -> Any:
        return self.runs[index]

    def __len__(self) -> int:
        return len(self.runs)

    def to_pandas(self) -> pandas.DataFrame:
        """Last record of each droplet of each run, with the values of the places and the errors."""
        rows: list[dict[str, Any]] = []
        for run in self.runs:
            last = run.track.as_array[-1] if len(run.track.as_array) else []
            for number, record in enumerate(last):
                named = dict(zip(run.track.names, record))
                rows.append({**run.values, "droplet": number, **named, "error": run.error})
        frame: pandas.DataFrame = needed("pandas", "a DataFrame").DataFrame(rows)
        frame.attrs["motile"] = VERSION
        return frame

    def to_parquet(self, path: FilePath) -> None:
        """Writes the table of `to_pandas` as a parquet file."""
        write_parquet(self.to_pandas(), path)

    def to_xarray(self) -> xarray.Dataset:
        """Last record of the first droplet of each run, as a Dataset with a dimension for each place that the sweep
        changes. Runs that ended without a record are not a number."""
        dataset: xarray.Dataset = needed("xarray", "a Dataset").Dataset(attrs={"motile": VERSION})
        places = list(self.runs[0].values) if self.runs else []
        known = [list(dict.fromkeys(_label(run.values[place]) for run in self.runs)) for place in places]
        names = list(dict.fromkeys(name for run in self.runs for name in run.track.names))
        values = {name: np.full([len(labels) for labels in known], np.nan) for name in names}
        for run in self.runs:
            at = tuple(labels.index(_label(run.values[place])) for place, labels in zip(places, known))
            if run.track.as_array.size:
                for name, value in zip(run.track.names, run.track.as_array[-1, 0]):
                    values[name][at] = value
        dataset = dataset.assign_coords(dict(zip(places, known)))
        return dataset.assign({name: (places, value) for name, value in values.items()})

    def _repr_html_(self) -> str:
        """Values, speed at the end and error of each run, for notebooks."""
        rows: dict[str, tuple[Any, ...]] = {}
        for number, run in enumerate(self.runs):
            known = len(run.track.as_array) and "speed" in run.track.names
            speed = float(np.ravel(run.track["speed"][-1])[0]) if known else float("nan")
            rows[str(number)] = (*run.values.values(), speed, run.error or "")
        places = tuple(self.runs[0].values) if self.runs else ()
        return _html.table(rows, ("run", *places, "speed", "error"))


def _label(value: Any) -> Any:
    """Value as a coordinate: a number or a text."""
    return value if isinstance(value, int | float | str) else str(value)


def sweep(
    setup: Setup,
    changes: Mapping[str, Sequence[Any]],
    until: float,
    every: float | None = None,
    *,
    processes: int = 1,
    folder: FilePath | None = None,
    progress: bool = False,
) -> Sweep:
    """Runs a setup to the time `until` for each combination of values at places as `droplets.0.particles.activity`.

    Runs are spread over `processes`. With a `folder` each is kept there when it is done, and what is kept is not run
    again: a sweep that was interrupted goes on, and values can be added. What a run is kept as depends on all of its
    setup, on `until` and `every`, so that a changed sweep never takes results of another. A run that another version of
    motile has kept is run again, with a warning. A run that ends in an error is part of the result, with all that was
    recorded of it. With `progress`, a bar counts the runs that are done. As with all of `multiprocessing`, programs
    that use more than one process need `if __name__ == "__main__":`.
    """
    if every is None:
        every = until / 100
    for key, time in {"until": until, "every": every}.items():
        if not 0 < time < float("inf"):
            remedy = "use a positive finite time"
            raise Error(f"{key} = {time}: {remedy}", key=key, value=str(time), remedy=remedy)
    combinations = [dict(zip(changes, values)) for values in itertools.product(*changes.values())]
    # All are checked before the first run.
    setups = [setup.replace(values) for values in combinations]
    kept = None if folder is None else Path(folder)
    if kept:
        kept.mkdir(parents=True, exist_ok=True)
    work = [(one.to_toml(), until, every, str(kept) if kept else None) for one in setups]
    if processes > 1 and len(work) > 1:
        # Forked copies of a process with threads may hang.
        context = multiprocessing.get_context("spawn")
        others = set(multiprocessing.active_children())
        with ProcessPoolExecutor(processes, mp_context=context) as pool:
            try:
                results = _counted(pool.map(_run, work), len(work), progress)
            except BaseException:
                # After Ctrl-C nobody waits for the runs that have begun.
                for child in set(multiprocessing.active_children()) - others:
                    child.terminate()
                raise
    else:
        results = _counted(map(_run, work), len(work), progress)
    runs = zip(combinations, setups, results)
    return Sweep([SweepRun(v, s, Track(*table, origin_of(s)), error) for v, s, (table, error) in runs])


def _counted(results: Iterable[_Result], count: int, progress: bool) -> list[_Result]:
    """All results, with a bar that counts them."""
    bar = Bar(0, count, "run") if progress else None
    found: list[_Result] = []
    try:
        for result in results:
            found.append(result)
            if bar:
                bar(len(found))
    finally:
        if bar:
            bar.close(len(found))
    return found


def _run(work: tuple[str, float, float, str | None]) -> _Result:
    text, until, every, folder = work
    place = None
    if folder:
        name = hashlib.sha256(f"{text}\n{until!r}\n{every!r}".encode()).hexdigest()[:24]
        place = Path(folder) / f"{name}.npz"
        if place.exists():
            try:
                with np.load(place) as known:
                    version = str(known["version"]) if "version" in known else "of an older version"
                    if version == str(VERSION):
                        error = str(known["error"]) or None
                        return (known["names"].tolist(), known["values"]), error
                warnings.warn(
                    f"{place} was kept by motile {version}, and this is motile {VERSION}: it is run again",
                    stacklevel=2,
                )
            except (ValueError, KeyError, EOFError, OSError, zipfile.BadZipFile) as broken:
                remedy = "Remove it to run it again"
                raise Error(f"{place} is not a result of a sweep. {remedy}", remedy=remedy) from broken
    error = None
    names, values = ["time"], np.empty((0, 0, 1))
    try:
        scene = Setup.from_toml(text).build()
        try:
            scene.run(until, every)
        finally:
            names, values = scene.track.names, scene.track.as_array
    except Error as raised:
        error = str(raised)
    if place:
        part = place.with_suffix(f".{os.getpid()}.part")
        with part.open("wb") as file:
            np.savez(file, names=names, values=values, error=error or "", setup=text, version=str(VERSION))
        part.replace(place)
    return (names, values), error
