"""Figures that the frames of a record tell and the summary does not."""

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


def transfer_share(path):
    """Until the middle of the fill leaves the hull, of all that was dissipated, the part that the transfer between particles
    and grid took: what the discretisation resists the flow through the slot. Between two frames linearly; None where the
    middle does not leave."""
    record = pr.Record(path)
    try:
        above = None  # of the frame before: height of the middle above the hull's lowest point, taken by the transfer, by all
        for height, frame in zip(record.height, record.frames):
            if "hull" not in frame:
                return None
            energy = frame["energy"].attrs
            unit = "j_per_m" if "dissipated_j_per_m" in energy else "j"  # a slice, or in space
            now = np.array([height - frame["hull/position"][:, 2].min(), energy[f"dissipated_transfer_{unit}"],
                            energy[f"dissipated_{unit}"]])
            if now[0] < 0.0 and above is not None:
                _, transfer, everything = above + (now - above) * above[0] / (above[0] - now[0])
                return float(transfer / everything)
            above = now
        return None
    finally:
        record.file.close()


def overlap(path):
    """How deep the sheets of several containers ever reached into each other, m."""
    record = pr.Record(path)
    try:
        return float(max(of_frame(frame) for frame in record.frames))
    finally:
        record.file.close()
