"""Frequencies, onsets and orders of convergence out of series of numbers."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Convergence:
    """Errors of one method over a list of cell sizes."""

    method: str
    quantity: str
    unit: str
    dx: list  # m, descending
    error: list

    @property
    def order(self):
        """Slope of log error over log cell size, least squares over all sizes; not a number when a run gave none."""
        error = np.array(self.error, dtype=float)
        if len(error) < 2 or not np.all(np.isfinite(error)) or np.any(error <= 0.0):
            return float("nan")
        return float(np.polyfit(np.log(self.dx), np.log(error), 1)[0])

    def steps(self):
        """Order observed from each size to the next."""
        error = np.array(self.error, dtype=float)
        with np.errstate(divide="ignore", invalid="ignore"):
            return list(np.diff(np.log(error)) / np.diff(np.log(np.array(self.dx))))


def crossings(time, value):
    """Times at which a series passes through zero, linear between samples."""
    time, value = np.asarray(time), np.asarray(value)
    i = np.flatnonzero((value[:-1] <= 0.0) != (value[1:] <= 0.0))
    return time[i] - value[i] * (time[i + 1] - time[i]) / (value[i + 1] - value[i])


def frequency(time, value):
    """Frequency, Hz, of an oscillation about zero: from its first to its last passage through zero."""
    passes = crossings(time, value)
    return float("nan") if len(passes) < 3 else 0.5 * (len(passes) - 1) / (passes[-1] - passes[0])


def onset(time, value, threshold):
    """First time at which a series exceeds a threshold, linear between samples; not a number if it never does."""
    time, value = np.asarray(time), np.asarray(value)
    above = np.flatnonzero(value > threshold)
    if above.size == 0 or above[0] == 0:
        return float("nan")
    i = above[0]
    return float(time[i - 1] + (threshold - value[i - 1]) * (time[i] - time[i - 1]) / (value[i] - value[i - 1]))


def ramp_integral(time, ramp_s):
    """Twofold integral over time of a factor that rises linearly from 0 to 1 within ramp_s and stays: the distance
    of what is pulled with unit acceleration under a load that is put on gently."""
    time = np.asarray(time, dtype=float)
    after = np.maximum(time - ramp_s, 0.0)
    return np.where(time < ramp_s, time**3 / (6.0 * ramp_s),
                    ramp_s**2 / 6.0 + 0.5 * ramp_s * after + 0.5 * after**2)
