"""The pictures of a record: drawn for every kind of run, telling the right instants, clear about bad input."""

import importlib.machinery
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import matplotlib.image
import numpy

from record_reader import read_everything, read_sidecar

WRITER, PLOT = sys.argv.pop(1), sys.argv.pop(1)
sys.path.append(os.path.dirname(PLOT))
sys.dont_write_bytecode = True
import record_file  # noqa: E402  (it is beside the program)

SOLID = ["history.png", "section.png", "side.png", "solid.png"]


def load_program():
    loader = importlib.machinery.SourceFileLoader("plot_record", PLOT)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("plot_record", loader))
    loader.exec_module(module)
    return module


class PlotRecord(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.program = load_program()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def record(self, name, frames, change=None, kind=()):
        path = self.path(name)
        subprocess.run([WRITER, path, str(frames), "6", *kind], check=True, stdout=subprocess.DEVNULL)
        if change is not None:
            with h5py.File(path, "r+") as file:
                for frame in file["frames"].values():
                    change(frame)
        return path

    def plot(self, *arguments):
        return subprocess.run([sys.executable, PLOT, *arguments], stderr=subprocess.PIPE, text=True, timeout=120)

    def expect_pictures(self, record, *arguments, names=("history.png", "section.png")):
        out = self.path(os.path.basename(record) + ".pictures")
        run = self.plot(record, "--out", out, *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(sorted(os.listdir(out)), list(names))
        for name in names:
            picture = matplotlib.image.imread(os.path.join(out, name))
            self.assertGreater(min(picture.shape[:2]), 300)
            drawn = (picture[..., :3].min(axis=2) < 0.9).mean()
            self.assertGreater(drawn, 0.01, name)
        return out

    def expect_refusal(self, *arguments, naming):
        run = self.plot(*arguments)
        self.assertEqual(run.returncode, 2)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(naming, run.stderr)

    def chosen(self, path):
        record = self.program.Record(path)
        picked = self.program.chosen_frames(record, None)
        return [caption for _, caption in picked], [float(record.time[index]) for index, _ in picked]

    def test_released_run(self):
        path = self.record("released.h5", 201)
        captions, times = self.chosen(path)
        self.assertEqual(captions, ["closed", "opening", "squeezing", "release", "landing", "at rest"])
        self.assertEqual(sorted(set(times)), times)
        closed, opening, squeezing, release, landing, rest = times
        self.assertTrue(4.0 <= closed <= 7.0 < opening < squeezing < 27.0, times)
        self.assertEqual(release, 27.0)
        self.assertTrue(27.0 < landing < 29.5, times)
        self.assertEqual(rest, 40.0)
        summary = self.path("summary.json")
        with open(summary, "w", encoding="utf-8") as file:
            json.dump({"outcome": "released", "real_time_factor": None}, file)
        self.expect_pictures(path, "--summary", summary)

    def test_coarse_output_gives_six_different_frames(self):
        _, times = self.chosen(self.record("coarse.h5", 14))
        self.assertEqual(len(times), 6)
        self.assertEqual(sorted(set(times)), times)

    def test_hung_up_run(self):
        def stays(frame):
            frame["status"].attrs["release_time_s"] = -1.0
            frame["status"].attrs["outcome"] = numpy.bytes_("hung_up")

        path = self.record("hung.h5", 81, stays)
        captions, times = self.chosen(path)
        self.assertEqual(captions, [""] * 6)
        self.assertEqual((times[0] < 7.0, times[-1]), (True, 40.0))
        self.expect_pictures(path)

    def test_column_without_hull_and_sheet(self):
        def strip(frame):
            for name in ("hull", "geotextile", "surface"):
                del frame[name]
            frame["status"].attrs["release_time_s"] = -1.0

        self.expect_pictures(self.record("column.h5", 9, strip), "--soil", "stress")

    def test_cable_alone(self):
        def only_cable(frame):
            for name in ("hull", "soil", "surface"):
                del frame[name]
            frame["status"].attrs["release_time_s"] = -1.0
            sheet = frame["geotextile"]
            sheet.attrs["closed"] = [0]
            sheet.attrs["segment_count"] = [sheet["node"].shape[0] - 1]
            for name in ("connectivity", "tension", "gauge_tension"):
                kept = sheet[name][:-1]
                del sheet[name]
                sheet[name] = kept

        self.expect_pictures(self.record("cable.h5", 9, only_cable))

    def test_several_sheets_and_a_roller(self):
        def six_sheets(frame):
            frame["surface"].attrs["closed"] = [1]
            sheet = frame["geotextile"]
            count = sheet["node"].shape[0]
            for name in ("node", "tension", "gauge_tension", "connectivity"):
                one = sheet[name][()]
                more = [one + (i * count if name == "connectivity" else 0.1 * i) for i in range(6)]
                del sheet[name]
                sheet[name] = numpy.concatenate(more)
            sheet.attrs["name"] = numpy.array([f"bag_{i}" for i in range(6)], dtype="S")
            for name, value in (("first", [i * count for i in range(6)]), ("count", [count] * 6), ("closed", [1] * 6)):
                sheet.attrs[name] = value
            sheet.attrs["first_segment"], sheet.attrs["segment_count"] = sheet.attrs["first"], sheet.attrs["count"]
            for name in ("gauge_length_m", "strength_n_per_m", "seam_strength_n_per_m"):
                sheet.attrs[name] = numpy.repeat(sheet.attrs[name], 6)

        path = self.record("six.h5", 9, six_sheets)
        self.assertEqual(self.program.Record(path).tension.shape, (9, 6))
        self.expect_pictures(path)

    def test_short_run_and_chosen_times(self):
        self.expect_pictures(self.record("one.h5", 1))
        self.expect_pictures(self.record("some.h5", 41), "--times", "0,12.5,40")

    def solid(self, name, change=None):
        return self.record(name, 3, change, ["solid"])

    def test_three_dimensional_run(self):
        path = self.solid("solid.h5")
        self.assertEqual(len(read_everything(path)), 3)
        self.assertEqual(read_sidecar(self.path("solid.xdmf")), [0.0, 20.0, 40.0])
        record = self.program.Record(path)
        self.assertEqual((record.dimensions, record.tension.shape), (3, (3, 1)))
        self.assertGreater(record.energy("potential")[0], record.energy("potential")[-1])
        self.expect_pictures(path, names=SOLID)

    def test_three_dimensional_run_without_sheet_and_hull(self):
        def strip(frame):
            for name in ("hull", "geotextile"):
                del frame[name]

        self.expect_pictures(self.solid("heap.h5", strip), "--soil", "stress", names=SOLID)

    def test_section_of_triangles(self):
        """A tetrahedron cut where one corner, or two, are ahead: each cut triangle gives one line, together a ring."""
        points = numpy.array([[0.0, 0, 0], [0, 2, 0], [0, 0, 2], [4, 0, 0]])
        faces = numpy.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
        lines, owner = record_file.section_lines(points, faces, 2.0)
        self.assertEqual(owner.tolist(), [1, 2, 3])
        expected = {((0, 0), (1, 0)), ((0, 1), (1, 0)), ((0, 0), (0, 1))}
        self.assertEqual({tuple(sorted(map(tuple, line))) for line in lines.tolist()}, expected)
        turned = points[:, [1, 0, 2]]  # corners 1 is ahead of y = 1 alone; from behind, 0, 2 and 3
        lines, owner = record_file.section_lines(turned, faces, 1.0)
        self.assertEqual(owner.tolist(), [0, 1, 2])
        self.assertEqual({tuple(sorted(map(tuple, line))) for line in lines.tolist()},
                         {((0, 0), (0, 1)), ((0, 0), (2, 0)), ((0, 1), (2, 0))})

    def test_edges_of_a_cube(self):
        """Twelve edges, none of the six diagonals of its faces; of an open box as many."""
        corners = numpy.array([[x, y, z] for x in (0.0, 1) for y in (0, 1) for z in (0, 1)])
        faces = numpy.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6],
                             [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
        for kept in (faces, faces[:10]):
            edges = record_file.sharp_edges(corners, kept)
            self.assertEqual(edges.shape, (12, 2, 3))
            self.assertTrue(numpy.allclose(numpy.linalg.norm(edges[:, 1] - edges[:, 0], axis=1), 1.0))

    def test_bad_input(self):
        record, out = self.record("good.h5", 3), self.path("out")
        self.expect_refusal(self.path("none.h5"), "--out", out, naming="none.h5")
        self.expect_refusal(PLOT, "--out", out, naming=PLOT)
        self.expect_refusal(record, "--out", out, "--times", "1,x", naming="--times 1,x")
        self.expect_refusal(record, "--out", out, "--times", "1,41", naming="0 to 40 s")
        self.expect_refusal(record, "--out", out, "--times", "nan", naming="--times nan")
        self.expect_refusal(record, "--out", out, "--summary", PLOT, naming="--summary")
        self.expect_refusal(record, "--out", record, naming="--out")
        with h5py.File(self.path("empty.h5"), "w") as file:
            file.create_group("frames")
        self.expect_refusal(self.path("empty.h5"), "--out", out, naming="holds no frame")


if __name__ == "__main__":
    unittest.main()
