"""A smooth hinged plate is turned into sand: exact positions, work against torque, energy closed."""

import math

import numpy as np

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import at_most, relative
from suite.run import Run

TITLE = "Rotating plate of boundary particles"
SOURCE = "Rigid rotation; work = integral of torque over angle; balance of energy"
REMARKS = """The torque is that of the material on the plate, sampled 500 times a second; the work is the solver's own sum
over every step."""

ANGLE = math.radians(-10)


def runs(full):
    return [Run("plate", {"grid.cell_size_m": 0.025} if full else {}, record=True, effort=6)]


def positions_error(result):
    """Largest distance of a boundary particle from the rigid rotation of where it started, over all frames, m."""
    if not result.frames:
        return math.nan
    start = result.frames[0]["surface/position"]
    # The plate's particles are those that move at all; the bed follows the same file.
    moving = np.max(np.abs(result.frames[-1]["surface/position"] - start), axis=1) > 0.0
    moving |= np.hypot(start[:, 0], start[:, 1]) < 1e-12
    worst = 0.0
    for frame in result.frames:
        angle = ANGLE * min(max((frame["time"] - 0.1) / 0.8, 0.0), 1.0)
        rotation = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        moved = start[moving] @ rotation.T
        worst = max(worst, float(np.max(np.abs(frame["surface/position"][moving] - moved))))
    return worst


def quantities(results, full):
    result = results["plate"]
    moment, angle = result.series("plate", "moment_n"), result.series("plate", "angle_rad")
    # The plate's work on the sand is minus that of the sand's moment on the plate; each sample is the mean since the one
    # before, and the plate turns evenly in between.
    integral = -float(np.sum(moment[1:] * np.diff(angle))) if angle.size else math.nan
    work = result.last("plate", "work_j_per_m")
    energy = result.summary.get("energy", {})
    return [
        # Round-off of a rotation by sine and cosine.
        at_most("boundary particles, distance from the rigid rotation", "default", positions_error(result), 1e-12, "m"),
        relative("angle at the end", "default", result.last("plate", "angle_rad"), ANGLE, "rad", 1e-12),
        # 1 % is the bar of the issue.
        relative("work of the plate against the torque integral", "default", work, integral, "J/m", 0.01),
        at_most("energy balance of the whole, relative", "default",
                energy.get("relative_balance_error", math.nan), 0.01, ""),
    ]


def draw(results, path):
    result = results["plate"]
    with picture(path, 2) as (left, right):
        angle, moment = result.series("plate", "angle_rad"), result.series("plate", "moment_n")
        left.plot(-np.degrees(angle), moment, color=COLOURS[0], linewidth=0.6)
        left.set(xlabel="rotation [deg]", ylabel="moment of the sand on the plate [N]")
        work = np.concatenate([[0.0], -np.cumsum(moment[1:] * np.diff(angle))])
        right.plot(result.time("plate"), result.series("plate", "work_j_per_m"), color=COLOURS[0], label="work, every step")
        right.plot(result.time("plate"), work, label="torque integral", **REFERENCE)
        right.set(xlabel="time [s]", ylabel="work on the sand [J/m]")
        right.legend()
