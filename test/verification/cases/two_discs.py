"""Two elastic discs collide centrally and rebound."""

import math

import numpy as np

from suite import methods
from suite.drawing import COLOURS, REFERENCE, picture
from suite.quantity import absolute, at_most, relative, shown
from suite.run import Run
from suite.series import Convergence, onset

TITLE = "Two elastic discs"
SOURCE = "Sulsky, Chen and Schreyer 1994, Comput. Methods Appl. Mech. Eng. 118:179; time of contact from the geometry"
REMARKS = """The rebound sets the discs vibrating: the energy "after" is kinetic and elastic together. There is no exact
value for the kinetic energy after the rebound."""

ENERGY = 1000 * math.pi * 0.2**2 * (0.1**2 + 0.1**2)  # both discs, J/m
APPROACH = 2 * math.hypot(0.1, 0.1)
CONTACT = (math.hypot(0.5, 0.5) - 0.4) / APPROACH
CELLS = [20, 40, 80]
METHODS = {"flip musl": methods.DEFAULT, "apic usl": {"numerics.transfer": "apic", "numerics.update": "usl"},
           "linear flip": methods.STANDARD}  # the scene itself asks for flip and musl


def run(method, cells):
    return Run(f"{method} {cells}", {"grid.cell_size_m": 1.0 / cells, **METHODS[method]}, method,
               effort=(cells / 40) ** 3)


def runs(full):
    return [run(method, cells) for method in (METHODS if full else ["flip musl"]) for cells in (CELLS if full else [40])]


def energy(result):
    """Kinetic and elastic of both discs over time, J/m."""
    return sum(result.series(disc, column) for disc in ("lower", "upper")
               for column in ("kinetic_j_per_m", "elastic_j_per_m"))


def quantities(results, full):
    result = results["flip musl 40"]
    speed = result.series("lower", "velocity_y_m_per_s")
    # Contact begins to act when the disc has lost 1 % of its speed; that takes about (1 % of 0.1 m/s) over the first
    # decelerations, below 0.01 s.
    contact = onset(result.time("lower"), 0.1 - speed, 0.001)
    momentum = np.abs(speed + result.series("upper", "velocity_y_m_per_s")) / 0.1 if not result.stopped else [math.nan]
    after = float("nan") if result.stopped else float(energy(result)[-1])
    figures = [
        relative("energy after rebound", "flip musl", after, ENERGY, "J/m", 0.05),
        # Equal and opposite from the start: any sum is the scheme's; round-off of a few thousand particles and steps.
        at_most("momentum of both over that of one", "flip musl", float(np.max(momentum)), 1e-9, ""),
        # Half a cell's travel of the approaching discs.
        absolute("time of contact", "flip musl", contact, CONTACT, "s", 0.5 / 40 / APPROACH),
    ]
    if full:
        figures += [shown("energy after rebound", method,
                          float(energy(results[f"{method} 40"])[-1]) if not results[f"{method} 40"].stopped
                          else float("nan"), ENERGY, "J/m") for method in list(METHODS)[1:]]
    return figures


def convergence(results):
    return [Convergence(method, "energy lost over the initial", "", [1.0 / n for n in CELLS],
                        [float("nan") if results[f"{method} {n}"].stopped
                         else float(abs(energy(results[f"{method} {n}"])[-1] / ENERGY - 1)) for n in CELLS])
            for method in METHODS]


def draw(results, path):
    with picture(path, 2) as (left, right):
        for colour, cells in zip(COLOURS, CELLS):
            result = results[f"flip musl {cells}"]
            left.plot(result.time("lower"), energy(result), color=colour, label=f"flip musl, {cells} cells")
            right.plot(result.time("lower"), result.series("lower", "velocity_y_m_per_s"), color=colour,
                       label=f"{cells} cells")
        left.axhline(ENERGY, label="initial", **REFERENCE)
        left.set(xlabel="time [s]", ylabel="kinetic + elastic energy [J/m]", ylim=(0, 1.15 * ENERGY))
        right.axvline(CONTACT, label="geometric contact", **REFERENCE)
        right.set(xlabel="time [s]", ylabel="velocity of the lower disc, y [m/s]")
        left.legend()
        right.legend()
