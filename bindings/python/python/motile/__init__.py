"""Active droplets swimming in two-dimensional Stokes flow.

A droplet is a closed fluid interface that carries active particles. The particles raise its tension; differences of
tension drive flow along the interface; the flow gathers the particles. Above a threshold of activity the droplet
polarises and swims.

>>> import motile
>>> setup = motile.Setup(droplets=[motile.droplet(-2)], method=motile.integral(nodes=48, elements=192))
>>> scene = setup.build()
>>> track = scene.run(20, every=1)
>>> print(f"{track['speed'][-1]:.3f}")
0.130

Quantities may have any consistent units; those of the defaults are R0 = 10 um for length, 10 s for time and 10 Pa um
for force (line tension). Keys and dimensions of a setup are those of scene files, with underscores; the file
`scene.toml` of the crate `motile` shows every one of them.
"""

from ._error import Error
from ._fit import Combination, FitResult, Profile, Samples, fit
from ._fit_model import Free
from ._measured import Measured, MeasuredConcentration, MeasuredModes, MeasuredOutline, MeasuredRun
from ._motile import Setup, SteadyState, read_outline, steady
from ._parts import box, channel, droplet, grid, harmonics, integral, layers, plane, slit, space, tube
from ._scene import Droplet, Scene, SpaceDroplet, Track
from ._steady import Branch, branch
from ._sweep import Sweep, SweepRun, sweep

__all__ = [
    "Branch",
    "Combination",
    "Droplet",
    "Error",
    "FitResult",
    "Free",
    "Measured",
    "MeasuredConcentration",
    "MeasuredModes",
    "MeasuredOutline",
    "MeasuredRun",
    "Profile",
    "Samples",
    "Scene",
    "Setup",
    "SpaceDroplet",
    "SteadyState",
    "Sweep",
    "SweepRun",
    "Track",
    "box",
    "branch",
    "channel",
    "droplet",
    "fit",
    "grid",
    "harmonics",
    "integral",
    "layers",
    "plane",
    "read_outline",
    "slit",
    "space",
    "steady",
    "sweep",
    "tube",
]
