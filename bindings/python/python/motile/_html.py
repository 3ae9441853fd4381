"""Views of objects for notebooks: a picture and its numbers."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._curve import Array

if TYPE_CHECKING:
    from ._motile import Setup, SteadyState

_SIZE = 220
# Colours from few to many particles.
_COLOURS = np.array([[68, 1, 84], [49, 104, 142], [53, 183, 121], [253, 231, 37]], dtype=float)


def table(rows: Mapping[str, Any], head: Sequence[str] = ()) -> str:
    """Table with a name and a value, or several values, on each line."""
    top = "<tr>" + "".join(f"<th>{html.escape(name)}</th>" for name in head) + "</tr>" if head else ""
    lines = []
    for name, entry in rows.items():
        values = entry if isinstance(entry, tuple) else (entry,)
        shown = (f"{value:.5g}" if isinstance(value, float) else str(value) for value in values)
        cells = "".join(f"<td>{html.escape(text)}</td>" for text in shown)
        lines.append(f"<tr><th>{html.escape(name)}</th>{cells}</tr>")
    return f"<table>{top}{''.join(lines)}</table>"


def drawing(curves: Sequence[tuple[Array, Array | None]], arrow: tuple[float, float] | None = None) -> str:
    """Picture (SVG) of closed curves, each coloured by the values at its points if there are any, and an arrow from the
    middle of the first one."""
    known = [(points, values) for points, values in curves if len(points) > 1]
    if not known:
        return ""
    every = np.concatenate([points for points, _ in known])
    low, high = every.min(axis=0), every.max(axis=0)
    extent = float(max(*(high - low), 1e-300))
    scale = _SIZE / (1.1 * extent)
    width, height = ((high - low) * scale + 0.1 * extent * scale).tolist()

    def place(points: Array) -> Array:
        moved: Array = (points - low + 0.05 * extent) * scale
        moved[:, 1] = height - moved[:, 1]
        return moved

    parts = []
    for points, values in known:
        at = place(points)
        if values is None or len(values) != len(at):
            text = " ".join(f"{x:.1f},{y:.1f}" for x, y in at)
            parts.append(f'<polygon points="{text}" fill="none" stroke="currentColor"/>')
            continue
        span = float(np.ptp(values)) or 1.0
        shade = (values - values.min()) / span * (len(_COLOURS) - 1)
        parts += [
            f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{_colour(s)}"'
            ' stroke-width="4" stroke-linecap="round"/>'
            for a, b, s in zip(at, np.roll(at, -1, axis=0), shade)
        ]
    if arrow is not None and np.hypot(*arrow) > 0:
        middle = place(np.mean(known[0][0], axis=0)[None, :])[0]
        along = np.array([arrow[0], -arrow[1]]) / np.hypot(*arrow)
        tip, across = middle + 0.2 * _SIZE * along, np.array([-along[1], along[0]])
        corners = (tip, tip - 9 * along + 4 * across, tip - 9 * along - 4 * across)
        head = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
        parts.append(
            f'<line x1="{middle[0]:.1f}" y1="{middle[1]:.1f}" x2="{tip[0]:.1f}" y2="{tip[1]:.1f}"'
            f' stroke="currentColor" stroke-width="2"/><polygon points="{head}" fill="currentColor"/>'
        )
    view = f'width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.1f} {height:.1f}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {view}>{"".join(parts)}</svg>'


def _colour(shade: float) -> str:
    below = min(int(shade), len(_COLOURS) - 2)
    red, green, blue = _COLOURS[below] + (shade - below) * (_COLOURS[below + 1] - _COLOURS[below])
    return f"#{round(red):02x}{round(green):02x}{round(blue):02x}"


def of_steady(state: SteadyState) -> str:
    """Shape of a steady state with its particles and the direction of its motion, and what is measured of it."""
    velocity = state.velocity
    at_rest = state.speed < 1e-9
    picture = drawing([(state.positions, state.concentration)], None if at_rest else velocity)
    return f"<div>{picture}{table(state.measured)}</div>"


def of_setup(setup: Setup) -> str:
    """Bodies of a setup where they start, and its entries."""
    bodies = [(points, None) for _, points in setup.build().bodies]
    entries = f"<details><summary>scene file</summary><pre>{html.escape(setup.to_toml())}</pre></details>"
    return f"<div>{drawing(bodies)}{entries}</div>"
