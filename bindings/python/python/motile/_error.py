"""The exception of the package."""

from __future__ import annotations


class Error(Exception):
    """A setup that makes no scene, a run that went wrong, a file that cannot be read or written.

    The message names the value and the remedy. `key`, `value` and `remedy` have them by themselves where they are
    known, as text, and are None elsewhere.
    """

    def __init__(
        self, message: str, *, key: str | None = None, value: str | None = None, remedy: str | None = None
    ) -> None:
        super().__init__(message)
        self.key = key
        self.value = value
        self.remedy = remedy

    def __reduce__(self) -> tuple[object, ...]:
        return (_error, (str(self), self.key, self.value, self.remedy))


def _error(message: str, key: str | None, value: str | None, remedy: str | None) -> Error:
    return Error(message, key=key, value=value, remedy=remedy)
