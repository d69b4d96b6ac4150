"""Generalized vortex: a neo-Hookean ring sheared in itself by 1 rad."""

import numpy as np

from suite import methods
from suite.drawing import COLOURS, draw_convergence, picture
from suite.quantity import at_least, shown
from suite.run import Run
from suite.series import Convergence

TITLE = "Manufactured solution, generalized vortex"
SOURCE = "Kamojjala, Brannon, Sadeghirad and Guilkey 2015, Eng. Comput. 31:341"
REMARKS = """The shear within the ring reaches 6, which pulls neighbours of a lattice with two by two particles a cell three
cells apart: at dx = 0.0125 m what is left there of the sums over particles is all that is left of the error. With four by
four, which the case has, order is second throughout. `shape: gimp` (not shown) is not made for this: its upright boxes neither shear nor turn, so they
do not tile the ring. With four by four its error is 15 mm at dx = 0.025 m, the default's 7 mm, and its order is first; with
two by two and three by three the ring tears and the run is stopped. Standard linear MPM is shown beside the default; at a twist of 1 rad
every particle crosses many cells."""

SIZES = [0.1, 0.05, 0.025, 0.0125]
METHODS = {"default": methods.DEFAULT, "default, 2x2 a cell": {"bodies.ring.particles_per_cell": 2},
           "linear flip": {**methods.STANDARD, "bodies.ring.particles_per_cell": 2}}


def run(method, size):
    return Run(f"{method} {size:g}", {"grid.cell_size_m": size, **METHODS[method]}, method, effort=(0.05 / size) ** 3)


def runs(full):
    return [run(method, size) for method in (METHODS if full else ["default"])
            for size in (SIZES if full else SIZES[:3])]


def rms(result):
    """Largest over half a period of the root-mean-square distance of the particles from the solution, m."""
    return float("nan") if result.stopped else float(np.max(result.series("error", "error_rms_m")))


def series(results, method, sizes):
    return Convergence(method, "RMS distance from the solution", "m", sizes,
                       [rms(results[f"{method} {size:g}"]) for size in sizes])


def quantities(results, full):
    sizes = SIZES if full else SIZES[:3]
    # The bar of the issue.
    figures = [at_least("observed order, RMS", "default", series(results, "default", sizes).order, 1.7)]
    if full:
        figures += [shown("RMS distance at dx = 0.0125 m", method, rms(results[f"{method} 0.0125"]), 0.0, "m", False)
                    for method in METHODS]
    return figures


def convergence(results):
    return [series(results, method, SIZES) for method in METHODS]


def draw(results, path):
    with picture(path, 2) as (left, right):
        for colour, method in zip(COLOURS, METHODS):
            result = results[f"{method} 0.025"]
            left.plot(result.time("error"), result.series("error", "error_rms_m"), color=colour, label=method)
        left.set(xlabel="time [s]", ylabel="RMS distance [m], dx = 0.025 m", yscale="log")
        left.legend()
        draw_convergence(right, convergence(results))
