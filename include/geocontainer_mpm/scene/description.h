#pragma once
/// What a case is: plain data, as a scene file gives it. Every field carries unit and reason; `validate()` names the
/// first key that is wrong, its value and what is allowed. In plane strain positions are [y, z] in metres in the
/// barge frame (`base_link`: hinge axis midships, y to port, z up). Compression is negative, tension is N/m.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/material/parameters.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::scene {

struct TimeDescription {
  double end_s = 0.0;              ///< simulated time at which the run is complete, s, > 0
  double output_interval_s = 0.1;  ///< spacing of frames (record, topics), s, > 0
};

/// What a face of the grid does to material that reaches it.
using mpm::FaceCondition;

struct GridDescription {
  double cell_size_m = 0.1;     ///< dx, m, > 0
  Vec2 lower_m = Vec2::Zero();  ///< lower corner of the space that material may occupy, m
  Vec2 upper_m = Vec2::Zero();  ///< upper corner, m; extent is a whole number of cells (1e-6)
  /// Order y_min, y_max, z_min, z_max. Free: material that leaves ends the run with a reason. Roller: no motion
  /// through the face, none hindered along it. Fixed: no motion at all.
  std::array<FaceCondition, 4> faces{};
};

struct NumericsDescription {
  double time_step_factor = 0.8;        ///< fraction of the stability bound that a step may use, (0, 1]
  double max_step_s = 0.01;             ///< upper bound of a step, s, > 0
  double max_travel_cells = 0.25;       ///< furthest a particle may move in a step, cells, (0, 0.5]
  double damping_per_s = 0.0;           ///< mass-proportional damping of the live run, 1/s, >= 0; 0 for physics
  bool skip_resting = true;             ///< no steps while nothing moves
  double rest_velocity_m_per_s = 2e-3;  ///< root-mean-square velocity below which a body counts as resting, m/s, > 0
  double rest_time_s = 0.5;             ///< how long it must stay below, s, > 0
};

struct Box {
  Vec2 lower_m, upper_m;
  double rotation_deg = 0.0;  ///< counter-clockwise seen against x (y to the right, z up), about `pivot_m`
  Vec2 pivot_m = Vec2::Zero();
};
struct Disc {
  Vec2 center_m;
  double radius_m = 0.0;
};
struct Polygon {
  std::vector<Vec2> vertices_m;  ///< at least 3, simple, either sense
};
/// The closed hopper filled from its bottom to the level at which the filled section has this area.
struct HopperFill {
  double area_m2 = 0.0;
};
/// Exactly one of the four is set.
struct ShapeDescription {
  std::optional<Box> box;
  std::optional<Disc> disc;
  std::optional<Polygon> polygon;
  std::optional<HopperFill> hopper_fill;
};

enum class InitialStress {
  none,    ///< stress-free
  k0,      ///< vertical stress from the depth below the body's top at that y, horizontal by K0
  gravity  ///< k0, then settled under gravity with damping, hulls closed, until it rests; clock and history start after
};

struct BodyDescription {
  std::string material;  ///< a key of `materials`
  ShapeDescription shape;
  int particles_per_cell = 2;  ///< in each direction, 1 to 4
  Vec2 initial_velocity_m_per_s = Vec2::Zero();
  InitialStress initial_stress = InitialStress::none;
  double k0 = 0.5;  ///< horizontal over vertical stress for k0 and gravity, [0, 2]
};

struct GeotextileDescription {
  std::string encloses;            ///< the body around whose outline the closed sheet is laid
  double circumference_m = 0.0;    ///< unstretched length around; the excess over the outline is slack laid in evenly
  double stiffness_n_per_m = 0.0;  ///< J (warp), force per width and strain, > 0
  double mass_kg_per_m2 = 0.0;     ///< true mass: what gravity pulls, > 0
  double computational_mass_kg_per_m2 = 0.0;  ///< inertia used (mass scaling), >= true mass
  double strength_n_per_m = 0.0;              ///< tensile strength of the sheet (warp), > 0
  double seam_efficiency = 0.85;              ///< strength of a seam over the sheet's, (0, 1]
  double segment_length_m = 0.0;              ///< wanted length of a membrane segment, > 0; about a cell
  double gauge_length_m = 0.5;                ///< reported tension is the mean over this length, >= segment length
};

/// One opening row of a table: time, s, and both angles, rad.
struct OpeningRow {
  double time_s = 0.0;
  double port_rad = 0.0;
  double starboard_rad = 0.0;
};

struct HullDescription {
  Vec2 hinge_m = Vec2::Zero();  ///< hinge axis, m
  /// Closed section of the port half, y >= 0: from the bottom inwards, round the lip and up the inner wall to the deck,
  /// so that the free side is on the left walking along it. Starboard is its mirror image.
  std::vector<Vec2> port_section_m;
  double lip_radius_m = 0.0;              ///< corners of the section are rounded with this radius, m, >= 0
  double friction = 0.0;                  ///< Coulomb coefficient geotextile on hull, >= 0
  std::vector<OpeningRow> opening_table;  ///< used when no log is given; empty: stays closed
  barge::OpeningSignalParameters signal;  ///< how logged angles are judged and filtered
};

/// A rigid surface that stands still.
struct SurfaceDescription {
  std::vector<Vec2> line_m;  ///< open polyline; the free side is on the left walking along it
  double friction = 0.0;     ///< Coulomb coefficient, >= 0
};

/// When the container counts as released, hung up, at rest.
struct OutcomeDescription {
  double hung_up_after_s = 5.0;  ///< standing still this long in the open slot means hung up, s, > 0
};

struct SceneDescription {
  std::string name;         ///< short, for summaries and records
  std::string description;  ///< one sentence
  std::string source;       ///< file it came from, for messages; empty for one built in code
  Vec2 gravity_m_per_s2{ 0.0, -9.81 };
  TimeDescription time;
  GridDescription grid;
  NumericsDescription numerics;
  std::map<std::string, material::Parameters> materials;
  std::map<std::string, BodyDescription> bodies;             ///< at least one
  std::map<std::string, GeotextileDescription> geotextiles;  ///< each around its own body
  std::optional<HullDescription> hull;
  std::map<std::string, SurfaceDescription> surfaces;  ///< the bed and other fixed surfaces
  OutcomeDescription outcome;

  /// Throws InputError naming `source`, the dotted key, its value and what is allowed.
  void validate() const;
};

/// Reads and validates a YAML scene. `overrides` are `dotted.key=value` strings, applied before checking; a key that
/// does not exist in the scene grammar is an error, as is an unknown, missing or ill-typed one in the file.
SceneDescription load_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from YAML text; `source` names it in messages.
SceneDescription parse_scene(const std::string& yaml, const std::string& source,
                             const std::vector<std::string>& overrides = {});

/// The scene as YAML with every key written out, overrides and defaults included: what a record keeps. parse_scene
/// reads it back to the same values, bit for bit.
std::string scene_text(const SceneDescription& scene);

/// Every key with unit, range, default and meaning, as Markdown: docs/scene-reference.md.
std::string scene_reference();

}  // namespace geocontainer_mpm::scene
