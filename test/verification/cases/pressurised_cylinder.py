"""Circular sheet under inside pressure: tension at rest and breathing frequency."""

import math

import numpy as np

from suite.drawing import COLOURS, REFERENCE, draw_convergence, picture
from suite.quantity import relative
from suite.run import Run
from suite.series import Convergence, frequency

TITLE = "Pressurised cylinder of geotextile"
SOURCE = "T = p R in the deformed state; linear equation of the breathing ring with follower pressure"
REMARKS = """Hencky's circular sheet (a clamped disc that bulges) is a three-dimensional case and is not done."""

PRESSURE, STIFFNESS, MASS, RADIUS = 1000.0, 1e5, 0.84, 1.0
RADIUS_AT_REST = RADIUS / (1 - PRESSURE * RADIUS / STIFFNESS)
TENSION = PRESSURE * RADIUS_AT_REST
OMEGA = math.sqrt(STIFFNESS / (MASS * RADIUS**2) - PRESSURE / (MASS * RADIUS))
SIZES = [0.2, 0.1, 0.05]
# York's membrane points beside the default, segments; they need several a cell (docs/study/membranes.md).
FORMULATIONS = {"default": "segments", "membrane points": "membrane_points"}
SPACING = {"default": 1.0, "membrane points": 0.25}  # over the cell size


def run(method, kind, size):
    overrides = {"grid.cell_size_m": size, "geotextiles.cylinder.segment_length_m": size * SPACING[method],
                 "geotextiles.cylinder.formulation": FORMULATIONS[method]}
    if kind == "static":
        overrides.update({"numerics.damping_per_s": 300, "geotextiles.cylinder.inside_pressure.table": [[0, 0], [0.1, 1]]})
    return Run(f"{method} {kind} {size:g}", overrides, method, effort=(0.1 / size) ** 2)


def runs(full):
    return [run(method, kind, size) for method in FORMULATIONS for kind in ("static", "dynamic")
            for size in (SIZES if full else [0.1])]


def radius(result):
    """Of the circle with the enclosed area, m."""
    return np.sqrt(result.series("cylinder", "area_m2") / math.pi)


def breathing(result):
    return frequency(result.time("cylinder"), radius(result) - RADIUS_AT_REST)


def quantities(results, full):
    size = 0.05 if full else 0.1
    figures = []
    for method in FORMULATIONS:
        static, dynamic = results[f"{method} static {size:g}"], results[f"{method} dynamic {size:g}"]
        mean, largest = (static.last("cylinder", f"tension_{kind}_n_per_m") for kind in ("mean", "max"))
        figures += [
            # 1 % and 2 % are the bars of the issue. The polygon of n chords costs (pi / n)^2 / 6: 0.04 % at dx = 0.1 m.
            relative("tension at rest, mean", method, mean, TENSION, "N/m", 0.01),
            relative("tension at rest, largest", method, largest, TENSION, "N/m", 0.01),
            relative("breathing frequency", method, breathing(dynamic), OMEGA / (2 * math.pi), "Hz", 0.02),
        ]
    return figures


def convergence(results):
    exact = OMEGA / (2 * math.pi)

    def at_rest(method, size):
        return results[f"{method} static {size:g}"].last("cylinder", "tension_mean_n_per_m") / TENSION - 1

    return [Convergence(f"{quantity}, {method}", "relative error", "", SIZES,
                        [abs(error(method, size)) for size in SIZES])
            for quantity, error in (
                ("tension at rest", at_rest),
                ("breathing frequency",
                 lambda method, size: breathing(results[f"{method} dynamic {size:g}"]) / exact - 1))
            for method in FORMULATIONS]


def draw(results, path):
    with picture(path, 2) as (left, right):
        time = np.linspace(0, 0.2, 800)
        exact = RADIUS_AT_REST + (RADIUS - RADIUS_AT_REST) * np.cos(OMEGA * time)
        left.plot(1e3 * time, 1e3 * (exact - RADIUS), label="exact", **REFERENCE)
        for colour, size in zip(COLOURS, SIZES):
            result = results[f"default dynamic {size:g}"]
            left.plot(1e3 * result.time("cylinder"), 1e3 * (radius(result) - RADIUS), color=colour, linewidth=0.8,
                      label=f"dx = {size:g} m")
        left.set(xlabel="time [ms]", ylabel="growth of the radius [mm]", xlim=(0, 100))
        left.legend()
        draw_convergence(right, convergence(results))
