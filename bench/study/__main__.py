#!/usr/bin/python3
"""Runs parameter studies: every row of a sweep file is one run of `simulate`; CSV, page and pictures come out."""

import argparse
import datetime
import os
import signal
import subprocess
import sys

import yaml
from tqdm import tqdm

import report
import sweep as sweeps
from runs import Cache, Interrupted, Result, Runner, kept, run_all

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
STUDIES = os.path.join(ROOT, "config", "studies")
WORDS = {True: "as expected", False: "NOT as expected", None: "not run"}
ALL_RAN, EXPECTATION_MISSED, BAD_SWEEP, SOME_FAILED, INTERRUPTED = 0, 1, 2, 3, 130


def names():
    return sorted(name[:-5] for name in os.listdir(STUDIES) if name.endswith(".yaml"))


def origin():
    """Version and day, for the page."""
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False)
    return f"{commit.stdout.strip() or 'unknown version'}, {datetime.date.today().isoformat()}"


def assignments(texts):
    """--set key=value, as in simulate."""
    values = {}
    for text in texts:
        key, equals, value = text.partition("=")
        if not equals or not key or not value:
            raise sweeps.BadSweep(f"--set {text}: must be dotted.key=value")
        try:
            values[key] = yaml.safe_load(value)
        except yaml.YAMLError:
            raise sweeps.BadSweep(f"--set {text}: the value is not YAML") from None
    return values


def parse():
    parser = argparse.ArgumentParser(prog="script/study", description=__doc__.splitlines()[0],
                                     epilog=f"NAME: {', '.join(names())}, all. Exit status: 0 all ran, 1 an expectation is "
                                            "not met, 2 bad input, 3 some run was stopped or refused, 130 interrupted.")
    parser.add_argument("study", nargs="?", metavar="NAME|SWEEP.yaml", help="a study, all, or a sweep file of your own")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="in every run; wins over the sweep file")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at once (default: cores)")
    parser.add_argument("--out", metavar="DIR", help="for CSV, page, pictures (default: docs/study, or study_NAME here)")
    parser.add_argument("--cache", default=os.path.join(ROOT, "build-study"), metavar="DIR", help="finished runs are kept here")
    parser.add_argument("--no-runs", action="store_true", help="report on the runs that are there, those of an interrupted study")
    parser.add_argument("--no-pictures", action="store_true", help="neither records nor pictures")
    parser.add_argument("--simulate", required=True, metavar="PROGRAM", help=argparse.SUPPRESS)
    parser.add_argument("--directory", default=os.getcwd(), help=argparse.SUPPRESS)
    return parser.parse_args()


def chosen(options):
    """The sweeps that are asked for, and the folder for their results."""
    overrides = assignments(options.set)
    if options.study in [*names(), "all"]:
        wanted = names() if options.study == "all" else [options.study]
        default = os.path.join(ROOT, "docs", "study")
        if overrides and not options.out:
            raise sweeps.BadSweep("--set changes a study of this package: give --out, so that docs/study stays as it is")
        return [sweeps.load(os.path.join(STUDIES, f"{name}.yaml"), overrides) for name in wanted], options.out or default
    path = os.path.join(options.directory, options.study)
    if not os.path.exists(path):
        raise sweeps.BadSweep(f"{options.study}: neither a study ({', '.join(names())}, all) nor a file")
    sweep = sweeps.load(path, overrides)
    return [sweep], options.out or f"study_{sweep.name}"


def compute(options, runner, wanted):
    """Results by study and label. One bar over everything, with the time that is left."""
    results = {sweep.name: {} for sweep in wanted}
    ready = [(s, row) for s in wanted for row in s.rows if kept(runner.cache.folder_of(s, row)) is not None]
    total = sum(row.effort for sweep in wanted for row in sweep.rows)
    initial = sum(row.effort for _, row in ready)
    with tqdm(total=total, initial=initial, unit="run", mininterval=0.0 if sys.stderr.isatty() else 30.0,
              bar_format="{percentage:3.0f} % |{bar:24}| {elapsed}, {remaining} left  {desc}") as bar:
        waiting = {(s.name, row.label) for s, row in ready}

        def done(sweep, row, result):
            results[sweep.name][row.label] = result
            if (sweep.name, row.label) not in waiting:
                bar.set_description_str(f"{sweep.name}: {row.label}"[:60], refresh=False)
                bar.update(row.effort)
            if not result.completed:
                bar.write(f"{sweep.name}: {row.label}: {result.why}", file=sys.stderr)

        run_all(runner, wanted, max(1, options.jobs), done)
    if ready:
        print(f"{len(ready)} of {sum(len(s.rows) for s in wanted)} runs were there already")
    return results


def there(runner, wanted):
    """Results by study and label of the runs that are there already."""
    none = Result(None, None, "not run", 0.0)
    return {sweep.name: {row.label: kept(runner.cache.folder_of(sweep, row)) or none for row in sweep.rows} for sweep in wanted}


def measure_beside(sweep, cache, folder):
    """The program that a sweep names; whether it ended well."""
    if sweep.beside is None:
        return True
    kept_rows = os.path.join(cache.folder, f"{sweep.name}-{cache.version[:24]}.csv")
    command = [sys.executable, sweep.beside, "--simulate", cache.program, "--out", folder, "--kept", kept_rows]
    return subprocess.run(command, check=False).returncode == 0


def draw(sweep, results, folder):
    import pictures  # matplotlib takes a second

    return pictures.draw(sweep, results, folder)


def interrupt(*_):
    raise KeyboardInterrupt


def main():
    options = parse()
    if options.study is None:
        print("Studies (script/study NAME):")
        for name in names():
            print(f"  {name:16}{sweeps.load(os.path.join(STUDIES, f'{name}.yaml')).title}")
        return ALL_RAN
    signal.signal(signal.SIGTERM, interrupt)
    try:
        wanted, out = chosen(options)
        out = os.path.abspath(os.path.join(options.directory, out))
        os.makedirs(out, exist_ok=True)
        runner = Runner(Cache(os.path.join(options.directory, options.cache), os.path.abspath(options.simulate),
                              record=not options.no_pictures))
        results = there(runner, wanted) if options.no_runs else compute(options, runner, wanted)
        status = ALL_RAN
        for sweep in wanted:
            measured = measure_beside(sweep, runner.cache, out)
            drawn = [] if options.no_pictures else draw(sweep, results[sweep.name], out)
            rows, verdicts = report.report(sweep, results[sweep.name], out, drawn, origin())
            print(f"{sweep.name}: {len(rows)} runs, {os.path.join(out, sweep.name)}.csv and .md")
            for text, found, met in verdicts:
                print(f"  {WORDS[met]}: {text}: {found}")
            if not all(met for *_, met in verdicts):
                status = max(status, EXPECTATION_MISSED)
            if not measured or any(row["status"] != "completed" for row in rows):
                status = SOME_FAILED
        if out == os.path.join(ROOT, "docs", "study"):
            everything = [sweeps.load(os.path.join(STUDIES, f"{name}.yaml")) for name in names()]
            report.write_index(os.path.join(ROOT, "docs", "study.md"), everything, out)
        return status
    except sweeps.BadSweep as error:
        print(f"study: {error}", file=sys.stderr)
        return BAD_SWEEP
    except (KeyboardInterrupt, Interrupted):
        print("\nstudy: interrupted; finished runs are kept, the same command goes on from there", file=sys.stderr)
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
