"""Plane Poiseuille flow, Newtonian and Bingham."""

import math

import numpy as np

from suite import methods
from suite.drawing import COLOURS, REFERENCE, draw_convergence, picture
from suite.quantity import relative, shown
from suite.run import Run
from suite.series import Convergence

TITLE = "Channel flow, Newtonian and Bingham"
SOURCE = "Plane Poiseuille flow: start-up series of the Newtonian fluid, steady plug profile of the Bingham fluid"
REMARKS = """The affine transfer of the default smooths the velocity a little in every step, like a viscosity that grows as
1 / dt. A fluid whose own viscosity forces small steps feels it: the Bingham flow (6000 steps) is 19 % too slow at ten cells
over the gap and 46 % with a fifth of the step, while FLIP is within 2 %. There is no periodic boundary: the slab has ends, ten gaps apart, and the middle is measured while the slab has
moved by half a cell. The Bingham law is regularised (0.02 1/s here): the reference is the steady profile of the law as it
is, and what the regularisation itself costs against the ideal plug is shown as a figure of its own. Bingham flow is compared when steady; its start-up has no closed form."""

DENSITY, VISCOSITY, FORCE, HALF, YIELD, RATE = 1000.0, 100.0, 1.0, 0.1, 40.0, 0.02
END = 0.25
HEIGHTS = {"middle": 0.0, "quarter": 0.05, "wall": 0.08}  # of the probes, m
SIZES = [0.04, 0.02, 0.01]
METHODS = {"default": methods.DEFAULT, "flip": methods.FLIP}
WANTED = [(law, method) for law in ("newtonian", "bingham") for method in METHODS]


def newtonian(z, time):
    """Velocity; the series of the start from rest."""
    kinematic = VISCOSITY / DENSITY
    u = FORCE / (2 * kinematic) * (HALF**2 - np.asarray(z, dtype=float) ** 2)
    for n in range(60):
        k = (2 * n + 1) * math.pi / (2 * HALF)
        u = u - (-1) ** n * 2 * FORCE / (kinematic * HALF * k**3) * np.cos(k * np.asarray(z)) * math.exp(
            -kinematic * k**2 * time)
    return u


def regularised(z):
    """Steady velocity of the law as it is (Papanastasiou 1987): eta rate + tau_y (1 - exp(-rate / rate0)) = rho g |z|,
    solved for the rate by bisection and integrated from the wall."""
    heights = np.linspace(abs(float(z)), HALF, 401)
    low, high = np.zeros_like(heights), DENSITY * FORCE * heights / VISCOSITY
    for _ in range(60):
        rate = 0.5 * (low + high)
        above = VISCOSITY * rate + YIELD * (1 - np.exp(-rate / RATE)) > DENSITY * FORCE * heights
        low, high = np.where(above, low, rate), np.where(above, rate, high)
    return float(np.sum(0.5 * (rate[1:] + rate[:-1]) * np.diff(heights)))


def bingham(z):
    plug = YIELD / (DENSITY * FORCE)
    outside = np.maximum(np.abs(np.asarray(z, dtype=float)), plug)
    return DENSITY * FORCE / (2 * VISCOSITY) * ((HALF - plug) ** 2 - (outside - plug) ** 2)


def run(law, size, method="default"):
    overrides = {"grid.cell_size_m": size, **METHODS[method]}
    if law == "bingham":
        overrides.update({"materials.slurry": {"law": "bingham", "density_kg_per_m3": DENSITY, "bulk_modulus_pa": 1e5,
                                               "viscosity_pa_s": VISCOSITY, "yield_stress_pa": YIELD,
                                               "regularisation_rate_per_s": RATE}})
    return Run(f"{law} {method} {size:g}", overrides, method, record=True, effort=(0.02 / size) ** 3)


def runs(full):
    if not full:
        return [run("newtonian", 0.02), run("bingham", 0.02, "flip")]
    return [run(law, size, method) for law in ("newtonian", "bingham") for method in METHODS for size in SIZES]


def exact(law, z):
    return float(newtonian(z, END) if law == "newtonian" else regularised(z))


def quantities(results, full):
    size = 0.01 if full else 0.02
    figures = []
    for law, method in (WANTED if full else WANTED[::3]):
        result = results[f"{law} {method} {size:g}"]
        for name in ("middle", "quarter"):
            z = HEIGHTS[name]
            # 2 %: ten cells over the gap, second order, and a particle layer at the wall.
            figures.append(relative(f"velocity, {name}, {law}", method, result.last(name, "velocity_y_m_per_s"),
                                    exact(law, z), "m/s", 0.02))
        if law == "bingham":
            figures.append(shown("velocity of the ideal plug", method, result.last("middle", "velocity_y_m_per_s"),
                                 float(bingham(0.0)), "m/s"))
        # Shear stress from equilibrium, rho g z, when steady (to exp(-0.25 / 0.04) = 0.2 % for the Newtonian fluid).
        figures.append(relative(f"shear stress near the wall, {law}", method,
                                abs(result.last("wall", "stress_yz_pa")), DENSITY * FORCE * HEIGHTS["wall"], "Pa", 0.03))
    return figures


def convergence(results):
    return [Convergence(f"{law}, {method}", "relative error of the middle's velocity", "", SIZES,
                        [abs(results[f"{law} {method} {size:g}"].last("middle", "velocity_y_m_per_s")
                             / exact(law, 0.0) - 1) for size in SIZES])
            for law, method in WANTED]


def draw(results, path):
    with picture(path, 2) as (left, right):
        z = np.linspace(-HALF, HALF, 200)
        for colour, law in zip(COLOURS, ("newtonian", "bingham")):
            left.plot([exact(law, one) for one in z], z, **REFERENCE)
            frames = results[f"{law} default 0.01"].frames
            if frames:
                position, velocity = frames[-1]["soil/position"], frames[-1]["soil/velocity"]
                near = np.abs(position[:, 0]) < 0.02
                left.plot(velocity[near, 0], position[near, 1], ".", color=colour, markersize=3, label=law)
        left.set(xlabel="velocity [m/s] (dashed: exact)", ylabel="z [m]")
        left.legend()
        draw_convergence(right, convergence(results))
