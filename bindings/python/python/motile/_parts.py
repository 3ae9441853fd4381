"""Parts of setups: short ways to write their dictionaries."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Part = dict[str, Any]


def box(length: float, width: float | None = None, height: float | None = None) -> Part:
    """Periodic box of length x width (length), a square one if only one side is given, centred on the origin.

    With a height (length), the box is in three dimensions.
    """
    sides = [length, length if width is None else width]
    return {"box": {"lengths": sides if height is None else [*sides, height]}}


def channel(length: float, width: float, **more: Any) -> Part:
    """Channel of period `length` along x between rigid walls that are `width` apart (length).

    Its drive is a keyword: `drive="zero-gradient"` (the default), `"zero-flux"`, `{"gradient": g}` (stress per length)
    or `{"flux": q}` (area per time).
    """
    return {"channel": {"length": length, "width": width, "drive": "zero-gradient", **more}}


def plane() -> str:
    """Unbounded fluid."""
    return "plane"


def space() -> str:
    """Unbounded fluid in three dimensions. Droplets with a `position` or `heading`, or off the x axis, need no symmetry."""
    return "space"


def tube(radius: float, **more: Any) -> Part:
    """Tube of that radius (length) around the x axis, in three dimensions; keywords as in scene files."""
    return {"tube": {"radius": radius, **more}}


def slit(lower: float, upper: float) -> Part:
    """Two plane walls at the heights z = `lower` and z = `upper` (length) in three dimensions."""
    return {"slit": {"lower": lower, "upper": upper}}


def integral(**more: Any) -> Part:
    """Boundary integrals: `nodes` of the shape and `elements` of the interface (concentration) of each droplet."""
    return {"integral": more}


def harmonics(degree: int = 16) -> Part:
    """Spherical harmonics of a degree, for droplets in three dimensions without symmetry."""
    return {"harmonics": {"degree": degree}}


def layers(**more: Any) -> Part:
    """Interfaces as layers beside solids on a grid: `nodes`, `elements`, `spacing` of the grid (length), `kernel`."""
    return {"layers": more}


def grid(**more: Any) -> Part:
    """Immersed boundary method: `spacing` (grid) and `marker_spacing` (length), `kernel`, `corrected`, `solver`."""
    return {"grid": more}


def droplet(activity: float | None = -2.0, *, particles: Mapping[str, Any] | None = None, **more: Any) -> Part:
    """Droplet of an activity (force times length; in three dimensions force times length squared), negative for
    particles that contract; passive if None.

    `particles` has further entries of the particles (`concentration`, `diffusion`, `start`, ...), all other keywords
    are entries of the droplet (`centre`, `angle`, `viscosity`, `tension`, `shape`, ...).
    """
    if activity is None:
        if particles:
            raise TypeError("a passive droplet has no particles. Use an activity, or leave particles out")
        return {**more, "particles": "none"}
    return {**more, "particles": {"activity": activity, **(particles or {})}}
