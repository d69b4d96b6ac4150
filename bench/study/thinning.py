"""Keeps of a record what pictures need: every frame's sheet, hull and status, the soil of six frames only."""

import h5py

from plotting import plot_record


def thin(whole, kept):
    """Writes `kept` with all frames of `whole`; frames without soil have lost it. Attribute `chosen`: the six."""
    record = plot_record.Record(whole)
    chosen = plot_record.chosen_frames(record, None)
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
