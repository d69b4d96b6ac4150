#include <fmt/format.h>

#include <cmath>

#include "description_leaf.h"
#include "description_rules.h"
#include "description_shapes.h"

namespace geocontainer_mpm::scene {

namespace {

using grammar::number_text;
using grammar::refuse;
using grammar::to_text;

constexpr double pi = 3.14159265358979323846;
constexpr double vortex_inner_m = 0.75, vortex_outer_m = 1.25;

void check_shape(const std::string& key, const ShapeDescription& shape, const SceneDescription& scene)
{
  check_choice(key,
               { { "box", shape.box.has_value() },
                 { "disc", shape.disc.has_value() },
                 { "ring", shape.ring.has_value() },
                 { "polygon", shape.polygon.has_value() },
                 { "hopper_fill", shape.hopper_fill.has_value() } },
               1, 1);
  if (shape.box && !((shape.box->upper_m - shape.box->lower_m).minCoeff() > 0.0))
    refuse(key + ".box.upper_m", to_text(shape.box->upper_m),
           "must lie above lower_m = " + to_text(shape.box->lower_m));
  if (shape.ring && !(shape.ring->outer_radius_m > shape.ring->inner_radius_m))
    refuse(key + ".ring.outer_radius_m", number_text(shape.ring->outer_radius_m),
           "must be above inner_radius_m = " + number_text(shape.ring->inner_radius_m));
  if (shape.polygon)
    check_simple(key + ".polygon.vertices_m", shape.polygon->vertices_m, true);
  if (shape.hopper_fill && !scene.hull)
    refuse(key + ".hopper_fill", "", "fills the hopper of a hull: the scene needs the section hull");
  if (const auto box = extent(shape))
    check_inside(key, *box, scene.grid);
}

/// Laws of finite strain know their stress from the deformation alone, and fluids have no K0.
void check_initial_stress(const std::string& key, const BodyDescription& body, const material::Parameters& material,
                          const SceneDescription& scene)
{
  if (body.initial_stress == InitialStress::none)
    return;
  const std::string stress_key = key + ".initial_stress";
  const std::string stress = to_text(body.initial_stress);
  const bool fluid = material::is_fluid(material.law);
  if (body.initial_stress == InitialStress::hydrostatic && !fluid)
    refuse(stress_key, stress, "needs law newtonian or bingham, is " + to_text(material.law));
  if (body.initial_stress != InitialStress::hydrostatic && material.law != material::LawName::linear_elastic &&
      material.law != material::LawName::mohr_coulomb)
    refuse(stress_key, stress, "needs law linear_elastic or mohr_coulomb, is " + to_text(material.law));
  const Vec2 gravity = scene.gravity_at(0.0);
  if (gravity[0] != 0.0 || gravity[1] > 0.0)
    refuse(stress_key, stress, "needs gravity along -z, is " + to_text(gravity));
}

/// A K0 beyond the passive or below the active state lies outside the Mohr-Coulomb cone (Rankine).
void check_k0(const std::string& key, const BodyDescription& body, const material::Parameters& material)
{
  if (body.initial_stress != InitialStress::k0 || material.law != material::LawName::mohr_coulomb ||
      material.cohesion_pa > 0.0)
    return;
  const double sine = std::sin(material.friction_angle_deg * pi / 180.0);
  const double active = (1.0 - sine) / (1.0 + sine);
  if (body.k0 < active * (1.0 - relative_tolerance) || body.k0 > (1.0 + relative_tolerance) / active)
    refuse(key + ".k0", number_text(body.k0),
           fmt::format("must lie between the active and passive states of {}, in [{:.4g}, {:.4g}]", body.material,
                       active, 1.0 / active));
}

bool near(double a, double b)
{
  return std::abs(a - b) <= relative_tolerance;  // lengths about 1 m
}

bool near(const Vec2& a, const Vec2& b)
{
  return near(a[0], b[0]) && near(a[1], b[1]);
}

void check_manufactured(const std::string& key, const BodyDescription& body, const material::Parameters& material,
                        const SceneDescription& scene)
{
  const ManufacturedDescription& manufactured = *body.manufactured;
  const std::string solution = to_text(manufactured.solution);
  const std::string solution_key = key + ".manufactured.solution";
  if (material.law != material::LawName::neo_hookean)
    refuse(key + ".manufactured", "", "needs law neo_hookean, is " + to_text(material.law));
  if (!scene.gravity_table.empty() || scene.gravity_m_per_s2 != Vec2::Zero())
    refuse(key + ".manufactured", "",
           "has a body force of its own: needs gravity_m_per_s2 [0, 0] and no gravity_table");
  if (body.initial_velocity_m_per_s != Vec2::Zero() || body.initial_spin_rad_per_s != 0.0 || body.initial_velocity_wave)
    refuse(key + ".initial_velocity_m_per_s", to_text(body.initial_velocity_m_per_s),
           "a body with a manufactured solution starts with the solution's velocity: no other, no spin, no wave");
  const Vec2& origin = manufactured.origin_m;
  const ShapeDescription& shape = body.shape;
  if (body.held_until_s > 0.0)
    refuse(key + ".held_until_s", number_text(body.held_until_s),
           "must be 0: a body with a manufactured solution starts on the solution");
  if (manufactured.solution == ManufacturedSolution::axis_aligned) {
    if (!(manufactured.amplitude < 1.0 / pi))
      refuse(key + ".manufactured.amplitude", number_text(manufactured.amplitude),
             "must be below 1 / pi: beyond it the solution turns matter inside out");
    if (!shape.box || shape.box->rotation_deg != 0.0 || !near(shape.box->lower_m, origin) ||
        !near(shape.box->upper_m, origin + Vec2::Ones()))
      refuse(solution_key, solution,
             fmt::format("needs a shape box with lower_m = origin_m = {} and upper_m = {}", to_text(origin),
                         to_text(Vec2(origin + Vec2::Ones()))));
  }
  if (manufactured.solution == ManufacturedSolution::vortex &&
      (!shape.ring || !near(shape.ring->center_m, origin) || !near(shape.ring->inner_radius_m, vortex_inner_m) ||
       !near(shape.ring->outer_radius_m, vortex_outer_m)))
    refuse(solution_key, solution,
           fmt::format("needs a shape ring with center_m = origin_m = {}, inner_radius_m = {} and outer_radius_m = {}",
                       to_text(origin), number_text(vortex_inner_m), number_text(vortex_outer_m)));
}

}  // namespace

void check_bodies(const SceneDescription& scene)
{
  std::string in_hopper;
  for (const auto& [name, body] : scene.bodies) {
    const std::string key = "bodies." + name;
    const material::Parameters& material = entry_of(scene.materials, body.material, key + ".material", "materials");
    check_shape(key + ".shape", body.shape, scene);
    if (!body.velocity_field.empty())
      check_name(body.velocity_field, key + ".velocity_field", body.velocity_field);
    check_initial_stress(key, body, material, scene);
    check_k0(key, body, material);
    if (body.manufactured)
      check_manufactured(key, body, material, scene);
    if (body.shape.hopper_fill && !in_hopper.empty())
      refuse(key + ".shape.hopper_fill", name, "the hopper is filled by " + in_hopper + " already");
    if (body.shape.hopper_fill)
      in_hopper = name;
  }
}

}  // namespace geocontainer_mpm::scene
