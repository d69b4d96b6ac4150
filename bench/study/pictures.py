"""Pictures of a study, in the manner of the paper: sections at successive openings, tension against time and along the
perimeter, figures against the changed key."""

import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import Normalize

from figures import at, figures, tension_histories
from plotting import plot_record as pr

COLOURS = [pr.BLACK, pr.RED, pr.BLUE, pr.GREEN, pr.ORANGE, pr.SKY]
LINES = ["-", "--", "-.", ":"]
AXES = {"release_time_s": ("release time [s]", 1.0), "peak_tension_n_per_m": ("peak tension [kN/m]", 1e-3),
        "peak_tension_in_hull_n_per_m": ("peak until release [kN/m]", 1e-3),
        "residual_tension_n_per_m": ("residual tension [kN/m]", 1e-3), "container_width_m": ("final width [m]", 1.0),
        "container_height_m": ("final height [m]", 1.0), "geotextile_elongation_max": ("largest elongation [%]", 100.0),
        "slot_m": ("slot at release [m]", 1.0)}


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
    """Largest tension against time, of every run, of the pictured ones where there are several sheets; returns whether
    there was any."""
    figure, ax = plt.subplots(figsize=(8.5, 3.8), layout="constrained")
    released = 0.0
    lines = [(row.label, name, history) for row in sweep.rows
             for name, history in tension_histories(results[row.label].summary).items()]
    several = any(name != lines[0][1] for _, name, _ in lines)
    if several:
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
    """Figures against the first changed key, where that is a number."""
    key = sweep.columns[0] if sweep.columns else None
    rows = [row for row in sweep.rows if isinstance(row.changed.get(key), (int, float))]
    curves = [name for name in sweep.curves]
    if len(rows) < 2 or not curves:
        return False
    figure, axes = plt.subplots(1, len(curves), figsize=(3.6 * len(curves), 3.2), squeeze=False, layout="constrained")
    others = list(dict.fromkeys(tuple((k, str(v)) for k, v in row.changed.items() if k != key) for row in rows))
    for ax, name in zip(axes[0], curves):
        label, factor = AXES.get(name, (name, 1.0))
        for number, other in enumerate(others):
            points = []
            for row in rows:
                if tuple((k, str(v)) for k, v in row.changed.items() if k != key) == other:
                    value = figures(results[row.label]).get(name)
                    points.append((row.changed[key], factor * value if isinstance(value, (int, float)) else np.nan))
            points.sort()
            ax.plot(*zip(*points), marker="o", markersize=4, **style(number),
                    label=", ".join(f"{k.split('.')[-1]} {v}" for k, v in other) if len(others) > 1 else None)
        ax.set(xlabel=key, ylabel=label)
        ax.grid(color="#dddddd", linewidth=0.6)
    if 1 < len(others) < 8:
        axes[0][0].legend(fontsize=7)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return True


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
