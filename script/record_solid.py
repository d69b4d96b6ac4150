"""Shaded views of a three-dimensional record: the sheets by tension, or the soil where there is none, and the hull."""

from collections import namedtuple

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection

from record_file import material_points, sharp_edges
from record_section import (
    BED, SAND, SKY, STEEL, STEEL_EDGE, TENSION, finish, head, label, name_axes, norms, panels, sand_value)

# Where the viewer stands: azimuth from x over y, elevation, in degrees. From starboard x runs to the right.
Camera = namedtuple("Camera", "azimuth elevation")
SIDE, CORNER = Camera(-90.0, 0.0), Camera(-55.0, 18.0)
LAMP = np.array([-0.35, 0.75, 0.56])  # to the lamp: over the viewer's left shoulder


def seen(camera, points):
    """To the right, up and towards the viewer, without perspective."""
    azimuth, elevation = np.radians(camera)
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    towards = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    return points @ np.stack([right, np.cross(towards, right), towards], axis=1)


def triangles(frame, group, points):
    """Corners of a group's triangles; none where it is absent or of lines."""
    if group not in frame or frame[group]["connectivity"].shape[1] != 3:
        return np.zeros((0, 3, 3))
    return frame[group][points][()][frame[group]["connectivity"][()]]


def shade(faces):
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    normals *= np.where(normals[:, 2] < 0.0, -1.0, 1.0)[:, None]  # the side that is seen
    return 0.62 + 0.38 * np.clip(normals @ LAMP, 0.0, 1.0)


def draw_sheets(ax, frame, camera, norm):
    faces = seen(camera, triangles(frame, "geotextile", "node"))
    if not len(faces):
        return None
    colours = TENSION(norm(frame["geotextile/gauge_tension"][()] / 1e3))
    colours[:, :3] *= shade(faces)[:, None]
    order = np.argsort(faces[:, :, 2].mean(axis=1))
    # Edges of the faces' own colour close the seams that smoothing leaves between them.
    ax.add_collection(PolyCollection(faces[order, :, :2], facecolors=colours[order], edgecolors=colours[order],
                                     linewidths=0.3, zorder=3))
    return ScalarMappable(norm, TENSION)


def draw_grains(ax, frame, camera, quantity, norm):
    if "soil" not in frame:
        return None
    position = seen(camera, frame["soil/position"][()])
    order = np.argsort(position[:, 2])
    diameter = 1.3 * np.cbrt(frame["soil/volume"][()])[order]
    grains = EllipseCollection(diameter, diameter, np.zeros_like(diameter), units="xy", offsets=position[order, :2],
                               offset_transform=ax.transData, cmap=SAND, norm=norm, linewidths=0.1, edgecolors="#6b4f22",
                               zorder=3)
    grains.set_array(sand_value(frame, quantity)[order])
    return ax.add_collection(grains)


def draw_boundaries(ax, frame, camera):
    """The hull see-through around the sheet, what is behind it first; surfaces below all."""
    ground = seen(camera, triangles(frame, "surface", "position"))
    ax.add_collection(PolyCollection(ground[:, :, :2], facecolors="#e7e2d8", edgecolors="#e7e2d8", linewidths=0.3, zorder=0))
    if len(ground):
        rim = sharp_edges(frame["surface/position"][()], frame["surface/connectivity"][()])
        ax.add_collection(LineCollection(seen(camera, rim)[:, :, :2], colors=BED, linewidths=1.0, zorder=0.5))
    hull = seen(camera, triangles(frame, "hull", "position"))
    if not len(hull):
        return
    middle = np.mean([seen(camera, points)[:, 2].mean() for points in material_points(frame)] or [0.0])
    before = hull[:, :, 2].mean(axis=1) > middle
    for faces, zorder, alpha in ((hull[~before], 1, 0.6), (hull[before], 4, 0.22)):
        ax.add_collection(PolyCollection(faces[:, :, :2], facecolors=STEEL, alpha=alpha, linewidths=0, zorder=zorder))
    edges = seen(camera, sharp_edges(frame["hull/position"][()], frame["hull/connectivity"][()]))
    ax.add_collection(LineCollection(edges[:, :, :2], colors=STEEL_EDGE, linewidths=0.9, alpha=0.8, zorder=5))


def draw_axes(ax, camera, corner, length):
    """Arrows along x, y and z."""
    origin = np.array(corner)
    for name, along in zip("xyz", np.eye(3)):
        tip = origin + length * seen(camera, along)[:2]
        ax.annotate("", tip, origin, arrowprops={"arrowstyle": "->", "linewidth": 0.9}, zorder=6)
        ax.text(*(origin + 1.25 * (tip - origin)), name, ha="center", va="center", fontsize=8, zorder=6)


def draw_solid(record, chosen, quantity, title, camera, path):
    """One panel an instant, as the camera sees it."""
    frames = [record.frames[index] for index, _ in chosen]
    shown = [points for frame in frames for points in material_points(frame)]
    shown += [frame["hull/position"][()] for frame in frames if "hull" in frame]
    points = np.vstack([seen(camera, points)[:, :2] for points in shown])
    lower, upper = points.min(axis=0), points.max(axis=0)
    margin = 0.06 * max(upper - lower)
    lower, upper = lower - margin, upper + margin
    figure, axes = panels(chosen, *(upper - lower))
    tension_norm, sand_norm = norms(record, chosen, quantity)
    sheet = sand = None
    for number, (ax, (index, caption)) in enumerate(zip(axes.flat, chosen)):
        frame = record.frames[index]
        draw_boundaries(ax, frame, camera)
        drawn = draw_sheets(ax, frame, camera, tension_norm)
        sheet = drawn or sheet
        if drawn is None:
            sand = draw_grains(ax, frame, camera, quantity, sand_norm) or sand
        head(ax, number, *label(record, index, caption))
        ax.set(xlim=(lower[0], upper[0]), ylim=(lower[1], upper[1]), aspect="equal")
        if camera == SIDE:
            if "water_level_m" in frame.attrs:
                ax.axhline(frame.attrs["water_level_m"], color=SKY, linewidth=1.2, zorder=1)
            name_axes(ax, number, len(chosen), axes.shape[1], "x forward [m]")
        else:
            ax.set_axis_off()
            draw_axes(ax, camera, lower + 2.0 * margin, 1.5 * margin)
    finish(figure, axes, sheet, sand, quantity, title, path)
