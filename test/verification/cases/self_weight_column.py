"""Column under its own weight, put on at once: static with damping, dynamic without."""

import math

import numpy as np

from suite import methods
from suite.drawing import COLOURS, REFERENCE, draw_convergence, picture
from suite.quantity import relative, shown
from suite.run import Run
from suite.series import Convergence

TITLE = "Self-weight column, static and dynamic"
SOURCE = "Anura3D Verification Manual (2021): its static and dynamic displacements of one point, and their closed forms"
REMARKS = """The error of the five instants is measured against the full swing of the point (1.32 mm). At 0.6 s the exact
value is 6 % of the swing and the point moves at 40 mm/s, so that a wrong phase of 0.1 % after 13 periods is already 4 %
of *that* value; the table has the error against the swing, the picture shows the phase."""

DENSITY, GRAVITY, HEIGHT, POINT = 2000.0, 9.81, 1.0, 0.94309
OEDOMETRIC = 1e7 * (1 - 0.33) / ((1 + 0.33) * (1 - 2 * 0.33))
WAVE_SPEED = math.sqrt(OEDOMETRIC / DENSITY)
INSTANTS = [0.2, 0.4, 0.6, 0.8, 1.0]
# What the manual states for its point, m; the closed forms below give them back (to its last digit).
MANUAL_STATIC = -0.65991e-3
MANUAL_DYNAMIC = [-0.91109e-3, -1.19839e-3, -0.08456e-3, -0.48610e-3, -1.31657e-3]
SIZES = [0.1, 0.05, 0.025, 0.0125]


def static(z):
    return DENSITY * GRAVITY / (2 * OEDOMETRIC) * z * (z - 2 * HEIGHT)


def dynamic(z, time):
    """Eigenfunctions of the fixed-free column about the static state, from rest."""
    n = np.arange(1, 4001)
    k = (2 * n - 1) * math.pi / (2 * HEIGHT)
    amplitude = 2 * GRAVITY / (HEIGHT * WAVE_SPEED**2 * k**3) * np.sin(k * z)
    time = np.atleast_1d(np.asarray(time, dtype=float))
    return static(z) + np.cos(np.outer(time, k * WAVE_SPEED)) @ amplitude


SWING = 2 * abs(static(POINT))


def run(kind, method, size, overrides):
    settings = {"grid.cell_size_m": size, **overrides}
    if kind == "static":
        # Twice the first natural frequency: critical.
        settings.update({"numerics.damping_per_s": 250, "time.end_s": 0.4})
    return Run(f"{kind} {method} {size:g}", settings, method, effort=(0.05 / size) ** 3)


METHODS = {"default": methods.DEFAULT, "linear flip": methods.STANDARD}


def runs(full):
    wanted = [run("static", "default", 0.05, {}), run("dynamic", "default", 0.025, {})]
    if full:
        wanted += [run("dynamic", method, size, extra) for method, extra in METHODS.items() for size in SIZES
                   if (method, size) != ("default", 0.025)]
    return wanted


def error(result):
    """Largest error at the five instants over the swing."""
    return max(abs(result.at("point", "displacement_z_m", t) - dynamic(POINT, t)[0]) for t in INSTANTS) / SWING


def quantities(results, full):
    value = results["static default 0.05"].last("point", "displacement_z_m")
    # 0.2 % is the bar of the issue; the manual's remedied method is 0.08 % off.
    figures = [relative("static displacement", "default", value, static(POINT), "m", 0.002)]
    size = 0.025
    result = results[f"dynamic default {size:g}"]
    for t in INSTANTS:
        value = result.at("point", "displacement_z_m", t)
        # 2 %, the bar of the issue, of the swing.
        figures.append(relative(f"displacement at {t:g} s", "default", value, dynamic(POINT, t)[0], "m", 0.02, of=SWING))
    if full:
        figures += [shown(f"displacement at {t:g} s", "linear flip",
                          results[f"dynamic linear flip {size:g}"].at("point", "displacement_z_m", t),
                          dynamic(POINT, t)[0], "m", of=SWING) for t in INSTANTS]
    return figures


def convergence(results):
    return [Convergence(method, "largest error at the five instants over the swing", "", SIZES,
                        [error(results[f"dynamic {method} {size:g}"]) for size in SIZES]) for method in METHODS]


def draw(results, path):
    with picture(path, 2, (5.0, 3.2)) as (left, right):
        result = results["dynamic default 0.025"]
        time = np.linspace(0, 1, 2000)
        left.plot(time, 1e3 * dynamic(POINT, time), label="exact", **REFERENCE)
        left.plot(result.time("point"), 1e3 * result.series("point", "displacement_z_m"), color=COLOURS[0], linewidth=0.8,
                  label="default, dx = H/40")
        left.plot(INSTANTS, [1e3 * value for value in MANUAL_DYNAMIC], "k^", markersize=5, label="manual")
        left.set(xlabel="time [s]", ylabel="displacement [mm]", xlim=(0.75, 1.0))
        left.legend()
        draw_convergence(right, convergence(results))
