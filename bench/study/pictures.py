"""Pictures of a study, in the manner of the paper: sections at successive openings, tension against time and along the
perimeter, figures against the changed key."""

import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import Normalize

from figures import at, figures, tension_histories
from plotting import plot_record as pr

MOST_LINES = 15
COLOURS = [pr.BLACK, pr.RED, pr.BLUE, pr.GREEN, pr.ORANGE, pr.SKY]
LINES = ["-", "--", "-.", ":"]
AXES = {"release_time_s": ("release time [s]", 1.0), "peak_tension_n_per_m": ("peak tension [kN/m]", 1e-3),
        "peak_tension_in_hull_n_per_m": ("peak until release [kN/m]", 1e-3),
        "residual_tension_n_per_m": ("residual tension [kN/m]", 1e-3), "container_width_m": ("final width [m]", 1.0),
        "container_height_m": ("final height [m]", 1.0), "geotextile_elongation_max": ("largest elongation [%]", 100.0),
        "slot_m": ("slot at release [m]", 1.0), "lifted_m": ("gap, beyond 1.5 m [m]", 1.0),
        "grid.cell_size_m": ("cell size [m]", 1.0),
        **{f"{name}: {kind}_tension_n_per_m": (f"{name}: {kind} tension [kN/m]", 1e-3)
           for name in ("lower", "upper") for kind in ("peak", "residual")},
        "weight_n_per_m": ("weight, submerged [kN/m]", 1e-3), "water.draught_m": ("draught [m]", 1.0),
        "mean_tension_opening_n_per_m": ("mean tension, 17 to 19 s [kN/m]", 1e-3),
        "transfer_share": ("dissipated by transfer until release [%]", 100.0)}


def style(number):
    return {"color": COLOURS[number % len(COLOURS)], "linestyle": LINES[number // len(COLOURS) % len(LINES)]}


class Kept:
    """A thinned record."""

    def __init__(self, path):
        self.record = pr.Record(path)
        self.chosen = [int(index) for index in self.record.file.attrs["chosen"]]
        self.captions = [pr.text(caption) for caption in self.record.file.attrs["caption"]]

    def close(self):
        self.record.file.close()


def draw_sections(sweep, shown, path):
    """One row of panels a run."""
    frames = [one.record.frames[index] for _, one in shown for index in one.chosen]
    y0, y1, z0, z1 = pr.view(frames)
    columns = max(len(one.chosen) for _, one in shown)
    width = 2.9
    height = width * (z1 - z0) / (y1 - y0)
    tops = [one.record.tension[index].max() for _, one in shown for index in one.chosen if one.record.tension.size]
    tension_norm = Normalize(0.0, max(tops, default=1.0) or 1.0)
    speeds = [np.percentile(pr.sand_value(frame, "speed"), 99.5) for frame in frames if "soil" in frame]
    sand_norm = Normalize(0.0, max(max(speeds, default=1.0), 1e-3))
    figure, axes = plt.subplots(len(shown), columns, figsize=(columns * width + 0.4, len(shown) * (height + 0.55) + 1.1),
                                sharex=True, sharey=True, squeeze=False, layout="constrained")
    sheet = sand = None
    for line, (label, one) in zip(axes, shown):
        for ax in line[len(one.chosen):]:
            ax.set_visible(False)
        for ax, index, caption in zip(line, one.chosen, one.captions):
            frame = one.record.frames[index]
            pr.draw_surfaces(ax, frame, 0.3 * (y1 - y0))
            pr.draw_hull(ax, frame)
            if "water_level_m" in frame.attrs:
                ax.axhline(frame.attrs["water_level_m"], color=pr.SKY, linewidth=1.0, zorder=1)
            sand = pr.draw_sand(ax, frame, "speed", sand_norm) or sand
            sheet = pr.draw_geotextile(ax, frame, tension_norm) or sheet
            heading, note = pr.label(one.record, index, caption)
            ax.set_title(f"{heading}\n{note}", loc="left", fontsize=8)
            ax.set(xlim=(y0, y1), ylim=(z0, z1), aspect="equal")
        line[0].set_ylabel(f"{label}\nz up [m]", weight="bold")
    for ax in axes[-1]:
        ax.set_xlabel("y to port [m]")
    bars = {"location": "bottom", "aspect": 60, "shrink": 0.6, "pad": 0.02}
    if sheet is not None:
        figure.colorbar(sheet, ax=axes, label="geotextile: gauge tension [kN/m]", **bars)
    if sand is not None:
        figure.colorbar(sand, ax=axes, label="soil: speed [m/s]", extend="max", **bars)
    figure.suptitle(sweep.title, fontsize=11.5, weight="bold")
    figure.savefig(path, dpi=90)
    plt.close(figure)


def draw_tension_history(sweep, results, path):
    """Largest tension against time: of every run, of the pictured ones where there are several sheets or more lines than
    can be told apart; returns whether there was any."""
    figure, ax = plt.subplots(figsize=(8.5, 3.8), layout="constrained")
    released = 0.0
    lines = [(row.label, name, history) for row in sweep.rows
             for name, history in tension_histories(results[row.label].summary).items()]
    several = any(name != lines[0][1] for _, name, _ in lines)
    if several or len(lines) > MOST_LINES:
        lines = [line for line in lines if line[0] in sweep.pictured]
    for number, (label, name, (time, tension)) in enumerate(lines):
        ax.plot(time, np.asarray(tension, dtype=float) / 1e3, linewidth=1.1,
                label=f"{label}: {name}" if several else label, **style(number))
        moving = np.flatnonzero(np.abs(np.diff(np.asarray(tension, dtype=float))) > 20.0)
        released = max(released, time[moving[-1]] if moving.size else 0.0)
    if lines:
        ax.set(xlabel="time since the start [s]", ylabel="largest tension [kN/m]", xlim=(0, 1.05 * released or None))
        ax.set_ylim(bottom=0.0)
        ax.grid(color="#dddddd", linewidth=0.6)
        ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
        ax.set_title(f"{sweep.title}: tension against time", loc="left", weight="bold")
        figure.savefig(path, dpi=110)
    plt.close(figure)
    return bool(lines)


def perimeter(frame, circumference):
    """Place of each segment's middle along the unstretched sheet, m, 0 where it is lowest in the closed hull; order."""
    node = frame["geotextile/node"][:, 1:]
    count = frame["geotextile/gauge_tension"].shape[0]
    lowest = np.flatnonzero(node[:, 1] < node[:, 1].min() + 1e-3)
    start = lowest[np.argmin(np.abs(node[lowest, 0]))]
    place = (np.arange(count) - start + 0.5) / count  # segments are equally long
    return ((place + 0.5) % 1.0 - 0.5) * circumference


def draw_tension_perimeter(sweep, shown, results, path):
    """Tension along the sheet at release, when it is largest, and at the end."""
    shown = [(label, one) for label, one in shown if len(one.record.sheets) == 1]
    if not shown:
        return False
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), sharey=True, layout="constrained")
    for number, (label, one) in enumerate(shown):
        record = one.record
        circumference = at(results[label].summary, "design_rules.0.rules.slot_needed.inputs.S.value")
        place = perimeter(record.frames[0], circumference or 1.0)
        order = np.argsort(place)
        largest = int(np.argmax(record.tension[:, 0]))
        released = None if record.release is None else int(np.argmin(np.abs(record.time - record.release)))
        for ax, index in zip(axes, (released, largest, len(record.time) - 1)):
            if index is not None:
                tension = record.frames[index]["geotextile/gauge_tension"][()] / 1e3
                ax.plot(place[order], tension[order], label=f"{label}, t = {record.time[index]:.1f} s", **style(number))
    for ax, title in zip(axes, ("at release", "frame of the largest tension", "at the end")):
        ax.set_title(title, loc="left", weight="bold")
        ax.set_xlabel("along the sheet from the bottom's middle [m]" if circumference else "along the sheet / circumference")
        ax.grid(color="#dddddd", linewidth=0.6)
        if ax.lines:
            ax.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.2))
    axes[0].set_ylabel("gauge tension [kN/m]")
    axes[0].set_ylim(bottom=0.0)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return True


def draw_curves(sweep, results, path):
    """Figures against a number, by default the first changed key: one line for each setting of the other keys, or of those
    that `by` names. Of several runs with the same number the first is on the line, the others are hollow."""
    rows = [{**row.changed, **figures(results[row.label], sweep.means)} for row in sweep.rows if results[row.label].completed]
    first = sweep.columns[0] if sweep.columns else None
    curves = [curve if isinstance(curve, dict) else {"figure": curve, "against": first} for curve in sweep.curves]
    curves = [curve for curve in curves if sum(is_number(row.get(curve["against"])) for row in rows) > 1]
    if not curves:
        return False
    keys = [key for key in (sweep.columns if sweep.by is None else sweep.by) if key not in {c["against"] for c in curves}]
    groups = list(dict.fromkeys(tuple((key, str(row[key])) for key in keys if key in row) for row in rows))
    columns = len(curves) if len(curves) < 5 else 3
    lines = -(-len(curves) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(3.6 * columns, 3.2 * lines), squeeze=False, layout="constrained")
    for ax in axes.flat[len(curves):]:
        ax.set_visible(False)
    for ax, curve in zip(axes.flat, curves):
        label, factor = AXES.get(curve["figure"], (curve["figure"], 1.0))
        across, across_factor = AXES.get(curve["against"], (curve["against"], 1.0))
        for number, group in enumerate(groups):
            own = [(across_factor * row[curve["against"]], factor * row[curve["figure"]]) for row in rows
                   if tuple((key, str(row[key])) for key in keys if key in row) == group
                   and is_number(row.get(curve["against"])) and is_number(row.get(curve["figure"]))]
            line = sorted({x: (x, y) for x, y in reversed(own)}.values())
            beside = [point for point in own if point not in line]
            if line:
                ax.plot(*zip(*line), marker="o", markersize=4, **style(number),
                        label=group_label(group) if len(groups) > 1 else None)
            if beside:
                ax.plot(*zip(*beside), linestyle="", marker="o", markersize=6, fillstyle="none", color=style(number)["color"])
        ax.set(xlabel=across, ylabel=label)
        ax.grid(color="#dddddd", linewidth=0.6)
    if 1 < len(groups) < 8:
        axes[0][0].legend(fontsize=7)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return True


def group_label(group):
    return ", ".join(f"{key.split('.')[-1]} {value}" for key, value in group) or "as the scene"


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def flat(record):
    """A slice: its pictures are sections. A record in space has none here."""
    return int(record.frames[0].attrs.get("dimensions", 2)) == 2


def draw(sweep, results, folder):
    """Draws what there is to draw; (file, caption) of each."""
    done = []

    def keep(kind, caption, drawn):
        if drawn is not False:
            done.append((f"{sweep.name}_{kind}.png", caption))

    def path(kind):
        return os.path.join(folder, f"{sweep.name}_{kind}.png")

    shown = [(label, Kept(results[label].record)) for label in sweep.pictured if results[label].record]
    try:
        shown = [(label, one) for label, one in shown if flat(one.record)]
        with plt.rc_context(pr.STYLE):
            keep("curves", "Figures against the changed key", draw_curves(sweep, results, path("curves")))
            if shown:
                keep("sections", "Sections at successive instants", draw_sections(sweep, shown, path("sections")))
                keep("perimeter", "Tension along the perimeter", draw_tension_perimeter(sweep, shown, results, path("perimeter")))
            keep("tension", "Largest tension against time", draw_tension_history(sweep, results, path("tension")))
    finally:
        for _, one in shown:
            one.close()
    return done
