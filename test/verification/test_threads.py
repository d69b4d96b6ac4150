"""Every scene gives the same bits on one and on two threads."""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from suite.run import ROOT

# Enough for every part of a scene to act, short enough for all scenes to take some seconds.
PART_OF_THE_RUN = 0.1


def digest(program, scene, threads, until_s):
    with tempfile.TemporaryDirectory(prefix="threads_") as folder:
        summary = Path(folder) / "summary.json"
        subprocess.run([program, scene, "--threads", str(threads), "--until", f"{until_s}", "--summary", summary],
                       check=True, stdout=subprocess.DEVNULL)
        result = json.loads(summary.read_text())
    return result["digest"], result["steps"]


def end_s(scene):
    for line in scene.read_text().splitlines():
        if line.strip().startswith("end_s:"):
            return float(line.split(":")[1].split("#")[0])
    raise SystemExit(f"{scene}: no end_s")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--simulate", required=True)
    program = parser.parse_args().simulate
    differ = []
    for scene in sorted((Path(ROOT) / "config/scenes/verification").glob("*.yaml")):
        until_s = PART_OF_THE_RUN * end_s(scene)
        one, two = (digest(program, scene, threads, until_s) for threads in (1, 2))
        print(f"{scene.stem:24}{one[1]:7} steps  {one[0]}  {'same' if one == two else 'DIFFERENT: ' + two[0]}")
        if one != two:
            differ.append(scene.stem)
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
