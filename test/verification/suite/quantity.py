"""A figure of a run beside its reference, and whether it is close enough."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    name: str
    method: str
    value: float
    reference: float
    unit: str
    error: float  # as the definition of its kind says; not a number when the run gave none
    tolerance: float = None  # None: shown, not judged
    relative: bool = True  # error is a fraction, printed in per cent

    @property
    def judged(self):
        return self.tolerance is not None

    @property
    def passed(self):
        # A figure that is not a number fails.
        return not self.judged or bool(self.error <= self.tolerance)


def relative(name, method, value, reference, unit, tolerance, of=None):
    """Error |value - reference| over |of|, which is the reference unless given."""
    return Quantity(name, method, value, reference, unit, abs(value - reference) / abs(of if of else reference),
                    tolerance)


def absolute(name, method, value, reference, unit, tolerance):
    """Error |value - reference|, in the unit."""
    return Quantity(name, method, value, reference, unit, abs(value - reference), tolerance, relative=False)


def at_most(name, method, value, bound, unit):
    """The value itself must not pass a bound."""
    return Quantity(name, method, value, 0.0, unit, abs(value), bound, relative=False)


def at_least(name, method, value, bound, unit=""):
    """Error: what the value falls short of the bound."""
    short = bound - value
    return Quantity(name, method, value, bound, unit, max(0.0, short) if math.isfinite(value) else math.nan, 0.0,
                    relative=False)


def within(name, method, value, low, high, unit=""):
    """Error: how far outside a range of values the value lies; for what is known as a class, not as a number."""
    outside = max(low - value, value - high, 0.0) if math.isfinite(value) else math.nan
    return Quantity(name, method, value, 0.5 * (low + high), unit, outside, 0.0, relative=False)


def shown(name, method, value, reference, unit, is_relative=True, of=None):
    """Reported without a bound: a method or a figure that the suite shows and does not promise."""
    error = abs(value - reference)
    if is_relative:
        error /= abs(of if of else reference)
    return Quantity(name, method, value, reference, unit, error, None, is_relative)
