#pragma once
/// What a case is: plain data, as a scene file gives it. Every field carries unit and reason; `validate()` names the
/// first key that is wrong, its value and what is allowed. In plane strain positions are [y, z] in metres in the
/// barge frame (`base_link`: hinge axis midships, y to port, z up). Compression is negative, tension is N/m.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/geotextile/sheet.h"
#include "geocontainer_mpm/material/parameters.h"
#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/types.h"
#include "geocontainer_mpm/scene/time_table.h"

namespace geocontainer_mpm::scene {

struct TimeDescription {
  double end_s = 0.0;              ///< simulated time at which the run is complete, s, > 0
  double output_interval_s = 0.1;  ///< spacing of frames (record, topics), s, > 0
  /// Spacing of the samples of `probes`, s, > 0; not given: every frame.
  std::optional<double> probe_interval_s;
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

/// Which part of a scene in space that is its own mirror image is computed; the planes of symmetry are y = 0 and x = 0.
enum class Symmetry {
  none,    ///< all of it
  half,    ///< the port half, y >= 0
  quarter  ///< of that the fore half, x >= 0
};

/// Given, a scene is three-dimensional: the section that all else draws in y and z reaches along the barge.
struct SpaceDescription {
  Vec2 along_m = Vec2::Zero();  ///< from and to, x of the space that material may occupy, m; a whole number of cells
  /// Order x_min, x_max. Rollers make the ends what plane strain takes them for.
  std::array<FaceCondition, 2> faces{ FaceCondition::roller, FaceCondition::roller };
  Symmetry symmetry = Symmetry::none;
};

struct NumericsDescription {
  mpm::Discretisation method;        ///< shape, transfer, flip_fraction, mass, update, smoothing
  double transfer_memory_s = 0.005;  ///< how long aflip remembers what the grid does not see, s, > 0
  double time_step_factor = 0.8;     ///< fraction of the stability bound that a step may use, (0, 1]
  double max_step_s = 0.01;          ///< upper bound of a step, s, > 0
  double max_travel_cells = 0.25;    ///< furthest a particle may move in a step, cells, (0, 0.5]
  double damping_per_s = 0.0;        ///< mass-proportional damping of the live run, 1/s, >= 0; 0 for physics
  /// No steps while nothing moves; not given: in a scene with a hull.
  std::optional<bool> skip_resting;
  double rest_velocity_m_per_s = 2e-3;  ///< root-mean-square velocity below which a body counts as resting, m/s, > 0
  double rest_time_s = 0.5;             ///< how long it must stay below, s, > 0
  int max_halvings = 6;                 ///< how often a step that went wrong is halved before the run ends, [0, 20]
  double energy_jump = 0.1;             ///< energy from nowhere, over that present or exchanged, that undoes steps, > 0
  double speed_jump = 5.0;  ///< speed over what can be explained that undoes steps, > 1; see explained_speed.h
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
struct Ring {
  Vec2 center_m;
  double inner_radius_m = 0.0;  ///< > 0
  double outer_radius_m = 0.0;  ///< > inner radius
};
struct Polygon {
  std::vector<Vec2> vertices_m;  ///< at least 3, simple, either sense
};
/// The closed hopper filled from its bottom to the level at which the filled section has this area.
struct HopperFill {
  double area_m2 = 0.0;
};
/// Exactly one of the five is set.
struct ShapeDescription {
  std::optional<Box> box;
  std::optional<Disc> disc;
  std::optional<Ring> ring;
  std::optional<Polygon> polygon;
  std::optional<HopperFill> hopper_fill;
};

enum class InitialStress {
  none,        ///< stress-free
  k0,          ///< vertical stress from the depth below the body's top at that y, horizontal by K0
  gravity,     ///< k0, then settled under gravity with damping, hulls closed, until it rests; clock and history start
               ///< after
  hydrostatic  ///< the same pressure in all directions, from the depth: how a fluid starts
};

/// Motions with a known body force (method of manufactured solutions): the body starts on the solution, is driven by
/// its body force, and the distance of its particles from the solution is the error.
enum class ManufacturedSolution {
  axis_aligned,  ///< u_i = A sin(pi X_i) sin(c pi t + f_i) in the unit square (Wallstedt & Guilkey 2008), f = (0, pi)
  vortex         ///< generalized vortex in the ring 0.75 m < R < 1.25 m (Kamojjala et al. 2015)
};
struct ManufacturedDescription {
  ManufacturedSolution solution = ManufacturedSolution::axis_aligned;
  double amplitude = 0.05;       ///< A: m (axis_aligned) or rad (vortex), > 0
  Vec2 origin_m = Vec2::Zero();  ///< lower corner of the unit square, or centre of the ring, m
};

/// A sine over space: v = amplitude sin(wave_number . X + phase). The modes of bars and strings.
struct VelocityWave {
  Vec2 amplitude_m_per_s = Vec2::Zero();
  Vec2 wave_number_rad_per_m = Vec2::Zero();
  double phase_rad = 0.0;
};

/// What the velocity field is called of bodies and sheets that name none.
inline constexpr const char* common_field = "common";

struct BodyDescription {
  std::string material;  ///< a key of `materials`
  ShapeDescription shape;
  std::optional<Vec2> along_m;  ///< from and to, m: in space the shape reaches so far along x, with flat ends
  int particles_per_cell = 2;   ///< in each direction, 1 to 4
  double jitter = 0.0;          ///< furthest random offset of a particle, over the spacing, [0, 0.5]
  /// Bodies that name the same field move in one velocity field and stick together where they meet. Fields touch by
  /// `contacts`. Empty: the common field.
  std::string velocity_field;
  Vec2 initial_velocity_m_per_s = Vec2::Zero();
  double initial_spin_rad_per_s = 0.0;                ///< about the middle of the body's mass, from y towards z
  std::optional<VelocityWave> initial_velocity_wave;  ///< on top of both
  InitialStress initial_stress = InitialStress::none;
  double k0 = 0.5;                                      ///< horizontal over vertical stress for k0 and gravity, [0, 2]
  std::optional<ManufacturedDescription> manufactured;  ///< needs law neo_hookean and no gravity
  /// Until then the body and the sheet around it stay where they are, touch nothing and take no part, s, >= 0. Then
  /// they start with the initial velocity: how a second container is dropped on the first.
  double held_until_s = 0.0;
};

/// Axis-parallel rectangle that selects.
struct Region {
  Vec2 lower_m = Vec2::Zero(), upper_m = Vec2::Zero();
};

/// Grid nodes in a region that do not move, or move as prescribed, whatever is on them.
struct SupportDescription {
  Region region;                        ///< nodes within, edges included (1e-6 cells); may be a line or a node
  bool holds_y = true, holds_z = true;  ///< at least one
  TimeTable<2> velocity_table;          ///< [t, v_y, v_z], m/s; empty: still
};

/// Stress on a body's boundary, carried along with it.
struct TractionDescription {
  std::string body;
  /// Selects the pieces of the body's boundary whose middle lies within at the start; not given: all of it.
  std::optional<Region> region;
  Vec2 traction_pa = Vec2::Zero();  ///< force per present area, direction fixed in space
  double pressure_pa = 0.0;         ///< against the present surface, inwards positive
  TimeTable<1> table;               ///< [t, factor] on both; empty: 1
};

/// Contact between two velocity fields. Every pair of fields of a scene is named once.
struct ContactDescription {
  std::vector<std::string> between;  ///< two names of velocity fields
  double friction = 0.0;             ///< Coulomb coefficient, >= 0
};

/// Path along which a free sheet is laid.
struct SheetLine {
  std::vector<Vec2> points_m;  ///< at least 2, open or closed
  bool closed = false;         ///< joined from the last point to the first
};

/// What happens at one end of an open sheet.
struct SheetEnd {
  bool held = false;                  ///< stays at its place, or follows `motion_table`
  TimeTable<2> motion_table;          ///< [t, y, z]: displacement of a held end, m
  Vec2 force_n_per_m = Vec2::Zero();  ///< pulls at a free end
  TimeTable<1> force_table;           ///< [t, factor] on force_n_per_m; empty: 1
};

/// Pressure on the inner side of a closed sheet: p(z) = (pressure_pa + gradient_pa_per_m (z_ref - z)) factor, where
/// z_ref is level_m, or the sheet's own highest point when no level is given.
struct InsidePressure {
  double pressure_pa = 0.0;
  double gradient_pa_per_m = 0.0;  ///< unit weight of what is inside, >= 0
  std::optional<double> level_m;
  TimeTable<1> table;  ///< [t, factor]; empty: 1
};

/// A seam that is named; the slice cuts it in a point. `at_m` or `along` says where, in the sheet as it is laid.
struct SeamDescription {
  std::optional<Vec2> at_m;          ///< the segment nearest to this point
  std::optional<double> along;       ///< part of the sheet's length from its first point, [0, 1]
  std::optional<double> efficiency;  ///< its strength over the sheet's, (0, 1]; not given: the sheet's seam_efficiency
  bool tears = false;                ///< where its tension reaches its strength, it carries nothing from then on
};

/// Cloth laid in folds along part of a sheet's path. A fold is smaller than what the grid resolves: what is modelled is
/// the length of cloth in it and where it lies, not its shape.
struct Wrinkles {
  Region region;             ///< the parts of the path within it hold the folds
  int number = 1;            ///< of folds, at even distances, >= 1
  double amplitude_m = 0.0;  ///< height of a fold, two straight sides from the path up and back, m, > 0
};

/// How a sheet and the body that it encloses are bound to each other.
enum class SheetInterface {
  bonded,     ///< one velocity field: neither slips nor parts
  frictional  ///< a field each, unilateral Coulomb contact between them
};

struct GeotextileDescription {
  // Exactly one of these three says where it is laid.
  std::string encloses;  ///< the body around whose outline the closed sheet is laid
  std::optional<SheetLine> line;
  std::optional<Disc> circle;  ///< closed, along a circle
  // At most one of these three says how long it is unstretched; none: as long as its path. The difference is spread
  // evenly.
  std::optional<double> circumference_m;     ///< unstretched length around, or from end to end, m
  std::optional<double> slack;               ///< unstretched length over that of the path, less 1, >= 0
  std::optional<double> pretension_n_per_m;  ///< tension in the path as laid, >= 0
  SheetEnd start, end;                       ///< of an open line
  std::optional<InsidePressure> inside_pressure;
  std::string velocity_field;                         ///< of a free sheet; an enclosing one moves with its body
  Vec2 initial_velocity_m_per_s = Vec2::Zero();       ///< of a free sheet
  std::optional<VelocityWave> initial_velocity_wave;  ///< of a free sheet, on top
  double stiffness_n_per_m = 0.0;                     ///< J (warp), force per width and strain, > 0; unless a table is
  // Along the barge, in space; not given: as across it (warp).
  std::optional<double> stiffness_weft_n_per_m;                     ///< > 0
  std::optional<double> strength_weft_n_per_m;                      ///< > 0
  std::vector<geotextile::ForceStrainRow> force_strain_weft_table;  ///< empty: linear
  /// In space, length of cloth in a closed end over that of the flat end, both ways, less 1, >= 0; not given: as around
  /// the section, as if the end were gathered from the tube.
  std::optional<double> end_slack;
  double mass_kg_per_m2 = 0.0;                ///< true mass: what gravity pulls, > 0
  double computational_mass_kg_per_m2 = 0.0;  ///< inertia used (mass scaling), >= true mass
  double strength_n_per_m = 0.0;              ///< tensile strength of the sheet (warp), > 0
  double seam_efficiency = 0.85;              ///< strength of a seam over the sheet's, (0, 1]
  double segment_length_m = 0.0;              ///< wanted length of a membrane segment, > 0; about a cell
  double gauge_length_m = 0.5;                ///< reported tension is the mean over this length, >= segment length
  geotextile::Formulation formulation = geotextile::Formulation::segments;
  std::vector<geotextile::ForceStrainRow> force_strain_table;  ///< from (0, 0), ascending; empty: linear, J
  std::optional<double> rupture_strain;               ///< from which on a piece carries nothing, > 0; not given: never
  std::map<std::string, SeamDescription> seams;       ///< none: one of seam_efficiency may be anywhere
  std::optional<Wrinkles> wrinkles;                   ///< on top of slack that is spread evenly
  SheetInterface interface = SheetInterface::bonded;  ///< of an enclosing sheet with its body
  double interface_friction = 0.0;                    ///< Coulomb coefficient, tan(delta), of a frictional one, >= 0
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
  double lip_radius_m = 0.0;  ///< corners of the section are rounded with this radius, m, >= 0
  double friction = 0.0;      ///< Coulomb coefficient geotextile on hull, >= 0
  /// From and to, m: in space the hopper between its end bulkheads, half of which moves with each half of the hull. Not
  /// given: no bulkheads. The walls reach through the whole space.
  std::optional<Vec2> along_m;
  std::vector<OpeningRow> opening_table;  ///< used when no log is given; empty: stays closed
  barge::OpeningSignalParameters signal;  ///< how logged angles are judged and filtered
  /// Where the halves stop, rad, > 0. Not given: the largest angle of opening_table, without one signal.max_angle_rad.
  std::optional<double> full_opening_rad;

  double full_opening() const;  ///< rad
};

/// Prescribed rigid motion: x = pivot + R(angle) (X - pivot) + displacement.
struct MotionDescription {
  Vec2 pivot_m = Vec2::Zero();
  TimeTable<3>
      table;  ///< [t, y, z, angle]: displacement, m, and rotation about +x (y towards z), rad; at least one row
};

/// A rigid surface of boundary particles.
struct SurfaceDescription {
  std::vector<Vec2> line_m;                 ///< polyline; the free side is on the left walking along it
  bool closed = false;                      ///< joined from the last point to the first
  double corner_radius_m = 0.0;             ///< corners of an open line are rounded with this radius, m, >= 0
  double friction = 0.0;                    ///< Coulomb coefficient, >= 0
  std::optional<MotionDescription> motion;  ///< not given: stands still
};

// What is measured during a run, as time series in summary and record.
struct PointProbe {
  std::string body;
  Vec2 at_m = Vec2::Zero();  ///< where the material point is at the start; it moves with the body
};
struct SectionProbe {
  Vec2 from_m = Vec2::Zero(), to_m = Vec2::Zero();  ///< straight cut, fixed in space
};
struct GeotextileProbe {
  std::string geotextile;
  std::optional<Vec2> at_m;  ///< the sheet's point nearest to this at the start is followed as well
};
/// Exactly one is set.
struct ProbeDescription {
  std::optional<PointProbe> point;      ///< displacement, velocity, stress of a material point
  std::optional<std::string> body;      ///< a body's centroid, mean velocity, mean stress, volume, extent, energies
  std::optional<SectionProbe> section;  ///< force that the right side of the cut exerts on the left side
  std::optional<GeotextileProbe> geotextile;  ///< largest and mean tension, length, enclosed area, extent
  std::optional<std::string> surface;       ///< force, moment about the pivot, and work of a rigid surface or hull half
  std::optional<std::string> manufactured;  ///< a body's distance from its manufactured solution
};

/// Still water of one density around the bodies; docs/concepts.md has what it does to them. Needs constant gravity
/// along -z.
struct WaterDescription {
  double density_kg_per_m3 = 0.0;  ///< 1025 at sea, 1000 fresh, > 0
  // Exactly one says where the surface is: the draught in a scene with a hull, the level in one without.
  std::optional<double> draught_m;  ///< from the lowest point of the closed hull's section up to the surface, m, > 0
  std::optional<double> level_m;    ///< z of the surface, m
  double drag_coefficient = 0.0;    ///< Cd, over the body's width across its motion, >= 0
  double added_mass_coefficient = 0.0;  ///< Ca: water that moves with a body, over the water it displaces, >= 0
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
  TimeTable<2> gravity_table;  ///< [t, g_y, g_z]: body force per mass over time, m/s^2, instead of gravity_m_per_s2
  TimeDescription time;
  GridDescription grid;
  std::optional<SpaceDescription> space;  ///< not given: plane strain
  NumericsDescription numerics;
  std::map<std::string, material::Parameters> materials;
  std::map<std::string, BodyDescription> bodies;             ///< at least one body or geotextile
  std::map<std::string, GeotextileDescription> geotextiles;  ///< around a body each, or free
  std::optional<HullDescription> hull;
  std::map<std::string, SurfaceDescription> surfaces;  ///< the bed and other rigid surfaces
  std::map<std::string, SupportDescription> supports;
  std::map<std::string, TractionDescription> tractions;
  std::map<std::string, ContactDescription> contacts;  ///< between velocity fields
  std::map<std::string, ProbeDescription> probes;
  OutcomeDescription outcome;
  std::optional<WaterDescription> water;

  /// 2 in plane strain, 3 in space.
  int dimensions() const { return space ? 3 : 2; }
  Symmetry symmetry() const { return space ? space->symmetry : Symmetry::none; }
  /// How many times what is computed makes the whole.
  double parts() const { return symmetry() == Symmetry::quarter ? 4.0 : symmetry() == Symmetry::half ? 2.0 : 1.0; }

  /// Gravity at an instant, from whichever of the two is given.
  Vec2 gravity_at(double time_s) const;

  /// z of the water's surface, from whichever of the two is given, m; of a scene with water.
  double water_level_m() const;

  /// Names of the velocity fields that bodies and free sheets move in, in order.
  std::vector<std::string> velocity_fields() const;
  /// Whether a velocity field is that of one container: a body, the closed sheet around it, and nothing else.
  bool is_container(const std::string& field) const;

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
