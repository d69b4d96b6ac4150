"""A block on each of two walls that open: the angle at which they start to slide."""

import math

import numpy as np

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import absolute
from suite.run import Run

TITLE = "Blocks on two opening walls"
SOURCE = "A block slides when its wall passes atan(mu); distance then grows with the cube of time"
REMARKS = """The walls start two degrees below the friction angle and turn at 1 deg/s. The start of sliding is read off the
motion by its closed form: acceleration g cos b (tan b - mu) grows linearly, so the distance is the cube of the time since
the start times g / (6 cos(atan mu)) per radian and second."""

GRAVITY, RATE, BELOW = 9.81, math.radians(1.0), math.radians(2.0)
COEFFICIENTS = [0.2, 0.4, 0.6]


def run(friction):
    slope = math.atan(friction) - BELOW
    overrides = {}
    for name, side in (("port", 1), ("starboard", -1)):
        direction = np.array([math.cos(slope), side * math.sin(slope)])  # towards +y along the wall
        pivot = np.array([1.5 * side, 0.0])
        overrides[f"surfaces.{name}.line_m"] = [list(pivot - 1.2 * direction), list(pivot + 1.2 * direction)]
        overrides[f"surfaces.{name}.friction"] = friction
        overrides[f"bodies.{name}.shape.box.rotation_deg"] = math.degrees(side * slope)
    return Run(f"{friction:g}", overrides, effort=3)


def runs(full):
    return [run(friction) for friction in (COEFFICIENTS if full else [0.4])]


def distances(result, name, side, friction):
    """Distance down the wall that the block has slid, as the wall sees it, m."""
    time = result.time(name)
    pivot = np.array([1.5 * side, 0.0])
    arm = np.column_stack([result.series(name, f"centroid_{axis}_m") for axis in "yz"]) - pivot
    slope = side * (math.atan(friction) - BELOW + RATE * time)
    along = np.column_stack([np.cos(slope), np.sin(slope)])
    position = np.sum(arm * along, axis=1)
    return time, -side * (position - position[0])


def sliding_angle(result, name, side, friction):
    """Slope of the wall when the block starts, deg: mean of what distances of 2, 5 and 10 mm say by the cube."""
    if result.stopped:
        return math.nan
    time, distance = distances(result, name, side, friction)
    factor = GRAVITY * RATE / (6 * math.cos(math.atan(friction)))
    starts = []
    for reached in (0.002, 0.005, 0.010):
        beyond = np.flatnonzero(distance > reached)
        if beyond.size == 0 or beyond[0] == 0:
            return math.nan
        i = beyond[0]
        at = time[i - 1] + (reached - distance[i - 1]) * (time[i] - time[i - 1]) / (distance[i] - distance[i - 1])
        starts.append(at - (reached / factor) ** (1 / 3))
    return math.degrees(math.atan(friction) - BELOW + RATE * float(np.mean(starts)))


def quantities(results, full):
    # 0.25 degrees is the bar of the issue.
    return [absolute(f"sliding angle, {name}, mu = {key}", "default",
                     sliding_angle(result, name, side, float(key)), math.degrees(math.atan(float(key))), "deg", 0.25)
            for key, result in results.items() for name, side in (("port", 1), ("starboard", -1))]


def draw(results, path):
    with picture(path, 1, (5.0, 3.2)) as (axis,):
        for i, (key, result) in enumerate(results.items()):
            time, distance = distances(result, "port", 1, float(key))
            slope = np.degrees(RATE * time - BELOW)
            axis.plot(slope, 1e3 * distance, color=COLOURS[i], label=f"mu = {key}")
            factor = GRAVITY * RATE / (6 * math.cos(math.atan(float(key))))
            axis.plot(slope, 1e3 * factor * np.maximum(time - BELOW / RATE, 0.0) ** 3, **REFERENCE)
        axis.set(xlabel="slope of the wall less atan(mu) [deg]", ylabel="distance slid [mm] (dashed: exact)",
                 ylim=(-0.5, 30))
        axis.legend()
