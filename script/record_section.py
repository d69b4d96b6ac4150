"""Sections of a record: soil, sheets, hull and surfaces in the y-z plane, of a three-dimensional one midships."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen before)
import numpy as np  # noqa: E402
from matplotlib.collections import EllipseCollection, LineCollection  # noqa: E402
from matplotlib.colors import LinearSegmentedColormap, Normalize  # noqa: E402

from record_file import BadInput, dimensions, material_points, midships, parts, section_lines  # noqa: E402

BLACK, ORANGE, SKY, GREEN, BLUE, RED = "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00"
SAND = LinearSegmentedColormap.from_list("sand", ["#f6ecd2", "#dcbf86", "#a97b35"])
TENSION = LinearSegmentedColormap.from_list("tension", plt.get_cmap("viridis")(np.linspace(0.97, 0.08, 256)))
STEEL, STEEL_EDGE, BED = "#d5dae0", "#3c4650", "#8a8378"
STYLE = {
    "font.family": "DejaVu Sans", "font.size": 10, "axes.titlesize": 10.5, "axes.labelsize": 10, "axes.linewidth": 0.8,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "legend.fontsize": 9,
    "xtick.labelsize": 9, "ytick.labelsize": 9, "savefig.dpi": 160,
}


def hull_body(line, angle, side):
    """The inner wall closed to a body: the record has no outer shell, so one is drawn 0.8 m outside, in the half's axes."""
    turn = side * angle  # counter-clockwise with y to the right and z up: opens the port half
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])  # rows: the half's y and z
    own = line @ axes.T
    outer = side * (np.max(side * own[:, 0]) + 0.8)
    return np.vstack([own, [outer, own[-1, 1]], [outer, own[0, 1]]]) @ axes


def hull_bodies(frame):
    """Inner wall and body of each half of a plane-strain hull."""
    if "hull" not in frame or dimensions(frame) == 3:
        return
    for (name, rows), angle in zip(parts(frame["hull"]), frame["hull/angle"][()]):
        line = frame["hull/position"][rows][:, 1:]
        yield line, hull_body(line, angle, 1.0 if name == "hull_port" else -1.0)


def boundary_lines(frame, group):
    """Where a three-dimensional hull or surface is cut by the section."""
    if group not in frame or dimensions(frame) != 3:
        return np.zeros((0, 2, 2))
    return section_lines(frame[group]["position"][()], frame[group]["connectivity"][()], midships(frame))[0]


def draw_hull(ax, frame):
    ax.add_collection(LineCollection(boundary_lines(frame, "hull"), colors=STEEL_EDGE, linewidths=1.4,
                                     capstyle="round", zorder=5))
    for line, body in hull_bodies(frame):
        ax.fill(body[:, 0], body[:, 1], color=STEEL, linewidth=0, zorder=1)
        ax.plot(line[:, 0], line[:, 1], color=STEEL_EDGE, linewidth=1.4, solid_joinstyle="round", zorder=5)


def surfaces(frame):
    """Points of each rigid surface in plane strain, and whether the last is joined to the first."""
    if "surface" not in frame or dimensions(frame) == 3:
        return
    for (_, rows), closed in zip(parts(frame["surface"]), frame["surface"].attrs["closed"]):
        yield frame["surface/position"][rows][:, 1:], bool(closed)


def draw_surfaces(ax, frame, depth):
    """Rigid surfaces, in plane strain hatched on their solid side: the right, walking along them."""
    ax.add_collection(LineCollection(boundary_lines(frame, "surface"), colors=BED, linewidths=1.2, zorder=1))
    for line, closed in surfaces(frame):
        if closed:
            draw_closed_surface(ax, line)
            continue
        along = np.gradient(line, axis=0)
        right = np.column_stack([along[:, 1], -along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
        solid = np.vstack([line, (line + depth * right)[::-1]])
        ax.fill(solid[:, 0], solid[:, 1], facecolor="#e7e2d8", edgecolor=BED, hatch="////", linewidth=0, zorder=0)
        ax.plot(line[:, 0], line[:, 1], color=BED, linewidth=1.2, zorder=1)


def draw_closed_surface(ax, line):
    """A roller is filled: clockwise its solid side is inside. A basin is a line: all around it would be solid."""
    y, z = line.T
    clockwise = np.sum(y * np.roll(z, -1) - np.roll(y, -1) * z) < 0.0
    if clockwise:
        ax.fill(y, z, facecolor="#e7e2d8", edgecolor=BED, hatch="////", linewidth=0, zorder=0)
    ring = np.vstack([line, line[:1]])
    ax.plot(ring[:, 0], ring[:, 1], color=BED, linewidth=1.2, zorder=1)


def sand_value(frame, quantity):
    if quantity == "speed":
        return np.linalg.norm(frame["soil/velocity"][()], axis=1)
    return -frame["soil/stress"][:, 5] / 1e3


def particles_in_section(frame):
    """The edge of each particle, m, and which particles the section meets."""
    volume = frame["soil/volume"][()]
    if dimensions(frame) == 2:
        return np.sqrt(volume), np.ones(len(volume), dtype=bool)
    size = np.cbrt(volume)
    return size, np.abs(frame["soil/position"][:, 0] - midships(frame)) <= 0.6 * size


def draw_sand(ax, frame, quantity, norm):
    if "soil" not in frame:
        return None
    size, shown = particles_in_section(frame)
    diameter = 1.8 * size[shown]  # overlapping: sheared sand shows no gaps between its rows
    sand = EllipseCollection(diameter, diameter, np.zeros_like(diameter), units="xy",
                             offsets=frame["soil/position"][()][shown, 1:], offset_transform=ax.transData, cmap=SAND,
                             norm=norm, linewidths=0, zorder=2)
    sand.set_array(sand_value(frame, quantity)[shown])
    return ax.add_collection(sand)


def draw_geotextile(ax, frame, norm):
    if "geotextile" not in frame:
        return None
    pieces, owner = section_lines(frame["geotextile/node"][()], frame["geotextile/connectivity"][()], midships(frame))
    ax.add_collection(LineCollection(pieces, colors="black", linewidths=4.0, capstyle="round", zorder=3))
    sheet = LineCollection(pieces, cmap=TENSION, norm=norm, linewidths=2.8, capstyle="round", zorder=4)
    sheet.set_array(frame["geotextile/gauge_tension"][()][owner] / 1e3)
    return ax.add_collection(sheet)


def view(frames):
    """Limits that show all of hull, sand, sheet and rollers in every panel: y from, y to, z from, z to."""
    corners = [points[:, 1:] for frame in frames for points in material_points(frame)]
    corners += [boundary_lines(frame, "hull").reshape(-1, 2) for frame in frames]
    corners += [body for frame in frames for _, body in hull_bodies(frame)]
    corners += [line for frame in frames for line, closed in surfaces(frame) if closed]
    if not sum(map(len, corners)):
        raise BadInput("the record holds neither hull nor soil nor geotextile")
    points = np.vstack(corners)
    (y0, z0), (y1, z1) = points.min(axis=0), points.max(axis=0)
    margin = 0.06 * max(y1 - y0, z1 - z0)
    return y0 - margin, y1 + margin, z0 - 1.4 * margin, z1 + margin


def label(record, index, caption):
    instant = f"t = {record.time[index]:.1f} s"
    lines = []
    if "hull" in record.frames[index]:
        port, starboard = record.port[index], record.starboard[index]
        lines.append(f"opening {port:.1f}°" if abs(port - starboard) < 0.05
                     else f"opening {port:.1f}° / {starboard:.1f}°")
    if record.tension.size:
        lines.append(f"tension up to {record.tension[index].max():.1f} kN/m")
    return (f"{caption}, {instant}" if caption else instant), ", ".join(lines)


def panels(chosen, width, height):
    """Axes for the chosen instants, three in a row, for a view of that width and height."""
    columns = min(3, len(chosen))
    rows = -(-len(chosen) // columns)
    tallest = 6.5
    panel = np.clip(tallest * width / height, 2.4, 3.5)  # a narrow view, half a section, makes narrow panels
    height = np.clip(panel * height / width, 1.8, tallest)
    figure, axes = plt.subplots(rows, columns, figsize=(columns * panel + 0.4, rows * (height + 0.7) + 1.5), sharex=True,
                                sharey=True, squeeze=False, layout="constrained")
    for ax in axes.flat[len(chosen):]:
        ax.set_visible(False)
    return figure, axes


def head(ax, number, heading, note):
    ax.set_title(f"({'abcdefghijklmnopqrstuvwxyz'[number % 26]}) {heading}\n", loc="left", weight="bold")
    ax.text(0.0, 1.012, note, transform=ax.transAxes, va="bottom", fontsize=9.5)


def name_axes(ax, number, count, columns, horizontal):
    if number >= count - columns:
        ax.set_xlabel(horizontal)
        ax.tick_params(labelbottom=True)
    if number % columns == 0:
        ax.set_ylabel("z up [m]")


def norms(record, chosen, quantity):
    """Scales of tension and soil over the chosen instants."""
    frames = [record.frames[index] for index, _ in chosen]
    top = max([record.tension[index].max() for index, _ in chosen if record.tension.size], default=0.0)
    sand_top = max([np.percentile(sand_value(frame, quantity), 99.5) for frame in frames if "soil" in frame], default=1.0)
    return Normalize(0.0, top if top > 0.0 else 1.0), Normalize(0.0, max(float(sand_top), 1e-3))


def finish(figure, axes, sheet, sand, quantity, title, path):
    """Colour bars of what was drawn, title, file."""
    bars = {"location": "bottom", "aspect": 45, "shrink": 0.75, "pad": 0.02}
    if sheet is not None:
        figure.colorbar(sheet, ax=axes, label="geotextile: gauge tension [kN/m]", **bars)
    if sand is not None:
        what = "speed [m/s]" if quantity == "speed" else "vertical stress, compression positive [kPa]"
        figure.colorbar(sand, ax=axes, label=f"soil: {what}", extend="max", **bars)
    figure.suptitle(title, fontsize=11.5, weight="bold")
    figure.savefig(path)
    plt.close(figure)


def draw_section(record, chosen, quantity, title, path):
    frames = [record.frames[index] for index, _ in chosen]
    y0, y1, z0, z1 = view(frames)
    figure, axes = panels(chosen, y1 - y0, z1 - z0)
    tension_norm, sand_norm = norms(record, chosen, quantity)
    sheet = sand = None
    for number, (ax, (index, caption)) in enumerate(zip(axes.flat, chosen)):
        frame = record.frames[index]
        draw_surfaces(ax, frame, 0.3 * (y1 - y0))
        draw_hull(ax, frame)
        if "water_level_m" in frame.attrs:
            ax.axhline(frame.attrs["water_level_m"], color=SKY, linewidth=1.2, zorder=1)
        sand = draw_sand(ax, frame, quantity, sand_norm) or sand
        sheet = draw_geotextile(ax, frame, tension_norm) or sheet
        head(ax, number, *label(record, index, caption))
        ax.set(xlim=(y0, y1), ylim=(z0, z1), aspect="equal")
        name_axes(ax, number, len(chosen), axes.shape[1], "y to port [m]")
    finish(figure, axes, sheet, sand, quantity, title, path)
