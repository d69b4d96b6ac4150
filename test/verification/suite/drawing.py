"""One look for all pictures: Okabe and Ito's colours, told apart by colour-blind readers; the reference is black."""

import contextlib

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#E69F00", "#56B4E9", "#CC79A7"]
STYLE = {
    "font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 9.5, "axes.linewidth": 0.8,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#dddddd",
    "grid.linewidth": 0.6, "legend.frameon": False, "legend.fontsize": 8, "savefig.dpi": 110,
}
REFERENCE = {"color": "black", "linestyle": "--", "linewidth": 1.2}


def pyplot():
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    return plt


@contextlib.contextmanager
def picture(path, columns=1, size=(4.2, 3.2)):
    """Axes side by side; the picture is written at the end."""
    plt = pyplot()
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(1, columns, figsize=(size[0] * columns, size[1]), constrained_layout=True,
                                    squeeze=False)
        yield axes[0]
        figure.savefig(path)
        plt.close(figure)


def draw_convergence(axis, series):
    """Errors over cell size, both logarithmic, with the observed order in the legend."""
    for i, one in enumerate(series):
        axis.loglog(one.dx, one.error, "o-", color=COLOURS[i % len(COLOURS)], markersize=4,
                    label=f"{one.method}: order {one.order:.2f}")
    axis.set_xlabel("cell size [m]")
    axis.set_ylabel(f"{series[0].quantity} [{series[0].unit}]" if series[0].unit else series[0].quantity)
    axis.grid(True, which="both", linewidth=0.4)
    axis.legend()
