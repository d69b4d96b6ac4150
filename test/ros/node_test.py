"""What the rostests share: the diagnostics of the node, and nodes and players of a test's own."""
import os
import signal
import subprocess
import threading
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray

LEVEL_WARN, LEVEL_ERROR = 1, 2


class NodeDiagnostics:
    """Everything that release_node said of itself on /diagnostics."""

    def __init__(self):
        self._changed = threading.Condition()
        self._latest = {}       # task -> (level, message, values)
        self.warnings = []      # (task, message), in order
        self.finished = {}      # run -> digest of its end
        self._worst = {}        # task -> highest level
        self._subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self._receive, queue_size=100)

    def _receive(self, array):
        with self._changed:
            for status in array.status:
                task = status.name.split(": ")[-1]
                values = {pair.key: pair.value for pair in status.values}
                self._latest[task] = (status.level, status.message, values)
                self._worst[task] = max(self._worst.get(task, 0), status.level)
                if status.level >= LEVEL_WARN:
                    self.warnings.append((task, status.message))
                if task == "simulation" and values.get("state") == "finished":
                    self.finished.setdefault(int(values["run"]), values["state digest"])
            self._changed.notify_all()

    def value(self, task, key):
        with self._changed:
            return self._latest[task][2].get(key) if task in self._latest else None  # none while it is starting up

    def level(self, task):
        with self._changed:
            return self._latest[task][0] if task in self._latest else None

    def message(self, task):
        with self._changed:
            return self._latest[task][1] if task in self._latest else ""

    def worst(self, task):
        with self._changed:
            return self._worst.get(task, 0)

    def end(self):
        """Hears nothing more: a node of the same name may come."""
        self._subscriber.unregister()

    def warned(self, task, part):
        with self._changed:
            return any(where == task and part in message for where, message in self.warnings)

    def wait(self, condition, limit_s, what):
        end = time.monotonic() + limit_s
        with self._changed:
            while not condition(self):
                left = end - time.monotonic()
                assert left > 0.0, f"not within {limit_s} s: {what}; last heard: {self._latest}"
                self._changed.wait(min(left, 0.5))

    def wait_for_state(self, *states, run=None, limit_s=30.0):
        def reached(diagnostics):
            values = diagnostics._latest.get("simulation", (0, "", {}))[2]
            return values.get("state") in states and (run is None or int(values["run"]) == run)
        self.wait(reached, limit_s, f"state {states} of run {run}")


class Process:
    """A program of the test's own, ended with it."""

    def __init__(self, command, **options):
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()

    def signal(self, number):
        self.process.send_signal(number)

    def end(self, limit_s=15.0):
        """Exit status, standard output, standard error."""
        out, error = self.process.communicate(timeout=limit_s)
        return self.process.returncode, out, error

    def cpu_s(self):
        with open(f"/proc/{self.process.pid}/stat", encoding="utf-8") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def executable(name):
    found = subprocess.run(["catkin_find", "--first-only", "--libexec", "geocontainer_mpm", name],
                           capture_output=True, text=True, check=True).stdout.strip()
    assert found, f"catkin_find knows no {name} of geocontainer_mpm"
    return found


def start_node(name, parameters, program="release_node"):
    """The program under this name, with exactly these private parameters."""
    if rospy.has_param("/" + name):
        rospy.delete_param("/" + name)
    for key, value in parameters.items():
        rospy.set_param(f"/{name}/{key}", value)
    return Process([executable(program), f"__name:={name}"])


def play(bag, *options):
    return Process(["rosbag", "play", "--quiet", "--clock", "--hz", "100", "--wait-for-subscribers", *options, bag],
                   stdin=subprocess.DEVNULL)


TERMINATE, KILL, INTERRUPT = signal.SIGTERM, signal.SIGKILL, signal.SIGINT
