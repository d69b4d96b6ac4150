#pragma once
/// One instant of a run as everybody downstream sees it: record, topics, forecast. Plain data, owned by the receiver.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::scene {

/// What became of the container.
enum class Outcome {
  waiting,    ///< at rest in the closed hull
  releasing,  ///< the hull has opened and part of the container is still above the lips
  released,   ///< all of it is below the lips, on its way or landed
  hung_up,    ///< it stands still in the open slot
  none        ///< a scene without hull and container
};
const char* to_string(Outcome outcome);

/// Particles of one body.
struct SoilFrame {
  std::string name;
  std::vector<Vec2> position;                 ///< m
  std::vector<Vec2> velocity;                 ///< m/s
  std::vector<std::array<double, 4>> stress;  ///< Cauchy stress yy, zz, yz, xx (out of plane), Pa, tension positive
  std::vector<double> volume;                 ///< current volume per unit width, m^2
};

/// One sheet: node i and node i + 1 bound segment i. Closed: the last segment joins the last node to the first; open:
/// there is one segment less than nodes.
struct GeotextileFrame {
  std::string name;
  bool closed = true;
  std::vector<Vec2> node;             ///< m, in order along the sheet
  std::vector<Vec2> velocity;         ///< m/s
  std::vector<double> tension;        ///< per segment, raw, N/m, >= 0
  std::vector<double> gauge_tension;  ///< per segment, mean over the gauge length, N/m: what is reported and judged
  double gauge_length_m = 0.0;
  double strength_n_per_m = 0.0;  ///< of the sheet
  double seam_strength_n_per_m = 0.0;
};

/// One rigid half or surface of boundary particles.
struct BoundaryFrame {
  std::string name;                   ///< `hull_port`, `hull_starboard`, or the surface's key
  std::vector<Vec2> position;         ///< boundary particles, in order along the section, m
  bool closed = false;                ///< joined from the last particle to the first
  double angle_rad = 0.0;             ///< rotation about hinge or pivot: a hull half opening positive, else about +x
  Vec2 force_n_per_m = Vec2::Zero();  ///< what the bodies press on it, mean over the output interval, N/m
};

/// Energies per unit width, J/m; see docs/concepts for the balance.
struct EnergyFrame {
  double kinetic = 0.0;
  double elastic = 0.0;
  double potential = 0.0;   ///< gravity, zero at z = 0
  double dissipated = 0.0;  ///< plastic + friction and impact + transfer + damping, since the start
  double dissipated_plastic = 0.0;
  double dissipated_contact = 0.0;
  double dissipated_transfer = 0.0;     ///< lost by the particle-grid transfer: numerical
  double dissipated_water = 0.0;        ///< given to the water: drag, and the motion of what is taken up or left behind
  double work_in = 0.0;                 ///< done on the material by moving boundaries, since the start
  double unbalanced = 0.0;              ///< change + dissipated - work in: energy from nowhere, since the start
  double dissipated_rupture = 0.0;      ///< what was stored in pieces of sheets that broke
  double relative_balance_error = 0.0;  ///< |change + dissipated - work in| over all energy that changed hands
};

/// What the water does to the bodies, per unit width.
struct WaterFrame {
  double level_m = 0.0;                   ///< z of the surface
  double submerged_share = 0.0;           ///< of the bodies' volume, now
  double buoyancy_n_per_m = 0.0;          ///< now
  double submerged_weight_n_per_m = 0.0;  ///< of bodies and sheets less buoyancy, now
  double fastest_fall_m_per_s = 0.0;      ///< largest downward mean velocity of the submerged part of a body so far
  Vec2 drag_impulse_n_s_per_m = Vec2::Zero();  ///< since the start
  double dissipated_j_per_m = 0.0;             ///< since the start
};

/// A container's tension since another body started that had been held: what dropping that one on it does.
struct TensionEpisode {
  std::string started;  ///< name of the body that started
  double start_s = 0.0;
  double before_n_per_m = 0.0;  ///< largest gauge tension just before
  double peak_n_per_m = 0.0;    ///< largest since, or until the next episode
  double peak_time_s = 0.0;
};

/// One container: a body and the sheet around it.
struct ContainerStatus {
  std::string name;  ///< the sheet's
  Outcome outcome = Outcome::none;
  double release_time_s = -1.0;       ///< < 0 while not released
  double peak_tension_n_per_m = 0.0;  ///< largest gauge tension so far
  double peak_tension_time_s = 0.0;
  Vec2 peak_tension_position_m = Vec2::Zero();
  double current_tension_n_per_m = 0.0;
  double elongation_max = 0.0;
  double peak_utilisation_sheet = 0.0, peak_utilisation_seam = 0.0;
  Vec2 centroid_m = Vec2::Zero();  ///< of the fill, by mass
  double width_m = 0.0, height_m = 0.0;
  double soil_volume_m2 = 0.0, soil_volume_initial_m2 = 0.0;
  std::vector<TensionEpisode> episodes;
};

struct StatusFrame {
  Outcome outcome = Outcome::waiting;
  double release_time_s = -1.0;       ///< < 0 while not released
  bool resting = false;               ///< nothing moves: no steps are taken
  double peak_tension_n_per_m = 0.0;  ///< largest gauge tension so far
  double peak_tension_time_s = 0.0;
  Vec2 peak_tension_position_m = Vec2::Zero();
  double current_tension_n_per_m = 0.0;  ///< largest gauge tension now
  double elongation_max = 0.0;           ///< largest strain of the sheet so far
  Vec2 centroid_m = Vec2::Zero();        ///< of the soil, by mass
  double width_m = 0.0, height_m = 0.0;  ///< extent of the container now
  double soil_volume_m2 = 0.0;           ///< per unit width, now
  double soil_volume_initial_m2 = 0.0;
  double peak_utilisation_sheet = 0.0;  ///< largest gauge tension over the sheet's strength so far
  double peak_utilisation_seam = 0.0;   ///< the same at the seams, over theirs
  std::size_t ruptures = 0;             ///< pieces of sheets that broke
  double rupture_time_s = -1.0;         ///< when the first did; < 0: none
  Vec2 rupture_position_m = Vec2::Zero();
  std::vector<ContainerStatus> containers;  ///< in the order of their sheets
};

/// What one probe measured since the frame before.
struct ProbeFrame {
  struct Column {
    std::string name;            ///< a name of an HDF5 data set, not `time`
    std::string unit;            ///< `1` for a number without
    std::vector<double> values;  ///< one a sample
  };
  std::string name;            ///< the probe's key in the scene
  std::string kind;            ///< point, body, section, geotextile, surface, manufactured
  std::vector<double> time_s;  ///< of the samples, ascending
  std::vector<Column> columns;
};

struct Frame {
  double time_s = 0.0;        ///< simulation time
  std::int64_t stamp_ns = 0;  ///< the same in the log's epoch
  std::uint64_t step = 0;
  double dt_s = 0.0;
  barge::OpeningAngles opening;
  std::vector<SoilFrame> soil;
  std::vector<GeotextileFrame> geotextile;
  std::vector<BoundaryFrame> boundary;
  EnergyFrame energy;
  StatusFrame status;
  std::vector<ProbeFrame> probes;
  std::optional<double> water_level_m;  ///< z of the surface, in a scene with water
};

}  // namespace geocontainer_mpm::scene
