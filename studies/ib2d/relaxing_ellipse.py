"""The relaxing ellipse of `studies -- shared_benchmark`, computed by IB2d (its Python version, unchanged).

    python3 relaxing_ellipse.py IB2D CELLS STEP DENSITY TIME

IB2D is a clone of IB2d; numpy and scipy are all it needs. Prints the aspect ratio by the moments of area, the area over
that at the start and the processor time in seconds. IB2d solves the Navier-Stokes equations: the density is to be so
small that inertia does not matter. The tension is a force of IB2d's user, its markers half a cell apart.
"""

import contextlib
import io
import os
import sys
import tempfile
import time
import types

import numpy as np

SIDE, VISCOSITY, TENSION, HALF_AXIS = 6.0, 1.0, 1.0, 1.3


def ellipse(count):
    """Points of the ellipse (a cos t, sin t / a), equally spaced along it, about the middle of the box."""
    t = np.linspace(0.0, 2.0 * np.pi, 200 * count + 1)
    x, y = HALF_AXIS * np.cos(t), np.sin(t) / HALF_AXIS
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    t = np.interp(np.arange(count) * arc[-1] / count, arc, t)
    return SIDE / 2 + HALF_AXIS * np.cos(t), SIDE / 2 + np.sin(t) / HALF_AXIS, arc[-1]


def tension(ds, count, x, y, *_):
    """Force density of a constant tension: the difference of the unit tangents of both segments of a marker."""
    dx, dy = np.roll(x, -1) - x, np.roll(y, -1) - y
    length = np.hypot(dx, dy)
    tx, ty = TENSION * dx / length, TENSION * dy / length
    return (tx - np.roll(tx, 1)) / ds, (ty - np.roll(ty, 1)) / ds


def moments(x, y):
    """Area of a polygon and its aspect ratio by the second moments about its centroid."""
    u, v = np.roll(x, -1), np.roll(y, -1)
    cross = x * v - u * y
    area = cross.sum() / 2
    cx, cy = ((x + u) * cross).sum() / (6 * area), ((y + v) * cross).sum() / (6 * area)
    xx = ((x * x + x * u + u * u) * cross).sum() / 12 - area * cx * cx
    yy = ((y * y + y * v + v * v) * cross).sum() / 12 - area * cy * cy
    return area, np.sqrt(xx / yy)


def main(code, cells, step, density, end):
    sys.path.insert(0, os.path.join(os.path.abspath(code), "pyIB2d", "IBM_Blackbox"))
    forces = types.ModuleType("give_Me_General_User_Defined_Force_Densities")
    forces.give_Me_General_User_Defined_Force_Densities = tension
    sys.modules[forces.__name__] = forces
    import IBM_Driver

    move = IBM_Driver.please_Move_Lagrangian_Point_Positions
    seen = []

    def watched(*arguments):
        seen[:] = move(*arguments)
        return seen

    IBM_Driver.please_Move_Lagrangian_Point_Positions = watched
    _, _, perimeter = ellipse(64)
    count = int(round(perimeter / (SIDE / cells / 2)))
    x, y, _ = ellipse(count)
    area, _ = moments(x, y)
    model = [0.0] * 26
    model[23] = 1.0  # the force of the user
    output = [10**9] + [0] * 16  # nothing is written
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        with open("ellipse.vertex", "w") as file:
            file.write(f"{count}\n" + "".join(f"{a:.17g} {b:.17g}\n" for a, b in zip(x, y)))
        with open("ellipse.user_force", "w") as file:
            file.write("1\n0 0 0 0\n")

        def run(until):
            IBM_Driver.main([VISCOSITY, density], [cells, cells, SIDE, SIDE, 4], [until, step], model, output, "ellipse")
            os.chdir(folder)

        with contextlib.redirect_stdout(io.StringIO()):
            run(step)  # compiles what numba compiles
            start = time.process_time()
            run(end)
            seconds = time.process_time() - start
        os.chdir("/")
    last, ratio = moments(*seen)
    print(f"{ratio:.10f} {last / area:.10f} {seconds:.4f}")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), *map(float, sys.argv[3:6]))
