"""Scenes: runs, interruptions, state and output."""

import copy
import importlib.util
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import motile
import numpy as np
import pytest

ROOT = Path(__file__).parents[3]


def small(**more: object) -> motile.Setup:
    return motile.Setup(method=motile.integral(nodes=32, elements=128), **more)


def test_the_command_line_gives_the_same_numbers(tmp_path: Path) -> None:
    # As the tests of the workspace are built, so that nothing is compiled twice.
    build = "cargo build --release --quiet --workspace --features rayon --bin motile"
    subprocess.run(build.split(), cwd=ROOT, check=True)
    program = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "motile"
    command = f"{program} run examples/scenes/swimmer.toml --time 2"
    written = tmp_path / "scene.toml"
    keys = ["droplets.0.particles.start=polarised", "method.integral={ nodes = 32, elements = 128 }"]
    flags = ["--quiet", "--no-pictures", *(flag for key in keys for flag in ("--set", key))]
    subprocess.run(
        [*command.split(), *flags, "--out", str(tmp_path / "out"), "--write-scene", str(written)], cwd=ROOT, check=True
    )
    rows = np.genfromtxt(tmp_path / "out" / "trajectory.csv", delimiter=",", names=True)
    scene = motile.Setup.from_toml(written.read_text()).build()
    track = scene.run(2)
    assert np.allclose(track.time, rows["time"], rtol=1e-12)
    for name in rows.dtype.names:
        if name in track:
            assert np.allclose(track[name], rows[name], rtol=1e-12, atol=1e-12, equal_nan=True), name
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["speed"] == pytest.approx(track["speed"][-1], rel=1e-5)


def test_a_run_warns_once_of_each_kind() -> None:
    scene = motile.Setup(method=motile.integral(nodes=24, elements=48), droplets=[motile.droplet(-4)]).build()
    with pytest.warns(UserWarning) as given:
        scene.run(0.1)
    assert len(given) == len(scene.warnings)
    assert any("edge of the concentration not resolved" in str(warning.message) for warning in given)
    kinds = len(scene.warnings)
    with warnings.catch_warnings(record=True) as more:
        warnings.simplefilter("always")
        scene.run(0.2)
    assert len(more) == len(scene.warnings) - kinds


def test_a_copy_goes_on_by_itself() -> None:
    scene = small().build()
    scene.droplets[0].set_tension(lambda c: 10 - 3 * c)
    scene.run(0.5, every=0.1)
    for other in (copy.copy(scene), copy.deepcopy(scene)):
        before = other.droplets[0].positions
        assert np.array_equal(other.track["speed"], scene.track["speed"])
        once = copy.copy(scene)
        once.run(1)
        assert np.array_equal(other.droplets[0].positions, before) and scene.time == 0.5
        other.run(1)
        assert np.array_equal(other.droplets[0].positions, once.droplets[0].positions)


@pytest.mark.parametrize("every", [0.0, -1.0, 1e-300, float("nan")])
@pytest.mark.parametrize("callback", [None, print])
def test_reports_have_an_interval(every: float, callback: Callable[[object], None] | None) -> None:
    with pytest.raises(motile.Error):
        small().build().run(1, every=every, callback=callback)


def test_a_run_in_parts_is_one_run(tmp_path: Path) -> None:
    whole, parts, other = (small().build() for _ in range(3))
    track = whole.run(2, every=0.5)
    seen = []
    parts.run(2, every=0.5, callback=lambda scene: seen.append(scene.droplets[0].observe()["speed"]))
    assert np.array_equal(seen, track["speed"])
    assert np.array_equal(track["speed"], whole.track["speed"])
    assert track.time.tolist() == [0, 0.5, 1, 1.5, 2]
    assert parts.run(2.5, every=0.5).time.tolist() == [2, 2.5]
    whole.save(tmp_path / "state")
    other.load(tmp_path / "state")
    assert np.array_equal(other.run(3, every=1)["speed"], whole.run(3, every=1)["speed"])
    assert np.array_equal(other.droplets[0].positions, whole.droplets[0].positions)
    with pytest.raises(motile.Error, match="viscosity is 100.0 in it and 3.0 here"):
        small(viscosity=3).build().load(tmp_path / "state")
    with pytest.raises(motile.Error, match="missing"):
        other.load(tmp_path / "missing")


def test_broken_checkpoints_are_refused(tmp_path: Path) -> None:
    scene, other = small().build(), small().build()
    scene.run(0.5)
    path = tmp_path / "state"
    scene.save(path)
    whole = path.read_bytes()
    flipped = bytearray(whole)
    flipped[len(whole) // 2] ^= 1
    before = other.droplets[0].positions
    half = whole[: len(whole) // 2]
    for broken in [b"", whole[:10], half, whole[:-1], whole + b"x", bytes(flipped), os.urandom(999)]:
        path.write_bytes(broken)
        with pytest.raises(motile.Error):
            other.load(path)
        assert other.time == 0 and np.array_equal(other.droplets[0].positions, before)
    with pytest.raises(motile.Error):
        other.load(tmp_path)


def test_a_full_disk_leaves_the_last_checkpoint(tmp_path: Path) -> None:
    program = """
import motile, resource, sys
scene = motile.Setup(method=motile.integral(nodes=32, elements=128)).build()
scene.save("state")
scene.run(0.5)
resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
go_on = lambda: scene.run(1, 0.25, checkpoint="state")
for write in (lambda: scene.save("state"), go_on, lambda: scene.picture("a.png")):
    try:
        write()
    except motile.Error as error:
        print(error)
    else:
        sys.exit("written")
assert scene.time == 0.75, scene.time
"""
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done
    assert done.stdout.count("state") == 2, done.stdout
    scene = small().build()
    scene.load(tmp_path / "state")
    assert scene.time == 0


def test_tables() -> None:
    one = small().build().run(1, every=0.5)
    assert one["speed"].shape == (3,) and set(one) == set(one.names) and len(one) == len(one.names)
    assert one.to_pandas()["speed"].tolist() == one["speed"].tolist()
    pair = [motile.droplet(-2, centre=(-1.4, 0)), motile.droplet(-1, centre=(1.4, 0))]
    two = small(droplets=pair, region=motile.box(8, 6)).build().run(1, every=0.5)
    assert two["speed"].shape == (3, 2) and two.time.shape == (3,)
    assert two.to_pandas().loc[(1.0, 1)]["speed"] == two["speed"][-1, 1]
    assert two.to_xarray()["speed"].sel(time=1.0, droplet=0) == two["speed"][-1, 0]
    with pytest.raises(KeyError, match="aspect_ratio_moments"):
        one["aspect"]
    assert small(droplets=[]).build().run(1).time.size == 0


def test_state_and_samples() -> None:
    scene = small().build()
    scene.run(0.5, every=0.5)
    droplet = scene.droplets[0]
    positions = droplet.positions
    positions[:] = 0
    assert droplet.positions.any() and len(droplet.concentration) == len(droplet.velocities) == len(positions)
    grid = np.stack(np.meshgrid(np.linspace(-2, 2, 5), np.linspace(-2, 2, 4)), axis=-1)
    velocity, pressure = scene.sample(grid)
    assert velocity.shape == (4, 5, 2) and pressure.shape == (4, 5)
    one, _ = scene.sample(grid[::2, ::2].transpose(1, 0, 2))
    assert np.array_equal(one, velocity[::2, ::2].transpose(1, 0, 2))
    # Incompressible, and the gradient is that of the velocity.
    gradient = scene.velocity_gradient([0.3, 0.2])
    assert abs(np.trace(gradient)) < 1e-9
    h = 1e-4
    (right, left), _ = scene.sample([[0.3 + h, 0.2], [0.3 - h, 0.2]])
    assert np.allclose((right - left) / (2 * h), gradient[:, 0], atol=1e-6)
    single = grid.astype(np.float32)[:, ::-1]
    assert np.array_equal(scene.sample(single)[0][:, ::-1], scene.sample(grid.astype(np.float32))[0])
    assert np.array_equal(scene.sample(np.array([[0, 1]]))[0], scene.sample([[0.0, 1.0]])[0])
    for wrong in [[1, 2, 3], 5.0, [[np.nan, 0]], "ab", [[1j, 0]], [["a", "b"]], [[1], [1, 2]], [[None, 1]], object()]:
        with pytest.raises(motile.Error):
            scene.sample(wrong)
    assert scene.sample(np.empty((0, 2)))[0].shape == (0, 2)


@pytest.mark.parametrize("region", [motile.space(), motile.tube(2.0)], ids=["space", "tube"])
def test_three_dimensions(region: object) -> None:
    scene = small(region=region, droplets=[motile.droplet(-4, shape={"round": {"radius": 1.0}})]).build()
    track = scene.run(0.5, every=0.25)
    assert track["speed"].shape == (3,) and track["speed"][-1] > 1e-3
    assert abs(track["y"]).max() < 1e-9
    velocity, pressure = scene.sample([[0.0, 0.3], [0.0, -0.3], [3.0, 0.5]])
    assert np.isfinite(pressure).all() and velocity[1] == pytest.approx(velocity[0] * [1, -1], abs=1e-9)
    text = scene._repr_svg_()
    assert text.startswith("<svg")
    assert pickle.loads(pickle.dumps(small(region=region))) == small(region=region)
    method = motile.integral(nodes=48, elements=192)
    swimmer = motile.steady(motile.Setup(region=region, method=method, droplets=[motile.droplet(-1)]))
    assert 0.08 < swimmer.speed < 0.11


def test_three_dimensions_without_symmetry(tmp_path: Path) -> None:
    particles = {"excluded_volume": {"step": 2.0}}
    droplets = [
        motile.droplet(-1, particles=particles, position=[-1.3, 0.2, 0.0], heading=[1.0, 0.0, 0.5]),
        motile.droplet(-1, particles=particles, position=[1.3, 0.0, 0.3], heading=[-1.0, 0.5, 0.0]),
    ]
    setup = motile.Setup(region=motile.space(), method=motile.harmonics(6), droplets=droplets)
    assert pickle.loads(pickle.dumps(setup)) == setup
    scene = setup.build()
    assert scene.droplets == [] and len(scene.space_droplets) == 2
    track = scene.run(0.2, every=0.1)
    assert track["speed"].shape == (3, 2) and (track["speed"] > 0.05).all()
    assert np.allclose(track["volume"], 4 / 3 * np.pi, rtol=1e-6)
    first = scene.space_droplets[0]
    points, triangles = first.points, first.triangles
    assert points.shape[1] == 3 and triangles.max() == len(points) - 1
    a, b, c = (points[triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->i", a - first.position, np.cross(b - first.position, c - first.position)).sum() / 6
    assert volume == pytest.approx(4 / 3 * np.pi, rel=0.03)
    assert first.concentration.shape == first.tension.shape == (len(points),)
    # The fluid on the surface moves as the fluid next to it.
    assert scene.velocity_at(points[:5]) == pytest.approx(first.velocities[:5], abs=1e-3)
    assert first.heading == pytest.approx(np.array([1.0, 0.0, 0.5]) / np.sqrt(1.25), abs=0.2)
    assert scene.minimum_gap == pytest.approx(track["gap"][-1].min())
    with pytest.raises(motile.Error, match="velocity_at"):
        scene.sample([[0.0, 0.0]])
    scene.save(tmp_path / "state")
    again, twin = setup.build(), copy.copy(scene)
    again.load(tmp_path / "state")
    assert again.run(0.3)["speed"][-1].tolist() == scene.run(0.3)["speed"][-1].tolist() == twin.run(0.3)["speed"][-1].tolist()
    scene.picture(tmp_path / "pair.png")
    assert scene._repr_svg_().startswith("<svg")
    scene.write_paraview(tmp_path / "vtk")
    assert (tmp_path / "vtk" / "surface.pvd").exists()
    with pytest.raises(motile.Error, match="droplets\\[0\\].heading"):
        motile.Setup(region=motile.plane(), droplets=[motile.droplet(heading=[1, 0, 0])]).build()


def test_walls_around_droplets_in_space() -> None:
    droplet = motile.droplet(-1, particles={"excluded_volume": {"step": 2.0}}, heading=[1.0, 0.0, 0.3])
    setup = motile.Setup(region=motile.slit(-2.0, 2.0), method=motile.harmonics(6), droplets=[droplet])
    scene = setup.build()
    assert scene.minimum_gap == pytest.approx(1.0, abs=0.05)
    assert np.abs(scene.velocity_at([[0.3, 0.2, 2.0]])).max() < 1e-9 < np.abs(scene.velocity_at([[0.3, 0.2, 1.5]])).max()
    assert motile.Setup(region=motile.box(6, 5, 4), droplets=[droplet]).build().space_droplets


@pytest.mark.skipif(importlib.util.find_spec("meshio") is None, reason="needs meshio")
def test_surfaces_are_read_by_another_reader(tmp_path: Path) -> None:
    meshio = importlib.import_module("meshio")
    setup = motile.Setup(region=motile.space(), method=motile.harmonics(6), droplets=[motile.droplet(-4, heading=[0, 1, 1])])
    scene = setup.build()
    scene.write_paraview(tmp_path)
    droplet = scene.space_droplets[0]
    found = meshio.read(tmp_path / "surface_0000.vtu")
    assert np.allclose(found.points, droplet.points)
    assert (found.cells_dict["triangle"] == droplet.triangles).all()
    assert np.allclose(found.point_data["concentration"].ravel(), droplet.concentration, rtol=1e-6)
    assert np.allclose(found.point_data["velocity"], droplet.velocities, atol=1e-6)


def test_sixteen_droplets() -> None:
    suspension = [{"count": 16, "radius": [0.8, 1.0], "activity": [-3.0, -2.0], "seed": 3}]
    setup = small(region=motile.box(16), droplets=[], suspension=suspension)
    assert pickle.loads(pickle.dumps(setup)) == setup == motile.Setup.from_toml(setup.to_toml())
    scene = setup.build()
    track = scene.run(0.2, every=0.1)
    assert track["speed"].shape == (3, 16) and len(scene.droplets) == len(scene.bodies) == 16
    assert track.to_pandas().shape[0] == 48 and (track["speed"][-1] > 0).all()
    radii = np.sqrt(track["area"][0] / np.pi)
    assert 0.79 < radii.min() < radii.max() < 1.01 and np.ptp(radii) > 0.05
    assert np.allclose(track["area"][-1], track["area"][0], rtol=1e-6)
    assert scene.minimum_gap is not None and scene.minimum_gap > 0
    with pytest.raises(motile.Error, match="suspension"):
        small(region=motile.box(6), droplets=[], suspension=[{"count": 16}]).build()


def test_forces_on_a_post_and_walls() -> None:
    post = {"name": "post", "held": True, "centre": [0, 0], "shape": {"round": {"radius": 0.5}}}
    region = {"channel": {"length": 6.0, "width": 3.0, "drive": {"flux": 1.0}}}
    scene = small(region=region, viscosity=1.0, droplets=[], rigid_bodies=[post]).build()
    [(name, force, torque)] = scene.body_forces
    # An independent boundary-integral program.
    assert name == "post" and force == pytest.approx([16.7187598671, 0], abs=1e-6)
    assert torque == pytest.approx(0, abs=1e-6)
    forces = scene.channel_forces
    assert forces is not None and forces["extra_pressure_drop"] == pytest.approx(7.936105974, rel=1e-7)
    shear = scene.wall_shear(64)
    assert shear is not None
    x, lower, upper = shear
    assert x[0] == -3 and np.allclose(lower, upper) and upper[32] == pytest.approx(2.76673351, rel=1e-6)
    assert 6 * (np.mean(lower) + np.mean(upper)) + force[0] == pytest.approx(3 * forces["pressure_drop"], rel=1e-7)
    assert motile.Setup().build().channel_forces is None and motile.Setup().build().wall_shear() is None


def test_pictures_and_files(tmp_path: Path) -> None:
    scene = small().build()
    text = scene.picture(spacing=0.3, caption="a <caption>")
    assert text is not None and text.startswith("<svg") or text.startswith("<?xml")
    assert scene._repr_svg_()
    scene.picture(tmp_path / "a.png", spacing=0.3)
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    scene.write_paraview(tmp_path / "vtk", spacing=0.3)
    assert list((tmp_path / "vtk").glob("*.pvd"))
    for wrong in [lambda: scene.picture(tmp_path / "none" / "a.png"), lambda: scene.picture(spacing=-1)]:
        with pytest.raises(motile.Error):
            wrong()


def test_a_tension_of_ones_own() -> None:
    particles = {"excluded_volume": {"quadratic": 0.02}}
    setup = small(droplets=[motile.droplet(-2, particles=particles)], step={"fixed": 0.01})
    known, tabulated, sampled = (setup.build() for _ in range(3))
    # The law of the setup: gamma0 - activity c - B c^2 / 2.
    c = np.linspace(0, 1500, 6001)
    gamma0, activity, strength = 10.0, -2.0, 0.02
    table = gamma0 - activity * c - strength * c**2 / 2
    tabulated.droplets[0].set_tension(np.column_stack([c, table]).T)
    sampled.droplets[0].set_tension(lambda c: gamma0 - activity * c - strength * c**2 / 2, up_to=1500, points=6001)
    speeds = [scene.run(0.5, every=0.5)["speed"][-1] for scene in (known, tabulated, sampled)]
    assert speeds[1] == pytest.approx(speeds[0], rel=1e-5)
    # Of a function, which the polynomials through five points know.
    assert speeds[2] == pytest.approx(speeds[0], rel=1e-10)
    droplet = known.droplets[0]
    for wrong in [
        ((0, 1), (1, 2)),
        ((0, 2, 1), (1, 2, 3)),
        ((0, 1, 2), (1, np.nan, 2)),
        ((0, 1, 2), (1, 2)),
        ((0, 1, 2), ("a", "b", "c")),
        ((0, 1, 2),),
        lambda c: c[:-1],
        lambda c: c + 1j,
        lambda c: "steep",
        lambda c: None,
        lambda c: np.log(c - 1e9),
    ]:
        with pytest.raises(motile.Error), np.errstate(invalid="ignore"):
            droplet.set_tension(wrong)
    with pytest.raises(ZeroDivisionError):
        droplet.set_tension(lambda c: 1 // 0)
    # The law of before is there still.
    assert known.run(1, every=1)["speed"][-1] == setup.build().run(1, every=0.5)["speed"][-1]


def test_tables_of_laws_follow_the_concentration() -> None:
    """In a small unit of length concentrations are far below one."""

    def speed(length: float) -> float:
        particles = {"concentration": 100 / length, "diffusion": 0.1 * length**2, "excluded_volume": "none"}
        droplet = motile.droplet(-2 * length, particles=particles, shape={"round": {"radius": length}})
        region = {"box": {"lengths": [6 * length, 6 * length]}}
        setup = small(region=region, viscosity=100 / length, droplets=[droplet], step={"fixed": 0.02})
        scene = setup.build()
        c0 = 100 / length
        scene.droplets[0].set_tension(lambda c: 10 + 400 * c / (c + c0))
        return float(scene.run(0.5, every=0.5)["speed"][-1]) / length

    assert speed(1e5) == pytest.approx(speed(1.0), rel=1e-9)


def test_samples_have_the_mean_pressure_gradient() -> None:
    region = {"channel": {"length": 6, "width": 6, "drive": {"gradient": -2.0}}}
    drop = motile.droplet(None, centre=[0.3, 0.2], tension=10.0)
    scene = small(region=region, viscosity=1.0, droplets=[drop]).build()
    _, pressure = scene.sample([[0.3, 0.2], [2.9, 2.9], [-2.9, 2.9]])
    # Next to the drop the flow past it adds to the pressure of its tension, less far away.
    assert pressure[2] - pressure[1] == pytest.approx(2.0 * 5.8, rel=0.3)
    assert pressure[0] > 8


def test_laws_of_functions_are_of_fourth_order() -> None:
    start = {"excluded_volume": "none"}
    setup = small(droplets=[motile.droplet(-2, particles=start)], step={"fixed": 0.02})

    def speed(points: int) -> float:
        scene = setup.build()
        scene.droplets[0].set_tension(lambda c: 10 + 400 * c / (c + 100), up_to=1600, points=points)
        return float(scene.run(0.5, every=0.5)["speed"][-1])

    exact = speed(20001)
    errors = [abs(speed(points) - exact) for points in (101, 201)]
    assert np.log2(errors[0] / errors[1]) > 3.5 and errors[1] < 1e-5 * exact, errors


def _interrupted(work: Callable[[], object], after: float) -> float:
    """Seconds between Ctrl-C, some time after the start, and the end of the work by it."""
    # A process in the background may have been started with Ctrl-C ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    pressed = threading.Event()
    began = [0.0]

    def press() -> None:
        began[0] = time.monotonic()
        pressed.set()
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(after, press)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
    finally:
        timer.cancel()
        signal.signal(signal.SIGINT, before)
    assert pressed.is_set()
    return time.monotonic() - began[0]


def test_ctrl_c_leaves_whatever_takes_long() -> None:
    def fine(nodes: int) -> motile.Setup:
        return motile.Setup(region=motile.plane(), method=motile.integral(nodes=nodes, elements=4 * nodes))

    crowd = motile.Setup(region=motile.box(200), droplets=[], suspension=[{"count": 4000, "seed": 1}])
    start = motile.steady(fine(64))
    values: list[float] = []
    for name, work in {
        "build": crowd.build,
        "steady": lambda: motile.steady(fine(1000)),
        "branch": lambda: motile.branch(motile.steady(fine(256)), "activity", -6, callback=values.append),
        "sweep": lambda: motile.sweep(fine(300), {"viscosity": [90, 100]}, 1e3, 1.0),
    }.items():
        assert _interrupted(work, 0.5) < 5, name
    # What was begun does not hold up what comes next.
    assert motile.steady(fine(64)).speed == start.speed


def test_ctrl_c_ends_a_run_within_a_second() -> None:
    scene = motile.Setup(method=motile.grid(spacing=0.05)).build()
    assert _interrupted(lambda: scene.run(1e3, every=1.0), 0.6) < 5
    reached = scene.time
    assert reached > 0 and scene.track.time[-1] <= reached
    scene.run(reached + 0.01)
    assert scene.time == reached + 0.01


def test_exceptions_of_callbacks_come_through() -> None:
    scene = small().build()

    def stop(scene: motile.Scene) -> None:
        if scene.time > 0.7:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        scene.run(5, every=0.5, callback=stop)
    assert scene.time == 1.0 and scene.track.time[-1] == 1.0


def test_errors_of_runs_keep_the_state() -> None:
    scene = small().build()
    for until in [float("nan"), -1.0, float("inf")]:
        with pytest.raises(motile.Error):
            scene.run(until)
    with pytest.raises(motile.Error):
        scene.run(1, every=-1.0)
    with pytest.raises(motile.Error, match="fixd"):
        scene.run(1, step={"fixd": 1})
    with pytest.raises(motile.Error, match="above the stable"):
        scene.run(1, step={"fixed": 10.0})
    assert scene.time == 0
    assert scene.run(0.5, step={"fixed": 0.01}).time[-1] == pytest.approx(0.5)


def test_two_scenes_in_two_threads_and_one_scene_in_two() -> None:
    scenes = [small().build() for _ in range(2)]
    threads = [threading.Thread(target=scene.run, args=(1, 0.5)) for scene in scenes]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    alone = small().build().run(1, 0.5)
    for scene in scenes:
        assert np.array_equal(scene.track["speed"], alone["speed"])
    busy = small().build()

    def go() -> None:
        # The look from the other thread may come first.
        try:
            busy.run(50)
        except motile.Error as error:
            assert "in use" in str(error)
            go()

    running = threading.Thread(target=go)
    running.start()
    refused = 0
    while running.is_alive() and not refused:
        try:
            busy.time
        except motile.Error as error:
            assert "in use" in str(error)
            refused += 1
    running.join()
    assert refused and busy.time == 50


def _speed(setup: motile.Setup) -> float:
    return float(setup.build().run(0.5, 0.5)["speed"][-1])


def test_setups_go_to_other_processes() -> None:
    setups = [small().replace({"droplets.0.particles.activity": a}) for a in (-1, -2)]
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert list(pool.map(_speed, setups)) == [_speed(setup) for setup in setups]


def test_sweeps_resume_and_keep_errors(tmp_path: Path) -> None:
    changes = {"droplets.0.particles.activity": [-1, -2], "viscosity": [50, 100]}
    done = motile.sweep(small(), changes, 0.5, 0.25, processes=2, folder=tmp_path)
    assert [run.values["viscosity"] for run in done] == [50, 100, 50, 100]
    assert len(list(tmp_path.glob("*.npz"))) == 4 and not list(tmp_path.glob("*.part"))
    assert done[3].track["speed"][-1] == small().build().run(0.5, 0.25)["speed"][-1]
    stamps = {file: file.stat().st_mtime_ns for file in tmp_path.iterdir()}
    again = motile.sweep(small(), changes, 0.5, 0.25, folder=tmp_path)
    assert {file: file.stat().st_mtime_ns for file in tmp_path.iterdir()} == stamps
    assert again.to_pandas().equals(done.to_pandas())
    # Another end is another sweep, and so is another scene.
    motile.sweep(small(), {"viscosity": [100]}, 0.25, 0.25, folder=tmp_path)
    assert len(list(tmp_path.glob("*.npz"))) == 5
    # What another version of motile has kept is run again.
    kept = next(iter(stamps))
    with np.load(kept) as known:
        entries = dict(known)
    np.savez(kept, **{**entries, "version": "0.0.9+1", "values": 2 * entries["values"]})
    with pytest.warns(UserWarning, match="was kept by motile 0.0.9"):
        renewed = motile.sweep(small(), changes, 0.5, 0.25, folder=tmp_path)
    assert renewed.to_pandas().equals(done.to_pandas())
    bad = motile.sweep(small(step={"fixed": 5.0}), {"viscosity": [100]}, 20)
    assert bad[0].error and "step" in bad[0].error
    for until, every in [(float("nan"), None), (-1, None), (1, 0), (1, float("inf"))]:
        with pytest.raises(motile.Error, match="positive finite time"):
            motile.sweep(small(), {"viscosity": [100]}, until, every)
    with pytest.raises(motile.Error):
        motile.sweep(small(), {"viscosity": [1, -1]}, 1)
    # Of a sweep that is stopped, runs that have begun are not waited for, and results are whole.
    endless = {"viscosity": [60, 70, 80]}
    longest = motile.Setup(method=motile.integral(nodes=200, elements=800))
    assert _interrupted(lambda: motile.sweep(longest, endless, 1e4, 1.0, processes=2, folder=tmp_path), 2.0) < 5
    assert not multiprocessing.active_children() and len(list(tmp_path.glob("*.npz"))) == 5
    alone = tmp_path / "alone"
    for broken in (b"", b"junk", b"PK\x03\x04"):
        motile.sweep(small(), {"viscosity": [100]}, 0.1, folder=alone)
        (file,) = alone.iterdir()
        file.write_bytes(broken)
        with pytest.raises(motile.Error, match="Remove it"):
            motile.sweep(small(), {"viscosity": [100]}, 0.1, folder=alone)
        file.unlink()


def test_scenes_pickle_with_state_and_records() -> None:
    scene = small(droplets=[motile.droplet(-2)]).build()
    scene.run(0.4, 0.1)
    again = pickle.loads(pickle.dumps(scene))
    assert again.setup == scene.setup and again.time == scene.time
    assert np.array_equal(again.track.as_array, scene.track.as_array, equal_nan=True)
    after, expected = again.run(0.6, 0.1), scene.run(0.6, 0.1)
    assert np.array_equal(after["speed"], expected["speed"])
    assert "<svg" in again._repr_html_() and "stresslet_xx" in again._repr_html_()
    scene.droplets[0].set_tension(lambda c: 10.0 + 0.01 * c)
    with pytest.raises(motile.Error, match="load"):
        pickle.dumps(scene)
    with pytest.raises(motile.Error, match="Send its setup"):
        pickle.dumps(motile.steady(small(region="plane", droplets=[motile.droplet(-1)])))
