"""What physics says of a sweep, checked on its rows: a sentence and a verdict each."""

import math

from sweep import shown


def number(row, key):
    """A figure or a changed key as a number. A container that is never released is released later than any other."""
    value = row.get(key)
    if key == "release_time_s" and value is None and row["status"] == "completed":
        return math.inf
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else math.nan


def chosen(rows, item):
    """Rows that completed, change the key that is asked about, and are among `rows` and have the values of `where`."""
    where, labels = item.get("where", {}), item.get("rows")
    return [row for row in rows if row["status"] == "completed" and row.get(item.get("against", "label")) is not None
            and (labels is None or row["label"] in labels) and all(row.get(key) == value for key, value in where.items())]


def allowance(item, *values):
    largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    return max(float(item.get("absolute", 0.0)), float(item.get("relative", 0.0)) * largest)


def ordered(rows, item):
    """By what they are judged against, or else as `rows` names them."""
    if "against" in item:
        return sorted(rows, key=lambda row: number(row, item["against"]))
    return sorted(rows, key=lambda row: item["rows"].index(row["label"])) if "rows" in item else rows


def monotone(rows, item, sign):
    values = [sign * number(row, item["figure"]) for row in ordered(rows, item)]
    for before, after in zip(values, values[1:]):
        if math.isinf(before) and math.isinf(after):
            continue
        if not after >= before - allowance(item, before, after):
            return False
    return len(values) > 1


def proportional(rows, item):
    ratios = [number(row, item["figure"]) / number(row, item["against"]) for row in rows]
    return len(ratios) > 1 and max(ratios) - min(ratios) <= allowance(item, *ratios)


def same(rows, item):
    """The last two rows, which are the finest."""
    values = [number(row, item["figure"]) for row in ordered(rows, item)[-2:]]
    return len(values) == 2 and (values[0] == values[1] or abs(values[1] - values[0]) <= allowance(item, *values))


def equal(row, item):
    value, wanted = row.get(item["figure"]), item["value"]
    if isinstance(value, (int, float)) and isinstance(wanted, (int, float)):
        return abs(value - wanted) <= allowance(item, wanted)
    return value == wanted


def sentence(item):
    where = ", ".join(f"{key} = {shown(value)}" for key, value in item.get("where", {}).items())
    limits = ([f"{100 * item['relative']:g} %"] if "relative" in item else []) + (
        [f"{item['absolute']:g}"] if "absolute" in item else [])
    within = " or ".join(limits)
    trend = item["trend"]
    order = f"with {item['against']}" if "against" in item else "from run to run"
    text = {"rising": f"{item['figure']} does not fall {order}",
            "falling": f"{item['figure']} does not rise {order}",
            "proportional": f"{item['figure']} is proportional to {item.get('against')}",
            "same": f"{item['figure']} is the same in {' and '.join(item.get('rows', ['the last two rows']))}",
            "equals": f"{item['figure']} is {item.get('value')}"}[trend]
    rows = f" in {'; '.join(item['rows'])}" if "rows" in item and trend != "same" else ""
    return text + (f" (within {within})" if within else "") + (f" where {where}" if where else "") + rows + (
        f": {item['why']}" if "why" in item else "")


def found(rows, item):
    """The values that were judged, in the order of what they are judged against."""
    rows = ordered(rows, item)
    values = [row.get(item["figure"]) for row in (rows[-2:] if item["trend"] == "same" else rows)]
    return ", ".join("-" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)
                     for value in (values if item["trend"] != "equals" else dict.fromkeys(values)))


def check(sweep, rows):
    """(sentence, values, met) for every expectation; met is None where a run that it names was not made. `rows`: changed keys
    and figures of each run."""
    verdicts = []
    for item in sweep.expect:
        judged = chosen(rows, item)
        met = {"rising": lambda: monotone(judged, item, 1.0), "falling": lambda: monotone(judged, item, -1.0),
               "proportional": lambda: proportional(judged, item), "same": lambda: same(judged, item),
               "equals": lambda: bool(judged) and all(equal(row, item) for row in judged)}[item["trend"]]()
        missing = any(row["status"] == "not run" and row["label"] in item.get("rows", [row["label"]]) for row in rows)
        verdicts.append((sentence(item), found(judged, item), None if missing else met))
    return verdicts
