#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/scene/design_rules.h"
#include "geocontainer_mpm/scene/doubts.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::scene {
namespace {

using Json = nlohmann::ordered_json;

/// [y, z] in plane strain, [x, y, z] in 3-D.
Json components(const Vec3& vector, int dimensions)
{
  return dimensions == 3 ? Json::array({ vector.x(), vector.y(), vector.z() })
                         : Json::array({ vector.y(), vector.z() });
}

/// A key of what is per metre of length in plane strain, and whole in 3-D: `buoyancy_n_per_m`, `buoyancy_n`.
std::string per_metre(const char* key, int dimensions)
{
  return std::string(key) + (dimensions == 3 ? "" : "_per_m");
}

Json rejected_samples(const barge::OpeningSignal& opening)
{
  Json counts = Json::object();
  for (int i = 0; i < barge::sample_verdict_count; ++i) {
    const auto verdict = static_cast<barge::SampleVerdict>(i);
    if (verdict != barge::SampleVerdict::accepted)
      counts[barge::to_string(verdict)] = opening.count(verdict);
  }
  return counts;
}

/// A gap that lasts has an infinite end, which JSON writes as null.
Json gaps(const barge::OpeningSignal& opening)
{
  Json list = Json::array();
  for (const barge::OpeningGap& gap : opening.gaps())
    list.push_back({ { "from_s", gap.from_s }, { "to_s", gap.to_s } });
  return list;
}

Json energy(const EnergyFrame& frame, int dimensions)
{
  return { { "kinetic", frame.kinetic },
           { "elastic", frame.elastic },
           { "potential", frame.potential },
           { "dissipated", frame.dissipated },
           { "dissipated_plastic", frame.dissipated_plastic },
           { "dissipated_contact", frame.dissipated_contact },
           { "dissipated_transfer", frame.dissipated_transfer },
           { "dissipated_rupture", frame.dissipated_rupture },
           { "dissipated_water", frame.dissipated_water },
           { "work_in", frame.work_in },
           { "unbalanced", frame.unbalanced },
           { "relative_balance_error", frame.relative_balance_error },
           { "unit", dimensions == 3 ? "J" : "J/m" } };
}

/// Null in a scene without water.
Json water(const std::optional<WaterFrame>& frame, int dimensions)
{
  if (!frame)
    return {};
  return { { "level_m", frame->level_m },
           { "submerged_share", frame->submerged_share },
           { per_metre("buoyancy_n", dimensions), frame->buoyancy },
           { per_metre("submerged_weight_n", dimensions), frame->submerged_weight },
           { "fastest_fall_m_per_s", frame->fastest_fall_m_per_s },
           { per_metre("drag_impulse_n_s", dimensions), components(frame->drag_impulse, dimensions) },
           { per_metre("dissipated_j", dimensions), frame->dissipated } };
}

Json skipped(const SkippedCounts& counts)
{
  return { { "resting_time_s", counts.resting_time_s },
           { "contact_searches", counts.contact_searches },
           { "grid_nodes", counts.grid_nodes },
           { "membrane_passes", counts.membrane_passes } };
}

Json stages(const StageTimes& times)
{
  return { { "p2g_s", times.p2g_s },           { "forces_s", times.forces_s }, { "contact_s", times.contact_s },
           { "membrane_s", times.membrane_s }, { "g2p_s", times.g2p_s },       { "material_s", times.material_s },
           { "bound_s", times.bound_s } };
}

Json probes(const std::vector<ProbeFrame>& series)
{
  Json all = Json::object();
  for (const ProbeFrame& one : series) {
    Json probe{ { "kind", one.kind }, { "time_s", one.time_s } };
    for (const ProbeFrame::Column& column : one.columns)
      probe[column.name] = column.values;
    all[one.name] = std::move(probe);
  }
  return all;
}

/// Widest slot up to now and slot at the release, m, from the opening's history.
struct Slot {
  std::optional<double> widest_m, at_release_m;
};

Slot slot(const Simulation& simulation, const StatusFrame& status)
{
  Slot slot;
  const SceneDescription& scene = simulation.scene();
  const barge::OpeningSignal& opening = simulation.opening();
  const double known_s = std::min(simulation.time_s(), opening.known_until_s());
  if (!scene.hull || !(known_s >= 0.0))
    return slot;
  const barge::SplitHull hull(scene.hull->hinge_m, scene.hull->port_section_m, "hull");
  constexpr int looks = 1000;  // hydraulics move the hull over many seconds
  for (int i = 0; i <= looks; ++i) {
    const double width_m = hull.slot_width_m(opening.angles(known_s * i / looks));
    slot.widest_m = std::max(slot.widest_m.value_or(width_m), width_m);
  }
  if (status.release_time_s >= 0.0)
    slot.at_release_m = hull.slot_width_m(opening.angles(status.release_time_s));
  return slot;
}

Json number(const std::optional<double>& value)
{
  return value ? Json(*value) : Json();
}

/// What of this run, or of its scene, a rule's value is to be compared with.
Json counterpart(const std::string& rule, const ContainerData& container, const Slot& slot, const StatusFrame& status)
{
  if (rule == "circumference_needed" || rule == "circumference_of_rectangle")
    return { { "what", "circumference of the sheet" }, { "value", container.circumference_m } };
  if (rule == "slot_needed")
    return { { "what", slot.at_release_m ? "slot at release" : "widest slot, not released" },
             { "value", number(slot.at_release_m ? slot.at_release_m : slot.widest_m) } };
  if (rule == "tension_opening" || rule == "tension_hanging")
    return { { "what", "peak tension" }, { "value", status.peak_tension_n_per_m } };
  return {};
}

/// A list with one entry a container: what hand rules say, each with its source, and what stands beside it.
Json design_view(const Simulation& simulation, const StatusFrame& status)
{
  const Slot slot_of_run = slot(simulation, status);
  Json view = Json::array();
  for (const ContainerData& container : container_data(simulation.scene(), slot_of_run.widest_m.value_or(0.0))) {
    Json rules = Json::object();
    for (const DesignRule& rule : design_rules(container)) {
      Json inputs = Json::object();
      for (const DesignRule::Input& input : rule.inputs)
        inputs[input.name] = { { "value", input.value }, { "unit", input.unit }, { "assumed", input.assumed } };
      rules[rule.name] = { { "value", number(rule.value) },
                           { "unit", rule.unit },
                           { "rule", rule.rule },
                           { "source", rule.source },
                           { "inputs", inputs },
                           { "beside", counterpart(rule.name, container, slot_of_run, status) } };
    }
    view.push_back({ { "container", container.name }, { "rules", rules } });
  }
  return view;
}

Json release_time(double time_s)
{
  return time_s >= 0.0 ? Json(time_s) : Json();
}

/// Where and when of a peak that has not been are null.
void add_peak(Json& summary, const ContainerState& state, int dimensions)
{
  const bool taut = state.peak_tension_n_per_m > 0.0;
  summary["peak_tension_n_per_m"] = state.peak_tension_n_per_m;
  summary["peak_tension_time_s"] = taut ? Json(state.peak_tension_time_s) : Json();
  summary["peak_tension_position_m"] = taut ? components(state.peak_tension_position_m, dimensions) : Json();
  summary["peak_utilisation"] = std::max(state.peak_utilisation_sheet, state.peak_utilisation_seam);
  summary["peak_utilisation_sheet"] = state.peak_utilisation_sheet;
  summary["peak_utilisation_seam"] = state.peak_utilisation_seam;
}

void add_place(Json& summary, const ContainerState& state, int dimensions)
{
  summary["container_centroid_m"] = components(state.centroid_m, dimensions);
  if (dimensions == 3)
    summary["container_length_m"] = state.length_m;
  summary["container_width_m"] = state.width_m;
  summary["container_height_m"] = state.height_m;
}

Json volume_change(const ContainerState& state)
{
  return state.soil_volume_initial > 0.0 ? Json(state.soil_volume / state.soil_volume_initial - 1.0) : Json();
}

/// Keys of the sheet; null in a scene without one.
void add_geotextile(Json& summary, const SceneDescription& scene, const StatusFrame& status)
{
  Json sheet;
  add_peak(sheet, status, status.dimensions);
  sheet["ruptured"] = status.ruptures == 0
                          ? Json()
                          : Json{ { "pieces", status.ruptures },
                                  { "time_s", status.rupture_time_s },
                                  { "position_m", components(status.rupture_position_m, status.dimensions) } };
  sheet["residual_tension_n_per_m"] = status.current_tension_n_per_m;
  sheet["geotextile_elongation_max"] = status.elongation_max;
  for (const auto& [key, value] : sheet.items())
    summary[key] = scene.geotextiles.empty() ? Json() : value;
}

/// What each container did, and its tension before and after others started.
Json container(const ContainerStatus& status, int dimensions)
{
  Json one;
  one["name"] = status.name;
  one["outcome"] = to_string(status.outcome);
  one["release_time_s"] = release_time(status.release_time_s);
  add_peak(one, status, dimensions);
  one["residual_tension_n_per_m"] = status.current_tension_n_per_m;
  one["geotextile_elongation_max"] = status.elongation_max;
  add_place(one, status, dimensions);
  one["soil_volume_change"] = volume_change(status);
  one["episodes"] = Json::array();
  for (const TensionEpisode& episode : status.episodes)
    one["episodes"].push_back({ { "started", episode.started },
                                { "start_s", episode.start_s },
                                { "tension_before_n_per_m", episode.before_n_per_m },
                                { "peak_tension_n_per_m", episode.peak_n_per_m },
                                { "peak_tension_time_s", episode.peak_time_s } });
  return one;
}

/// The list of containers; where there are several, what is one container's is a list at the top as well.
void add_containers(Json& summary, const StatusFrame& status)
{
  Json all = Json::array();
  for (const ContainerStatus& one : status.containers)
    all.push_back(container(one, status.dimensions));
  if (all.size() > 1)
    for (const auto& [key, value] : all[0].items())
      if (summary.contains(key) && key != "soil_volume_change") {
        summary[key] = Json::array();
        for (const Json& one : all)
          summary[key].push_back(one.at(key));
      }
  summary["containers"] = std::move(all);
}

}  // namespace

std::string summary_json(const Simulation& simulation, double wall_time_s, int threads)
{
  const SceneDescription& scene = simulation.scene();
  const StatusFrame status = simulation.status();
  const RunCounters counters = simulation.counters();
  const barge::OpeningSignal& opening = simulation.opening();

  Json summary;
  summary["scene"] = scene.name;
  summary["outcome"] = to_string(status.outcome);
  summary["release_time_s"] = release_time(status.release_time_s);
  add_geotextile(summary, scene, status);
  add_place(summary, status, status.dimensions);
  summary[status.dimensions == 3 ? "soil_volume_m3" : "soil_volume_m2"] = status.soil_volume;
  summary["soil_volume_change"] = volume_change(status);
  add_containers(summary, status);
  summary["energy"] = energy(simulation.energy(), status.dimensions);
  summary["water"] = water(simulation.water(), status.dimensions);
  const std::optional<WaterFrame> in_water = simulation.water();
  const double length = status.dimensions == 3 ? status.length_m : 1.0;
  summary["flags"] = doubts(status, simulation.energy(),
                            in_water ? in_water->submerged_weight / length : weight_in_air_n_per_m(scene));
  summary["design_rules"] = design_view(simulation, status);
  summary["momentum_error"] = counters.momentum_error;
  summary["particles"] = counters.particles;
  summary["steps"] = counters.steps;
  summary["retries"] = counters.retries;
  summary["min_dt_s"] = counters.min_dt_s;
  summary["max_dt_s"] = counters.max_dt_s;
  summary["simulated_time_s"] = counters.simulated_time_s;
  summary["wall_time_s"] = wall_time_s;
  summary["real_time_factor"] = wall_time_s > 0.0 ? Json(counters.simulated_time_s / wall_time_s) : Json();
  summary["threads"] = threads;
  summary["probes"] = probes(simulation.probes());
  summary["stages"] = stages(counters.stages);
  summary["skipped"] = skipped(counters.skipped);
  summary["accepted_samples"] = opening.count(barge::SampleVerdict::accepted);
  summary["rejected_samples"] = rejected_samples(opening);
  summary["gaps"] = gaps(opening);
  summary["digest"] = fmt::format("{:016x}", simulation.digest());
  return summary.dump(2) + "\n";
}

}  // namespace geocontainer_mpm::scene
