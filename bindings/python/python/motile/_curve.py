"""Closed curves of steady states as trigonometric polynomials."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._error import Error

Array = npt.NDArray[np.float64]
_Complex = npt.NDArray[np.complex128]

_FINE = 8
_MOST_ITERATIONS = 30
_ROUND_OFF = 1e-13


class Curve:
    """Outline of a droplet with its concentration, known between the nodes."""

    def __init__(self, positions: Array, concentration: Array) -> None:
        """Analyses positions of nodes (length, shape (n, 2), counter-clockwise) and concentrations there."""
        count = len(positions)
        waves: Array = np.fft.fftfreq(count, 1.0 / count).astype(np.float64)
        self._waves = waves
        self._place: _Complex = np.fft.fft(positions[:, 0] + 1j * positions[:, 1]) / count
        given = concentration if len(concentration) == count else np.zeros(count)
        self._concentration: _Complex = np.fft.fft(given) / count
        if count % 2 == 0:
            # The highest wave has no sign.
            half = count // 2
            self._waves = np.append(waves, half)
            for name in ("_place", "_concentration"):
                series: _Complex = getattr(self, name)
                series = np.append(series, 0.5 * series[half])
                series[half] *= 0.5
                setattr(self, name, series)
        self._rate: _Complex = 1j * self._waves * self._place
        self._parameters: Array = np.linspace(0.0, 2 * np.pi, _FINE * count, endpoint=False)
        place, rate = self._at(self._parameters)
        area = 0.5 * np.mean((place.conj() * rate).imag)
        x, y = place.real, place.imag
        self.centroid = complex(0.5 * np.mean(x * x * rate.imag), -0.5 * np.mean(y * y * rate.real)) / area
        """Centroid of the area inside (length), x + iy."""
        self._place_fine: _Complex = place

    def _at(self, parameters: Array) -> tuple[_Complex, _Complex]:
        waves = np.exp(1j * np.multiply.outer(parameters, self._waves))
        return waves @ self._place, waves @ self._rate

    def _crossings(self, angles: Array) -> Array:
        """Parameters of the curve in directions from its centroid (radians)."""
        seen: Array = np.unwrap(np.angle(self._place_fine - self.centroid))
        if np.any(np.diff(seen) <= 0) or seen[0] + 2 * np.pi <= seen[-1]:
            remedy = "Compare the aspect ratio or the perimeter instead of the outline"
            raise Error(f"the outline crosses a ray from its centroid more than once. {remedy}", remedy=remedy)
        wanted = seen[0] + np.mod(angles - seen[0], 2 * np.pi)
        known = np.append(seen, seen[0] + 2 * np.pi)
        parameters: Array = np.interp(wanted, known, np.append(self._parameters, 2 * np.pi))
        turn = np.exp(-1j * angles)
        for _ in range(_MOST_ITERATIONS):
            place, rate = self._at(parameters)
            step = ((place - self.centroid) * turn).imag / (rate * turn).imag
            parameters = parameters - step
            if np.max(np.abs(step), initial=0.0) < _ROUND_OFF * 2 * np.pi:
                break
        return parameters

    def radii(self, angles: Array) -> Array:
        """Distances from the centroid (length) in directions against the x axis (radians)."""
        place, _ = self._at(self._crossings(angles))
        radii: Array = np.abs(place - self.centroid)
        return radii

    def concentrations(self, angles: Array) -> Array:
        """Concentrations (particles per length) in directions from the centroid (radians)."""
        waves = np.exp(1j * np.multiply.outer(self._crossings(angles), self._waves))
        values: Array = (waves @ self._concentration).real
        return values

    def modes(self, count: int) -> Array:
        """Amplitudes of cos(m angle), m = 0 to `count`, of the distance from the centroid over its mean."""
        many = max(128, 8 * count)
        radii = self.radii(np.linspace(0.0, 2 * np.pi, many, endpoint=False))
        series: Any = np.fft.rfft(radii).real / many
        modes: Array = 2.0 * series[: count + 1] / series[0]
        return modes
