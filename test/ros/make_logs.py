#!/usr/bin/python3
"""Makes the short logs of the rostests and the state in which the offline program ends with each: FOLDER/<log>.bag and
FOLDER/<log>.json. Fails when one and two threads end differently.

    make_logs.py FOLDER SCENE.yaml SIMULATE
"""
import json
import os
import subprocess
import sys

LOGS = {"hull_opening": [], "joint_states": ["--joint-states"], "faults": ["--faults"]}
LENGTH_S = "6"


def main():
    folder, scene, simulate = sys.argv[1:]
    here = os.path.dirname(os.path.abspath(__file__))
    generator = os.path.join(here, "..", "..", "config", "logs", "make_log.py")
    os.makedirs(folder, exist_ok=True)
    for log, options in LOGS.items():
        prefix = os.path.join(folder, log)
        subprocess.run([sys.executable, generator, "--short", LENGTH_S, "--output", prefix] + options, check=True)
        digests = set()
        for threads in ("1", "2"):
            subprocess.run([simulate, scene, "--bag", prefix + ".bag", "--threads", threads,
                            "--summary", prefix + ".json"], check=True)
            with open(prefix + ".json", encoding="utf-8") as file:
                digests.add(json.load(file)["digest"])
        if len(digests) != 1:
            sys.exit(f"{log}: one and two threads end in different states: {digests}")


if __name__ == "__main__":
    main()
