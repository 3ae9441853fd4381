"""Setups: ways in and out, errors with their keys."""

import copy
import pickle
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import motile
import numpy as np
import pytest


def channel() -> motile.Setup:
    return motile.Setup(
        region=motile.channel(12, 5, drive="zero-flux"),
        method=motile.integral(nodes=32, elements=128),
        droplets=[
            motile.droplet(-3, centre=(0, 0.5), particles={"concentration": 90}),
            motile.droplet(None, centre=[5, 0]),
        ],
        repulsion={"strength": 5000, "range": 0.05},
    )


def test_ways_in_and_out_are_one() -> None:
    setup = channel()
    for other in [
        motile.Setup.from_dict(setup.to_dict()),
        motile.Setup.from_toml(setup.to_toml()),
        motile.Setup(**setup.to_dict()),
        pickle.loads(pickle.dumps(setup)),
        copy.deepcopy(setup),
        eval(repr(setup)),
    ]:
        assert other == setup and hash(other) == hash(setup)
        assert other.to_toml() == setup.to_toml()
    assert setup != setup.replace(viscosity=99)
    assert setup.repulsion == {"strength": 5000, "range": 0.05}
    assert setup.droplets[1]["particles"] == "none"
    assert "viscosity" in dir(setup) and "to_toml" in dir(setup)
    assert motile.Setup().repulsion is None
    with pytest.raises(AttributeError):
        setup.viscosty


def test_replace() -> None:
    setup = channel()
    places = {"droplets.0.particles.activity": -4, "droplets.0.centre.1": 0.25}
    other = setup.replace(places, viscosity=50, repulsion=None)
    assert (other.viscosity, other.repulsion) == (50, None)
    assert other.droplets[0]["particles"]["activity"] == -4
    assert other.droplets[0]["particles"]["concentration"] == 90
    assert other.droplets[0]["centre"] == [0, 0.25]
    assert setup == channel()


def test_outlines_of_files_and_arrays(tmp_path: Path) -> None:
    angle = np.linspace(0, 2 * np.pi, 80, endpoint=False)
    pixels = np.column_stack([50 + 30 * np.cos(angle), 40 - 20 * np.sin(angle)])
    np.savetxt(tmp_path / "cell.csv", pixels, delimiter=",", header="x,y", comments="")
    shape: dict[str, Any] = {"outline": {"file": tmp_path / "cell.csv", "scale": 0.05}}
    of_file = motile.Setup(droplets=[motile.droplet(None, shape=shape)])
    shape = {"outline": {"points": pixels, "scale": 0.05}}
    of_array = motile.Setup(droplets=[motile.droplet(None, shape=shape)])
    assert of_file == of_array and "file" not in of_file.droplets[0]["shape"]["outline"]
    (report,) = of_file.outlines()
    assert report["key"] == "droplets[0].shape.outline"
    assert (report["points"], report["was_clockwise"]) == (80, True)
    assert report["area"] == pytest.approx(np.pi * 1.5, rel=1e-5)
    assert report["polygon_area"] == pytest.approx(40 * np.sin(np.pi / 40) * 1.5, rel=1e-9)
    assert of_file.build().droplets[0].observe()["area"] == pytest.approx(report["area"], rel=1e-3)
    scene = tmp_path / "scene.toml"
    scene.write_text('[[droplets]]\nparticles = "none"\nshape.outline = { file = "cell.csv", scale = 0.05 }\n')
    assert motile.Setup.from_file(scene) == of_file
    with pytest.raises(motile.Error, match="none.csv cannot be read: there is no such file"):
        motile.Setup(droplets=[motile.droplet(None, shape={"outline": {"file": "none.csv"}})])
    (tmp_path / "block.msh").write_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
        "$Elements\n2\n1 2 2 7 1 1 2 3\n2 2 2 0 1 1 3 4\n$EndElements\n"
    )
    solid = {
        "outline": {"mesh": {"file": tmp_path / "block.msh", "place": (1.8, -0.5)}},
        "material": {"neo_hookean": {"shear": 10, "bulk": 20}},
        "hold": "free",
    }
    method = {"grid": {"spacing": 0.1, "corrected": False}}
    setup = motile.Setup(method=method, solids=[solid])
    assert setup.solids[0]["outline"]["mesh"]["triangles"] == [[0, 1, 2], [0, 2, 3]]
    assert setup.solids[0]["outline"]["mesh"]["groups"] == [{"name": "7", "members": [0]}]
    assert [name for name, _ in setup.build().bodies] == ["droplet", "solid"]


def test_arrays_are_lists() -> None:
    points = np.array([[np.cos(t), np.sin(t)] for t in np.linspace(0, 2 * np.pi, 32, endpoint=False)])
    strided = np.repeat(points, 2, axis=0)[::2]
    one, other = (motile.Setup(droplets=[motile.droplet(shape={"points": p})]) for p in (points, strided))
    assert one == other
    assert motile.Setup(viscosity=np.float32(50)).viscosity == 50
    assert motile.Setup(method=motile.integral(nodes=np.int64(32), elements=128)).method["integral"]["nodes"] == 32


OUTLINE = "droplets[0].shape.outline.points[1]"


@pytest.mark.parametrize(
    ("entries", "key"),
    [
        ({"viscosty": 1}, "viscosty"),
        ({"viscosity": -1}, "viscosity"),
        ({"viscosity": float("nan")}, "viscosity"),
        ({"viscosity": "a"}, "viscosity"),
        ({"viscosity": object()}, "viscosity"),
        ({"viscosity": 1j}, "viscosity"),
        ({"region": {"box": {"length": [1, 2]}}}, "region.box.length"),
        ({"region": "sphere"}, "region"),
        ({"droplets": [{"centr": [0, 0]}]}, "droplets[0].centr"),
        ({"droplets": [{}, {"centre": [0, None]}]}, "droplets[1].centre[1]"),
        ({"droplets": [{"particles": {"activty": 1}}]}, "droplets[0].particles.activty"),
        ({"droplets": [{"centre": np.array(["a", "b"])}]}, "droplets[0].centre[0]"),
        ({"droplets": [{"centre": np.zeros((2, 2))}]}, "droplets[0].centre[0]"),
        ({"droplets": [{"tension": -1}]}, "droplets[0].tension"),
        ({"droplets": [{}, {"centre": [0, 0, 1]}]}, "droplets[1].centre"),
        ({"region": {"channel": {"length": 6, "width": 3, "slip": [0, 1, 2]}}}, "region.channel.slip"),
        ({"droplets": [{"shape": {"outline": {"points": [[0, 0], [1, 0, 5], [0, 1]]}}}]}, OUTLINE),
        ({"least_gap": 10**30}, "least_gap"),
        ({"region": "box"}, "region.box"),
        ({"region": {"box": {"lengths": [6, 6]}, "tube": {"radius": 1}}}, "region"),
        ({1: 2}, ""),
    ],
)
def test_wrong_entries_name_their_key(entries: dict[str, object], key: str) -> None:
    with pytest.raises(motile.Error) as raised:
        motile.Setup.from_dict(entries)
    assert raised.value.key == key, str(raised.value)
    assert "\n" not in str(raised.value)
    again = pickle.loads(pickle.dumps(raised.value))
    assert (str(again), again.key, again.remedy) == (str(raised.value), key, raised.value.remedy)


@pytest.mark.parametrize(
    ("entries", "key", "new"),
    [
        ({"method": motile.integral(nodes=32, cells=128)}, "method.integral.cells", "method.integral.elements"),
        ({"method": motile.layers(cells=128)}, "method.layers.cells", "method.layers.elements"),
        ({"solids": [{}, {"skin": {"stretching": 1}}]}, "solids[1].skin", "solids.surface_elasticity"),
        ({"method": motile.grid(spacing=0.1, contrast="sharp")}, "method.grid.contrast", "method.integral"),
    ],
)
def test_keys_of_earlier_versions_name_the_new_ones(entries: dict[str, Any], key: str, new: str) -> None:
    for wrong in (lambda: motile.Setup(**entries), lambda: motile.Setup.from_dict(entries)):
        with pytest.raises(motile.Error) as raised:
            wrong()
        assert raised.value.key == key, str(raised.value)
        assert new in str(raised.value.remedy) and str(raised.value.remedy) in str(raised.value)


def test_replacing_a_key_of_an_earlier_version_names_the_new_one() -> None:
    with pytest.raises(motile.Error, match=r"method\.integral\.cells = 128: .* method\.integral\.elements"):
        motile.Setup().replace({"method.integral.cells": 128})


def _whole() -> dict[str, Any]:
    """All entries of the file that shows every key."""
    text = (Path(__file__).parents[3] / "crates" / "motile" / "scene.toml").read_text()
    whole: dict[str, Any] = motile.Setup.from_toml(text).to_dict()
    return whole


def _parts(value: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    """Places and values of everything in a dictionary, at every depth."""
    yield place, value
    if isinstance(value, dict):
        for key, entry in value.items():
            yield from _parts(entry, f"{place}.{key}" if place else key)
    if isinstance(value, list):
        for number, entry in enumerate(value):
            yield from _parts(entry, f"{place}[{number}]")


def _changed(place: str, value: Any) -> dict[str, Any]:
    whole: Any = _whole()
    *above, last = [int(k) if k.isdigit() else k for k in re.findall(r"[^.\[\]]+", place)]
    at = whole
    for key in above:
        at = at[key]
    at[last] = value
    changed: dict[str, Any] = whole
    return changed


def test_wrong_keys_at_every_depth() -> None:
    places = [place for place, value in _parts(_whole()) if isinstance(value, dict)]
    assert len(places) > 50
    for place in places:
        wrong = f"{place}.wrong_key" if place else "wrong_key"
        with pytest.raises(motile.Error) as raised:
            motile.Setup.from_dict(_changed(wrong, 1))
        # Where one of several kinds has to be given, a second entry is an error of the whole.
        assert raised.value.key == wrong or "use exactly one entry" in str(raised.value), (wrong, str(raised.value))
        assert raised.value.key in (wrong, place)


def test_wrong_values_at_every_depth() -> None:
    leaves = [(place, value) for place, value in _parts(_whole()) if not isinstance(value, (dict, list))]
    assert len(leaves) > 80
    wrong = [object(), 1j, "no such name", np.array(["a", "b"]), np.array([1.0, np.nan]), float("nan"), -float("inf")]
    for place, known in leaves:
        # Names are free.
        for value in [other for other in wrong if not (isinstance(other, str) and place.endswith(".name"))]:
            with pytest.raises(motile.Error) as raised:
                motile.Setup.from_dict(_changed(place, value))
            assert raised.value.key, (place, known, value, str(raised.value))
            parts = re.split(r"\[\d\]$", place)[0]
            assert raised.value.key.startswith(parts), (place, raised.value.key)


def test_walls_of_ones_own_are_arrays() -> None:
    """Sides of a channel and obstacles as arrays of any kind; a channel of that shape is the same to second order."""
    shape = {"sinusoidal": {"width": 3.0, "amplitude": 0.2, "waves": 1, "phase": 0.0}}
    method = motile.integral(nodes=32, elements=128)

    def speed(below: Any, above: Any) -> float:
        walls = [{"outline": outline, "spacing": 0.2} for outline in (below, above)]
        setup = motile.Setup(region=motile.channel(12, 5), method=method, walls=walls, droplets=[motile.droplet(-3)])
        assert pickle.loads(pickle.dumps(setup)) == setup
        return float(setup.build().run(0.5, every=0.5)["speed"][-1])

    def own(count: int) -> float:
        # The shape is its own mirror image in y = 0; its sides are farthest apart in the middle.
        x = np.linspace(-6, 6, count + 1)
        y = 1.5 + shape["sinusoidal"]["amplitude"] * np.cos(np.pi * x / 6)
        # From the other end, with the end of the period, and strided; a transposed array of single precision.
        below = np.repeat(np.column_stack([x, -y]), 2, axis=0)[::-2]
        above = np.array([x[:-1], y[:-1]]).T
        assert not below.flags.c_contiguous and not above.flags.c_contiguous
        return speed({"wall_below_points": below}, {"wall_above_points": above})

    expected = speed({"wall_below": shape}, {"wall_above": shape})
    coarse, fine = (abs(own(count) - expected) / expected for count in (48, 96))
    assert fine < 2e-4 and coarse > 3 * fine, (coarse, fine)

    t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    post = np.column_stack([3 + 0.3 * np.cos(t), 0.3 * np.sin(t)])
    disc = {"disc": {"centre": (3, 0), "radius": 0.3}}
    walls = [[{"outline": outline, "spacing": 0.1}] for outline in ({"polygon": {"corners": post}}, disc)]
    speeds = []
    for wall in walls:
        setup = motile.Setup(region=motile.channel(12, 5), method=method, walls=wall)
        speeds.append(setup.build().run(0.5, every=0.5)["speed"][-1])
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-3)
    for wrong in (np.zeros((8, 3)), post.T, post + np.nan, "circle", post[0]):
        wall = {"outline": {"polygon": {"corners": wrong}}, "spacing": 0.1}
        with pytest.raises(motile.Error, match="walls"):
            motile.Setup(region=motile.channel(12, 5), method=method, walls=[wall]).build()


def test_lists_that_hold_themselves() -> None:
    itself: list[object] = []
    itself.append(itself)
    deep: dict[str, object] = {}
    inner = deep
    for _ in range(10000):
        inner["inner"] = {}
        inner = inner["inner"]  # type: ignore[assignment]
    for wrong in (itself, [deep]):
        with pytest.raises(motile.Error, match="holds itself"):
            motile.Setup(droplets=wrong)
        with pytest.raises(motile.Error, match="holds itself"):
            motile.Setup().replace({"droplets": wrong})


def test_remedies() -> None:
    with pytest.raises(motile.Error) as raised:
        motile.Setup(viscosity=-1)
    assert (raised.value.value, raised.value.remedy) == ("-1", "use a positive finite number")
    two = [motile.droplet(), motile.droplet(centre=(0.5, 0))]
    with pytest.raises(motile.Error, match="overlaps") as raised:
        motile.Setup(droplets=two).build()
    assert raised.value.key == "droplets[1]"
    for places in [{"droplets.3.angle": 1}, {"viscosity.a": 1}, {"droplets.x": 1}]:
        with pytest.raises(motile.Error, match="place|unknown|invalid"):
            motile.Setup().replace(places)
    with pytest.raises(TypeError):
        motile.droplet(None, particles={"concentration": 1})


def test_droplets_that_would_collapse_are_refused() -> None:
    with pytest.raises(motile.Error, match="the particles would collapse to a point") as raised:
        motile.Setup(droplets=[motile.droplet(-12)]).build()
    assert (raised.value.key, raised.value.value) == ("droplets[0].particles.activity", "-12")
    assert raised.value.remedy.endswith("Use an activity weaker than -10, or a larger excluded volume")
    with pytest.raises(motile.Error, match="collapse"):
        motile.Setup().replace({"droplets.0.particles.activity": -12}).build()
    crowd = motile.Setup(droplets=[], suspension=[{"count": 2, "activity": -12}], region=motile.box(12, 12))
    with pytest.raises(motile.Error, match="collapse") as raised:
        crowd.build()
    assert raised.value.key.endswith(".activity")
    # A larger excluded volume or a larger viscosity keeps them apart, at least for long.
    motile.Setup(droplets=[motile.droplet(-12, particles={"excluded_volume": {"step": 30}})]).build()
    motile.Setup(droplets=[motile.droplet(-12)], viscosity=1000).build()


def test_a_setup_does_not_change() -> None:
    base = motile.Setup()
    with pytest.raises(AttributeError, match=r"replace\(viscosity="):
        base.viscosity = 5
    with pytest.raises(AttributeError, match="no key viscosty"):
        base.viscosty = 5
    with pytest.raises(AttributeError, match="replace"):
        del base.viscosity
    assert base.replace(viscosity=5.0).viscosity == 5
