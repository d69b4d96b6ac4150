#!/usr/bin/python3
"""Two formulations of the geotextile where the tension is known, after section 3 of the founding paper.

Sweeps cell size and segment length (distance of the membrane points) on a cylinder under pressure, a hanging cable and a
fluid-filled tube. Writes membranes_exact.csv and membranes_exact.png; a part of `script/study membranes`. Every run has one
thread.

    error      mean over the sheet of tension over exact tension, less 1
    scatter    standard deviation of the same over the sheet: what a single segment may be off by
    length     of the line of points over the exact one, less 1: membrane points may part without a strain
"""

import argparse
import csv
import math
import os
import sys

import numpy as np
from tqdm import tqdm

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "test", "verification"))

from cases import fluid_tube, hanging_cable, pressurised_cylinder  # noqa: E402  (its folder is put on the path before)
from suite.drawing import COLOURS, STYLE, pyplot  # noqa: E402
from suite.run import Run, scene_path, simulate  # noqa: E402

COLUMNS = ["case", "formulation", "dx", "segment_length", "error", "scatter", "length_error", "tension_n_per_m",
           "balance_error", "user_cpu_s"]
FORMULATIONS = ["segments", "membrane_points"]
SIZES = [0.2, 0.1, 0.05]
SCENES = {"cylinder": ("pressurised_cylinder", "cylinder"), "cable": ("hanging_cable", "cable"), "tube": ("fluid_tube", "tube")}
# Segment length over cell size. A scene refuses fewer than two membrane points a cell.
RATIOS = {"segments": [0.25, 0.5, 1.0, 2.0], "membrane_points": [0.125, 0.25, 0.5]}
LENGTHS = {"cylinder": 2 * math.pi * pressurised_cylinder.RADIUS_AT_REST, "cable": hanging_cable.LENGTH * 1.0006,
           "tube": fluid_tube.LENGTH * (1 + fluid_tube.shape(0.05)[2] * fluid_tube.WEIGHT * fluid_tube.LENGTH**2 / 4e6)}


def overrides(case, sheet, formulation, dx, segment):
    keys = {"grid.cell_size_m": dx, f"geotextiles.{sheet}.segment_length_m": segment,
            f"geotextiles.{sheet}.formulation": formulation}
    if case != "cable":
        keys[f"geotextiles.{sheet}.gauge_length_m"] = max(0.5, segment)
    else:
        keys["geotextiles.cable.gauge_length_m"] = segment
    if case == "cylinder":
        keys.update({"numerics.damping_per_s": 300, "geotextiles.cylinder.inside_pressure.table": [[0, 0], [0.1, 1]]})
    return keys


def along_the_sheet(result):
    """Tension of every segment in the last frame, and where its middle is."""
    frame = result.frames[-1]
    ends = frame["geotextile/node"][frame["geotextile/connectivity"]]
    return frame["geotextile/tension"], ends.mean(axis=1)


def exact(case, place):
    if case == "cylinder":
        return np.full(len(place), pressurised_cylinder.TENSION)
    if case == "cable":
        return hanging_cable.WEIGHT * (hanging_cable.A + hanging_cable.SAG + place[:, 1])
    return np.full(len(place), fluid_tube.shape(0.05)[2] * fluid_tube.WEIGHT * fluid_tube.LENGTH**2)


def row(case, formulation, dx, segment, result, error=math.nan, scatter=math.nan, length=math.nan, tension=math.nan):
    balance = result.summary.get("energy", {}).get("relative_balance_error", math.nan)
    return {"case": case, "formulation": formulation, "dx": f"{dx:g}", "segment_length": f"{segment:g}",
            "error": f"{error:.3e}", "scatter": f"{scatter:.3e}", "length_error": f"{length:.3e}",
            "tension_n_per_m": f"{tension:.6g}", "balance_error": f"{balance:.1e}", "user_cpu_s": f"{result.user_cpu_s:.2f}"}


def run_exact(program, case, formulation, dx, segment):
    scene, sheet = SCENES[case]
    result = simulate(program, scene_path(scene), Run("", overrides(case, sheet, formulation, dx, segment), record=True))
    if result.stopped:
        return row(case, formulation, dx, segment, result)
    tension, place = along_the_sheet(result)
    ratio = tension / exact(case, place)
    probe = next(probe for probe in result.summary["probes"].values() if probe["kind"] == "geotextile")
    return row(case, formulation, dx, segment, result, ratio.mean() - 1, ratio.std(),
               probe["length_m"][-1] / LENGTHS[case] - 1, tension.mean())


def sweep(program, rows, write):
    """Runs what `rows` has not yet."""
    done = {(r["case"], r["formulation"], r["dx"], r["segment_length"]) for r in rows}
    todo = [(case, formulation, dx, ratio * dx) for case in SCENES for dx in SIZES for formulation in FORMULATIONS
            for ratio in RATIOS[formulation]]
    for case, formulation, dx, segment in tqdm(todo, unit="run", desc="exact cases", mininterval=0.0 if sys.stderr.isatty() else 30.0):
        if (case, formulation, f"{dx:g}", f"{segment:g}") not in done:
            rows.append(run_exact(program, case, formulation, dx, segment))
            write()


def draw(rows, path):
    markers = {0.125: "D", 0.25: "v", 0.5: "s", 1.0: "o", 2.0: "^"}
    plt = pyplot()
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(2, len(SCENES), figsize=(2.8 * len(SCENES), 5.2), constrained_layout=True)
        for axis, (what, case) in zip(axes.flat, [(what, case) for what in ("error", "scatter") for case in SCENES]):
            for colour, formulation in zip(COLOURS, FORMULATIONS):
                for ratio, marker in markers.items():
                    own = sorted((float(r["dx"]), abs(float(r[what]))) for r in rows
                                 if r["case"] == case and r["formulation"] == formulation
                                 and math.isclose(float(r["segment_length"]), ratio * float(r["dx"]), rel_tol=1e-3))
                    own = [(dx, value) for dx, value in own if value > 0.0]
                    if own:
                        axis.loglog(*zip(*own), marker=marker, color=colour, markersize=4, linewidth=0.9,
                                    label=f"{formulation.replace('_', ' ')}, l = {ratio:g} dx")
            axis.set(xlabel="cell size [m]", title=f"{case}: {what}")
            axis.set_xticks(SIZES, [f"{size:g}" for size in SIZES])
            axis.minorticks_off()
            axis.set_ylim(1e-5, 1.0)
        handles, labels = axes[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, fontsize=7, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=4)
        figure.savefig(path, bbox_inches="tight")
        plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--simulate", required=True, help="the program")
    parser.add_argument("--out", required=True, help="folder for membranes_exact.csv and .png")
    parser.add_argument("--kept", required=True, help="table of the runs that were made; they are not made again")
    arguments = parser.parse_args()
    rows = []
    if os.path.exists(arguments.kept):
        with open(arguments.kept, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))

    def write(path=arguments.kept):
        with open(path + ".part", "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        os.replace(path + ".part", path)

    sweep(os.path.abspath(arguments.simulate), rows, write)
    write(os.path.join(arguments.out, "membranes_exact.csv"))
    draw(rows, os.path.join(arguments.out, "membranes_exact.png"))


if __name__ == "__main__":
    main()
