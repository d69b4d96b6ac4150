"""Runs `simulate` on a scene and reads what it left."""

import json
import os
import subprocess
import tempfile
import threading
from dataclasses import dataclass, field

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
SCENES = os.path.join(ROOT, "config", "scenes", "verification")


@dataclass(frozen=True)
class Run:
    """One run that a case wants: `key` is how the case finds its result again."""

    key: str
    overrides: dict = field(default_factory=dict)  # dotted scene key -> number, text, list or dict
    method: str = "default"  # for tables
    record: bool = False  # keep the particles of all frames
    effort: float = 1.0  # rough share of the whole, for the remaining time of script/bench


class Result:
    """What a run left. A run that the solver had to stop has what it produced until then, and `stopped` says why."""

    def __init__(self, run, status, message, summary, user_cpu_s, frames):
        self.run, self.status, self.summary, self.user_cpu_s, self.frames = run, status, summary, user_cpu_s, frames
        self.stopped = "" if status == 0 else message or f"exit status {status}"

    @property
    def method(self):
        return self.run.method

    @property
    def particle_steps(self):
        return self.summary.get("particles", 0) * self.summary.get("steps", 0)

    def series(self, probe, column):
        """A column of a probe over all its samples; empty where the run left none."""
        values = self.summary.get("probes", {}).get(probe, {})
        if values and column not in values:
            raise KeyError(f"probe {probe} has no column {column}, it has {', '.join(values)}")
        # null stands for a number that is not finite.
        return np.array([np.nan if value is None else value for value in values.get(column, [])], dtype=float)

    def time(self, probe):
        return self.series(probe, "time_s")

    def at(self, probe, column, time_s):
        """Value at an instant, between samples linearly; not a number when the run was stopped before."""
        time = self.time(probe)
        if time.size == 0 or time_s > time[-1] + 1e-9:
            return float("nan")
        return float(np.interp(time_s, time, self.series(probe, column)))

    def last(self, probe, column):
        """Value at the end; not a number when the run was stopped before."""
        return float("nan") if self.stopped else float(self.series(probe, column)[-1])

    def mean(self, probe, column, from_s, to_s=np.inf):
        """Mean over the samples in a span of time."""
        time = self.time(probe)
        chosen = (time >= from_s - 1e-9) & (time <= to_s)
        return float("nan") if self.stopped or not chosen.any() else float(np.mean(self.series(probe, column)[chosen]))


def text(value):
    """A Python value as the YAML that --set takes."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {text(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(text(item) for item in value) + "]"
    if isinstance(value, (int, np.integer, str)):
        return str(value)
    return repr(float(value))


def scene_path(case):
    return os.path.join(SCENES, f"{case}.yaml")


def simulate(program, scene, run, limit_s=900.0):
    """Runs one scene on one thread, in a folder that is gone afterwards, and measures its own user CPU time."""
    with tempfile.TemporaryDirectory(prefix="verification_") as folder:
        summary_path, record_path = os.path.join(folder, "summary.json"), os.path.join(folder, "record.h5")
        command = [program, scene, "--threads", "1", "--summary", summary_path]
        if run.record:
            command += ["--record", record_path]
        for key, value in run.overrides.items():
            command += ["--set", f"{key}={text(value)}"]
        with open(os.path.join(folder, "output"), "w+", encoding="utf-8") as output:
            process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
            timer = threading.Timer(limit_s, process.kill)
            timer.start()
            # wait4 instead of wait: the child's own CPU time, whatever runs beside it.
            _, wait_status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(wait_status)
            in_time = timer.is_alive()
            timer.cancel()
            output.seek(0)
            lines = output.read().strip().splitlines()
        # The line that says why, among the report's; it is for pages that are read elsewhere.
        message = next((line for line in lines if line.startswith("simulate: ")), lines[-1] if lines else "")
        message = message.replace(ROOT + os.sep, "")
        if process.returncode == 2:
            raise SystemExit(f"{os.path.basename(scene)} ({run.key}): {message}")
        if process.returncode < 0:
            message = f"ended by signal {-process.returncode}" if in_time else f"given up after {limit_s:g} s"
        summary = {}
        if os.path.exists(summary_path):
            with open(summary_path, encoding="utf-8") as file:
                summary = json.load(file)
        frames = read_frames(record_path) if run.record else []
        return Result(run, process.returncode, message, summary, usage.ru_utime, frames)


def read_frames(path):
    """Every frame of a record: time, and per group what it holds, in the plane (y, z)."""
    import h5py  # only records need it

    if not os.path.exists(path):
        return []
    with h5py.File(path, "r") as record:
        return [read_frame(frame) for frame in record["frames"].values()]


def read_frame(frame):
    values = {"time": float(frame["time"][()])}
    for group in ("soil", "geotextile", "surface", "hull"):
        for name, data in frame.get(group, {}).items():
            array = data[()]
            # Points are x, y, z in the record; x is 0 in a slice.
            values[f"{group}/{name}"] = array[:, 1:] if array.ndim == 2 and array.shape[1] == 3 else array
    return values
