"""A block on a plane of 30 degrees, all coefficients of friction from 0 to 1."""

import math

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import at_most, relative
from suite.run import Run

TITLE = "Block on an incline"
SOURCE = "Coulomb friction on a rigid block: s = (g/2)(sin a - mu cos a) t^2"
REMARKS = """The block has a little material damping (stiffness-proportional). Without it an elastic block under Coulomb
friction flutters from about mu = 0.5 on this slope, a known instability of the continuum (Adams 1995; Martins et al.
1995), and slips some per cent too far; the closed form is that of a rigid block, which cannot flutter."""

GRAVITY, SLOPE, TIME = 9.81, math.radians(30), 1.2
COEFFICIENTS = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]


def acceleration(friction):
    return GRAVITY * max(0.0, math.sin(SLOPE) - friction * math.cos(SLOPE))


def runs(full):
    return [Run(f"{mu:g}", {"surfaces.plane.friction": mu}, effort=2) for mu in (COEFFICIENTS if full else [0.0, 0.3, 0.7])]


def slide(result, time):
    """Distance down the plane that the centroid has moved, m."""
    y, z = (result.at("block", f"centroid_{axis}_m", time) - result.at("block", f"centroid_{axis}_m", 0.0)
            for axis in "yz")
    return y * math.cos(SLOPE) - z * math.sin(SLOPE)


def quantities(results, full):
    figures = []
    for key, result in results.items():
        mu = float(key)
        if acceleration(mu) > 0.0:
            # 1 % is the bar of the issue.
            figures.append(relative(f"distance after {TIME} s, mu = {key}", "default", slide(result, TIME),
                                    0.5 * acceleration(mu) * TIME**2, "m", 0.01))
        else:
            # "No creep": a micrometre in 0.6 s is a tenth of a millionth of the block per second.
            figures.append(at_most(f"creep from 0.6 to {TIME} s, mu = {key}", "default",
                                   slide(result, TIME) - slide(result, 0.6), 1e-6, "m"))
    return figures


def draw(results, path):
    with picture(path, 1, (5.0, 3.4)) as (axis,):
        for i, (key, result) in enumerate(results.items()):
            time = result.time("block")
            axis.plot(time, [slide(result, t) for t in time], color=COLOURS[i % 6], label=f"mu = {key}")
            axis.plot(time, 0.5 * acceleration(float(key)) * time**2, **REFERENCE)
        axis.set(xlabel="time [s]", ylabel="distance down the plane [m] (dashed: exact)")
        axis.legend(ncol=2)
