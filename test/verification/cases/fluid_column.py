"""A fluid that starts in hydrostatic equilibrium stays there."""

import numpy as np

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import at_most, relative
from suite.run import Run

TITLE = "Fluid column at rest"
SOURCE = "Hydrostatics"
REMARKS = """The free surface runs through particles, not through nodes: what moves at the start is the top row of cells
finding its balance on the grid."""

DENSITY, GRAVITY, HEIGHT = 1000.0, 9.81, 1.0


def runs(full):
    size = 0.025 if full else 0.05
    return [Run("rest", {"grid.cell_size_m": size}, record=True, effort=4 if full else 1)]


def quantities(results, full):
    result = results["rest"]
    kinetic = result.series("water", "kinetic_j_per_m")
    mass = DENSITY * 0.5 * HEIGHT
    speed = float(np.sqrt(2 * np.max(kinetic) / mass)) if kinetic.size else float("nan")
    pressure = DENSITY * GRAVITY
    return [
        # Root-mean-square speed against that of a fall through the height, 4.4 m/s: at rest to 0.1 %.
        at_most("largest RMS speed", "default", speed, 1e-3 * np.sqrt(2 * GRAVITY * HEIGHT), "m/s"),
        # A fiftieth of the compression under its own weight.
        at_most("change of the centroid's height", "default",
                result.last("water", "centroid_z_m") - result.at("water", "centroid_z_m", 0.0), 2e-4, "m"),
        relative("vertical stress at mid-height, mean over 1 s", "default", result.mean("middle", "stress_zz_pa", 0.0),
                 -0.5 * pressure, "Pa", 0.01),
        relative("vertical stress 0.9 m deep, mean over 1 s", "default", result.mean("deep", "stress_zz_pa", 0.0),
                 -0.9 * pressure, "Pa", 0.01),
        relative("horizontal stress 0.9 m deep, mean over 1 s", "default", result.mean("deep", "stress_yy_pa", 0.0),
                 -0.9 * pressure, "Pa", 0.01),
    ]


def draw(results, path):
    result = results["rest"]
    with picture(path, 2) as (left, right):
        if result.frames:
            last = result.frames[-1]
            left.plot(1e-3 * last["soil/stress"][:, 5], last["soil/position"][:, 1], ".", color=COLOURS[0], markersize=2,
                      label="particles, 1 s")
        left.plot([-1e-3 * DENSITY * GRAVITY * HEIGHT, 0], [0, HEIGHT], label="hydrostatic", **REFERENCE)
        left.set(xlabel="vertical stress [kPa]", ylabel="height [m]")
        left.legend()
        right.plot(result.time("water"), result.series("water", "kinetic_j_per_m"), color=COLOURS[0])
        right.set(xlabel="time [s]", ylabel="kinetic energy [J/m]")
