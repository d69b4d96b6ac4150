#pragma once
/// The mechanical model of a scene: bodies, sheets and boundary bodies on the grids of their velocity fields, and the
/// MPM step that moves them. Knows nothing of logs, outputs or outcomes; see simulation.h for those.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "geocontainer_mpm/contact/contact_solver.h"
#include "geocontainer_mpm/contact/field_contact.h"
#include "geocontainer_mpm/contact/sheet_contact.h"
#include "geocontainer_mpm/geotextile/membrane.h"
#include "geocontainer_mpm/geotextile/sheet.h"
#include "geocontainer_mpm/geotextile/strength.h"
#include "geocontainer_mpm/mpm/frequency_bound.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/grid_update.h"
#include "geocontainer_mpm/mpm/sorting.h"
#include "geocontainer_mpm/mpm/transfer.h"
#include "geocontainer_mpm/scene/boundary_loads.h"
#include "geocontainer_mpm/scene/description.h"
#include "geocontainer_mpm/scene/manufactured.h"
#include "geocontainer_mpm/scene/simulation.h"
#include "geocontainer_mpm/scene/water.h"

namespace geocontainer_mpm::scene {

template <int Dim>
struct Body {
  std::string name;
  std::size_t field = 0;  ///< index of its velocity field
  mpm::Particles<Dim> particles;
  mpm::Strips strips;
  std::vector<std::uint32_t> row;  ///< where the particle with an id stands
  std::shared_ptr<const material::Law<Dim>> law;
  mpm::Moduli elastic, viscous;  ///< of the unstrained material; viscous: any multiple of it
  mpm::StressDamping damping;
  bool enclosed = false;  ///< a sheet is its surface
  bool held = false;      ///< it has not started yet: stands where it is and takes no part
  /// Enclosed: by id, grains that are through their sheet and all of them behind a rigid surface. Empty: none.
  std::vector<std::uint8_t> strays;
  std::shared_ptr<const Manufactured> manufactured;
  std::shared_ptr<const std::vector<Vec<Dim>>> start;  ///< positions at the start by id, m
  double density = 0.0;                                ///< of the material, kg/m^3
  double particle_height = 0.0;                        ///< over which a particle enters the water, m; without water 0

  /// Without water that moves with it, kg/m.
  double own_mass(std::size_t p) const { return density * particles.initial_volume[p]; }
  Vec<Dim> position(std::size_t p) const { return particles.position_of(p); }
  Vec<Dim> velocity(std::size_t p) const { return particles.velocity_of(p); }
  Mat<Dim> gradient(std::size_t p) const { return particles.gradient_of(p); }
};

/// What a geotextile is: a line in the section, a surface in space.
template <int Dim>
using SheetOf = std::conditional_t<Dim == 2, geotextile::Sheet, geotextile::Membrane>;

template <int Dim>
struct ModelSheet {
  std::string name;
  std::size_t field = 0;
  SheetOf<Dim> sheet;
  geotextile::Strength strength;                     ///< across the barge (warp)
  geotextile::Strength strength_weft;                ///< along it; in space
  std::optional<std::size_t> inside = std::nullopt;  ///< the body that it encloses
  bool held = false;                                 ///< as that body
};

/// A point of a body that is watched. It is carried by the particle nearest to it at the start: on the surface the
/// grid's own velocity field is extrapolated, and a free point would drift off.
template <int Dim>
struct Tracer {
  std::size_t body;
  std::uint32_t owner;  ///< id of the particle
  Vec<Dim> offset;      ///< from it; follows its deformation, m
  Vec<Dim> position;    ///< m
  Vec<Dim> velocity;    ///< of the last step, by its way: with FLIP particles have another, m/s
};

/// What a boundary body has done to the material since the start, per unit width.
template <int Dim>
struct BoundaryTotal {
  Vec<Dim> impulse = Vec<Dim>::Zero();  ///< N s / m
  double moment = 0.0;                  ///< about its pivot, N s
  double work = 0.0;                    ///< J/m
};

/// What the water has done since the start, per unit width.
template <int Dim>
struct WaterState {
  Vec<Dim> drag = Vec<Dim>::Zero();                     ///< of the present step, N/m
  Vec<Dim> drag_impulse = Vec<Dim>::Zero();             ///< N s / m
  std::vector<std::array<mpm::Column, Dim>> on_sheets;  ///< what of it sheets take, by node; empty: none, N/m
  double fastest_fall = 0.0;                            ///< downward mean velocity of the submerged part of a body, m/s
};

/// Energies that changed hands since the ledger was opened, per unit width, J/m, and what momentum did.
struct Ledger {
  double contact = 0.0, transfer = 0.0, faces = 0.0, damped = 0.0, material_damping = 0.0, work_in = 0.0;
  double water = 0.0;  ///< drag, and what water taken up or left behind keeps
  double plastic_at_start = 0.0, rupture_at_start = 0.0, kinetic_at_start = 0.0, elastic_at_start = 0.0,
         potential_at_start = 0.0;
  double momentum_error = 0.0, momentum_exchanged = 0.0;  ///< N s / m, summed over steps away from faces
};

/// Result of one step: plain, no exceptions.
struct StepStatus {
  bool ok = true;
  Failure failure;
};

/// One step: when, how long, and where the boundary bodies are at both ends, in the order of Model::boundaries().
struct StepInput {
  double time_s, dt_s;
  std::vector<contact::RigidPose> start, end;
  double damping_per_s;
};

/// Everything that steps change.
template <int Dim>
struct ModelState {
  std::vector<Body<Dim>> bodies;
  std::vector<ModelSheet<Dim>> sheets;
  std::vector<Traction> tractions;  ///< in plane strain
  std::vector<Tracer<Dim>> tracers;
  std::vector<contact::ContactSolver<Dim>> contact;       ///< per field
  std::vector<contact::SheetContact<Dim>> sheet_contact;  ///< in the order of the model's pairs
  std::vector<BoundaryTotal<Dim>> boundary_totals;
  WaterState<Dim> water;
  Ledger ledger;
  SkippedCounts skipped;
  StepStatus health;
  Vec<Dim> gravity = Vec<Dim>::Zero();  ///< of the last step, m/s^2
  double kinetic = 0.0;                 ///< on the grids after the last step, J/m
  bool kinetic_known = false;
  double last_dt = 0.0;             ///< s
  double fastest = 0.0;             ///< m/s
  double fastest_of_bodies = 0.0;   ///< m/s
  double travel_since_sort = 0.0;   ///< m
  double travel_since_bound = 0.0;  ///< m, since the stability bound was last assembled
  int steps_since_bound = 0;
  std::size_t bound_active_segments = 0;  ///< of sheets, then
  bool bound_known = false;
  double bound_dt = 0.0;  ///< s, by that bound
  bool sorted = false;
};

template <int Dim>
class Model {
public:
  using Body = scene::Body<Dim>;
  using ModelSheet = scene::ModelSheet<Dim>;
  using ModelState = scene::ModelState<Dim>;

  /// Bodies, sheets and boundaries as described; throws InputError for what only building can find out.
  Model(const SceneDescription& scene, int threads);

  /// Longest step that may be taken from the present state, s. Transfers to the grids on the way; idempotent until
  /// step().
  double stable_dt(double time_s);
  /// One step of at most stable_dt(). After a step that went wrong the state is not to be trusted: restore() another.
  StepStatus step(const StepInput& input);
  /// While held, nothing that touches a boundary slides on it, whatever its friction.
  void hold(bool held);
  /// When the next body starts that is held still, s; infinite for none.
  double next_start_s() const;
  /// Takes all velocity away: the model sleeps, and wakes from standstill.
  void stop_motion();
  /// Ends the initial settling: the ledger, counters and plastic work start from here.
  void open_ledger();

  const ModelState& state() const { return now_; }
  void restore(const ModelState& state);

  const std::vector<Body>& bodies() const { return now_.bodies; }
  const std::vector<ModelSheet>& sheets() const { return now_.sheets; }
  /// Parts of the hull as hull_parts() has them, then the surfaces by name.
  const std::vector<contact::BoundaryBody<Dim>>& boundaries() const { return boundaries_; }
  /// A new tracer at a point of a body, before the first step; its index.
  std::size_t add_tracer(std::size_t body, const Vec<Dim>& at);

  double rms_velocity() const;     ///< by mass, of the last step, m/s
  Vec<Dim> centroid() const;       ///< of the bodies (of the sheets where there are none), by mass, m
  double soil_mass() const;        ///< without water that moves with it, kg/m
  double fundamental_frequency();  ///< rough lowest frequency of the bodies, rad/s: for settling
  EnergyFrame energy() const;
  std::optional<WaterFrame> water() const;  ///< of a scene with water
  double momentum_error() const;
  std::uint64_t digest() const;
  /// Sentence on what is fastest: particle, body, place; for reports of a run that went wrong.
  Failure fastest(bool sheets_too) const;
  /// A body far from its volume, or a load on a torn boundary; an empty reason: none.
  Failure distortion() const;
  /// Looks for grains that have slipped through their sheet between its nodes and are behind a rigid surface, which
  /// their sheet keeps all others from. From now on they touch it themselves.
  void find_strays();
  const StageTimes& stages() const { return stages_; }

private:
  /// One velocity field: what moves on one grid.
  struct Field {
    Field(std::string field_name, mpm::Grid<Dim> field_grid) : name(std::move(field_name)), grid(std::move(field_grid))
    {
    }

    std::string name;
    mpm::Grid<Dim> grid;
    mpm::GridUpdate<Dim> update;
    mpm::FrequencyBound<Dim> bound;
    Vec<Dim> extent_lower = Vec<Dim>::Zero(), extent_upper = Vec<Dim>::Zero();  ///< of its particles, m
    std::vector<contact::ContactPoints<Dim>> all_points;                        ///< scratch of step()
    std::vector<contact::ContactPoints<Dim>> points;                            ///< scratch of step()
    contact::ContactImpulses<Dim> impulses;
    std::vector<contact::Anchor<Dim>> anchors;
  };
  /// Contact of two fields.
  struct FieldPair {
    std::size_t a, b;
    double friction;
    contact::FieldContact contact;
  };
  /// A sheet that points touch from one of its sides: those of a body, or the nodes of another sheet.
  struct SheetPair {
    std::size_t sheet;
    std::optional<std::size_t> body;  ///< its fill; or
    std::size_t other_sheet = 0;      ///< another sheet
    std::size_t point_field, sheet_field;
  };
  /// A body that starts late, with its sheet, and the velocities that it starts with.
  struct LateStart {
    double at_s;
    std::size_t body;
    std::optional<std::size_t> sheet;
    mpm::Particles<Dim> body_start, sheet_start;  ///< as built
    double weight_mass, inertia;                  ///< kg/m
  };
  /// An end of an open sheet that is held, or led.
  struct HeldEnd {
    std::size_t sheet, node;
    Vec<Dim> place;       ///< at the start, m
    TimeTable<2> motion;  ///< displacement over time, m
  };

  void build_fields(const SceneDescription& scene);
  void add_field(const std::string& name, const SceneDescription& scene);
  void build_bodies(const SceneDescription& scene);
  void build_sheets(const SceneDescription& scene);
  void build_boundaries(const SceneDescription& scene);
  void build_loads(const SceneDescription& scene);
  void build_tractions(const SceneDescription& scene);
  std::size_t field_index(const std::string& name) const;
  // model_containers.cpp: containers touch by their sheets, slip in them, and start when they are to
  void build_contacts(const SceneDescription& scene);
  void build_late_starts(const SceneDescription& scene);
  std::optional<std::size_t> sheet_of_container(const SceneDescription& scene, const std::string& field) const;
  void add_sheet_pair(const SheetPair& pair, contact::SheetSide side, double friction);
  contact::ContactPoints<Dim> points_of(const SheetPair& pair) const;
  bool takes_part(const SheetPair& pair) const;
  void solve_sheet_contact(const StepInput& input, double kick);
  void take(const contact::ContactSums<Dim>& sums);
  void take_impulses(const Field& field);
  void start_bodies(double time_s);
  double held(double LateStart::*what) const;

  // model.cpp: one step
  Vec<Dim> gravity_at(double time_s) const;
  void sort_particles();
  void open_grids();
  void transfer_to_grid(double time_s);
  bool books_transferred_work() const;
  void apply_forces(const StepInput& input, double kick);
  void collect_points();
  void solve_contact(const StepInput& input, double kick);
  void collect_anchors(const StepInput& input, std::size_t field);
  void hold_nodes(const StepInput& input, double kick);
  // model_transfer.cpp: particles and grids
  void load_particles(double time_s);
  void scatter(mpm::Part part);
  void add_tractions(double time_s);
  void assemble_mass();
  double load_power(double time_s) const;
  void stress_first(double dt);
  void move_particles(const StepInput& input);
  void map_back(const StepInput& input);
  void smooth_gradients();
  void gather_bodies(mpm::Gather what, double dt);
  void gather_sheets(mpm::Gather what, double dt);
  void move_tracers(double dt);
  void update_stress(double dt);
  // model_water.cpp: buoyancy, drag and added mass
  void weigh();
  void load_water();
  std::size_t sheet_around(std::size_t body) const;
  double sheet_drag_power() const;
  double drag_power() const;
  // model_survey.cpp: is all well, and how long may the next step be
  void survey();
  bool bound_holds() const;
  std::size_t active_segments() const;
  void assemble_bound(std::size_t field);
  void bound_time_step();
  // model_balance.cpp: sums
  double elastic_energy() const;
  double potential_energy() const;
  double gravity_power(const Vec<Dim>& gravity) const;
  double plastic_work() const;
  double damping_power() const;
  double stress_power() const;
  double tension_power() const;
  double rupture_energy() const;
  double half_step_work() const;

  std::shared_ptr<mpm::ThreadTeam> team_;  ///< shared by copies of the model: one steps at a time
  mpm::Discretisation method_;
  double transfer_memory_s_;
  Vec<Dim> constant_gravity_;
  TimeTable<2> gravity_table_;
  std::vector<GeotextileDescription> sheet_descriptions_;  ///< in the order of the sheets
  std::vector<HeldEnd> held_ends_;
  std::vector<SupportDescription> supports_;
  double time_step_factor_, max_step_, max_travel_;
  Vec<Dim> lower_, upper_;
  mpm::Sorter<Dim> sorter_;
  std::vector<Field> fields_;
  std::vector<FieldPair> pairs_;
  std::vector<SheetPair> sheet_pairs_;
  std::vector<LateStart> late_starts_;
  std::vector<contact::BoundaryBody<Dim>> boundaries_;
  std::vector<std::size_t> traction_body_;  ///< per traction, the index of its body
  std::optional<Water> water_;
  double weight_mass_ = 0.0;  ///< what gravity pulls in all, less buoyancy, kg/m
  double inertia_ = 0.0;      ///< all mass, kg/m

  ModelState now_;
  bool on_grid_ = false;
  double stable_dt_ = 0.0;
  double load_power_before_ = 0.0;        ///< of loads on the velocity before the step, W/m
  double drag_power_before_ = 0.0;        ///< of drag, W/m
  double slowed_power_ = 0.0;             ///< of weight on the velocity that water taken up has taken, W/m
  double power_before_ = 0.0;             ///< of all forces on the motion before the transfer, W/m
  Vec<Dim> load_sum_ = Vec<Dim>::Zero();  ///< of all loads but gravity, N/m
  StageTimes stages_;
};

}  // namespace geocontainer_mpm::scene
