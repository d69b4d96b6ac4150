"""A study as data: reads a sweep file, checks it, and lists its rows. See docs/how-to.md, "Run a study"."""

import hashlib
import itertools
import os
from dataclasses import dataclass, field

import yaml

from figures import COLUMNS

KEYS = ("title", "question", "scene", "angles", "set", "follow", "stretch", "scale", "lift", "means", "sweep", "rows",
        "expect", "pictures", "beside", "notes", "learned")
ROW_KEYS = ("label", "effort")
TRENDS = ("rising", "falling", "proportional", "same", "equals")
EXPECTATION_KEYS = ("figure", "trend", "against", "rows", "where", "value", "relative", "absolute", "why")


class BadSweep(Exception):
    """One line: file, key, value, what is allowed."""


@dataclass
class Row:
    """One run of a study."""

    label: str
    changed: dict  # as written in the sweep file, column of the table -> value
    overrides: dict  # dotted scene key -> value: what `simulate --set` gets
    effort: float = 1.0  # rough share of the whole, for the remaining time


@dataclass
class Sweep:
    name: str
    path: str
    title: str
    scene: str
    angles: str | None
    rows: list
    question: str = ""
    expect: list = field(default_factory=list)
    pictured: list = field(default_factory=list)  # labels
    curves: list = field(default_factory=list)  # figures drawn against the first changed key, or {figure, against}
    by: list | None = None  # keys that tell their lines apart; None: all that change
    notes: str = ""  # Markdown for the page, before what was learned
    beside: str | None = None  # a program that measures what no run of a scene does
    means: dict = field(default_factory=dict)  # name -> start and end, s: of the tension's means
    learned: str = ""
    overrides: dict = field(default_factory=dict)  # --set

    @property
    def columns(self):
        """Every key that a row changes, in order of appearance."""
        return list(dict.fromkeys(key for row in self.rows for key in row.changed))


def scene_value(value):
    """A Python value as the YAML that --set takes, on one line."""
    text = yaml.safe_dump(value, default_flow_style=True, width=float("inf"), sort_keys=False).strip()
    return text.removesuffix("\n...").strip()


def shown(value):
    return value if isinstance(value, str) else scene_value(value)


def load(path, overrides=None):
    """Reads a sweep file; `overrides` (dotted key -> value) are set in every row, and win."""
    try:
        with open(path, encoding="utf-8") as file:
            data = yaml.safe_load(file)
    except OSError as error:
        raise BadSweep(f"{path}: cannot be read: {error.strerror}") from None
    except yaml.YAMLError as error:
        raise BadSweep(f"{path}: is not YAML: {' '.join(str(error).split())}") from None
    if not isinstance(data, dict):
        raise BadSweep(f"{path}: must be a map with the keys {', '.join(KEYS)}")
    return _Reader(path, data, overrides or {}).sweep()


class _Reader:
    def __init__(self, path, data, overrides):
        self.path, self.data, self.overrides = path, data, overrides

    def refuse(self, key, value, allowed):
        raise BadSweep(f"{self.path}: {key} = {shown(value)}: {allowed}")

    def part(self, key, kind, what, default):
        value = self.data.get(key)
        if value is None:
            return default
        if not isinstance(value, kind):
            self.refuse(key, value, f"must be {what}")
        return value

    def file(self, key, required):
        value = self.part(key, str, "the name of a file, relative to the sweep file", None)
        if value is None:
            if required:
                self.refuse(key, "", "is missing")
            return None
        path = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(self.path)), value))
        if not os.path.isfile(path):
            self.refuse(key, value, f"there is no file {path}")
        return path

    def sweep(self):
        for key in self.data:
            if key not in KEYS:
                self.refuse(key, self.data[key], f"unknown key; allowed: {', '.join(KEYS)}")
        name = os.path.splitext(os.path.basename(self.path))[0]
        self.scene = self.file("scene", True)
        angles = self.file("angles", False)
        self.fixed = self.part("set", dict, "a map from dotted scene keys to values", {})
        self.follow = self.part("follow", dict, "a map from a scene key to the changed key whose value it takes", {})
        self.stretch = self.part("stretch", dict, "a map from a name to a table of the scene", {})
        self.scale = self.part("scale", dict, "a map from a name to a table of the scene", {})
        self.lift = self.part("lift", dict, "a map from a name to a list of points of the scene", {})
        rows = self.rows()
        sweep = Sweep(name, self.path, self.part("title", str, "text", name), self.scene, angles, rows,
                      question=self.part("question", str, "text", "").strip(),
                      learned=self.part("learned", str, "text", "").strip(), overrides=self.overrides,
                      means=self.spans(), beside=self.file("beside", False), notes=self.part("notes", str, "text", "").strip())
        self.pictures(sweep)
        sweep.expect = [self.expectation(sweep, i, item) for i, item in enumerate(self.part("expect", list, "a list", []))
                        if not (isinstance(item, dict) and self.left_out.intersection(item.get("rows", [])))]
        return sweep

    def spans(self):
        spans = self.part("means", dict, "a map from a name to a start and an end, s", {})
        for name, span in spans.items():
            if not (isinstance(span, list) and len(span) == 2 and all(isinstance(s, (int, float)) for s in span) and span[0] < span[1]):
                self.refuse(f"means.{name}", span, "must be [start, end], s")
        return spans

    def rows(self):
        lists = self.part("sweep", dict, "a map from keys to lists of values", {})
        for key, values in lists.items():
            if not isinstance(values, list) or not values:
                self.refuse(f"sweep.{key}", values, "must be a list of values")
        changes = [dict(zip(lists, values)) for values in itertools.product(*lists.values())] if lists else []
        explicit = self.part("rows", list, "a list of maps from keys to values", [])
        for i, row in enumerate(explicit):
            if not isinstance(row, dict):
                self.refuse(f"rows[{i}]", row, "must be a map from keys to values")
        rows = [self.row(change) for change in changes + explicit]
        if not rows:
            self.refuse("sweep", "", "this or rows must list at least one run")
        labels = [row.label for row in rows]
        for label in labels:
            if labels.count(label) > 1:
                self.refuse("rows", label, "two rows have this label; every row needs its own")
        # A row that changes nothing but what --set has fixed is none of its own.
        self.left_out = {row.label for row in rows if row.changed and set(row.changed) <= set(self.overrides)}
        return [row for row in rows if row.label not in self.left_out] or rows[:1]

    def row(self, change):
        special = {key: change[key] for key in ROW_KEYS if key in change}
        changed = {key: value for key, value in change.items() if key not in ROW_KEYS}
        overrides = dict(self.fixed)
        for key, value in changed.items():
            if key in self.stretch:
                overrides[self.stretch[key]] = self.multiplied(key, self.stretch[key], value, 1.0)
            elif key in self.scale:
                overrides[self.scale[key]] = self.multiplied(key, self.scale[key], 1.0, value)
            elif key in self.lift:
                overrides[self.lift[key]] = self.lifted(key, self.lift[key], value)
            else:
                overrides[key] = value
        overrides.update(self.overrides)
        for key, source in self.follow.items():
            if key not in changed and key not in self.overrides and source in overrides:
                overrides[key] = overrides[source]
        effort = special.get("effort", 1.0)
        if not isinstance(effort, (int, float)) or effort <= 0:
            self.refuse("rows.effort", effort, "must be a number above 0")
        label = str(special.get("label") or ", ".join(f"{key.split('.')[-1]} {shown(v)}" for key, v in changed.items()))
        return Row(label or "as it is", changed, overrides, float(effort))

    def multiplied(self, name, key, times, values):
        """The scene's table (rows of a time and values) with its times and its values multiplied."""
        for factor in (times, values):
            if not isinstance(factor, (int, float)) or factor <= 0:
                self.refuse(name, factor, f"must be a number above 0, which multiplies the table {key}")
        table = self.listed(name, key)
        return [[round(row[0] * times, 9), *(round(value * values, 9) for value in row[1:])] for row in table]

    def lifted(self, name, key, by):
        """The scene's points [..., z], raised."""
        if not isinstance(by, (int, float)):
            self.refuse(name, by, f"must be a number, which is added to the z of {key}")
        return [[*point[:-1], round(point[-1] + by, 9)] for point in self.listed(name, key)]

    def listed(self, name, key):
        """A list of lists in the scene."""
        with open(self.scene, encoding="utf-8") as file:
            table = yaml.safe_load(file)
        for part in key.split("."):
            table = table.get(part) if isinstance(table, dict) else None
        if not isinstance(table, list):
            self.refuse(name, key, f"{self.scene} has no such table")
        return table

    def pictures(self, sweep):
        pictures = self.part("pictures", dict, "a map with the keys sections, curves, by", {})
        for key in pictures:
            if key not in ("sections", "curves", "by"):
                self.refuse(f"pictures.{key}", pictures[key], "unknown key; allowed: sections, curves, by")
        labels = [row.label for row in sweep.rows]
        sweep.pictured = [str(label) for label in pictures.get("sections") or [] if str(label) not in self.left_out]
        for label in sweep.pictured:
            if label not in labels:
                self.refuse("pictures.sections", label, f"no row has this label; there are: {'; '.join(labels)}")
        sweep.curves, sweep.by = list(pictures.get("curves") or []), pictures.get("by")
        for curve in sweep.curves:
            if not isinstance(curve, str) and not (isinstance(curve, dict) and set(curve) == {"figure", "against"}):
                self.refuse("pictures.curves", curve, "must be a column of the CSV, or a figure and what it is drawn against")

    def expectation(self, sweep, index, item):
        name = f"expect[{index}]"
        if not isinstance(item, dict) or "figure" not in item or item.get("trend") not in TRENDS:
            self.refuse(name, item, f"must have a figure and a trend of {', '.join(TRENDS)}")
        for key in item:
            if key not in EXPECTATION_KEYS:
                self.refuse(f"{name}.{key}", item[key], f"unknown key; allowed: {', '.join(EXPECTATION_KEYS)}")
        for label in item.get("rows", []):
            if label not in [row.label for row in sweep.rows]:
                self.refuse(f"{name}.rows", label, "no row has this label")
        runs = item["trend"] != "proportional" and "rows" in item and "against" not in item  # in that order
        if item["trend"] in ("rising", "falling", "proportional") and not runs and item.get("against") not in [
                *sweep.columns, *COLUMNS]:
            self.refuse(f"{name}.against", item.get("against", ""),
                        f"must be a figure of the CSV or a changed key: {', '.join(sweep.columns)}")
        return item


def fingerprint(*paths):
    """Hash of the contents of files."""
    digest = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            while block := file.read(1 << 20):
                digest.update(block)
        digest.update(b"\0")
    return digest.hexdigest()
