"""A record as plot_record reads it: histories, frames, and the lines that show its surfaces."""

import h5py
import numpy as np


class BadInput(Exception):
    """One line that says what is wrong."""


class Record:
    """The histories of a record, and its frames on demand."""

    def __init__(self, path):
        try:
            self.file = h5py.File(path, "r")
            self.frames = [self.file["frames"][name] for name in sorted(self.file["frames"])]
        except (OSError, KeyError) as error:
            raise BadInput(f"{path}: cannot be read as a record: {error}") from None
        if not self.frames:
            raise BadInput(f"{path}: holds no frame")
        self.name = text(self.file.attrs["scene_name"])
        self.dimensions = dimensions(self.frames[0])
        self.time = self.series(lambda frame: frame.attrs["time_s"])
        self.port = np.degrees(self.series(lambda frame: frame.attrs["port_rad"]))
        self.starboard = np.degrees(self.series(lambda frame: frame.attrs["starboard_rad"]))
        self.height = self.series(lambda frame: frame["status"].attrs["centroid_m"][2])
        first = self.frames[0]
        self.sheets = [text(name) for name in first["geotextile"].attrs["name"]] if "geotextile" in first else []
        self.tension = np.array([largest_tensions(frame) for frame in self.frames]).reshape(len(self.time), -1)
        self.has_soil = "soil" in first
        self.outcome = text(self.frames[-1]["status"].attrs["outcome"])
        release = self.frames[-1]["status"].attrs["release_time_s"]
        self.release = float(release) if release >= 0.0 else None
        # The peak of every step, which the frames may have missed.
        self.peak = float(self.frames[-1]["status"].attrs["peak_tension_n_per_m"]) / 1e3
        self.peak_time = float(self.frames[-1]["status"].attrs["peak_tension_time_s"])

    def series(self, value):
        return np.array([value(frame) for frame in self.frames], dtype=float)

    def lowest(self, index):
        """Lowest level of soil and sheets in a frame, m."""
        return min(points[:, 2].min() for points in material_points(self.frames[index]))

    def energy(self, name):
        key = f"{name}_j" if self.dimensions == 3 else f"{name}_j_per_m"
        return self.series(lambda frame: frame["energy"].attrs[key]) / 1e3


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def parts(group):
    """Name and row range of each body, sheet or boundary of a group."""
    for name, first, count in zip(group.attrs["name"], group.attrs["first"], group.attrs["count"]):
        yield text(name), slice(int(first), int(first + count))


def dimensions(frame):
    """3, or 2 in plane strain."""
    return int(frame.attrs.get("dimensions", 2))


def segments(group):
    """Range of each sheet's pieces: segments, of which an open sheet has one less than nodes, or triangles."""
    for first, count in zip(group.attrs["first_segment"], group.attrs["segment_count"]):
        yield slice(int(first), int(first + count))


def material_points(frame):
    """Positions of soil and sheets."""
    return [frame[path][()] for path in ("soil/position", "geotextile/node") if path in frame]


def largest_tensions(frame):
    """The largest gauge tension of each sheet, kN/m."""
    if "geotextile" not in frame:
        return []
    tension = frame["geotextile/gauge_tension"][()]
    return [tension[rows].max() / 1e3 for rows in segments(frame["geotextile"])]


def midships(frame):
    """The x nearest 0 that the container reaches; at its end just inside, so that its triangles are cut."""
    points = np.vstack(material_points(frame) or [np.zeros((1, 3))])
    inside = 1e-3 * np.ptp(points[:, 0])
    return float(np.clip(0.0, points[:, 0].min() + inside, points[:, 0].max() - inside))


def section_lines(points, pieces, x):
    """Where the pieces of a sheet or boundary lie in the section at x: ends in (y, z), and which pieces these are."""
    corners = points[pieces]
    if pieces.shape[1] == 2:
        return corners[:, :, 1:], np.arange(len(pieces))
    ahead = corners[:, :, 0] >= x
    cut = np.flatnonzero(ahead.any(axis=1) & ~ahead.all(axis=1))
    corners, ahead = corners[cut], ahead[cut]
    # The corner that is alone on its side of the plane comes first: both its edges are cut.
    alone = np.argmax(ahead == (ahead.sum(axis=1) == 1)[:, None], axis=1)
    rows = np.arange(len(cut))
    first = corners[rows, alone]
    ends = []
    for step in (1, 2):
        other = corners[rows, (alone + step) % 3]
        share = (x - first[:, 0]) / (other[:, 0] - first[:, 0])
        ends.append((first + share[:, None] * (other - first))[:, 1:])
    return np.stack(ends, axis=1), cut


def sharp_edges(points, triangles):
    """Ends of the edges where a surface of triangles ends or turns by more than about 25 degrees."""
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    edges = np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, owner = edges[order], owner[order]
    first = np.flatnonzero(np.r_[True, (edges[1:] != edges[:-1]).any(axis=1)])
    count = np.diff(np.r_[first, len(edges)])
    pairs = first[count == 2]
    turned = np.sum(normals[owner[pairs]] * normals[owner[pairs + 1]], axis=1) < 0.9
    return points[edges[np.r_[first[count != 2], pairs[turned]]]]
