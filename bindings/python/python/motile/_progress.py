"""Progress in terminals and notebooks."""

from __future__ import annotations

import sys
import time as clock
from typing import Any

from ._optional import needed

# Seconds between two changes of the line.
_BETWEEN = 0.1
_WIDTH = 30


class Bar:
    """Progress bar on standard error, in a notebook a line of output that is replaced."""

    def __init__(self, start: float, until: float, name: str = "t") -> None:
        """Goes from `start` to `until`, which are values of the quantity with that name."""
        self._start, self._until, self._name = start, until, name
        self._began, self._shown = clock.monotonic(), 0.0
        self._handle: Any = None
        if "ipykernel" in sys.modules:
            # IPython's functions have no types, and need not be installed.
            display: Any = needed("IPython.display", "progress in a notebook").display
            self._handle = display({"text/plain": self._text(start)}, raw=True, display_id=True)

    def _text(self, value: float) -> str:
        span = self._until - self._start
        part = min(max((value - self._start) / span, 0.0), 1.0) if span else 1.0
        seconds = clock.monotonic() - self._began
        left = f"{seconds * (1 - part) / part:.0f} s left" if part > 0 else ""
        return f"{'█' * round(_WIDTH * part):<{_WIDTH}} {self._name} = {value:.4g} of {self._until:g}, {left}"

    def __call__(self, value: float) -> None:
        """Shows a value."""
        if clock.monotonic() - self._shown >= _BETWEEN:
            self._show(value)

    def _show(self, value: float) -> None:
        self._shown = clock.monotonic()
        self._write(self._text(value))

    def _write(self, text: str) -> None:
        if self._handle is not None:
            self._handle.update({"text/plain": text}, raw=True)
        else:
            print(f"\r{text}\x1b[K", end="", file=sys.stderr, flush=True)

    def close(self, value: float) -> None:
        """Shows the last value and ends the line."""
        self._show(value)
        if self._handle is None:
            print(file=sys.stderr)


class Search(Bar):
    """Progress of a search whose length nobody knows: how often it evaluated, and the lowest chi2 that it found."""

    def __init__(self) -> None:
        self._count, self._lowest = 0, float("inf")
        super().__init__(0.0, 0.0)

    def _text(self, value: float) -> str:
        return f"{self._count} evaluations, lowest chi2 = {self._lowest:.4g}" if self._count else "search begins"

    def __call__(self, value: float) -> None:
        """Counts an evaluation with this chi2."""
        self._count, self._lowest = self._count + 1, min(self._lowest, value)
        super().__call__(value)
