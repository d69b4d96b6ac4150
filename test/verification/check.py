#!/usr/bin/python3
"""Runs one verification case coarsely and compares its figures with their references; a test of ctest."""

import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import cases  # noqa: E402  (its folder is put on the path before)
from suite.run import scene_path, simulate  # noqa: E402


def line(quantity):
    scale, unit = (100.0, "%") if quantity.relative else (1.0, quantity.unit)
    verdict = "ok" if quantity.passed else "FAILED"
    if not quantity.judged:
        verdict = "shown"
    tolerance = f" (at most {scale * quantity.tolerance:.3g})" if quantity.judged else ""
    return (f"{verdict:6} {quantity.name} [{quantity.method}]: {quantity.value:.6g} {quantity.unit}, "
            f"reference {quantity.reference:.6g}, error {scale * quantity.error:.3g} {unit}{tolerance}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", choices=cases.NAMES)
    parser.add_argument("--simulate", required=True, metavar="PATH", help="the program to run")
    parser.add_argument("--full", action="store_true", help="at the resolutions of docs/verification.md")
    parser.add_argument("--draw", metavar="FILE.png", help="the case's picture; needs --full")
    options = parser.parse_args()
    if options.draw and not options.full:
        parser.error("--draw needs --full")

    case = cases.load(options.case)
    results, seconds = {}, 0.0
    for run in case.runs(options.full):
        results[run.key] = simulate(options.simulate, scene_path(options.case), run)
        seconds += results[run.key].user_cpu_s
        if results[run.key].stopped:
            print(f"stopped: {run.key}: {results[run.key].stopped}")
    figures = case.quantities(results, options.full)
    for quantity in figures:
        print(line(quantity))
    if options.full and hasattr(case, "convergence"):
        for series in case.convergence(results):
            pairs = ", ".join(f"{dx:g} m: {error:.3g}" for dx, error in zip(series.dx, series.error))
            print(f"       {series.quantity} [{series.method}]: {pairs}; order {series.order:.2f}")
    if options.draw:
        case.draw(results, options.draw)
    print(f"{options.case}: {len(results)} runs, {seconds:.1f} s of CPU time")
    return 0 if all(quantity.passed for quantity in figures) else 1


if __name__ == "__main__":
    sys.exit(main())
