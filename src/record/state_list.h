#pragma once
/// What of a run is state: one list for writing and for reading it (state_archive.h).
///
/// Every list takes its struct apart by a structured binding, which has to name all members: one that is added later
/// does not compile until it is put into the list, or left out of it on purpose. Left out is what the scene makes anew
/// (laws, rest lengths, densities) and what a step fills before it reads it.

#include "../scene/simulation_state.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm {

/// Members by their own names.
#define GEOCONTAINER_MPM_STATE(...) archive.members(#__VA_ARGS__, __VA_ARGS__)

struct StateAccess {
  template <class A, int Dim>
  static void list(A& archive, mpm::Particles<Dim>& particles)
  {
    auto& [position, velocity, affine, gradient, stress, deformation, box, force, mass, weight_mass, volume,
           initial_volume, separated_strain, elastic_energy, dissipated, id, scratch, id_scratch] = particles;
    GEOCONTAINER_MPM_STATE(position, velocity, affine, gradient, stress, deformation, box, force, mass, weight_mass,
                           volume, initial_volume, separated_strain, elastic_energy, dissipated, id);
  }

  template <class A, int Dim>
  static void list(A& archive, scene::Body<Dim>& body)
  {
    auto& [name, field, particles, strips, row, law, elastic, viscous, damping, enclosed, held, strays, manufactured,
           start, density, particle_height] = body;
    GEOCONTAINER_MPM_STATE(particles, row, held, strays);
    auto& [begin] = strips;
    archive("strips", begin);
  }

  template <class A>
  static void list(A& archive, geotextile::Sheet& sheet)
  {
    auto& [parameters, law, nodes, outwards, rest_length, tension, piece_length, strain, rupture_strain, broken,
           ruptures, rupture_place, external, stretch, tangent, point_tension] = sheet;
    GEOCONTAINER_MPM_STATE(nodes, tension, strain, broken, ruptures, rupture_place, external, stretch, tangent,
                           point_tension);
  }

  template <class A>
  static void list(A& archive, geotextile::Membrane& membrane)
  {
    auto& [parameters, nodes, triangles, closed, cloth, family, tension, ruptures, rupture_place, external, near, begin,
           share] = membrane;
    GEOCONTAINER_MPM_STATE(nodes, tension, ruptures, rupture_place, external);
    archive.parts("family", family, [](auto& inside, auto& yarns) {
      auto& [law, b1, b2, strain, rupture_strain, yarn_tension, broken] = yarns;
      inside.members("strain, tension, broken", strain, yarn_tension, broken);
    });
  }

  template <class A, int Dim>
  static void list(A& archive, scene::ModelSheet<Dim>& what)
  {
    auto& [name, field, sheet, strength, strength_weft, inside, held] = what;
    GEOCONTAINER_MPM_STATE(sheet, held);
  }

  template <class A>
  static void list(A& archive, scene::Traction& traction)
  {
    auto& [description, pieces] = traction;
    archive.rows("pieces", pieces, [](auto& row, auto& piece) {
      auto& [owner, offset, area, length, place, velocity] = piece;
      row.members("owner, offset, area, length, place, velocity", owner, offset, area, length, place, velocity);
    });
  }

  template <class A, int Dim>
  static void list(A& archive, scene::Tracer<Dim>& tracer)
  {
    auto& [body, owner, offset, position, velocity] = tracer;
    GEOCONTAINER_MPM_STATE(body, owner, offset, position, velocity);
  }

  /// The impulses of the last step are the first guess of the next one.
  template <class A, int Dim>
  static void list(A& archive, contact::ContactSolver<Dim>& solver)
  {
    auto& [shape, held, contacts, mirrored, holds, memory, remembered, anchor_memory, widest, others, touched, seen,
           untouched_velocity] = solver;
    GEOCONTAINER_MPM_STATE(held, remembered);
    archive.rows("memory", memory, [](auto& row, auto& load) {
      auto& [pressed, dragged] = load;
      row.members("pressed, dragged", pressed, dragged);
    });
    archive.rows("anchor_memory", anchor_memory);
  }

  /// A pair that is apart for a while keeps the contacts of the last step in which it was not.
  template <class A, int Dim>
  static void list(A& archive, contact::SheetContact<Dim>& sheet_contact)
  {
    auto& [shape, surface, friction, held, contacts, shares, mirrored, memory, gathered, near_mirror, slot] =
        sheet_contact;
    GEOCONTAINER_MPM_STATE(held);
    archive.rows("contacts", contacts, [](auto& row, auto& contact) {
      auto& [point, sheet, normal, compliance, along, approach, load, id] = contact;
      auto& [pressed, dragged] = load;
      row.members("pressed, dragged, id", pressed, dragged, id);
    });
    archive.rows("memory", memory, [](auto& row, auto& load) {
      auto& [pressed, dragged] = load;
      row.members("pressed, dragged", pressed, dragged);
    });
  }

  template <class A, int Dim>
  static void list(A& archive, scene::BoundaryTotal<Dim>& total)
  {
    auto& [impulse, moment, work] = total;
    GEOCONTAINER_MPM_STATE(impulse, moment, work);
  }

  template <class A, int Dim>
  static void list(A& archive, scene::WaterState<Dim>& water)
  {
    auto& [drag, drag_impulse, on_sheets, fastest_fall] = water;
    GEOCONTAINER_MPM_STATE(drag, drag_impulse, on_sheets, fastest_fall);
  }

  template <class A>
  static void list(A& archive, scene::Ledger& ledger)
  {
    auto& [contact, transfer, faces, damped, material_damping, work_in, water, plastic_at_start, rupture_at_start,
           kinetic_at_start, elastic_at_start, potential_at_start, momentum_error, momentum_exchanged] = ledger;
    GEOCONTAINER_MPM_STATE(contact, transfer, faces, damped, material_damping, work_in, water, plastic_at_start,
                           rupture_at_start, kinetic_at_start, elastic_at_start, potential_at_start, momentum_error,
                           momentum_exchanged);
  }

  template <class A>
  static void list(A& archive, scene::SkippedCounts& skipped)
  {
    auto& [resting_time_s, contact_searches, grid_nodes, membrane_passes] = skipped;
    GEOCONTAINER_MPM_STATE(resting_time_s, contact_searches, grid_nodes, membrane_passes);
  }

  template <class A>
  static void list(A& archive, scene::Failure& failure)
  {
    auto& [reason, position_m, time_s] = failure;
    GEOCONTAINER_MPM_STATE(reason, position_m, time_s);
  }

  template <class A>
  static void list(A& archive, scene::StepStatus& status)
  {
    auto& [ok, failure] = status;
    GEOCONTAINER_MPM_STATE(ok, failure);
  }

  template <class A, int Dim>
  static void list(A& archive, scene::ModelState<Dim>& state)
  {
    auto& [bodies, sheets, tractions, tracers, contact, sheet_contact, boundary_totals, water, ledger, skipped, health,
           gravity, kinetic, kinetic_known, last_dt, fastest, fastest_of_bodies, travel_since_sort, travel_since_bound,
           steps_since_bound, bound_active_segments, bound_known, bound_dt, sorted] = state;
    GEOCONTAINER_MPM_STATE(bodies, sheets, tractions, contact, sheet_contact, water, ledger, skipped, health, gravity,
                           kinetic, kinetic_known, last_dt, fastest, fastest_of_bodies, travel_since_sort,
                           travel_since_bound, steps_since_bound, bound_active_segments, bound_known, bound_dt, sorted);
    archive.rows("tracers", tracers);
    archive.rows("boundary_totals", boundary_totals);
  }

  template <class A>
  static void list(A& archive, scene::EnergyFrame& energy)
  {
    auto& [kinetic, elastic, potential, dissipated, dissipated_plastic, dissipated_contact, dissipated_transfer,
           dissipated_water, work_in, unbalanced, dissipated_rupture, relative_balance_error] = energy;
    GEOCONTAINER_MPM_STATE(kinetic, elastic, potential, dissipated, dissipated_plastic, dissipated_contact,
                           dissipated_transfer, dissipated_water, work_in, unbalanced, dissipated_rupture,
                           relative_balance_error);
  }

  template <class A>
  static void list(A& archive, scene::TensionEpisode& episode)
  {
    auto& [started, start_s, before_n_per_m, peak_n_per_m, peak_time_s] = episode;
    GEOCONTAINER_MPM_STATE(started, start_s, before_n_per_m, peak_n_per_m, peak_time_s);
  }

  template <class A>
  static void list(A& archive, scene::ContainerStatus& status)
  {
    auto& [outcome, release_time_s, peak_tension_n_per_m, peak_tension_time_s, peak_tension_position_m,
           current_tension_n_per_m, utilisation_sheet, utilisation_seam, elongation_max, peak_utilisation_sheet,
           peak_utilisation_seam, ruptures, rupture_time_s, rupture_position_m, centroid_m, length_m, width_m, height_m,
           soil_volume, soil_volume_initial] = static_cast<scene::ContainerState&>(status);
    GEOCONTAINER_MPM_STATE(outcome, release_time_s, peak_tension_n_per_m, peak_tension_time_s, peak_tension_position_m,
                           current_tension_n_per_m, utilisation_sheet, utilisation_seam, elongation_max,
                           peak_utilisation_sheet, peak_utilisation_seam, ruptures, rupture_time_s, rupture_position_m,
                           centroid_m, length_m, width_m, height_m, soil_volume, soil_volume_initial);
    // A binding does not reach over a base: what is added here shows by its size.
    static_assert(sizeof(scene::ContainerStatus) ==
                  sizeof(scene::ContainerState) + sizeof(status.name) + sizeof(status.episodes));
    archive.members("name, episodes", status.name, status.episodes);
  }

  template <class A, int Dim>
  static void list(A& archive, scene::ReleaseWatch<Dim>& watch)
  {
    auto& [hull, hung_up_after_s, symmetry, watched, held, initial_volume, gauge] = watch;
    GEOCONTAINER_MPM_STATE(watched, held, initial_volume);
  }

  template <class A>
  static void list(A& archive, scene::ProbeFrame::Column& column)
  {
    auto& [name, unit, values] = column;
    GEOCONTAINER_MPM_STATE(name, unit, values);
  }

  template <class A>
  static void list(A& archive, scene::ProbeFrame& series)
  {
    auto& [name, kind, time_s, columns] = series;
    GEOCONTAINER_MPM_STATE(name, kind, time_s, columns);
  }

  template <class A, int Dim>
  static void list(A& archive, scene::Probes<Dim>& probes)
  {
    auto& [cell_size, targets, series, frame_begin, frame_end] = probes;
    GEOCONTAINER_MPM_STATE(series, frame_begin, frame_end);
    archive.parts("targets", targets, [](auto& inside, auto& target) {
      auto& [probe, index, node, turned_rad, last_s, last] = target;
      inside.members("turned_rad, last_s, last", turned_rad, last_s, last);
    });
  }

  template <class A>
  static void list(A& archive, barge::OpeningSample& sample)
  {
    auto& [stamp_ns, angles] = sample;
    auto& [port_rad, starboard_rad] = angles;
    GEOCONTAINER_MPM_STATE(stamp_ns, port_rad, starboard_rad);
  }

  template <class A>
  static void list(A& archive, barge::MonotoneHistory& history)
  {
    auto& [knots] = history;
    archive.rows("knots", knots, [](auto& row, auto& knot) {
      auto& [time_ns, time_s, value, rate] = knot;
      row.members("time_ns, time_s, value, rate", time_ns, time_s, value, rate);
    });
  }

  template <class A>
  static void list(A& archive, barge::OpeningSignal& opening)
  {
    auto& [parameters, max_gap_ns, half_window_ns, counts, origin_ns, last_accepted, has_candidate, candidate_since_ns,
           candidate, window, next, stretch_starts, stretch_closed, play, play_width, still_since_ns, held,
           stretch_since_ns, history, held_until_ns, finished, gaps] = opening;
    GEOCONTAINER_MPM_STATE(counts, origin_ns, last_accepted, has_candidate, candidate_since_ns, candidate, next,
                           stretch_starts, stretch_closed, play, play_width, still_since_ns, held, stretch_since_ns,
                           history, held_until_ns, finished);
    archive.rows("window", window, [](auto& row, auto& measurement) {
      auto& [time_ns, angle] = measurement;
      row.members("time_ns, angle", time_ns, angle);
    });
    archive.rows("gaps", gaps, [](auto& row, auto& gap) {
      auto& [from_s, to_s] = gap;
      row.members("from_s, to_s", from_s, to_s);
    });
  }

  /// Of Run<Dim>::Progress, which no template can deduce.
  template <class A, class Progress>
  static void list_progress(A& archive, Progress& progress)
  {
    auto& [time_s, dt_s, still_since_s, resting, next_frame, next_sample, min_dt_s, max_dt_s, steps, resting_time_s,
           interval_start_s, interval_start, mean_force, retries, halvings, doubtful_s, wall_speed, start, turnover,
           failure, stopped] = progress;
    GEOCONTAINER_MPM_STATE(time_s, dt_s, still_since_s, resting, next_frame, next_sample, min_dt_s, max_dt_s, steps,
                           resting_time_s, interval_start_s, retries, halvings, doubtful_s, wall_speed, start, turnover,
                           failure, stopped);
    archive.rows("interval_start", interval_start);
    archive.rows("mean_force", mean_force);
  }

  /// Of a state that was found right.
  template <class A, class Checkpoint>
  static void list_checkpoint(A& archive, Checkpoint& checkpoint)
  {
    auto& [model, progress, watch, probes, energy] = checkpoint;
    GEOCONTAINER_MPM_STATE(model, watch, probes, energy);
    archive.group("progress", [&now = progress](auto& inside) { list_progress(inside, now); });
  }

  /// All but the state now, which is a checkpoint: `model`, `watch`, `probes` and `progress`.
  template <class A, int Dim>
  static void list(A& archive, scene::Run<Dim>& run)
  {
    auto& [scene, model, opening, motion, changes, watch, probes, progress, settled, fresh_probes, fresh_progress,
           explained_speed, checkpoint, steps_since_checkpoint] = run;
    GEOCONTAINER_MPM_STATE(opening, settled, fresh_probes, explained_speed);
    archive.group("fresh_progress", [&fresh = fresh_progress](auto& inside) { list_progress(inside, fresh); });
  }

  /// One to read a state into, with all that the scene makes.
  template <int Dim>
  static typename scene::Run<Dim>::Checkpoint fresh_state(const scene::Run<Dim>& run)
  {
    return { run.model.state(), run.progress, run.watch, run.probes, {} };
  }

  template <class F>
  static decltype(auto) with_run(const scene::Simulation& simulation, F&& f)
  {
    return simulation.state_->with(f);
  }
  template <int Dim>
  static scene::Simulation wrap(std::unique_ptr<scene::Run<Dim>> run)
  {
    auto state = std::make_unique<scene::Simulation::State>();
    state->run = std::move(run);
    return scene::Simulation(std::move(state));
  }
};

#undef GEOCONTAINER_MPM_STATE

}  // namespace geocontainer_mpm
