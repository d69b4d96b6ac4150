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
# York's membrane points beside the default, segments; they need several a cell (docs/study/membranes.md).
FORMULATIONS = {"default": "segments", "membrane points": "membrane_points"}
SPACING = {"default": 1.0, "membrane points": 0.25}  # over the cell size


def parameter():
    """a of the catenary: 2 a sinh(1 / a) = length, by bisection."""
    low, high = 0.2, 10.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if 2 * middle * math.sinh(HALF_SPAN / middle) > LENGTH else (low, middle)
    return low


A = parameter()
SAG = A * (math.cosh(HALF_SPAN / A) - 1.0)
# Of T = w sqrt(a^2 + s^2) over the length.
MEAN = WEIGHT * (0.5 * math.hypot(A, LENGTH / 2) + A**2 / LENGTH * math.asinh(LENGTH / 2 / A))


def run(method, size, record):
    return Run(f"{method} {size:g}", {
        "grid.cell_size_m": size, "geotextiles.cable.segment_length_m": size * SPACING[method],
        "geotextiles.cable.gauge_length_m": size, "geotextiles.cable.formulation": FORMULATIONS[method]}, method, record=record, effort=3 * (0.1 / size) ** 2)


def runs(full):
    return [run(method, size, full) for method in FORMULATIONS for size in (SIZES if full else [0.1])]


def quantities(results, full):
    figures = []
    for method in FORMULATIONS:
        result = results[f"{method} {0.05 if full else 0.1:g}"]
        end = result.last("end", "point_z_m")
        # The tension reported for a node is the mean of the segments that meet there; T = w (height above the directrix).
        exact_end = WEIGHT * (A + SAG + end)
        figures += [
            # 1 % is the bar of the issue; the cable's own stretch is 0.07 %.
            relative("sag", method, -result.last("bottom", "lower_z_m"), SAG, "m", 0.01),
            relative("mean tension", method, result.last("bottom", "tension_mean_n_per_m"), MEAN, "N/m", 0.01),
        ]
        if method == "default":  # a single membrane point is off by a tenth
            bottom, near_end = (result.last(place, "point_tension_n_per_m") for place in ("bottom", "end"))
            figures += [relative("tension at the bottom", method, bottom, WEIGHT * A, "N/m", 0.01),
                        relative("tension near the end", method, near_end, exact_end, "N/m", 0.01)]
    return figures


def convergence(results):
    return [Convergence(f"{quantity}, {method}", "relative error", "", SIZES,
                        [abs(results[f"{method} {size:g}"].last("bottom", column) / exact - 1) for size in SIZES])
            for quantity, column, exact in (("sag", "lower_z_m", -SAG),
                                            ("tension at the bottom", "point_tension_n_per_m", WEIGHT * A),
                                            ("mean tension", "tension_mean_n_per_m", MEAN))
            for method in FORMULATIONS]


def draw(results, path):
    with picture(path, 2) as (left, right):
        y = np.linspace(-1, 1, 200)
        left.plot(y, A * np.cosh(y / A) - A * math.cosh(HALF_SPAN / A), label="catenary", **REFERENCE)
        for colour, size in zip(COLOURS, SIZES):
            frames = results[f"default {size:g}"].frames
            if frames:
                left.plot(*frames[-1]["geotextile/node"].T, ".", color=colour, markersize=4, label=f"dx = {size:g} m")
        left.set(xlabel="y [m]", ylabel="z [m]", aspect="equal")
        left.legend()
        draw_convergence(right, convergence(results))
