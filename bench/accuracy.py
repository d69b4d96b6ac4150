#!/usr/bin/python3
"""Runs every verification case at its published resolution and writes docs/verification.md, .csv and pictures."""

import argparse
import csv
import datetime
import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "test", "verification"))

import cases  # noqa: E402  (its folder is put on the path before)
from suite.run import Result, scene_path, simulate  # noqa: E402

COLUMNS = ["case", "method", "quantity", "value", "reference", "unit", "error", "tolerance", "pass"]


def commit():
    """Of the working tree; `+` where it has changes that matter to the figures."""
    try:
        name = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True,
                              check=True).stdout.strip()
        dirty = subprocess.run(["git", "-C", ROOT, "status", "--porcelain", "src", "include", "config", "test/verification"],
                               capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return name + ("+" if dirty else "")


class Progress:
    """One line: what is done, and how long the rest will take at the pace so far."""

    def __init__(self, total):
        self.total, self.done, self.start = total, 0.0, time.monotonic()

    def step(self, effort, what):
        self.done += effort
        elapsed = time.monotonic() - self.start
        left = elapsed * (self.total - self.done) / self.done
        end = "\n" if not sys.stdout.isatty() else "\r"
        print(f"{100 * self.done / self.total:5.1f} %  {elapsed / 60:5.1f} min, about {left / 60:.1f} min left  {what[:70]:70}",
              end=end, flush=True)


def run_all(program, names, processes):
    """Results by case and key. Longest first, so that both processes end together."""
    wanted = [(name, run) for name in names for run in cases.load(name).runs(True)]
    wanted.sort(key=lambda pair: -pair[1].effort)
    progress = Progress(sum(run.effort for _, run in wanted))
    results = {name: {} for name in names}
    with ThreadPoolExecutor(processes) as pool:
        futures = {pool.submit(simulate, program, scene_path(name), run): (name, run) for name, run in wanted}
        for future in as_completed(futures):
            name, run = futures[future]
            try:
                results[name][run.key] = future.result()
            except SystemExit as error:  # a scene that the program refuses; the page says so and goes on
                results[name][run.key] = Result(run, 2, str(error), {}, 0.0, [])
            progress.step(run.effort, f"{name}: {run.key}")
    # In the order in which the case asked for them.
    return {name: {run.key: results[name][run.key] for run in cases.load(name).runs(True)} for name in names}


def number(value):
    return f"{value:.5g}"


def shown_error(quantity, value):
    return f"{100 * value:.3g} %" if quantity.relative else f"{value:.3g} {quantity.unit}".strip()


def verdict(quantity):
    return "" if not quantity.judged else "yes" if quantity.passed else "**no**"


def quantity_table(figures):
    lines = ["| quantity | method | value | reference | unit | error | tolerance | met |", "|---|---|---|---|---|---|---|---|"]
    for q in figures:
        tolerance = shown_error(q, q.tolerance) if q.judged else "shown"
        lines.append(f"| {q.name} | {q.method} | {number(q.value)} | {number(q.reference)} | {q.unit} | "
                     f"{shown_error(q, q.error)} | {tolerance} | {verdict(q)} |")
    return lines


def convergence_table(all_series):
    lines = ["| " + " | ".join(["method", "quantity"] + [f"dx = {dx:g} m" for dx in all_series[0].dx] + ["order"]) + " |"]
    lines.append("|" + "---|" * (len(all_series[0].dx) + 3))
    for one in all_series:
        steps = [float("nan")] + one.steps()
        cells = [number(error) + ("" if step != step else f" ({step:.2f})") for error, step in zip(one.error, steps)]
        lines.append(f"| {one.method} | {one.quantity}{', ' + one.unit if one.unit else ''} | " + " | ".join(cells)
                     + f" | {one.order:.2f} |")
    return lines


def section(name, results, figures, series, has_picture):
    case = cases.load(name)
    cpu = sum(result.user_cpu_s for result in results.values())
    lines = [f"## {case.TITLE}", "", f"{case.__doc__.strip()} Source: {case.SOURCE}.",
             f"Scene: [{name}.yaml](../config/scenes/verification/{name}.yaml); {len(results)} runs, {cpu:.0f} s of CPU time.", ""]
    if has_picture:
        lines += [f"![{case.TITLE}](verification/{name}.png)", ""]
    lines += quantity_table(figures) + [""]
    if series:
        lines += ["Error over cell size, order from each to the next in brackets:", ""] + convergence_table(series) + [""]
    stopped = [f"{key}: {result.stopped}" for key, result in results.items() if result.stopped]
    if stopped:
        lines += ["Runs that ended early:", ""] + [f"- {line}" for line in stopped] + [""]
    missed = [q.name for q in figures if not q.passed]
    if missed:
        lines += [f"Not met: {'; '.join(missed)}.", ""]
    if case.REMARKS.strip():
        lines += [case.REMARKS.strip(), ""]
    return lines


def evaluate(name, results):
    """Figures and convergence."""
    case = cases.load(name)
    figures = case.quantities(results, True)
    series = case.convergence(results) if hasattr(case, "convergence") else []
    return figures, series


def write_csv(path, figures):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for name, quantities in figures.items():
            for q in quantities:
                writer.writerow([name, q.method, q.name, repr(float(q.value)), repr(float(q.reference)), q.unit,
                                 repr(float(q.error)), repr(float(q.tolerance)) if q.judged else "",
                                 ("true" if q.passed else "false") if q.judged else ""])


def page(figures, sections, minutes):
    judged = [q for quantities in figures.values() for q in quantities if q.judged]
    met = sum(q.passed for q in judged)
    lines = ["# Verification", "", "<!-- Written by `script/bench accuracy`; its fixed parts are bench/verification_notes.md and the",
             "     REMARKS of test/verification/cases/. Do not edit here. -->", "",
             f"Written by `script/bench accuracy` at commit {commit()} on {datetime.date.today().isoformat()}, "
             f"{minutes:.0f} minutes. The figures are in [verification.csv](verification.csv).", "",
             f"**{met} of {len(judged)} bounds are met.** Figures without a bound are shown for comparison.", "",
             "| case | bounds met | not met |", "|---|---|---|"]
    for name, quantities in figures.items():
        missed = "; ".join(f"{q.name} ({q.method})" for q in quantities if not q.passed)
        count = [q.passed for q in quantities if q.judged]
        title = cases.load(name).TITLE
        anchor = "".join(c for c in title.lower().replace(" ", "-") if c.isalnum() or c == "-")
        lines.append(f"| [{title}](#{anchor}) | {sum(count)} of {len(count)} | {missed} |")
    with open(os.path.join(ROOT, "bench", "verification_notes.md"), encoding="utf-8") as file:
        lines += ["", file.read().strip(), ""]
    return "\n".join(lines + sections).rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--simulate", required=True, metavar="PATH", help="the program to run")
    parser.add_argument("--out", default=os.path.join(ROOT, "docs"), metavar="FOLDER", help="where page, CSV and pictures go")
    parser.add_argument("--case", action="append", choices=cases.NAMES, help="only this one; may be given several times")
    parser.add_argument("--processes", type=int, default=2, help="runs at a time, one thread each")
    options = parser.parse_args()
    names = options.case or cases.NAMES
    if options.case and os.path.abspath(options.out) == os.path.join(ROOT, "docs"):
        parser.error("--case needs another --out: the page in docs/ is that of all cases")

    start = time.monotonic()
    results = run_all(options.simulate, names, options.processes)
    pictures = os.path.join(options.out, "verification")
    shutil.rmtree(pictures, ignore_errors=True)
    os.makedirs(pictures)
    figures, sections = {}, []
    for name in names:
        figures[name], series = evaluate(name, results[name])
        has_picture = not all(result.stopped for result in results[name].values())
        if has_picture:
            cases.load(name).draw(results[name], os.path.join(pictures, f"{name}.png"))
        sections += section(name, results[name], figures[name], series, has_picture)
    write_csv(os.path.join(options.out, "verification.csv"), figures)
    with open(os.path.join(options.out, "verification.md"), "w", encoding="utf-8") as file:
        file.write(page(figures, sections, (time.monotonic() - start) / 60))
    missed = [(name, q) for name, quantities in figures.items() for q in quantities if not q.passed]
    for name, q in missed:
        print(f"not met: {name}: {q.name} [{q.method}]: {number(q.value)} against {number(q.reference)} {q.unit}")
    print(f"{options.out}/verification.md: {len(missed)} bounds not met")
    return 0


if __name__ == "__main__":
    sys.exit(main())
