"""Picture of the page docs/reference/python.md: `python bindings/python/draw.py`."""

from pathlib import Path

import motile

ways = [(-1.7, -1.5, 0.3), (1.6, -1.4, 2.2), (-1.4, 1.6, -1.0), (1.5, 1.5, 4.0)]
droplets = [motile.droplet(-2 - k / 2, centre=(x, y), angle=angle) for k, (x, y, angle) in enumerate(ways)]
setup = motile.Setup(region=motile.box(8, 6.4), method=motile.integral(nodes=48, elements=192), droplets=droplets)
scene = setup.build()
scene.run(4)
scene.picture(Path(__file__).parents[2] / "docs" / "images" / "python.png", spacing=0.1, width=9)
