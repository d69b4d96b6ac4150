"""Transverse vibration of a stretched sheet."""

import math

import numpy as np

from suite.drawing import COLOURS, REFERENCE, draw_convergence, picture
from suite.quantity import relative
from suite.run import Run
from suite.series import Convergence, frequency

TITLE = "Stretched string"
SOURCE = "f1 = sqrt(T / m) / (2 L); d'Alembert's triangle wave of the middle"
REMARKS = """The string starts with one velocity everywhere and so with all odd modes; the transfer takes the high ones, the
corners of the triangle round off. The frequency is that of the passages through zero."""

TENSION, MASS, LENGTH, VELOCITY = 1000.0, 1.0, 2.0, 0.1
SPEED = math.sqrt(TENSION / MASS)
FREQUENCY = SPEED / (2 * LENGTH)
SIZES = [0.2, 0.1, 0.05]


def runs(full):
    return [Run(f"{size:g}", {"grid.cell_size_m": size, "geotextiles.string.segment_length_m": size},
                effort=(0.1 / size) ** 2) for size in (SIZES if full else [0.1])]


def observed(result):
    z = result.series("middle", "point_z_m")
    return frequency(result.time("middle"), z)


def quantities(results, full):
    result = results["0.05" if full else "0.1"]
    return [
        # 1 % is the bar of the issue.
        relative("frequency", "default", observed(result), FREQUENCY, "Hz", 0.01),
        relative("mean tension", "default", result.mean("middle", "tension_mean_n_per_m", 0.0), TENSION, "N/m", 0.01),
    ]


def convergence(results):
    return [Convergence("default", "relative error of the frequency", "", SIZES,
                        [abs(observed(results[f"{size:g}"]) / FREQUENCY - 1) for size in SIZES])]


def draw(results, path):
    with picture(path, 2) as (left, right):
        time = np.linspace(0, 1.3, 2000)
        period = 1 / FREQUENCY
        phase = np.mod(time + period / 4, period)
        exact = VELOCITY * np.where(phase < period / 2, phase - period / 4, 0.75 * period - phase)
        left.plot(time, 1e3 * exact, label="exact", **REFERENCE)
        for colour, size in zip(COLOURS, SIZES):
            result = results[f"{size:g}"]
            left.plot(result.time("middle"), 1e3 * result.series("middle", "point_z_m"), color=colour, linewidth=0.8,
                      label=f"dx = {size:g} m")
        left.set(xlabel="time [s]", ylabel="middle [mm]", xlim=(0, 0.6))
        left.legend()
        draw_convergence(right, convergence(results))
