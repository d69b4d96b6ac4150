"""Keeps of a record what pictures need: every frame's sheet, hull and status, the soil of six frames only."""

import h5py
import numpy as np

from plotting import plot_record


def chosen_frames(record):
    """Those of plot_record; about the largest tension where no hull opens but a sheet is there."""
    if "hull" in record.frames[0] or not record.tension.size:
        return plot_record.chosen_frames(record, None)
    last, largest = len(record.time) - 1, int(np.argmax(record.tension.max(axis=1)))
    captions = {0: "start", last: "at the end"}
    captions |= {largest + round(share * (last - largest)): "" for share in (0.03, 0.15, 0.4) if largest < last}
    captions[largest] = "largest tension"
    return sorted(captions.items())


def thin(whole, kept):
    """Writes `kept` with all frames of `whole`; frames without soil have lost it. Attribute `chosen`: the six."""
    record = plot_record.Record(whole)
    chosen = chosen_frames(record)
    indices = {index for index, _ in chosen}
    with h5py.File(kept, "w") as out:
        for name, value in record.file.attrs.items():
            out.attrs[name] = value
        frames = out.create_group("frames")
        for number, frame in enumerate(record.frames):
            name = frame.name.rsplit("/", 1)[-1]
            target = frames.create_group(name)
            for key, value in frame.attrs.items():
                target.attrs[key] = value
            for part in frame:
                if part == "probes" or (part == "soil" and number not in indices):
                    continue
                frame.copy(part, target)
        out.attrs["chosen"] = [index for index, _ in chosen]
        out.attrs["caption"] = [caption.encode() for _, caption in chosen]
    record.file.close()
