"""Figures that studies take from the frames of a record, of frames that are made up."""
import os
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "study"))
import histories  # noqa: E402


def square(middle, half):
    return np.array([[0.0, middle + y, z] for y, z in ((-half, -half), (half, -half), (half, half), (-half, half))])


class Overlap(unittest.TestCase):
    def frame(self, *sheets):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        file = h5py.File(os.path.join(folder.name, "frame.h5"), "w")
        self.addCleanup(file.close)
        group = file.create_group("geotextile")
        group["node"] = np.concatenate(sheets)
        group.attrs["name"] = [f"sheet {i}" for i in range(len(sheets))]
        group.attrs["first"] = np.cumsum([0] + [len(sheet) for sheet in sheets[:-1]])
        group.attrs["count"] = [len(sheet) for sheet in sheets]
        return file

    def test_is_the_depth_of_the_node_that_is_deepest_in_another_sheet(self):
        self.assertEqual(histories.of_frame(self.frame(square(0.0, 1.0), square(2.5, 1.0))), 0.0)
        self.assertAlmostEqual(histories.of_frame(self.frame(square(0.0, 1.0), square(1.6, 0.7))), 0.1)  # 0.9 is within 1
        self.assertAlmostEqual(histories.of_frame(self.frame(square(0.0, 1.0), square(0.0, 0.2))), 0.8)


if __name__ == "__main__":
    unittest.main(verbosity=2)
