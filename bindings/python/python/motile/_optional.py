"""Packages that motile uses only when you ask for what they do."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ._error import Error

if TYPE_CHECKING:
    import os

    import pandas


def needed(package: str, what: str) -> Any:
    """Module of a package, or an error that says what needs it and how to install it."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        remedy = f"Install it: pip install {package}"
        message = f"{what} needs the package {package}, which is not installed. {remedy}"
        raise Error(message, key=package, remedy=remedy) from error


def write_parquet(frame: pandas.DataFrame, path: str | os.PathLike[str]) -> None:
    """Writes a table as a parquet file, with its index as columns."""
    needed("pyarrow", "a parquet file")
    frame.to_parquet(path, engine="pyarrow")
