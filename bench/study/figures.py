"""The figures of a run: columns of the CSV, in order, from the summary."""

# Column -> path in the summary.
PLAIN = {
    "outcome": "outcome",
    "release_time_s": "release_time_s",
    "peak_tension_n_per_m": "peak_tension_n_per_m",
    "peak_tension_time_s": "peak_tension_time_s",
    "peak_tension_y_m": "peak_tension_position_m.0",
    "peak_tension_z_m": "peak_tension_position_m.1",
    "peak_utilisation": "peak_utilisation",
    "peak_utilisation_sheet": "peak_utilisation_sheet",
    "residual_tension_n_per_m": "residual_tension_n_per_m",
    "geotextile_elongation_max": "geotextile_elongation_max",
    "container_centroid_y_m": "container_centroid_m.0",
    "container_centroid_z_m": "container_centroid_m.1",
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
COLUMNS = ["status", "why", *list(PLAIN)[:9], "peak_tension_in_hull_n_per_m", *list(PLAIN)[9:], "user_cpu_s", "flags"]


def at(summary, path):
    value = summary
    for part in path.split("."):
        if isinstance(value, dict):
            value = value.get(part)
        elif isinstance(value, list):
            value = value[int(part)] if int(part) < len(value) else None
        else:
            return None
    return value


def status(result):
    return {0: "completed", 2: "refused", 3: "stopped"}.get(result.status, "failed")


def tension_history(summary):
    """Time and largest tension of all sheets at the samples of a geotextile probe, or (None, None)."""
    for probe in summary.get("probes", {}).values():
        if probe.get("kind") == "geotextile":
            return probe["time_s"], probe["tension_max_n_per_m"]
    return None, None


def tension_in_hull(summary):
    """Largest tension until the release, at the samples of a probe: what the opening alone does."""
    time, tension = tension_history(summary)
    if time is None:
        return None
    release = summary.get("release_time_s")
    return max((t for s, t in zip(time, tension) if release is None or s <= release), default=None)


def figures(result):
    """Column -> value; None where the run has none."""
    values = {"status": status(result), "why": result.why}
    values.update({column: at(result.summary, path) for column, path in PLAIN.items()})
    values["peak_tension_in_hull_n_per_m"] = tension_in_hull(result.summary)
    values["user_cpu_s"] = round(result.user_cpu_s, 2)
    values["flags"] = "; ".join(result.summary.get("flags", []))
    return {column: values[column] for column in COLUMNS}
