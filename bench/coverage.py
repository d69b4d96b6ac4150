#!/usr/bin/python3
"""Do the ensemble's bands hold what they promise? Truths are drawn from the distributions that the ensemble is drawn from;
80 % of them should lie between its P10 and P90. Writes docs/coverage.csv.

    coverage.py --simulate PROGRAM [--truths 50 --members 16 --ensembles 5]
"""
import argparse
import csv
import os
import subprocess
import tempfile

import numpy as np
import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FIGURES = {"peak_tension_n_per_m": "peak tension", "release_time_s": "release time", "container_width_m": "final width"}
FINE = ["grid.cell_size_m=0.2", "geotextiles.container.segment_length_m=0.2"]
RUN = ["time.end_s=32"]


def coarse():
    with open(os.path.join(ROOT, "config", "forecast.yaml"), encoding="utf-8") as file:
        return yaml.safe_load(file)["forecast"]["ensemble"]["scene_overrides"]


def ensemble(simulate, members, seed, overrides):
    """Figures of the members that completed, by name; what was not within the run is infinite."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "members.csv")
        command = [simulate, os.path.join(ROOT, "config/scenes/release.yaml"), "--ensemble", str(members), "--seed", str(seed),
                   "--distributions", os.path.join(ROOT, "config/ensembles/release.yaml"), "--members", path,
                   "--angles", os.path.join(ROOT, "config/logs/release.csv")]
        for override in overrides + RUN:
            command += ["--set", override]
        subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        with open(path, encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["ending"] == "completed"]
    return {name: np.array([float(row[name]) if row[name] else np.inf for row in rows]) for name in FIGURES}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--simulate", required=True, metavar="PROGRAM")
    parser.add_argument("--truths", type=int, default=50)
    parser.add_argument("--members", type=int, default=16)
    parser.add_argument("--ensembles", type=int, default=5, help="ensembles of different seeds; their mean is what is reported")
    parser.add_argument("--out", default=os.path.join(ROOT, "docs", "coverage.csv"), metavar="FILE")
    options = parser.parse_args()
    truths = {"the members' cells": ensemble(options.simulate, options.truths, 1001, coarse()),
              "cells of 0.2 m": ensemble(options.simulate, options.truths, 1001, FINE)}
    bands = [ensemble(options.simulate, options.members, seed, coarse()) for seed in range(1, options.ensembles + 1)]
    rows = []
    for name, figure in FIGURES.items():
        for where, truth in truths.items():
            inside = [np.mean((truth[name] >= low) & (truth[name] <= high)) for low, high in
                      (np.quantile(band[name], [0.1, 0.9], method="weibull") for band in bands)]  # as ensemble::quantile
            rows.append({"figure": figure, "truths": f"{len(truth[name])} on {where}", "covered": f"{np.mean(inside):.2f}",
                         "least": f"{min(inside):.2f}", "most": f"{max(inside):.2f}"})
            print(rows[-1])
    with open(options.out, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
