"""Collapse of sand columns of many slendernesses: exponents of run-out and height."""

import numpy as np

from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import absolute, at_least, shown
from suite.run import Run

TITLE = "Granular columns of many slendernesses"
SOURCE = "Lube, Huppert, Sparks and Freundt 2005, Phys. Rev. E 72:041301: fits to experiments, one-sided plane flow"
REMARKS = """The exponents are fits to experiments with many sands; their factors depend on the sand and are shown, not
judged. Low columns end on their static slope, run-out h0 / (2 tan phi) = 0.83 a at a = 0.5, and overrun it more and more
as they grow: steeper than the fit. Tall ones run too far: the model has no grain size and its friction does not grow with
the rate of shearing, while a fast, thin front of real grains (inertial number above 0.3) is held by just that (MiDi 2004,
Eur. Phys. J. E 14:341; Lagree, Staron and Popinet 2011, J. Fluid Mech. 686:378). Smaller time steps and coarser grids
shorten the run-out, by the transfer's dissipation: neither is a remedy."""

WIDTH = 0.1
SLENDERNESS = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0]


def run(a, size):
    # Room for 1.5 times the fitted run-out.
    room = size * np.ceil(WIDTH * (2.0 + 1.5 * float(run_out_fit(a))) / size)
    return Run(f"{a:g}", {"grid.cell_size_m": size, "grid.upper_m": [room, size * np.ceil((a * WIDTH + 0.05) / size)],
                          "bodies.column.shape": {"box": {"lower_m": [0, 0], "upper_m": [WIDTH, a * WIDTH]}},
                          # Ten times the fall through the column's height is more than the collapse takes.
                          "time.end_s": float(max(1.0, 10 * np.sqrt(2 * a * WIDTH / 9.81)))},
               record=True, effort=a * (0.01 / size) ** 3)


def run_out_fit(a):
    a = np.asarray(a, dtype=float)
    return np.where(a < 2.3, 1.2 * a, 1.9 * a ** (2 / 3))


def height_fit(a):
    a = np.asarray(a, dtype=float)
    return np.where(a < 1.15, a, 0.65 * a ** 0.4)


def runs(full):
    return [run(a, 0.005 if full else 0.0125) for a in SLENDERNESS if full or a in (1.0, 2.0, 4.0, 8.0)]


def extent(result):
    """Run-out over the initial width, less 1, of the heap up to its first gap, and final height over the initial width."""
    if result.stopped:
        return float("nan"), float("nan")
    position = result.frames[-1]["soil/position"]
    # Single grains that have left the heap do not count: the heap ends where there is nothing for a cell.
    beyond = np.sort(position[position[:, 0] > WIDTH, 0])
    gap = np.flatnonzero(np.diff(beyond) > result.run.overrides["grid.cell_size_m"])
    return float(beyond[gap[0]] if gap.size else beyond[-1]) / WIDTH - 1.0, float(np.max(position[:, 1])) / WIDTH


def exponent(a, values):
    return float(np.polyfit(np.log(a), np.log(values), 1)[0]) if np.all(np.isfinite(values)) else float("nan")


def quantities(results, full):
    slenderness = [float(key) for key in results]
    values = {a: extent(results[f"{a:g}"]) for a in slenderness}
    low = [a for a in slenderness if a <= 2.0]
    high = [a for a in slenderness if a >= 3.0]
    growth = exponent(low, [values[a][0] for a in low]), exponent(high, [values[a][0] for a in high])
    # Two regimes, the exponent lower in the second; by half of what the fits say.
    figures = [at_least("exponent of the run-out falls from a <= 2 to a >= 3 by", "default", growth[0] - growth[1], 1 / 6)]
    if not full:
        return figures
    figures += [
        # 0.15: half the distance between the exponents of the two regimes (1 and 2/3), so that they are told apart.
        absolute("exponent of the run-out, a <= 2", "default", growth[0], 1.0, "", 0.15),
        absolute("exponent of the run-out, a >= 3", "default", growth[1], 2 / 3, "", 0.15),
        absolute("exponent of the height, a >= 2", "default",
                 exponent([2.0] + high, [values[a][1] for a in [2.0] + high]), 0.4, "", 0.15),
    ]
    for a in slenderness:
        figures.append(shown(f"run-out (d - d0) / d0, a = {a:g}", "default", values[a][0], float(run_out_fit(a)), ""))
        figures.append(shown(f"height h / d0, a = {a:g}", "default", values[a][1], float(height_fit(a)), ""))
    return figures


def draw(results, path):
    with picture(path, 2) as (left, right):
        a = np.array([float(key) for key in results])
        values = np.array([extent(result) for result in results.values()])
        fine = np.geomspace(0.4, 10, 200)
        for axis, column, fit, label in ((left, 0, run_out_fit, "(d - d0) / d0"), (right, 1, height_fit, "h / d0")):
            axis.loglog(fine, fit(fine), label="Lube et al. 2005, fit", **REFERENCE)
            axis.loglog(a, values[:, column], "o", color=COLOURS[0], label="computed")
            axis.set(xlabel="a = h0 / d0", ylabel=label)
            axis.legend()
