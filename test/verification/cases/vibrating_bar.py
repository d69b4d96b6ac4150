"""A bar held at one end that starts with a uniform axial velocity."""

import numpy as np

from suite import methods
from suite.drawing import COLOURS, REFERENCE, draw_convergence, picture
from suite.quantity import at_least, relative
from suite.run import Run
from suite.series import Convergence, frequency

TITLE = "Vibrating bar"
SOURCE = "d'Alembert's solution of the fixed-free bar with uniform initial velocity"
REMARKS = """A scene gives a body one initial velocity, so the bar carries all its odd modes at once; the position of its
centroid, to which mode n contributes as 1/n^3, is compared. The high modes are lost to dispersion and to the transfer's
dissipation: the energy falls."""

LENGTH, SPEED, VELOCITY = 25.0, 10.0, 0.1
PERIOD = 4 * LENGTH / SPEED
AMPLITUDE = VELOCITY * LENGTH / (2 * SPEED)
SIZES = [1.0, 0.5, 0.25]
METHODS = {"default": methods.DEFAULT, "linear flip": methods.STANDARD}


def centroid(time):
    """Displacement of the centroid: arcs of parabolas, from the mean velocity v0 (1 - c t / L) of the first half
    period."""
    half = PERIOD / 2
    within = np.mod(time, half)
    sign = np.where(np.mod(np.floor(np.asarray(time) / half), 2) == 0, 1.0, -1.0)
    return sign * VELOCITY * (within - SPEED * within**2 / (2 * LENGTH))


def run(method, size):
    # The transverse size is two cells.
    return Run(f"{method} {size:g}",
               {"grid.cell_size_m": size, "grid.upper_m": [27, 2 * size],
                "bodies.bar.shape": {"box": {"lower_m": [0, 0], "upper_m": [LENGTH, 2 * size]}}, **METHODS[method]},
               method, effort=(0.5 / size) ** 2)


def runs(full):
    return [run(method, size) for method in (METHODS if full else ["default"]) for size in (SIZES if full else [0.5])]


def displacement(result):
    y = result.series("bar", "centroid_y_m")
    return result.time("bar"), y - (y[0] if y.size else 0.0)


def error(result):
    """Root mean square over five periods, over the amplitude."""
    if result.stopped:
        return float("nan")
    time, moved = displacement(result)
    return float(np.sqrt(np.mean((moved - centroid(time)) ** 2)) / AMPLITUDE)


def quantities(results, full):
    size = 0.25 if full else 0.5
    result = results[f"default {size:g}"]
    time, moved = displacement(result)
    figures = [
        # 50 cells along the bar: a mode of that wave length disperses by (k h)^2 / 24, far below 0.2 %.
        relative("frequency", "default", frequency(time, moved), 1 / PERIOD, "Hz", 0.002),
        # Amplitude of the last period; the transfer dissipates the high modes only.
        relative("amplitude after four periods", "default", float(np.max(np.abs(moved[time > 40.0]), initial=0.0)),
                 AMPLITUDE, "m", 0.03),
    ]
    if full:
        figures.append(at_least("order of the centroid's error", "default", convergence(results)[0].order, 1.0))
    return figures


def convergence(results):
    return [Convergence(method, "RMS error of the centroid over its amplitude", "", SIZES,
                        [error(results[f"{method} {size:g}"]) for size in SIZES]) for method in METHODS]


def draw(results, path):
    with picture(path, 2, (5.0, 3.2)) as (left, right):
        time = np.linspace(0, 50, 1000)
        left.plot(time, centroid(time), label="exact", **REFERENCE)
        for colour, method in zip(COLOURS, METHODS):
            left.plot(*displacement(results[f"{method} 0.25"]), color=colour, linewidth=0.9, label=method)
        left.set(xlabel="time [s]", ylabel="displacement of the centroid [m]")
        left.legend()
        draw_convergence(right, convergence(results))
