"""Sweep files: what they become, what is refused; what physics expects of a sweep's rows."""

import os
import sys
import tempfile
import unittest

ROOT = sys.argv.pop(1)
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(ROOT, "bench", "study"))

import expectations  # noqa: E402
import sweep  # noqa: E402

SCENE = os.path.join(ROOT, "config", "scenes", "release.yaml")


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "mine.yaml")

    def load(self, text, overrides=None):
        with open(self.path, "w", encoding="utf-8") as file:
            file.write(f"scene: {SCENE}\n{text}")
        return sweep.load(self.path, overrides)


class Sweeps(Folder):
    def test_product_then_rows(self):
        study = self.load("""
set: {time.end_s: 3}
sweep: {hull.friction: [0.1, 0.2], grid.cell_size_m: [0.1, 0.2]}
rows: [{label: rough, hull.friction: 0.9, effort: 2}]
""")
        self.assertEqual([row.label for row in study.rows],
                         ["friction 0.1, cell_size_m 0.1", "friction 0.1, cell_size_m 0.2", "friction 0.2, cell_size_m 0.1",
                          "friction 0.2, cell_size_m 0.2", "rough"])
        self.assertEqual(study.columns, ["hull.friction", "grid.cell_size_m"])
        self.assertEqual(study.rows[1].overrides, {"time.end_s": 3, "hull.friction": 0.1, "grid.cell_size_m": 0.2})
        self.assertEqual((study.rows[4].changed, study.rows[4].effort), ({"hull.friction": 0.9}, 2.0))
        self.assertEqual(study.name, "mine")

    def test_overrides_win(self):
        study = self.load("set: {time.end_s: 3}\nsweep: {hull.friction: [0.1]}", {"time.end_s": 5, "hull.friction": 0.7})
        self.assertEqual(study.rows[0].overrides, {"time.end_s": 5, "hull.friction": 0.7})

    def test_tables_are_stretched_and_scaled(self):
        study = self.load("""
stretch: {slower: hull.opening_table}
scale: {further: hull.opening_table}
rows: [{slower: 2}, {further: 0.5}]
""")
        slower, further = (row.overrides["hull.opening_table"] for row in study.rows)
        self.assertEqual(slower[2], [15.0, 0.0089, 0.0089])
        self.assertEqual(further[2], [7.5, 0.00445, 0.00445])
        self.assertEqual(len(slower), 13)

    def test_values_become_one_line_of_yaml(self):
        for value, text in ((0.1, "0.1"), (3.0e6, "3000000.0"), (True, "true"), ([[0, 1.5], [2, 3]], "[[0, 1.5], [2, 3]]"),
                            ({"box": {"lower_m": [0, 1]}}, "{box: {lower_m: [0, 1]}}"), ("gravity", "gravity")):
            self.assertEqual(sweep.scene_value(value), text)

    def test_refusals_name_file_key_and_what_is_allowed(self):
        for text, words in (("sweeep: {a: [1]}", ["sweeep", "unknown key; allowed"]), ("", ["sweep", "at least one run"]),
                            ("sweep: {hull.friction: 0.1}", ["sweep.hull.friction", "list"]),
                            ("rows: [{label: a, x: 1}, {label: a, x: 2}]", ["two rows", "= a"]),
                            ("rows: [{slower: 2}]\nstretch: {slower: hull.nothing}", ["slower", "no such table"]),
                            ("rows: [{slower: -2}]\nstretch: {slower: hull.opening_table}", ["slower", "above 0"]),
                            ("rows: [{x: 1}]\nangles: none.csv", ["angles", "no file"]),
                            ("rows: [{x: 1}]\npictures: {sections: [y 1]}", ["y 1", "no row", "x 1"]),
                            ("rows: [{x: 1}]\nexpect: [{figure: a, trend: up}]", ["expect[0]", "rising"]),
                            ("rows: [{x: 1}]\nexpect: [{figure: a, trend: rising, against: y}]", ["expect[0].against", "x"])):
            with self.assertRaises(sweep.BadSweep, msg=text) as caught:
                self.load(text)
            message = str(caught.exception)
            self.assertNotIn("\n", message)
            for word in [self.path, *words]:
                self.assertIn(word, message)
        with self.assertRaises(sweep.BadSweep):
            sweep.load(self.path + ".none")

    def test_studies_of_the_package_are_read(self):
        folder = os.path.join(ROOT, "config", "studies")
        studies = [sweep.load(os.path.join(folder, name)) for name in sorted(os.listdir(folder))]
        self.assertGreaterEqual(len(studies), 6)
        for study in studies:
            self.assertTrue(study.question, study.name)


class Expectations(unittest.TestCase):
    def met(self, runs, **item):
        study = sweep.Sweep("x", "", "", "", None, [], expect=[item])
        runs = [{"status": "completed", "label": str(number), **row} for number, row in enumerate(runs)]
        (_, _, verdict), = expectations.check(study, runs)
        return verdict

    def test_monotone(self):
        rows = [{"mu": 0.3, "t": 3.0}, {"mu": 0.1, "t": 1.0}, {"mu": 0.2, "t": 2.0}, {"other": 5, "t": 0.0}]
        self.assertTrue(self.met(rows, figure="t", trend="rising", against="mu"))
        self.assertFalse(self.met(rows, figure="t", trend="falling", against="mu"))
        rows[0]["t"] = 1.95
        self.assertFalse(self.met(rows, figure="t", trend="rising", against="mu"))
        self.assertTrue(self.met(rows, figure="t", trend="rising", against="mu", absolute=0.06))
        self.assertFalse(self.met(rows[:1], figure="t", trend="rising", against="mu"), "one row shows no trend")

    def test_never_released_is_released_last(self):
        rows = [{"mu": 0.1, "release_time_s": 20.0}, {"mu": 0.8, "release_time_s": None}, {"mu": 0.9, "release_time_s": None}]
        self.assertTrue(self.met(rows, figure="release_time_s", trend="rising", against="mu", relative=0.1))
        self.assertFalse(self.met(rows, figure="release_time_s", trend="falling", against="mu", relative=0.1))

    def test_missing_figure_is_not_met(self):
        self.assertFalse(self.met([{"mu": 1, "t": 1.0}, {"mu": 2, "t": None}], figure="t", trend="rising", against="mu"))

    def test_proportional_same_equals(self):
        rows = [{"rho": 1.0, "t": 2.0, "word": "a"}, {"rho": 2.0, "t": 4.2, "word": "a"}]
        self.assertTrue(self.met(rows, figure="t", trend="proportional", against="rho", relative=0.06))
        self.assertFalse(self.met(rows, figure="t", trend="proportional", against="rho", relative=0.04))
        self.assertFalse(self.met(rows, figure="t", trend="same", relative=0.05))
        self.assertTrue(self.met(rows, figure="rho", trend="same", absolute=1.0))
        self.assertTrue(self.met(rows, figure="word", trend="equals", value="a"))
        self.assertFalse(self.met(rows, figure="word", trend="equals", value="a", where={"rho": 3.0}))
        self.assertTrue(self.met(rows, figure="t", trend="equals", value=2.1, relative=0.1, where={"rho": 1.0}))

    def test_without_a_key_the_order_of_rows_counts(self):
        rows = [{"label": "b", "t": 2.0}, {"label": "a", "t": 1.0}]
        self.assertTrue(self.met(rows, figure="t", trend="rising", rows=["a", "b"]))
        self.assertFalse(self.met(rows, figure="t", trend="rising", rows=["b", "a"]))

    def test_a_run_that_was_not_made_leaves_it_open(self):
        rows = [{"mu": 1, "t": 1.0}, {"mu": 2, "t": 2.0}, {"mu": 3, "t": None, "status": "not run"}]
        self.assertIsNone(self.met(rows, figure="t", trend="rising", against="mu"))

    def test_stopped_runs_do_not_count(self):
        rows = [{"mu": 1, "t": 1.0}, {"mu": 2, "t": 2.0}, {"mu": 3, "t": 0.0, "status": "stopped"}]
        self.assertTrue(self.met(rows, figure="t", trend="rising", against="mu"))


if __name__ == "__main__":
    unittest.main()
