"""The figures of a run: columns of the CSV, in order, from the summary.

A scene with several containers has one figure for all of them where that makes sense, the largest, and those of each beside
it. What a scene or a summary has not is None: a scene in space, one without a container or without water.
"""

import math

# Column -> path in the summary. Of a place [y, z] or [x, y, z], -2 is y and -1 is z.
PLAIN = {
    "outcome": "outcome",
    "release_time_s": "release_time_s",
    "peak_tension_n_per_m": "peak_tension_n_per_m",
    "peak_tension_time_s": "peak_tension_time_s",
    "peak_tension_y_m": "peak_tension_position_m.-2",
    "peak_tension_z_m": "peak_tension_position_m.-1",
    "peak_utilisation": "peak_utilisation",
    "peak_utilisation_sheet": "peak_utilisation_sheet",
    "residual_tension_n_per_m": "residual_tension_n_per_m",
    "geotextile_elongation_max": "geotextile_elongation_max",
    "container_centroid_y_m": "container_centroid_m.-2",
    "container_centroid_z_m": "container_centroid_m.-1",
    "container_width_m": "container_width_m",
    "container_height_m": "container_height_m",
    "soil_volume_change": "soil_volume_change",
    "energy_balance_error": "energy.relative_balance_error",
    "momentum_error": "momentum_error",
    "rule_circumference_needed_m": "design_rules.0.rules.circumference_needed.value",
    "rule_slot_needed_m": "design_rules.0.rules.slot_needed.value",
    "slot_m": "design_rules.0.rules.slot_needed.beside.value",
    "rule_tension_opening_n_per_m": "design_rules.0.rules.tension_opening.value",
    "rule_tension_hanging_n_per_m": "design_rules.0.rules.tension_hanging.value",
    "rule_terminal_velocity_m_per_s": "design_rules.0.rules.terminal_velocity.value",
    "particles": "particles",
    "steps": "steps",
    "retries": "retries",
    "simulated_time_s": "simulated_time_s",
    "digest": "digest",
}
COLUMNS = ["status", "why", *list(PLAIN)[:9], "peak_tension_in_hull_n_per_m", *list(PLAIN)[9:], "weight_n_per_m",
           "fastest_fall_m_per_s", "terminal_velocity_m_per_s", "sheets_overlap_m", "transfer_share", "user_cpu_s", "flags"]
# Column "CONTAINER: this" -> path in the container's part of the summary; where there are several.
EACH = {
    "tension_before_n_per_m": "episodes.-1.tension_before_n_per_m",
    "peak_tension_n_per_m": "peak_tension_n_per_m",
    "residual_tension_n_per_m": "residual_tension_n_per_m",
    "peak_utilisation": "peak_utilisation",
    "width_m": "container_width_m",
    "height_m": "container_height_m",
    "soil_volume_change": "soil_volume_change",
}


def at(summary, path):
    value = summary
    for part in path.split("."):
        if isinstance(value, dict):
            value = value.get(part)
        elif isinstance(value, list):
            value = value[int(part)] if -len(value) <= int(part) < len(value) else None
        else:
            return None
    return value


def of_all(values):
    """One figure for several containers: the largest, none as long as one has none; texts side by side."""
    if any(isinstance(value, str) for value in values):
        return "; ".join(dict.fromkeys(str(value) for value in values))
    return None if None in values else max(values)


def status(result):
    return {0: "completed", 2: "refused", 3: "stopped", None: "not run"}.get(result.status, "failed")


def probes(summary, kind):
    return {name: probe for name, probe in summary.get("probes", {}).items() if probe.get("kind") == kind}


def tension_histories(summary):
    """Name of each geotextile probe -> times, and the sheet's largest tension then."""
    return {name: (probe["time_s"], probe["tension_max_n_per_m"]) for name, probe in probes(summary, "geotextile").items()}


def tension_in_hull(summary):
    """Largest tension until the release, at the samples of a probe: what the opening alone does. Of one container."""
    release, histories = summary.get("release_time_s"), tension_histories(summary)
    if len(histories) != 1 or isinstance(release, list):
        return None
    (time, tension), = histories.values()
    return max((t for s, t in zip(time, tension) if release is None or s <= release), default=None)


def mean_column(name):
    return f"mean_tension_{name}_n_per_m"


def mean_tension(summary, start, end):
    """Of the largest tension of the one sheet that is probed, over a part of the run that has all of it."""
    histories = tension_histories(summary)
    if len(histories) != 1:
        return None
    (time, tension), = histories.values()
    within = [t for s, t in zip(time, tension) if start <= s <= end]
    return sum(within) / len(within) if within and time[-1] >= end else None


def fall(summary):
    """Fastest fall of the one body that is probed, and the speed at which the hand rule for the terminal velocity would
    have it with the width that its sheet has then."""
    bodies, sheets = probes(summary, "body"), probes(summary, "geotextile")
    rule = at(summary, "design_rules.0.rules.terminal_velocity.value")
    area = at(summary, "design_rules.0.rules.terminal_velocity.inputs.A.value")
    if len(bodies) != 1 or len(sheets) != 1:
        return None, None
    (body,), (sheet,) = bodies.values(), sheets.values()
    fastest = min(range(len(body["time_s"])), key=lambda i: body["velocity_z_m_per_s"][i])
    width = sheet["upper_y_m"][fastest] - sheet["lower_y_m"][fastest]
    terminal = None
    if rule is not None and summary.get("water"):
        terminal = rule * math.sqrt(math.sqrt(area) / width)
    return -body["velocity_z_m_per_s"][fastest], terminal


def of_record(result, what):
    if result.record is None:
        return None
    import histories  # matplotlib takes a second

    return getattr(histories, what)(result.record)


def figures(result, means=None):
    """Column -> value; None where the run has none. After COLUMNS: means over times (name -> start and end) as a sweep file
    asks for, and figures of each container."""
    summary = result.summary
    values = {"status": status(result), "why": result.why}
    containers = summary.get("containers") or []
    several = containers if len(containers) > 1 else []
    for column, path in PLAIN.items():
        if several and path.split(".")[0] in containers[0] and not path.startswith("soil_"):
            values[column] = None if "." in path else of_all([at(container, path) for container in several])
        else:
            values[column] = at(summary, path)
    values["peak_tension_in_hull_n_per_m"] = tension_in_hull(summary)
    hanging = values["rule_tension_hanging_n_per_m"]
    values["weight_n_per_m"] = None if hanging is None else 2.0 * hanging  # the rule's: fill and sheet, submerged in water
    values["fastest_fall_m_per_s"], values["terminal_velocity_m_per_s"] = fall(summary)
    values["sheets_overlap_m"] = of_record(result, "overlap") if several else None
    values["transfer_share"] = of_record(result, "transfer_share")
    values["user_cpu_s"] = round(result.user_cpu_s, 2)
    values["flags"] = "; ".join(summary.get("flags", []))
    each = {f"{container['name']}: {column}": at(container, path) for container in several for column, path in EACH.items()}
    averaged = {mean_column(name): mean_tension(summary, *span) for name, span in (means or {}).items()}
    return {**{column: values[column] for column in COLUMNS}, **averaged, **each}
