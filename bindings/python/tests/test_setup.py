"""Setups: ways in and out, errors with their keys."""

import copy
import pickle

import motile
import numpy as np
import pytest


def channel() -> motile.Setup:
    return motile.Setup(
        region=motile.channel(12, 5, drive="zero-flux"),
        method=motile.integral(nodes=32, cells=128),
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


def test_arrays_are_lists() -> None:
    points = np.array([[np.cos(t), np.sin(t)] for t in np.linspace(0, 2 * np.pi, 32, endpoint=False)])
    strided = np.repeat(points, 2, axis=0)[::2]
    one, other = (motile.Setup(droplets=[motile.droplet(shape={"points": p})]) for p in (points, strided))
    assert one == other
    assert motile.Setup(viscosity=np.float32(50)).viscosity == 50
    assert motile.Setup(method=motile.integral(nodes=np.int64(32), cells=128)).method["integral"]["nodes"] == 32


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
        ({"least_gap": 10**30}, "least_gap"),
    ],
)
def test_wrong_entries_name_their_key(entries: dict[str, object], key: str) -> None:
    with pytest.raises(motile.Error) as raised:
        motile.Setup(**entries)
    assert raised.value.key == key, str(raised.value)
    assert "\n" not in str(raised.value)
    again = pickle.loads(pickle.dumps(raised.value))
    assert (str(again), again.key, again.remedy) == (str(raised.value), key, raised.value.remedy)


def test_remedies() -> None:
    with pytest.raises(motile.Error) as raised:
        motile.Setup(viscosity=-1)
    assert (raised.value.value, raised.value.remedy) == ("-1", "give a positive finite number")
    two = [motile.droplet(), motile.droplet(centre=(0.5, 0))]
    with pytest.raises(motile.Error, match="overlaps") as raised:
        motile.Setup(droplets=two).build()
    assert raised.value.key == "droplets[1]"
    for places in [{"droplets.3.angle": 1}, {"viscosity.a": 1}, {"droplets.x": 1}]:
        with pytest.raises(motile.Error, match="place|unknown|invalid"):
            motile.Setup().replace(places)
    with pytest.raises(TypeError):
        motile.droplet(None, particles={"concentration": 1})
