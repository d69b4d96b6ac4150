"""Oedometer at large strain: a laterally held column under 20 kPa."""

import math

from suite import methods
from suite.drawing import COLOURS, REFERENCE, draw_convergence, picture
from suite.quantity import relative, within
from suite.run import Run
from suite.series import Convergence

TITLE = "Oedometer, large strain"
SOURCE = "Anura3D Verification Manual (2021); closed form: strain is uniform"
REMARKS = """Linear triangles without a remedy carry the error of this case that the manual reports for the original
method: particles of the compressed column cross cells, a cell then holds one row of them less than the next, and forces
jump. The mean stress of an element, integrated over the whole element wherever it is about full, cures it. Linear
triangles have three by three particles a cell here, 4.5 a triangle, as the sources have: with two by two, so few rows
are left in a compressed cell that the remedy leaves tens of per cent."""

LOAD = 20e3
HEIGHT = 1.0
OEDOMETRIC = 1e5 * (1 - 0.2) / ((1 + 0.2) * (1 - 2 * 0.2))
# sigma = Ec ln(stretch): uniform stretch exp(-load / Ec), whatever the point.
EXACT = math.exp(-LOAD / OEDOMETRIC) - 1.0

SIZES = [0.1, 0.05, 0.025]
METHODS = {"default": methods.DEFAULT, "linear flip cell_average": methods.CELL_AVERAGE,
           "linear flip": methods.STANDARD}


def run(method, size):
    rows = 2 if method == "default" else 3
    # The uppermost row of particles; the very surface is not followed well.
    return Run(f"{method} {size:g}", {"grid.cell_size_m": size, "bodies.column.particles_per_cell": rows,
                                      "probes.top.point.at_m": [0.05, HEIGHT - 0.5 * size / rows], **METHODS[method]},
               method, effort=(0.05 / size) ** 3)


def runs(full):
    return [run(method, size) for method in METHODS for size in (SIZES if full else [0.05])]


def settlement(result):
    """Of the top of the column, m, positive upwards: that of its uppermost particles, carried on by the uniform strain."""
    return result.last("top", "displacement_z_m") * HEIGHT / result.run.overrides["probes.top.point.at_m"][1]


def quantities(results, full):
    size = 0.025 if full else 0.05
    figures = []
    # 1 % and 2 % are the bars of the issue; the manual's own remedied method is at 1.9 %.
    for method, tolerance in (("default", 0.01), ("linear flip cell_average", 0.02)):
        value = settlement(results[f"{method} {size:g}"])
        figures.append(relative("displacement of the top", method, value, EXACT, "m", tolerance))
    # The manual's original MPM errs by 46 %; how much depends on where its particles happen to cross, so only the class
    # of the error is asserted.
    value = abs(settlement(results[f"linear flip {size:g}"]) / EXACT - 1.0)
    figures.append(within("error of the displacement, standard MPM", "linear flip", value, 0.2, 0.8))
    stress = results[f"default {size:g}"].last("column", "stress_zz_pa")
    figures.append(relative("mean vertical stress", "default", stress, -LOAD, "Pa", 0.01))
    return figures


def convergence(results):
    return [Convergence(method, "relative error of the displacement", "", SIZES,
                        [abs(settlement(results[f"{method} {size:g}"]) / EXACT - 1) for size in SIZES])
            for method in METHODS]


def draw(results, path):
    with picture(path, 2) as (left, right):
        for colour, method in zip(COLOURS, METHODS):
            result = results[f"{method} 0.025"]
            left.plot(result.time("top"), result.series("top", "displacement_z_m"), color=colour, label=method)
        left.axhline(EXACT, label="exact, at rest", **REFERENCE)
        left.set(xlabel="time [s]", ylabel="displacement of the top [m]")
        left.legend()
        draw_convergence(right, convergence(results))
