"""Branches of steady states."""

from __future__ import annotations

import html
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _html, _motile
from ._optional import needed, write_parquet
from ._progress import Bar
from ._scene import FilePath

if TYPE_CHECKING:
    import pandas
    import xarray


@dataclass(frozen=True)
class Branch:
    """Branch of steady states along a parameter, point by point."""

    parameter: str
    """Name of the parameter."""
    values: npt.NDArray[np.float64]
    """Values of the parameter."""
    speeds: npt.NDArray[np.float64]
    """Speeds (length per time)."""
    growth_rates: npt.NDArray[np.float64]
    """Largest growth rates of small disturbances (1/time)."""
    growth_rate_errors: npt.NDArray[np.float64]
    """Error estimates of the growth rates (1/time): a smaller growth rate does not decide whether a state is stable."""
    unstable: npt.NDArray[np.int64]
    """Numbers of growing disturbances, by their growth rates alone: zero for a stable state."""
    special: list[tuple[str, float]]
    """Folds, branch points and Hopf points: kind and value of the parameter."""
    end: str
    """Reason why the branch ends."""
    states: list[_motile.SteadyState]
    """Steady states."""

    def to_pandas(self) -> pandas.DataFrame:
        """Table with a line for each point: the parameter, speed, growth rate and its error, and the number of growing
        disturbances."""
        columns = {
            self.parameter: self.values,
            "speed": self.speeds,
            "growth_rate": self.growth_rates,
            "growth_rate_error": self.growth_rate_errors,
            "unstable": self.unstable,
        }
        frame: pandas.DataFrame = needed("pandas", "a DataFrame").DataFrame(columns)
        frame.attrs["motile"] = _motile.VERSION
        return frame

    def to_parquet(self, path: FilePath) -> None:
        """Writes the table of `to_pandas` as a parquet file."""
        write_parquet(self.to_pandas(), path)

    def to_xarray(self) -> xarray.Dataset:
        """Table of `to_pandas` along the parameter. At a fold, values of the parameter come twice."""
        needed("xarray", "a Dataset")
        frame = self.to_pandas()
        data: xarray.Dataset = frame.set_index(self.parameter).to_xarray()
        return data.assign_attrs(frame.attrs)

    def _repr_html_(self) -> str:
        """Both ends with their pictures, and the special points, for notebooks."""
        rows = {f"{number + 1}: {kind}": value for number, (kind, value) in enumerate(self.special)}
        both = [(self.values[k], self.states[k]) for k in (0, -1) if self.states]
        ends = "".join(f"<td>{self.parameter} = {value:.5g}{_html.of_steady(state)}</td>" for value, state in both)
        return f"<div><table><tr>{ends}</tr></table>{_html.table(rows)}<p>{html.escape(self.end)}</p></div>"


def branch(
    start: _motile.Setup | _motile.SteadyState,
    parameter: str,
    stop: float,
    *,
    largest_step: float = 0.05,
    most_points: int = 400,
    callback: Callable[[float], object] | None = None,
    progress: bool = False,
) -> Branch:
    """Branch from a steady state, or from that of a setup, to a value of a parameter, around folds.

    Parameters have the names of `SteadyState.sensitivities`: activity, diffusion, width, ... A wrong name raises an
    error that lists them. `callback` is called with each value, in the middle of the search for the next; what it raises
    ends the search. With `progress`, there is a bar in the terminal or notebook.
    """
    state = _motile.steady(start) if isinstance(start, _motile.Setup) else start
    bar: Bar | None = None

    def look(value: float) -> None:
        nonlocal bar
        if progress:
            bar = bar or Bar(value, stop, parameter)
            bar(value)
        if callback:
            callback(value)

    found = _motile.branch(state, parameter, stop, largest_step, most_points, look)
    if bar:
        bar.close(found["values"][-1])
    return Branch(parameter=parameter, **found)
