"""Capstan: a sheet drawn over a drum against a dead load."""

import math

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import relative
from suite.run import Run

TITLE = "Capstan"
SOURCE = "Euler and Eytelwein: T2 / T1 = exp(mu b)"
REMARKS = ""

LOAD, WRAP = 1000.0, math.pi
COEFFICIENTS = [0.1, 0.2, 0.4]
SLIDING_FROM = 2.5  # s: the sheet slides over the whole drum


def run(friction, size):
    return Run(f"{friction:g}", {
        "grid.cell_size_m": size, "geotextiles.sheet.segment_length_m": size,
        "surfaces.drum.friction": friction}, effort=3)


def runs(full):
    return [run(friction, 0.05 if full else 0.1) for friction in (COEFFICIENTS if full else [0.2])]


def quantities(results, full):
    figures = []
    for key, result in results.items():
        left = result.mean("left", "point_tension_n_per_m", SLIDING_FROM)
        right = result.mean("right", "point_tension_n_per_m", SLIDING_FROM)
        # 5 % is the bar of the issue: the wrap angle is uncertain by about a cell over the radius at each end.
        figures.append(relative(f"T2 / T1, mu = {key}", "default", left / right, math.exp(float(key) * WRAP), "", 0.05))
        # The dead load itself; the gauge averages over tension that is the same all along the tail.
        figures.append(relative(f"T1, mu = {key}", "default", right, LOAD, "N/m", 0.02))
    return figures


def draw(results, path):
    with picture(path, 1, (5.0, 3.2)) as (axis,):
        for i, (key, result) in enumerate(results.items()):
            axis.plot(result.time("left"), result.series("left", "point_tension_n_per_m"), color=COLOURS[i],
                      label=f"left, mu = {key}")
            axis.axhline(LOAD * math.exp(float(key) * WRAP), **REFERENCE)
        key = next(iter(results))
        axis.plot(results[key].time("right"), results[key].series("right", "point_tension_n_per_m"), color="#888888",
                  label="right (dead load)")
        axis.set(xlabel="time [s]", ylabel="tension [N/m] (dashed: exact)")
        axis.legend()
