"""An initially slack sheet carries nothing until it is taut."""

import math

import numpy as np

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import at_most, relative
from suite.run import Run
from suite.series import onset

TITLE = "Initially slack sheet"
SOURCE = "Free ring under pressure, closed form in the scene's comment; the question is that of York et al. 1999"
REMARKS = ""

PRESSURE, MASS, RADIUS, STIFFNESS, SLACK = 1000.0, 20.0, 1.0, 1e6, 0.05
OWN = RADIUS * (1 + SLACK)
RATE = math.sqrt(PRESSURE / (MASS * OWN))
TAUT = math.acosh(1 + SLACK) / RATE
# Speed at which the ring becomes taut, and the tension that its kinetic energy alone would raise: the scale of tension.
SPEED = RADIUS * RATE * math.sinh(RATE * TAUT)
PEAK = SPEED * math.sqrt(STIFFNESS * MASS)


def runs(full):
    size = 0.05 if full else 0.1
    return [Run("ring", {"grid.cell_size_m": size, "geotextiles.ring.segment_length_m": size})]


def quantities(results, full):
    result = results["ring"]
    time, tension = result.time("ring"), result.series("ring", "tension_max_n_per_m")
    before = float(np.max(tension[time < 0.97 * TAUT], initial=0.0)) if time.size else math.nan
    # 1 % of the peak: from there on the ring is taut by 0.1 of the smallest strain that matters.
    taut = onset(time, result.series("ring", "tension_mean_n_per_m"), 0.01 * PEAK)
    radius = math.sqrt(result.at("ring", "area_m2", 0.8 * TAUT) / math.pi)
    return [
        # Nothing at all: segments that are shorter than their own length have no force. Up to 97 % of the time, so that
        # 3 % of unevenness of the grid's motion are allowed for.
        at_most("largest tension before it is taut", "default", before, 0.0, "N/m"),
        # 2 %: the time is that of a free flight on the grid.
        relative("time at which it becomes taut", "default", taut, TAUT, "s", 0.02),
        relative("radius at 80 % of that time", "default", radius, RADIUS * math.cosh(RATE * 0.8 * TAUT), "m", 0.001),
    ]


def draw(results, path):
    result = results["ring"]
    with picture(path, 2) as (left, right):
        time = result.time("ring")
        free = np.linspace(0, TAUT, 200)
        left.plot(1e3 * time, np.sqrt(result.series("ring", "area_m2") / math.pi), color=COLOURS[0], label="default")
        left.plot(1e3 * free, RADIUS * np.cosh(RATE * free), label="exact, slack", **REFERENCE)
        left.axhline(OWN, color="#888888", linewidth=0.8, label="taut")
        left.set(xlabel="time [ms]", ylabel="radius [m]")
        left.legend()
        right.plot(1e3 * time, result.series("ring", "tension_max_n_per_m"), color=COLOURS[0], label="largest tension")
        right.axvline(1e3 * TAUT, label="exact onset", **REFERENCE)
        right.set(xlabel="time [ms]", ylabel="tension [N/m]")
        right.legend()
