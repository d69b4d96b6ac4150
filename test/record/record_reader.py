"""What the tests demand of a record and its sidecar, whatever happened to the run that wrote them."""

import os
import xml.etree.ElementTree as ElementTree

import h5py


def read_everything(path):
    """Opens the record, reads every array and attribute of every frame, and returns the frames' names."""

    def visit(_, thing):
        dict(thing.attrs)
        if isinstance(thing, h5py.Dataset):
            thing[()]

    with h5py.File(path, "r") as record:
        assert record["scene"][()].decode().startswith("name:")
        names = list(record["frames"])
        assert names == [f"{i:06}" for i in range(len(names))], names
        for name in names:
            frame = record["frames"][name]
            assert frame["time"][()] == frame.attrs["time_s"]
            assert {"soil", "geotextile", "hull", "surface", "energy", "status", "probes"} <= set(frame)
            frame.visititems(visit)
        return names


def read_sidecar(path):
    """Parses the sidecar, follows each reference into the HDF5 file, compares shapes, and returns the times."""
    times = []
    collection = ElementTree.parse(path).getroot().find("Domain/Grid")
    assert collection.get("CollectionType") == "Temporal"
    with_folder = os.path.dirname(os.path.abspath(path))
    opened = {}
    for grid in collection.findall("Grid"):
        times.append(float(grid.find("Time").get("Value")))
        assert {"soil", "geotextile", "hull", "surface"} == {part.get("Name") for part in grid.findall("Grid")}
        for item in grid.iter("DataItem"):
            file_name, inner = item.text.strip().split(":")
            record = opened.setdefault(file_name, h5py.File(os.path.join(with_folder, file_name), "r"))
            shape = tuple(int(n) for n in item.get("Dimensions").split())
            assert record[inner].shape == shape, (inner, record[inner].shape, shape)
            assert record[inner].dtype.itemsize == int(item.get("Precision")), inner
            assert record[inner].dtype.kind == {"Float": "f", "Int": "i"}[item.get("NumberType")], inner
            assert record[inner[: inner.index("/", len("/frames/"))]].attrs["time_s"] == times[-1]
    for record in opened.values():
        record.close()
    return times
