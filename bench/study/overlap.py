"""How deep closed sheets of several containers reach into each other."""

import numpy as np
from matplotlib.path import Path

from plotting import plot_record as pr


def distance_to_line(point, line):
    """From a point to a closed line."""
    start, end = line, np.roll(line, -1, axis=0)
    along = end - start
    share = np.einsum("ij,ij->i", point - start, along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
    return np.linalg.norm(start + np.clip(share, 0.0, 1.0)[:, None] * along - point, axis=1).min()


def of_frame(frame):
    """Largest distance of a node within another sheet from that sheet, m; 0 where none is within."""
    node = frame["geotextile/node"][:, 1:]
    lines = [node[rows] for _, rows in pr.parts(frame["geotextile"])]
    depth = 0.0
    for i, line in enumerate(lines):
        for j, other in enumerate(lines):
            if i != j:
                depth = max([depth, *(distance_to_line(point, line) for point in other[Path(line).contains_points(other)])])
    return depth


def deepest(path):
    """The largest over the frames of a record, m."""
    record = pr.Record(path)
    try:
        return float(max(of_frame(frame) for frame in record.frames))
    finally:
        record.file.close()
