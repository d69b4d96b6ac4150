#!/usr/bin/python3
"""What the builds of two compilers make of the same scenes: the largest distance of any point after about 1000 steps.

Writes a table, relative to the largest coordinate. Ends with status 1 where it is above 1e-9.
"""

import argparse
import os
import sys

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "test", "verification"))

import cases  # noqa: E402  (its folder is put on the path before)
from suite.run import Run, scene_path, simulate  # noqa: E402

WANTED_STEPS, MOST = 1000, 1e-9
# A finer grid where the whole scene has fewer steps.
FINER = {"two_discs": {"grid.cell_size_m": 0.00625}}


def run(program, scene, end_s, more):
    overrides = {"time.end_s": end_s, "time.output_interval_s": end_s, "numerics.skip_resting": False, **more}
    return simulate(program, scene, Run(os.path.basename(scene), overrides, record=True))


def end_of_steps(program, scene, more):
    """Simulated time of about the wanted number of steps."""
    end_s = 0.02
    for _ in range(8):
        result = run(program, scene, end_s, more)
        if result.stopped:  # too far: what leaves the grid at last
            end_s *= 0.5
            continue
        steps = result.summary["steps"]
        if abs(steps - WANTED_STEPS) < 0.1 * WANTED_STEPS:
            break
        end_s *= WANTED_STEPS / max(steps, 1)
    return end_s


def distance(one, other):
    """Of the last frames' points, over the largest coordinate."""
    names = [name for name in one.frames[-1] if name.endswith(("/position", "/node"))]
    pairs = [(one.frames[-1][name], other.frames[-1][name]) for name in names]
    return max(float(np.max(np.abs(a - b)) / np.max(np.abs(a))) for a, b in pairs if a.size)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--simulate", required=True, nargs=2, metavar="PATH", help="the programs of the two builds")
    programs = parser.parse_args().simulate
    scenes = {name: scene_path(name) for name in cases.NAMES}
    scenes["release"] = os.path.join(ROOT, "config", "scenes", "release.yaml")
    worst = 0.0
    print("| scene | steps | largest distance |\n|---|---|---|")
    for name, scene in scenes.items():
        more = FINER.get(name, {})
        end_s = end_of_steps(programs[0], scene, more)
        one, other = (run(program, scene, end_s, more) for program in programs)
        if one.stopped or other.stopped:
            sys.exit(f"{name}: {one.stopped or other.stopped}")
        apart = distance(one, other)
        worst = max(worst, apart)
        print(f"| {name} | {one.summary['steps']}, {other.summary['steps']} | {apart:.1e} |", flush=True)
    return 0 if worst <= MOST else 1


if __name__ == "__main__":
    sys.exit(main())
