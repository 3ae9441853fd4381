"""Branches of steady states."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _motile


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


def branch(
    start: _motile.Setup | _motile.SteadyState,
    parameter: str,
    stop: float,
    *,
    largest_step: float = 0.05,
    most_points: int = 400,
    callback: Callable[[float], object] | None = None,
) -> Branch:
    """Branch from a steady state, or from that of a setup, to a value of a parameter, around folds.

    Parameters are those of `motile_steady_states::Parameter`: activity, viscosity_ratio, width, ... A wrong name ends in an error
    that lists them. `callback` is called with each value, in the middle of the search for the next; what it raises
    ends the search.
    """
    state = _motile.steady(start) if isinstance(start, _motile.Setup) else start
    found = _motile.branch(state, parameter, stop, largest_step, most_points, callback)
    return Branch(parameter=parameter, **found)
