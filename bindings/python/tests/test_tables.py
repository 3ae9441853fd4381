"""Tables as pandas, xarray and parquet, progress and views for notebooks."""

import builtins
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import motile
import numpy as np
import pandas as pd
import pytest

SMALL = motile.integral(nodes=32, elements=128)
ACTIVITY = "droplets.0.particles.activity"


def setup(**more: Any) -> motile.Setup:
    return motile.Setup(region="plane", method=SMALL, droplets=[motile.droplet(-0.7)], **more)


def test_a_track_as_parquet(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    track = setup().build().run(1, every=0.25)
    track.to_parquet(tmp_path / "track.parquet")
    again = pd.read_parquet(tmp_path / "track.parquet")
    assert again.equals(track.to_pandas()) and again.index.name == "time"
    assert again.attrs == track.origin == {"motile": motile._motile.VERSION, "fingerprint": setup().fingerprint}
    assert track.to_xarray().attrs == track.origin
    two = motile.Setup(region="plane", method=SMALL, droplets=[motile.droplet(-1), motile.droplet(-1, centre=(4, 0))])
    both = two.build().run(0.5, every=0.25)
    both.to_parquet(tmp_path / "both.parquet")
    assert pd.read_parquet(tmp_path / "both.parquet").index.names == ["time", "droplet"]


def test_sweeps_samples_and_branches_are_tables(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("pyarrow")
    places = {ACTIVITY: [-0.7, -1.0], "viscosity": [90.0, 100.0, 110.0]}
    sweep = motile.sweep(setup(), places, until=0.5, every=0.25, progress=True)
    assert "run = 6 of 6" in capsys.readouterr().err
    sweep.to_parquet(tmp_path / "sweep.parquet")
    table = pd.read_parquet(tmp_path / "sweep.parquet")
    data = sweep.to_xarray()
    assert data["speed"].dims == (ACTIVITY, "viscosity") and data["speed"].shape == (2, 3)
    for _, row in table.iterrows():
        assert float(data["speed"].sel({ACTIVITY: row[ACTIVITY], "viscosity": row["viscosity"]})) == row["speed"]
    assert sweep._repr_html_().count("<tr>") == 7
    branch = motile.branch(motile.steady(setup()), "activity", -0.9, largest_step=0.2, progress=True)
    assert "activity = -0.9 of -0.9" in capsys.readouterr().err
    branch.to_parquet(tmp_path / "branch.parquet")
    points = pd.read_parquet(tmp_path / "branch.parquet")
    assert np.array_equal(points["speed"], branch.speeds) and points.columns[0] == "activity"
    assert branch._repr_html_().count("<svg") == 2
    samples = motile.Samples(("a", "b"), np.array([[1.0, 2.0], [3.0, 4.0]]), 0.5)
    samples.to_parquet(tmp_path / "samples.parquet")
    assert pd.read_parquet(tmp_path / "samples.parquet")["b"].tolist() == [2.0, 4.0]


@pytest.mark.parametrize(
    ("package", "use"),
    [
        ("pandas", lambda track, path: track.to_pandas()),
        ("xarray", lambda track, path: track.to_xarray()),
        ("pyarrow", lambda track, path: track.to_parquet(path)),
    ],
)
def test_a_missing_package_is_named(
    package: str, use: Callable[[motile.Track, Path], object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    track = setup().build().run(0.5, every=0.25)
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(motile.Error, match=f"needs the package {package}, which is not installed") as raised:
        use(track, tmp_path / "track.parquet")
    assert raised.value.remedy == f"Install it: pip install {package}" and not list(tmp_path.iterdir())


def test_nothing_but_numpy_is_imported() -> None:
    # In a new process, so that other tests have imported nothing.
    code = "import sys, motile; print([n for n in ('pandas', 'xarray', 'pyarrow', 'IPython') if n in sys.modules])"
    run = __import__("subprocess").run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert run.stdout.strip() == "[]"


def test_views_have_a_picture_and_numbers() -> None:
    state = motile.steady(setup())
    shown = state._repr_html_()
    # A line for each node, the arrow and its head.
    assert shown.count("<line") == 32 + 1 and shown.count("<polygon") == 1 and f"{state.speed:.5g}" in shown
    before = setup()._repr_html_()
    assert "<svg" in before and "activity = -0.7" in before and "<polygon" in before
    scene = setup().build()
    track = scene.run(0.5, every=0.25)
    assert "<svg" in scene._repr_html_() and f"{track['speed'][-1]:.5g}" in track._repr_html_()
    empty = motile.Track(["time"], np.empty((0, 0, 1)))
    assert "0 records" in empty._repr_html_()
    still = motile.steady(setup().replace({ACTIVITY: -0.1}))
    assert "<polygon" not in still._repr_html_()


def test_progress_in_a_notebook_replaces_one_output(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []

    class Handle:
        def update(self, data: dict[str, str], raw: bool) -> None:
            assert raw
            shown.append(data["text/plain"])

    def display(data: dict[str, str], raw: bool, display_id: bool) -> Handle:
        assert raw and display_id
        shown.append(data["text/plain"])
        return Handle()

    fake = type(builtins)("IPython.display")
    setattr(fake, "display", display)
    monkeypatch.setitem(sys.modules, "ipykernel", type(builtins)("ipykernel"))
    monkeypatch.setitem(sys.modules, "IPython.display", fake)
    setup().build().run(0.5, every=0.25, progress=True)
    assert shown[0].strip().startswith("t = 0 of 0.5") and "t = 0.5 of 0.5, 0 s left" in shown[-1]
