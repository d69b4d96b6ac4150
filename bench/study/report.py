"""What a study leaves: NAME.csv, NAME.md, and the index of all studies."""

import csv
import os

from expectations import check
from figures import COLUMNS, figures, mean_column
from sweep import shown

# Heading, figure, factor, decimals.
TABLE = [("release [s]", "release_time_s", 1.0, 2), ("slot then [m]", "slot_m", 1.0, 2),
         ("peak tension [kN/m]", "peak_tension_n_per_m", 1e-3, 1), ("until release [kN/m]", "peak_tension_in_hull_n_per_m", 1e-3, 1),
         ("residual tension [kN/m]", "residual_tension_n_per_m", 1e-3, 1), ("elongation [%]", "geotextile_elongation_max", 100.0, 1),
         ("of sheet [%]", "peak_utilisation_sheet", 100.0, 0), ("of seam [%]", "peak_utilisation", 100.0, 0),
         ("centroid y [m]", "container_centroid_y_m", 1.0, 3), ("width [m]", "container_width_m", 1.0, 2), ("height [m]", "container_height_m", 1.0, 2),
         ("fastest fall [m/s]", "fastest_fall_m_per_s", 1.0, 2), ("terminal, this width [m/s]", "terminal_velocity_m_per_s", 1.0, 2),
         ("sheets overlap [mm]", "sheets_overlap_m", 1e3, 2), ("transfer took [%]", "transfer_share", 100.0, 1),
         ("energy error [%]", "energy_balance_error", 100.0, 2), ("volume change [%]", "soil_volume_change", 100.0, 2),
         ("CPU [s]", "user_cpu_s", 1.0, 0)]
RULES = [("circumference needed [m]", "rule_circumference_needed_m", 1.0, 2), ("slot needed [m]", "rule_slot_needed_m", 1.0, 2),
         ("tension at opening [kN/m]", "rule_tension_opening_n_per_m", 1e-3, 1),
         ("tension hanging [kN/m]", "rule_tension_hanging_n_per_m", 1e-3, 1),
         ("terminal velocity [m/s]", "rule_terminal_velocity_m_per_s", 1.0, 2)]
# Of each of several containers.
EACH = [("before [kN/m]", "tension_before_n_per_m", 1e-3, 1), ("peak [kN/m]", "peak_tension_n_per_m", 1e-3, 1),
        ("residual [kN/m]", "residual_tension_n_per_m", 1e-3, 1), ("of seam [%]", "peak_utilisation", 100.0, 0),
        ("width [m]", "width_m", 1.0, 2), ("height [m]", "height_m", 1.0, 2), ("volume change [%]", "soil_volume_change", 100.0, 2)]


WORDS = {True: "yes", False: "**no**", None: "not run"}


def of_containers(rows):
    """Columns of the rows beyond those that every run has: those of each of several containers."""
    return list(dict.fromkeys(key for row in rows for key in row if ": " in key))


def each_table(rows):
    names = list(dict.fromkeys(key.split(": ")[0] for key in of_containers(rows)))
    columns = [(f"{name}: {heading}", f"{name}: {key}", factor, decimals)
               for name in names for heading, key, factor, decimals in EACH]
    return markdown_table(rows, columns, ["run"])


def table_rows(sweep, results):
    """Changed keys and figures of every row, in the order of the sweep file."""
    return [{**row.changed, **figures(results[row.label], sweep.means), "label": row.label} for row in sweep.rows]


def write_csv(path, sweep, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        columns = ["label", *sweep.columns, *COLUMNS, *map(mean_column, sweep.means), *of_containers(rows)]
        writer.writerow(columns)
        for row in rows:
            cells = [row.get(key) for key in columns]
            writer.writerow(["" if cell is None else shown(cell) for cell in cells])


def cell(value, factor, decimals):
    return f"{factor * value:.{decimals}f}" if isinstance(value, (int, float)) else "-"


def markdown_table(rows, columns, first):
    used = [column for column in columns if any(isinstance(row.get(column[1]), (int, float)) for row in rows)]
    if not used:
        return []
    lines = ["| " + " | ".join([*first, *(column[0] for column in used)]) + " |", "|---" * (len(first) + len(used)) + "|"]
    for row in rows:
        words = [row["label"]] + ([row["outcome"] or row["status"]] if len(first) > 1 else [])
        lines.append("| " + " | ".join([*words, *(cell(row.get(c[1]), c[2], c[3]) for c in used)]) + " |")
    return [*lines, ""]


def write_page(path, sweep, rows, verdicts, pictures, origin):
    lines = [f"# {sweep.title}", ""]
    if sweep.question:
        lines += [sweep.question, ""]
    lines += [f"Written by `script/study {sweep.name}` ({origin}): {len(rows)} runs, {sum(row['user_cpu_s'] for row in rows):.0f} s "
              f"of one core. Every figure: [{sweep.name}.csv]({sweep.name}.csv).", ""]
    if sweep.overrides:
        changes = ", ".join(f"`{key}={shown(value)}`" for key, value in sweep.overrides.items())
        lines += [f"Not as the sweep file has it: {changes} in every run.", ""]
    means = [(f"mean {start:g} to {end:g} s [kN/m]", mean_column(name), 1e-3, 1) for name, (start, end) in sweep.means.items()]
    lines += markdown_table(rows, TABLE[:4] + means + TABLE[4:], ["run", "outcome"])
    lines += each_table(rows)
    for row in rows:
        if row["status"] != "completed":
            lines += [f"**{row['label']}: {row['status']}.** {row['why']}", ""]
        if row["flags"]:
            lines += [f"**{row['label']}: doubtful.** {row['flags']}", ""]
    one_for_all = len({tuple(row[rule[1]] for rule in RULES) for row in rows}) == 1
    rules = markdown_table([{**rows[0], "label": "all"}] if one_for_all else rows, RULES, ["run"])
    if rules:
        lines += ["What hand rules say for the same data ([sources](../how-to.md#compare-with-hand-rules)):", "", *rules]
    if verdicts:
        lines += ["| expected | found | met |", "|---|---|---|",
                  *(f"| {text} | {found} | {WORDS[met]} |" for text, found, met in verdicts), ""]
    for name, caption in pictures:
        lines += [f"![{caption}]({name})", ""]
    if sweep.notes:
        lines += [sweep.notes, ""]
    if sweep.learned:
        lines += ["## Learned", "", sweep.learned, ""]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines).rstrip() + "\n")


def write_index(path, sweeps, folder):
    """Links to the pages that there are, with what was learned."""
    lines = ["# Studies", "",
             "One command each: `script/study NAME`; `script/study all` for all of them. How to run one of your own: "
             "[how-to.md](how-to.md#run-a-study).", ""]
    for sweep in sweeps:
        if os.path.exists(os.path.join(folder, f"{sweep.name}.md")):
            lines += [f"## [{sweep.title}](study/{sweep.name}.md)", "", sweep.question, ""]
            lines += [sweep.learned, ""] if sweep.learned else []
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines).rstrip() + "\n")


def report(sweep, results, folder, pictures, origin):
    """Writes CSV and page; returns the rows and the verdicts."""
    rows = table_rows(sweep, results)
    verdicts = check(sweep, rows)
    write_csv(os.path.join(folder, f"{sweep.name}.csv"), sweep, rows)
    write_page(os.path.join(folder, f"{sweep.name}.md"), sweep, rows, verdicts, pictures, origin)
    return rows, verdicts
