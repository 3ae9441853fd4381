"""Points of outlines in files."""

from pathlib import Path

import motile
import numpy as np
import pytest


def test_points_are_scaled_turned_and_run_around(tmp_path: Path) -> None:
    table = tmp_path / "cell.csv"
    table.write_text("x (\u00b5m);y (\u00b5m)\n0;0\n0;1,5\n2;1,5\n2;0\n0;0\n", encoding="utf-8")
    points = motile.read_outline(table, scale=2.0)
    # Clockwise in the file, with the first point twice.
    assert points.tolist() == [[0, 0], [4, 0], [4, 3], [0, 3]]
    assert motile.read_outline(str(table), flip=True).tolist() == [[0, 0], [0, -1.5], [2, -1.5], [2, 0]]
    drawing = tmp_path / "two.svg"
    drawing.write_text('<svg><path id="a" d="M0 0h2v1h-2z"/><path id="b" d="M0 0h4v3z"/></svg>')
    named, counted = motile.read_outline(drawing, name="b"), motile.read_outline(drawing, index=1)
    assert np.array_equal(named, counted) and named[:, 1].min() == -3


def test_a_traced_outline_is_smooth(tmp_path: Path) -> None:
    angle = np.linspace(0, 2 * np.pi, 400)
    steps = np.round(np.column_stack([60 + 40 * np.cos(angle), 60 + 40 * np.sin(angle)]))
    np.savetxt(tmp_path / "traced.txt", steps, header="x y")
    points = motile.read_outline(tmp_path / "traced.txt", scale=0.05, smooth=0.05)
    radii = np.hypot(*(points - points.mean(axis=0)).T)
    assert abs(radii.mean() - 2) < 0.01 and np.ptp(radii) < 0.08


def test_errors_help(tmp_path: Path) -> None:
    array = tmp_path / "cell.npy"
    np.save(array, np.zeros((4, 2)))
    with pytest.raises(motile.Error, match="an array of NumPy. Save it as text: numpy.savetxt"):
        motile.read_outline(array)
    with pytest.raises(motile.Error, match="there is no such file"):
        motile.read_outline(tmp_path / "none.csv")
    with pytest.raises(motile.Error, match="this is not a file"):
        motile.read_outline(tmp_path)
    (tmp_path / "cell.csv").write_text("0 0\n1 0\n0 1\n")
    with pytest.raises(motile.Error, match="scale"):
        motile.read_outline(tmp_path / "cell.csv", scale=-1)
    with pytest.raises(motile.Error, match="by its name or by its index"):
        motile.read_outline(tmp_path / "cell.csv", name="a", index=0)
