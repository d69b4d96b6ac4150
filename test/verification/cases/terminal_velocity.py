"""A body falls through deep water: terminal velocity and the way to it."""

import math

import numpy as np

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import relative
from suite.run import Run

TITLE = "Terminal velocity"
SOURCE = "v = v_t tanh(t / tau), v_t = sqrt(2 (rho - rho_w) g A / (rho_w Cd b)), tau = v_t / a_0"
REMARKS = ""

GRAVITY, DENSITY, WATER, END = 9.81, 1500.0, 1000.0, 3.0
BOX = {"box": {"lower_m": [-0.3, -0.15], "upper_m": [0.3, 0.15]}}
# Area, m2, and width across the motion, m.
SHAPES = {"disc": (math.pi * 0.25**2, 0.5), "box": (0.18, 0.6)}
CASES = {"disc, Ca = 0": ("disc", 0.0, 1.0), "disc, Ca = 1": ("disc", 1.0, 1.0), "box, Ca = 2, Cd = 2": ("box", 2.0, 2.0)}


def closed_form(key):
    """Terminal velocity and the time to it."""
    shape, added, drag = CASES[key]
    area, width = SHAPES[shape]
    terminal = math.sqrt(2 * (DENSITY - WATER) * GRAVITY * area / (WATER * drag * width))
    return terminal, terminal * (DENSITY + added * WATER) / ((DENSITY - WATER) * GRAVITY)


def runs(full):
    size = 0.025 if full else 0.05
    made = []
    for key, (shape, added, drag) in CASES.items():
        values = {"water.added_mass_coefficient": added, "water.drag_coefficient": drag, "grid.cell_size_m": size}
        if shape == "box":
            values["bodies.disc.shape"] = BOX
        made.append(Run(key, values, effort=4 if full else 1))
    return made


def quantities(results, full):
    figures = []
    for key, result in results.items():
        terminal, tau = closed_form(key)
        for time in (0.5 * tau, tau, END):
            # 3 % is the bar of the issue.
            figures.append(relative(f"velocity after {time:.2f} s, {key}", "default",
                                    -result.at("disc", "velocity_z_m_per_s", time), terminal * math.tanh(time / tau),
                                    "m/s", 0.03))
        figures.append(relative(f"fall in {END:g} s, {key}", "default",
                                result.at("disc", "centroid_z_m", 0.0) - result.at("disc", "centroid_z_m", END),
                                terminal * tau * math.log(math.cosh(END / tau)), "m", 0.03))
    return figures


def draw(results, path):
    with picture(path, 1, (5.0, 3.2)) as (axis,):
        for i, (key, result) in enumerate(results.items()):
            terminal, tau = closed_form(key)
            time = result.time("disc")
            axis.plot(time, -result.series("disc", "velocity_z_m_per_s"), color=COLOURS[i], label=key)
            axis.plot(time, terminal * np.tanh(time / tau), **REFERENCE)
        axis.set(xlabel="time [s]", ylabel="velocity of fall [m/s] (dashed: exact)")
        axis.legend()
