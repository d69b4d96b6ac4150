#!/usr/bin/python3
"""The references themselves: closed forms against published digits, series and integrals; no solver runs."""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy as np  # noqa: E402

import cases  # noqa: E402
from cases import (channel_flow, compaction, fluid_tube, hanging_cable, oedometer, self_weight_column,  # noqa: E402
                   terminal_velocity, two_discs, vibrating_bar)
from suite.run import scene_path  # noqa: E402
from suite.series import Convergence, frequency, onset, ramp_integral  # noqa: E402


def near(value, reference, tolerance, what):
    assert abs(value - reference) <= tolerance, f"{what}: {value} is not {reference} to {tolerance}"


def published_digits():
    """To half a unit of the last published digit, or one where the source rounds differently."""
    near(oedometer.EXACT, -0.16473, 5e-6, "oedometer")
    near(self_weight_column.static(0.94309), self_weight_column.MANUAL_STATIC, 6e-8, "static column")
    exact = self_weight_column.dynamic(0.94309, self_weight_column.INSTANTS)
    for value, manual in zip(exact, self_weight_column.MANUAL_DYNAMIC):
        near(value, manual, 1e-8, "dynamic column")
    for p0, row in fluid_tube.PUBLISHED.items():
        height, width, tension, _, _ = fluid_tube.shape(p0)
        for value, published in zip((height, width, tension), row):
            near(value, published, 6e-6, f"tube {p0}")
        # Balance of forces across the tube's middle.
        near(tension, p0 * height / 2 + height**2 / 4, 1e-9, f"tension of tube {p0}")
    near(two_discs.ENERGY, 2.513, 5e-4, "discs' energy")
    near(two_discs.CONTACT, 1.086, 5e-4, "discs' contact")


def closed_forms():
    time = np.linspace(0, 50, 501)
    n = np.arange(2000)
    k = (2 * n + 1) * math.pi / (2 * vibrating_bar.LENGTH)
    modes = 2 * vibrating_bar.VELOCITY / (vibrating_bar.LENGTH**2 * k**3 * vibrating_bar.SPEED)
    series = np.sin(np.outer(time, k * vibrating_bar.SPEED)) @ modes
    near(np.max(np.abs(series - vibrating_bar.centroid(time))), 0.0, 1e-6, "bar against its modes")
    steady = channel_flow.newtonian(0.03, 10.0)
    near(steady, channel_flow.FORCE / 0.2 * (0.01 - 0.0009), 1e-12, "steady channel")
    near(channel_flow.newtonian(0.03, 0.0), 0.0, 1e-6, "channel at the start")
    # The catenary through its ends has the length that was asked for.
    near(2 * hanging_cable.A * math.sinh(1 / hanging_cable.A), hanging_cable.LENGTH, 1e-12, "catenary")
    # Fall through water against its equation of motion, by Euler's method.
    terminal, tau = terminal_velocity.closed_form("disc, Ca = 1")
    start = terminal_velocity.GRAVITY * 500 / 2500
    velocity, step = 0.0, 1e-4
    for _ in range(int(round(tau / step))):
        velocity += step * start * (1 - (velocity / terminal) ** 2)
    near(velocity, terminal * math.tanh(1), 1e-4 * terminal, "fall after tau")
    # Stress over the present volume integrates to the moment of the weights; solved stretch satisfies the law.
    assert -0.5 * compaction.WEIGHT * compaction.LENGTH < compaction.mean_stress() < 0.0


def tools():
    time = np.linspace(0, 3, 3001)
    near(frequency(time, np.sin(2 * math.pi * 4 * time + 0.3)), 4.0, 1e-4, "frequency")
    near(onset(time, time**2, 2.0), math.sqrt(2), 1e-6, "onset")
    factor = np.minimum(time / 0.2, 1.0)
    velocity = np.concatenate([[0.0], np.cumsum(0.5 * (factor[1:] + factor[:-1]) * np.diff(time))])
    distance = np.concatenate([[0.0], np.cumsum(0.5 * (velocity[1:] + velocity[:-1]) * np.diff(time))])
    near(np.max(np.abs(distance - ramp_integral(time, 0.2))), 0.0, 1e-5, "ramp")
    near(Convergence("", "", "", [0.4, 0.2, 0.1], [3.2, 0.8, 0.2]).order, 2.0, 1e-12, "order")


def every_case():
    for name in cases.NAMES:
        case = cases.load(name)
        assert os.path.exists(scene_path(name)), name
        for full in (False, True):
            keys = [run.key for run in case.runs(full)]
            assert keys and len(keys) == len(set(keys)), (name, full)
    modules = {file[:-3] for file in os.listdir(os.path.dirname(cases.__file__)) if file.endswith(".py")}
    assert modules - {"__init__"} == set(cases.NAMES), modules


if __name__ == "__main__":
    published_digits()
    closed_forms()
    tools()
    every_case()
    print("references: all as published")
