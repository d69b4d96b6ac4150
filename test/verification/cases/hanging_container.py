"""A container hangs in a hull that is held partly open: what hull, water and the geotextile's two legs carry."""

import numpy as np

from suite.drawing import COLOURS, picture
from suite.quantity import relative, shown
from suite.run import Run

TITLE = "Hanging container"
SOURCE = "Equilibrium of the whole, and of the part below a level under the lips"
REMARKS = """In water the barge draws 3.5 m. The legs carry about three times the weight below the slot: what hangs there is
also pressed on by the fill above, which stands in the slot as in a silo. Equilibrium below a level is legs = weight below +
thrust of the fill on the cut. The level is taken in the middle between two rows of nodes, where weight, stress and tension
balance exactly when weighted by the grid's own shape functions: those of the nodes below sum up to a step that is smooth
over two cells. With a frictional interface a grain presses on the sheet from its middle, half its width inside: the step
is not the same at both ends of that force."""

GRAVITY, AREA, DENSITY, SHEET, WATER = 9.81, 10.8, 1990.0, 0.84 * 18.3, 1025.0
FROM = 5.5  # s: hangs at rest
LEVEL_CELLS = 1.0  # a cut's stresses come from one cell to either side, which must be below the lips


def run(water, interface, size):
    overrides = {"grid.cell_size_m": size, "geotextiles.container.segment_length_m": size}
    if interface == "frictional":
        overrides |= {"geotextiles.container.interface": interface, "geotextiles.container.interface_friction": 0.52}
    if water:
        overrides["water"] = {"density_kg_per_m3": WATER, "draught_m": 3.5, "drag_coefficient": 1,
                              "added_mass_coefficient": 0.5}
    return Run(f"{interface}, {'water' if water else 'dry'}", overrides, record=True, effort=10)


def runs(full):
    return [run(water, interface, 0.1 if full else 0.2) for interface in ("bonded", "frictional")
            for water in (False, True)]


def step_below(z, level, size):
    """Sum of the quadratic B-splines of all nodes below a level in the middle between two rows: 1 far below."""
    u = np.clip((level - z) / size, -1.0, 1.0)
    return np.where(u < 0.0, 0.5 * (1.0 + u)**2, 1.0 - 0.5 * (1.0 - u)**2)


def cut(frame, result, size):
    """Weight below the highest level that the hull does not reach, the legs' upward and the fill's downward force there, N/m."""
    lips = frame["hull/position"][:, 1].min()
    bottom = -7.0
    level = bottom + (np.floor((lips - LEVEL_CELLS * size - bottom) / size - 0.5) + 0.5) * size
    z, node = frame["soil/position"][:, 1], frame["geotextile/node"]
    weight = GRAVITY * AREA / len(z) * (DENSITY - (WATER if result.summary["water"] else 0.0))
    below = weight * np.sum(step_below(z, level, size))
    below += GRAVITY * SHEET / len(node) * np.sum(step_below(node[:, 1], level, size))
    start, end = (node[frame["geotextile/connectivity"][:, k]] for k in (0, 1))
    rise = (end - start)[:, 1] / np.linalg.norm(end - start, axis=1)
    step = step_below(start[:, 1], level, size) - step_below(end[:, 1], level, size)
    legs = np.sum(frame["geotextile/tension"] * rise * step)
    # The slope of the step is a hat one cell to either side.
    hat = np.maximum(0.0, 1.0 - np.abs(z - level) / size) / size
    thrust = -np.sum(frame["soil/volume"] * frame["soil/stress"][:, 5] * hat)
    return below, legs, thrust


def balance(result, size):
    """The same, means over the time at rest."""
    frames = [frame for frame in result.frames if frame["time"] >= FROM]
    if result.stopped or not frames:
        return (np.nan, np.nan, np.nan)
    return tuple(np.mean([cut(frame, result, size) for frame in frames], axis=0))


def quantities(results, full):
    figures = []
    for key, result in results.items():
        weight = GRAVITY * (AREA * DENSITY + SHEET)
        hull = -sum(result.mean(half, "force_z_n_per_m", FROM) for half in ("port", "starboard"))
        buoyancy = result.summary["water"]["buoyancy_n_per_m"] if result.summary.get("water") else 0.0
        below, legs, thrust = balance(result, 0.1 if full else 0.2)
        # 2 and 5 % are the bars of the issue.
        figures += [
            relative(f"hull + buoyancy, {key}", "default", hull + buoyancy, weight, "N/m", 0.02),
            relative(f"legs - thrust of the fill, {key}", "default", legs - thrust, below, "N/m", 0.05),
            shown(f"legs alone, {key}", "default", legs, below, "N/m"),
        ]
    return figures


def draw(results, path):
    with picture(path, len(results), (3.2, 3.0)) as axes:
        for axis, (key, result) in zip(axes, results.items()):
            frame = result.frames[-1]
            axis.plot(*frame["soil/position"].T, ".", color="#dcbf86", markersize=1.5)
            for first, last in frame["geotextile/connectivity"]:
                axis.plot(*frame["geotextile/node"][[first, last]].T, color=COLOURS[0], linewidth=1.2)
            axis.plot(*frame["hull/position"].T, ".", color="#3c4650", markersize=1.5)
            axis.set(title=key, aspect="equal", xlabel="y [m]", ylabel="z [m]", xlim=(-3, 3), ylim=(-6, 0.5))
