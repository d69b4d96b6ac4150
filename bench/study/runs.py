"""Runs the rows of studies: in parallel, each once. What has been computed is kept, and found again by what it was
computed from: scene, changed keys, log of angles and program."""

import hashlib
import json
import os
import shutil
import signal
import subprocess
import threading
from concurrent.futures import ThreadPoolExecutor, as_completed

from sweep import fingerprint, scene_value

COMPLETED, BAD_INPUT, STOPPED = 0, 2, 3


class Interrupted(Exception):
    """The user wants to stop."""


def program_files(program):
    """The program and its own shared library, if the build has one."""
    listed = subprocess.run(["ldd", program], capture_output=True, text=True, check=False).stdout
    paths = [line.split("=>")[1].split("(")[0].strip() for line in listed.splitlines() if "=>" in line]
    return [program] + [path for path in paths if os.path.basename(path).startswith("libgeocontainer_mpm")]


class Cache:
    """Folder of finished runs. A run's folder appears at once and whole; one that was interrupted leaves none."""

    def __init__(self, folder, program, record):
        self.folder, self.program, self.record = folder, program, record
        self.version = fingerprint(*program_files(program))
        os.makedirs(folder, exist_ok=True)

    def folder_of(self, study, row):
        inputs = [self.version, "with record" if self.record else "without", fingerprint(study.scene),
                  fingerprint(study.angles) if study.angles else "",
                  json.dumps({key: scene_value(value) for key, value in row.overrides.items()})]
        return os.path.join(self.folder, hashlib.sha256("\n".join(inputs).encode()).hexdigest()[:24])


class Result:
    """What a run left."""

    def __init__(self, folder, status, why, user_cpu_s):
        self.status, self.why, self.user_cpu_s = status, why, user_cpu_s
        self.summary, self.record = {}, None
        if folder is None:
            return
        summary, record = os.path.join(folder, "summary.json"), os.path.join(folder, "record.h5")
        if os.path.exists(summary):
            with open(summary, encoding="utf-8") as file:
                self.summary = json.load(file)
        self.record = record if os.path.exists(record) else None

    @property
    def completed(self):
        return self.status == COMPLETED


def kept(folder):
    """The result of a finished run, or None."""
    try:
        with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
            run = json.load(file)
    except (OSError, ValueError):
        return None
    return Result(folder, run["status"], run["why"], run["user_cpu_s"])


class Runner:
    """Computes what is not there yet. `stop()` ends the runs in progress; nothing of them is kept."""

    def __init__(self, cache):
        self.cache, self.record = cache, cache.record
        self.running, self.lock, self.stopped = set(), threading.Lock(), False

    def stop(self):
        with self.lock:
            self.stopped = True
            for process in self.running:
                process.terminate()

    def command(self, study, row, folder):
        command = [self.cache.program, study.scene, "--threads", "1", "--summary", os.path.join(folder, "summary.json")]
        if self.record:
            command += ["--record", os.path.join(folder, "whole.h5")]
        if study.angles:
            command += ["--angles", study.angles]
        for key, value in row.overrides.items():
            command += ["--set", f"{key}={scene_value(value)}"]
        return command

    def run(self, study, row):
        final = self.cache.folder_of(study, row)
        if (result := kept(final)) is not None:
            return result
        folder = f"{final}.{os.getpid()}.{threading.get_ident()}.part"
        os.makedirs(folder)
        try:
            return self.compute(study, row, folder, final)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def compute(self, study, row, folder, final):
        status, user_cpu_s, lines = self.execute(self.command(study, row, folder))
        # The line that says why, among the report's.
        why = next((line for line in lines if line.startswith("simulate: ")), lines[-1] if lines else "")
        why = why.removeprefix("simulate: ").replace(study.scene, os.path.basename(study.scene))
        if self.stopped:
            raise Interrupted
        if status < 0:
            return Result(None, status, f"ended by signal {signal.Signals(-status).name}", user_cpu_s)
        if status not in (COMPLETED, STOPPED):
            return Result(None, status, why, user_cpu_s)
        if self.record and os.path.exists(os.path.join(folder, "whole.h5")):
            from thinning import thin  # matplotlib takes a second

            thin(os.path.join(folder, "whole.h5"), os.path.join(folder, "record.h5"))
            for name in ("whole.h5", "whole.xdmf"):
                os.remove(os.path.join(folder, name))
        with open(os.path.join(folder, "run.json"), "w", encoding="utf-8") as file:
            json.dump({"status": status, "why": "" if status == COMPLETED else why, "user_cpu_s": user_cpu_s,
                       "label": row.label}, file)
        shutil.rmtree(final, ignore_errors=True)
        os.rename(folder, final)
        return kept(final)

    def execute(self, command):
        """Exit status (negative: a signal), user CPU time, lines of output."""
        with self.lock:
            if self.stopped:
                raise Interrupted
            # Its own session: Ctrl-C is ours to pass on.
            process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                       stdin=subprocess.DEVNULL, text=True, start_new_session=True)
            self.running.add(process)
        output = process.stdout.read()
        process.stdout.close()
        # wait4 instead of wait: the child's own CPU time, whatever runs beside it.
        _, wait_status, usage = os.wait4(process.pid, 0)
        with self.lock:
            self.running.discard(process)
            process.returncode = os.waitstatus_to_exitcode(wait_status)
        return process.returncode, usage.ru_utime, output.strip().splitlines()


def run_all(runner, studies, jobs, on_done):
    """Runs every row of every study, the longest first; `on_done(study, row, result)` in the order in which they end."""
    wanted = [(study, row) for study in studies for row in study.rows]
    wanted.sort(key=lambda pair: -pair[1].effort)
    with ThreadPoolExecutor(jobs) as pool:
        futures = {pool.submit(runner.run, study, row): (study, row) for study, row in wanted}
        try:
            for future in as_completed(futures):
                on_done(*futures[future], future.result())
        except BaseException:
            runner.stop()
            pool.shutdown(wait=True, cancel_futures=True)
            raise
