#!/usr/bin/python3
"""Run time against error: sweeps methods, cell size, particles per cell and time step factor over cases with a reference.

Every run has one thread; by default one runs at a time, so that user CPU times are not disturbed. Writes
docs/work-precision.csv, one log-log picture a case in docs/work-precision/ and docs/choosing.md.
"""

import argparse
import csv
import datetime
import math
import os
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Callable

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "test", "verification"))
sys.path.insert(0, os.path.join(ROOT, "bench"))

from accuracy import commit  # noqa: E402  (their folders are put on the path before)
from cases import (axis_aligned, block_on_incline, bui_collapse, disc_on_incline, pressurised_cylinder,  # noqa: E402
                   self_weight_column, vortex)
from suite import methods  # noqa: E402
from suite.drawing import COLOURS, picture  # noqa: E402
from suite.run import Run, scene_path, simulate, text  # noqa: E402

COLUMNS = ["case", "method", "dx", "ppc", "dt_factor", "error", "user_cpu_s", "particle_steps"]
DEFAULT_METHOD, DEFAULT_PARTICLES, DEFAULT_FACTOR = "bspline2 apic", 2, 0.8
# Swept one at a time about the default, for these methods.
PARTICLES, FACTORS = [1, 3, 4], [0.4, 1.0]
VARIED = [DEFAULT_METHOD, "linear flip cell_average"]
MARKERS = {1: "v", 2: "o", 3: "s", 4: "D"}
WANTED = [0.1, 0.05, 0.02, 0.01, 0.005]


@dataclass(frozen=True)
class Sweep:
    """A case as the sweep sees it. The error is relative to what `scale` says."""

    name: str
    scene: str
    body: str  # empty: the scene has only a sheet, and particles per cell are not swept
    sizes: list  # m, descending
    overrides: Callable  # (dx, particles per cell) -> scene keys
    error: Callable  # (result, dx, particles per cell) -> number
    scale: str
    record: bool = False
    consistent: bool = False  # consistent mass as well


def block_error(result, _dx, _particles):
    exact = 0.5 * block_on_incline.acceleration(0.3) * block_on_incline.TIME**2
    return abs(block_on_incline.slide(result, block_on_incline.TIME) / exact - 1)


def disc_error(result, _dx, _particles):
    along, _ = disc_on_incline.accelerations(0.5)
    exact = along * float(disc_on_incline.ramp_integral(disc_on_incline.TIME, disc_on_incline.RAMP))
    return abs(disc_on_incline.slide(result, disc_on_incline.TIME) / exact - 1)


def release_figures(result):
    """What a release is compared by: when, how strong, which shape; not where something is at some instant."""
    keys = ("release_time_s", "peak_tension_n_per_m", "container_width_m", "container_height_m")
    values = [result.summary.get(key) for key in keys]
    return [math.nan if value is None or isinstance(value, list) else float(value) for value in values]


def release_overrides(dx, _particles):
    return {"grid.cell_size_m": dx, "geotextiles.container.segment_length_m": dx, "time.end_s": 40}


def release_error(reference):
    def error(result, _dx, _particles):
        pairs = zip(release_figures(result), reference)
        return max(abs(value / exact - 1) for value, exact in pairs)

    return error


def sweeps(release_reference):
    return [
        Sweep("axis_aligned", scene_path("axis_aligned"), "square", [1 / 16, 1 / 32, 1 / 64],
              lambda dx, _: {"grid.cell_size_m": dx},
              lambda result, _dx, _n: axis_aligned.rms(result) / axis_aligned.AMPLITUDE, "the amplitude", consistent=True),
        Sweep("vortex", scene_path("vortex"), "ring", [0.1, 0.05, 0.025], lambda dx, _: {"grid.cell_size_m": dx},
              lambda result, _dx, _n: vortex.rms(result), "1 m, the ring's radius"),
        Sweep("self_weight_column", scene_path("self_weight_column"), "column", [0.1, 0.05, 0.025],
              lambda dx, _: {"grid.cell_size_m": dx}, lambda result, _dx, _n: self_weight_column.error(result), "the swing",
              consistent=True),
        Sweep("block_on_incline", scene_path("block_on_incline"), "block", [0.25, 0.1, 0.05],
              lambda dx, _: {"grid.cell_size_m": dx, "surfaces.plane.friction": 0.3}, block_error, "the distance, mu = 0.3"),
        Sweep("disc_on_incline", scene_path("disc_on_incline"), "disc", [0.1, 0.05, 0.025],
              lambda dx, _: {"grid.cell_size_m": dx, "surfaces.plane.friction": 0.5}, disc_error, "the distance, rolling"),
        Sweep("bui_collapse", scene_path("bui_collapse"), "column", [0.01, 0.006, 0.004],
              lambda dx, _: {"grid.cell_size_m": dx},
              lambda result, dx, _n: bui_collapse.rms(result, dx) / bui_collapse.HEIGHT,
              "the height; the measurement itself is good to about 0.02", record=True),
        Sweep("pressurised_cylinder", scene_path("pressurised_cylinder"), "", [0.2, 0.1, 0.05],
              lambda dx, _: {"grid.cell_size_m": dx, "geotextiles.cylinder.segment_length_m": dx},
              lambda result, _dx, _n: abs(2 * math.pi * pressurised_cylinder.breathing(result)
                                          / pressurised_cylinder.OMEGA - 1), "the breathing frequency"),
        Sweep("release", os.path.join(ROOT, "config", "scenes", "release.yaml"), "sand", [0.2, 0.1], release_overrides,
              release_error(release_reference), "the finest run: largest of release time, peak tension, width and height"),
    ]


def plan(sweep):
    """Settings of a case: every method at every size; particles and time step about the default."""
    names = list(methods.SWEEP) + (list(methods.CONSISTENT) if sweep.consistent else [])
    settings = [(name, dx, DEFAULT_PARTICLES, DEFAULT_FACTOR) for name in names for dx in sweep.sizes]
    for name in VARIED:
        if sweep.body:
            settings += [(name, dx, particles, DEFAULT_FACTOR) for particles in PARTICLES for dx in sweep.sizes]
        settings += [(name, dx, DEFAULT_PARTICLES, factor) for factor in FACTORS for dx in sweep.sizes]
    return settings


def measure(program, sweep, setting, limit_s):
    """One row of the table. A run that was stopped, or takes longer than the limit, has no error."""
    method, dx, particles, factor = setting
    overrides = {**sweep.overrides(dx, particles), **{**methods.SWEEP, **methods.CONSISTENT}[method],
                 "numerics.time_step_factor": factor}
    if sweep.body:
        overrides[f"bodies.{sweep.body}.particles_per_cell"] = particles
    result = simulate(program, sweep.scene, Run(text(list(setting)), overrides, method, sweep.record), limit_s)
    error = math.nan if result.stopped else float(sweep.error(result, dx, particles))
    return {"case": sweep.name, "method": method, "dx": dx, "ppc": particles, "dt_factor": factor, "error": error,
            "user_cpu_s": result.user_cpu_s, "particle_steps": result.particle_steps}


def finest_release(program, dx):
    result = simulate(program, os.path.join(ROOT, "config", "scenes", "release.yaml"),
                      Run("finest", release_overrides(dx, DEFAULT_PARTICLES)), 900.0)
    if result.stopped:
        print(f"the reference run of the release ended early: {result.stopped}")
        return [math.nan] * 4
    return release_figures(result)


def front(rows):
    """Rows that no other beats in both error and time, by time."""
    best, chosen = math.inf, []
    for row in sorted((row for row in rows if math.isfinite(row["error"])), key=lambda row: row["user_cpu_s"]):
        if row["error"] < best:
            best = row["error"]
            chosen.append(row)
    return chosen


def draw(sweep, rows, path):
    with picture(path, 1, (6.5, 4.2)) as (axis,):
        names = sorted({row["method"] for row in rows}, key=list({**methods.SWEEP, **methods.CONSISTENT}).index)
        for i, name in enumerate(names):
            own = [row for row in rows if row["method"] == name and math.isfinite(row["error"])]
            for particles, marker in MARKERS.items():
                some = [row for row in own if row["ppc"] == particles]
                axis.plot([row["user_cpu_s"] for row in some], [row["error"] for row in some], marker, markersize=4,
                          color=COLOURS[i % len(COLOURS)], markerfacecolor="none" if i >= len(COLOURS) else None,
                          label=name if particles == DEFAULT_PARTICLES else None)
        best = front(rows)
        axis.plot([row["user_cpu_s"] for row in best], [row["error"] for row in best], "k-", linewidth=1, zorder=0,
                  drawstyle="steps-post", label="Pareto front")
        axis.set(xscale="log", yscale="log", xlabel="user CPU time [s]", ylabel="error")
        axis.set_title(f"{sweep.name}: error over {sweep.scale}\n"
                       "particles per cell and direction: v 1, o 2, s 3, D 4", fontsize=9)
        axis.legend(fontsize=7)


def describe(row):
    return (f"{row['method']}, dx = {row['dx']:g} m, {row['ppc']} per direction, factor {row['dt_factor']:g}: "
            f"{row['user_cpu_s']:.2g} s")


def choosing(all_sweeps, rows, minutes):
    lines = ["# Choosing method and resolution", "", "<!-- Written by `script/bench work-precision`; its fixed part is bench/choosing_notes.md. Do not edit here. -->", ""]
    with open(os.path.join(ROOT, "bench", "choosing_notes.md"), encoding="utf-8") as file:
        lines += [file.read().strip(), ""]
    lines += ["## Cheapest run for a wanted error", "",
              f"From {len(rows)} runs on one thread at commit {commit()}, {datetime.date.today().isoformat()}, "
              f"{minutes:.0f} minutes ([work-precision.csv](work-precision.csv)). User CPU seconds.", "",
              "| case | " + " | ".join(f"{100 * wanted:g} %" for wanted in WANTED) + " |", "|---|" + "---|" * len(WANTED)]
    for sweep in all_sweeps:
        own = [row for row in rows if row["case"] == sweep.name]
        cells = []
        for wanted in WANTED:
            good = [row for row in own if row["error"] <= wanted]
            cells.append(describe(min(good, key=lambda row: row["user_cpu_s"])) if good else "-")
        lines.append(f"| {sweep.name} | " + " | ".join(cells) + " |")
    lines += ["", "## Methods side by side", "",
              "At the finest swept grid, 2 particles per cell and direction, time step factor 0.8: error (CPU seconds).", "",
              "| method | " + " | ".join(sweep.name for sweep in all_sweeps) + " |", "|---|" + "---|" * len(all_sweeps)]
    for name in {**methods.SWEEP, **methods.CONSISTENT}:
        cells = []
        for sweep in all_sweeps:
            found = [row for row in rows if row["case"] == sweep.name and row["method"] == name
                     and row["dx"] == sweep.sizes[-1] and row["ppc"] == DEFAULT_PARTICLES
                     and row["dt_factor"] == DEFAULT_FACTOR]
            cells.append("" if not found else "stopped" if not math.isfinite(found[0]["error"])
                         else f"{found[0]['error']:.2g} ({found[0]['user_cpu_s']:.2g})")
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    lines += ["", "## Particles per cell and time step, default method", "",
              "Error (CPU seconds) at the middle of the swept grids.", "",
              "| setting | " + " | ".join(sweep.name for sweep in all_sweeps) + " |", "|---|" + "---|" * len(all_sweeps)]
    for particles, factor in [(n, DEFAULT_FACTOR) for n in (1, 2, 3, 4)] + [(DEFAULT_PARTICLES, f) for f in FACTORS]:
        cells = []
        for sweep in all_sweeps:
            found = [row for row in rows if row["case"] == sweep.name and row["method"] == DEFAULT_METHOD
                     and row["dx"] == sweep.sizes[len(sweep.sizes) // 2 if len(sweep.sizes) > 2 else 0]
                     and row["ppc"] == particles and row["dt_factor"] == factor]
            cells.append("" if not found else "stopped" if not math.isfinite(found[0]["error"])
                         else f"{found[0]['error']:.2g} ({found[0]['user_cpu_s']:.2g})")
        lines.append(f"| {particles} per direction, factor {factor:g} | " + " | ".join(cells) + " |")
    lines += [""]
    for sweep in all_sweeps:
        lines += [f"![{sweep.name}](work-precision/{sweep.name}.png)", ""]
    return "\n".join(lines).rstrip() + "\n"


def write_csv(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--simulate", required=True, metavar="PATH", help="the program to run")
    parser.add_argument("--out", default=os.path.join(ROOT, "docs"), metavar="FOLDER")
    parser.add_argument("--case", action="append", help="only this one; may be given several times, needs --out")
    parser.add_argument("--processes", type=int, default=1, help="runs at a time; more than 1 disturbs the CPU times a little")
    parser.add_argument("--limit", type=float, default=60.0, metavar="S", help="a run that takes longer is given up")
    options = parser.parse_args()
    if options.case and os.path.abspath(options.out) == os.path.join(ROOT, "docs"):
        parser.error("--case needs another --out: the pages in docs/ are those of all cases")

    start = time.monotonic()
    wants_release = not options.case or "release" in options.case
    reference = finest_release(options.simulate, 0.05) if wants_release else [math.nan] * 4
    all_sweeps = [sweep for sweep in sweeps(reference) if not options.case or sweep.name in options.case]
    todo = [(sweep, setting) for sweep in all_sweeps for setting in plan(sweep)]
    rows = []
    with ThreadPoolExecutor(options.processes) as pool:
        work = pool.map(lambda pair: measure(options.simulate, *pair, options.limit), todo)
        for i, row in enumerate(work):
            rows.append(row)
            elapsed = time.monotonic() - start
            print(f"{i + 1}/{len(todo)}  {elapsed / 60:.1f} min, about {elapsed / (i + 1) * (len(todo) - i - 1) / 60:.1f} min left  "
                  f"{row['case']}: {row['method']} dx {row['dx']:g} ppc {row['ppc']} factor {row['dt_factor']:g}: "
                  f"error {row['error']:.3g}, {row['user_cpu_s']:.2f} s", flush=True)
    pictures = os.path.join(options.out, "work-precision")
    shutil.rmtree(pictures, ignore_errors=True)
    os.makedirs(pictures)
    for sweep in all_sweeps:
        draw(sweep, [row for row in rows if row["case"] == sweep.name], os.path.join(pictures, f"{sweep.name}.png"))
    write_csv(os.path.join(options.out, "work-precision.csv"), rows)
    with open(os.path.join(options.out, "choosing.md"), "w", encoding="utf-8") as file:
        file.write(choosing(all_sweeps, rows, (time.monotonic() - start) / 60))
    return 0


if __name__ == "__main__":
    sys.exit(main())
