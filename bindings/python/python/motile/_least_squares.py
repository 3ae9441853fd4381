"""Least squares within bounds, by the method of Levenberg and Marquardt."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._curve import Array

_MOST_ITERATIONS = 60
_MOST_DAMPING = 1e12
_FIRST_DAMPING = 1e-4
# Decrease of the sum of squares that linear residuals may promise at a minimum: a tenth of an error, or round-off.
_PROMISED, _ROUND_OFF = 1e-2, 1e-8


@dataclass(frozen=True)
class Minimum:
    """Result of a minimisation."""

    values: Array
    residuals: Array
    iterations: int
    converged: bool


def least_squares(
    residuals: Callable[[Array], Array | None],
    jacobian: Callable[[Array], Array],
    start: Array,
    lower: Array,
    upper: Array,
    scale: Array,
) -> Minimum:
    """Values between bounds at which the sum of squares of the residuals is least; None marks values without residuals.

    Each step solves `(J^T J + damping * diagonal) step = -J^T r` among the values that no bound holds (Marquardt 1963),
    and is cut off at the bounds. `scale` is a usual change of each value. The result has converged if no step of linear
    residuals from it promises a decrease that matters.
    """
    values = np.clip(start, lower, upper)
    found = residuals(values)
    if found is None:
        raise ValueError("there are no residuals at the start")
    best, damping = found, _FIRST_DAMPING
    for iteration in range(1, _MOST_ITERATIONS + 1):
        slopes = jacobian(values)
        gradient = slopes.T @ best
        free = ~((values <= lower) & (gradient >= 0) | (values >= upper) & (gradient <= 0)) & (lower < upper)
        if not np.any(free):
            return Minimum(values, best, iteration, True)
        blocked = False
        while True:
            moved, expected = _promise(values, slopes, best, free, damping, lower, upper, scale)
            step = moved - values
            # The rest is round-off.
            last = bool(np.max(np.abs(step) / scale) < 1e-10) or 0 <= expected < 1e-10 * (1.0 + best @ best)
            tried = residuals(moved)
            blocked = blocked or tried is None
            gain = -np.inf if tried is None else float(best @ best - tried @ tried)
            if tried is not None and gain > 0:
                values, best = moved, tried
                damping = max(
                    damping * (0.1 if gain > 0.7 * expected else 0.5 if gain > 0.3 * expected else 2.0), 1e-12
                )
                break
            if last:
                break
            damping = max(10.0 * damping, 1e-4)
            if damping > _MOST_DAMPING:
                return Minimum(values, best, iteration, False)
        if last:
            # A large damping makes any step small: a minimum promises little without it, too.
            _, promised = _promise(values, slopes, best, free, _FIRST_DAMPING, lower, upper, scale)
            little = promised <= _PROMISED + _ROUND_OFF * float(best @ best)
            return Minimum(values, best, iteration, little and not blocked)
    return Minimum(values, best, _MOST_ITERATIONS, False)


def _promise(
    values: Array,
    slopes: Array,
    residuals: Array,
    free: npt.NDArray[np.bool_],
    damping: float,
    lower: Array,
    upper: Array,
    scale: Array,
) -> tuple[Array, float]:
    """Values after a damped step, and how much the sum of squares decreases if the residuals are linear."""
    reduced, gradient = slopes[:, free] * scale[free], slopes.T @ residuals
    normal = reduced.T @ reduced
    diagonal = np.maximum(np.diag(normal), 1e-12 * np.max(np.diag(normal)) + 1e-300)
    matrix = normal + damping * np.diag(diagonal)
    step = np.zeros(len(values))
    step[free] = scale[free] * np.linalg.lstsq(matrix, -scale[free] * gradient[free], rcond=None)[0]
    moved = np.clip(values + step, lower, upper)
    step = moved - values
    return moved, -float(2.0 * gradient @ step + np.sum((slopes @ step) ** 2))
