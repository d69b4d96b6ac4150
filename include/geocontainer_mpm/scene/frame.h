#pragma once
/// One instant of a run as everybody downstream sees it: record, topics, forecast. Plain data, owned by the receiver.
///
/// Every vector is in the barge frame: x forward, y to port, z up. In plane strain x is 0, volumes are areas of the
/// section (m^2), and forces, energies and weights are per metre along x (N/m, J/m); in 3-D they are m^3, N and J.
/// `StatusFrame::dimensions` says which it is. Tension of a sheet is N/m, force per width, in both.

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

/// Components xx, yy, zz, xy, xz, yz, as in material/law.h's three dimensions; in plane strain xy and xz are 0.
using SymmetricTensor = std::array<double, 6>;

/// Particles of one body.
struct SoilFrame {
  std::string name;
  std::vector<Vec3> position;           ///< m
  std::vector<Vec3> velocity;           ///< m/s
  std::vector<SymmetricTensor> stress;  ///< Cauchy stress, Pa, tension positive
  std::vector<double> volume;           ///< current volume, m^2 or m^3
};

/// Corners of one triangle: indices into the nodes or positions of its part.
using Triangle = std::array<std::uint32_t, 3>;

/// One sheet, in pieces that carry its tension. Without triangles it is a line and its pieces are segments: node i and
/// node i + 1 bound segment i; closed: the last segment joins the last node to the first; open: there is one segment
/// less than nodes. With triangles these are the pieces.
struct GeotextileFrame {
  std::string name;
  bool closed = true;                 ///< of a line
  std::vector<Vec3> node;             ///< m; of a line in order along it
  std::vector<Vec3> velocity;         ///< m/s
  std::vector<Triangle> triangles;    ///< seen from outside counter-clockwise
  std::vector<double> tension;        ///< per piece, raw, N/m, >= 0; of a triangle the larger of warp and weft
  std::vector<double> gauge_tension;  ///< per piece, mean over the gauge length, N/m: what is reported and judged
  std::vector<double> warp_tension;   ///< per triangle, mean over the gauge length, along the warp, N/m; may be empty
  std::vector<double> weft_tension;   ///< the same along the weft
  double gauge_length_m = 0.0;
  double strength_n_per_m = 0.0;  ///< of the sheet
  double seam_strength_n_per_m = 0.0;
};

/// One rigid half or surface of boundary particles.
struct BoundaryFrame {
  std::string name;                 ///< `hull_port`, `hull_starboard`, or the surface's key
  std::vector<Vec3> position;       ///< boundary particles, m; of a line in order along the section
  std::vector<Triangle> triangles;  ///< counter-clockwise seen from the bodies; none: a line
  bool closed = false;              ///< a line joined from its last particle to the first
  double angle_rad = 0.0;           ///< rotation about hinge or pivot: a hull half opening positive, else about +x
  Vec3 force = Vec3::Zero();        ///< what the bodies press on it, mean over the output interval, N/m or N
};

/// Energies, J/m or J; see docs/concepts for the balance.
struct EnergyFrame {
  /// So many times as much: of the whole, from a part of it.
  EnergyFrame times(double parts) const;

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

/// What the water does to the bodies.
struct WaterFrame {
  double level_m = 0.0;               ///< z of the surface
  double submerged_share = 0.0;       ///< of the bodies' volume, now
  double buoyancy = 0.0;              ///< now, N/m or N
  double submerged_weight = 0.0;      ///< of bodies and sheets less buoyancy, now, N/m or N
  double fastest_fall_m_per_s = 0.0;  ///< largest downward mean velocity of the submerged part of a body so far
  Vec3 drag_impulse = Vec3::Zero();   ///< since the start, N s/m or N s
  double dissipated = 0.0;            ///< since the start, J/m or J
};

/// A container's tension since another body started that had been held: what dropping that one on it does.
struct TensionEpisode {
  std::string started;  ///< name of the body that started
  double start_s = 0.0;
  double before_n_per_m = 0.0;  ///< largest gauge tension just before
  double peak_n_per_m = 0.0;    ///< largest since, or until the next episode
  double peak_time_s = 0.0;
};

/// How a container is, or all containers together.
struct ContainerState {
  Outcome outcome = Outcome::waiting;
  double release_time_s = -1.0;       ///< < 0 while not released
  double peak_tension_n_per_m = 0.0;  ///< largest gauge tension so far
  double peak_tension_time_s = 0.0;
  Vec3 peak_tension_position_m = Vec3::Zero();
  double current_tension_n_per_m = 0.0;                  ///< largest gauge tension now
  double utilisation_sheet = 0.0;                        ///< largest gauge tension over the sheet's strength now
  double utilisation_seam = 0.0;                         ///< the same at the seams, over theirs
  double elongation_max = 0.0;                           ///< largest strain of the sheet so far
  double peak_utilisation_sheet = 0.0;                   ///< largest gauge tension over the sheet's strength so far
  double peak_utilisation_seam = 0.0;                    ///< the same at the seams, over theirs
  std::size_t ruptures = 0;                              ///< pieces of the sheet that broke
  double rupture_time_s = -1.0;                          ///< when the first did; < 0: none
  Vec3 rupture_position_m = Vec3::Zero();                ///< where the first did
  Vec3 centroid_m = Vec3::Zero();                        ///< of the soil, by mass
  double length_m = 0.0, width_m = 0.0, height_m = 0.0;  ///< extent along x (0 in plane strain), y and z now
  double soil_volume = 0.0, soil_volume_initial = 0.0;   ///< now and at the start, m^2 or m^3
};

/// One container: a body and the sheet around it.
struct ContainerStatus : ContainerState {
  std::string name;  ///< the sheet's
  std::vector<TensionEpisode> episodes;
};

/// All together, bodies without a sheet included: released when the last container is, hung up when one is.
struct StatusFrame : ContainerState {
  int dimensions = 2;                       ///< 2: plane strain, 3
  bool resting = false;                     ///< nothing moves: no steps are taken
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

/// `place(position, 3)` is "x 1.000 m, y 2.000 m, z 3.000 m"; of plane strain without x.
std::string place(const Vec3& position_m, int dimensions);

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
