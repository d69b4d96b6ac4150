"""A cable between two points hangs in the catenary."""

import math

import numpy as np

from suite.drawing import COLOURS, REFERENCE, draw_convergence, picture
from suite.quantity import relative
from suite.run import Run
from suite.series import Convergence

TITLE = "Hanging cable"
SOURCE = "Catenary z = a cosh(y / a) of given length and span"
REMARKS = "Tension at the end is that of the cable's point nearest to it, compared with the catenary at that point."

LENGTH, HALF_SPAN, WEIGHT = 2.5, 1.0, 98.1
SIZES = [0.2, 0.1, 0.05]


def parameter():
    """a of the catenary: 2 a sinh(1 / a) = length, by bisection."""
    low, high = 0.2, 10.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if 2 * middle * math.sinh(HALF_SPAN / middle) > LENGTH else (low, middle)
    return low


A = parameter()
SAG = A * (math.cosh(HALF_SPAN / A) - 1.0)


def runs(full):
    return [Run(f"{size:g}", {"grid.cell_size_m": size, "geotextiles.cable.segment_length_m": size,
                              "geotextiles.cable.gauge_length_m": size}, record=full,
                effort=3 * (0.1 / size) ** 2) for size in (SIZES if full else [0.1])]


def quantities(results, full):
    result = results["0.05" if full else "0.1"]
    end = result.last("end", "point_z_m")
    # The tension reported for a node is the mean of the segments that meet there; T = w (height above the directrix).
    exact_end = WEIGHT * (A + SAG + end)
    return [
        # 1 % is the bar of the issue; the cable's own stretch is 0.07 %.
        relative("sag", "default", -result.last("bottom", "lower_z_m"), SAG, "m", 0.01),
        relative("tension at the bottom", "default", result.last("bottom", "point_tension_n_per_m"), WEIGHT * A, "N/m", 0.01),
        relative("tension near the end", "default", result.last("end", "point_tension_n_per_m"), exact_end, "N/m", 0.01),
    ]


def convergence(results):
    return [Convergence("sag", "relative error", "", SIZES,
                        [abs(results[f"{size:g}"].last("bottom", "lower_z_m") / SAG + 1) for size in SIZES]),
            Convergence("tension at the bottom", "relative error", "", SIZES,
                        [abs(results[f"{size:g}"].last("bottom", "point_tension_n_per_m") / (WEIGHT * A) - 1)
                         for size in SIZES])]


def draw(results, path):
    with picture(path, 2) as (left, right):
        y = np.linspace(-1, 1, 200)
        left.plot(y, A * np.cosh(y / A) - A * math.cosh(HALF_SPAN / A), label="catenary", **REFERENCE)
        for colour, size in zip(COLOURS, SIZES):
            frames = results[f"{size:g}"].frames
            if frames:
                left.plot(*frames[-1]["geotextile/node"].T, ".", color=colour, markersize=4, label=f"dx = {size:g} m")
        left.set(xlabel="y [m]", ylabel="z [m]", aspect="equal")
        left.legend()
        draw_convergence(right, convergence(results))
