#pragma once
/// What hand calculation says of a release, to stand beside what is computed. Per metre of barge, SI.
///
/// Sources. [CUR] Bezuijen and Vastenburg (eds.), Geosystems. Design Rules and Applications (CUR 217), chapter 6:
/// formulas (6.2), (6.3) and (6.9) and their coefficients as its worked example uses them (A = 10.8 m2, b0 = 3 m: 16.50
/// m and 47.2 kN/m; 320 m3 over 100 m2: 7.9 m/s). The others are derived where they stand.

#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

/// Sea water, and the drag of a blunt body across its length (1.0 to 1.2; [CUR] has 1.0): assumed where a scene does
/// not say.
struct DesignWater {
  double density_kg_per_m3 = 1025.0;
  double drag_coefficient = 1.0;
  bool assumed = true;  ///< not of the scene: the container hangs with its full weight
};

/// Data of one container that the rules ask for.
struct ContainerData {
  std::string name;                ///< of the geotextile
  double fill_area_m2 = 0.0;       ///< A, section of the fill
  double circumference_m = 0.0;    ///< S, unstretched
  double density_kg_per_m3 = 0.0;  ///< rho, of the fill
  double sheet_mass_kg_per_m2 = 0.0;
  double slot_width_m = 0.0;  ///< b0, widest slot
  double gravity_m_per_s2 = 0.0;
  DesignWater water;
};

/// One number of a rule, with what it was made of.
struct DesignRule {
  struct Input {
    std::string name;
    double value;
    std::string unit;
    bool assumed = false;
  };
  std::string name;
  std::optional<double> value;  ///< none: the rule has no answer for these data
  std::string unit;
  std::string rule;    ///< the formula
  std::string source;  ///< where it comes from, and what it takes for granted
  std::vector<Input> inputs;
};

/// Circumference that a fill of section A needs to pass a slot of width b, m: `factor` (b + A / b). 2 is a rectangle
/// that fills the slot; [CUR] (6.2) has 2.5. A container need not be wider than the square of its section, so that a
/// slot wider than sqrt(A) asks for no more than that.
double circumference_for_slot_m(double factor, double fill_area_m2, double slot_width_m);

/// The same solved for the narrowest slot that a circumference allows, m; none where no slot is wide enough.
std::optional<double> slot_for_circumference_m(double factor, double fill_area_m2, double circumference_m);

/// Terminal velocity of a body with this volume over area (of its plan, across the fall), m/s: submerged weight = drag.
double terminal_velocity_m_per_s(double volume_over_area_m, double density_kg_per_m3, double gravity_m_per_s2,
                                 const DesignWater& water);

/// Every container of a scene with a hull.
std::vector<ContainerData> container_data(const SceneDescription& scene, double slot_width_m);

std::vector<DesignRule> design_rules(const ContainerData& container);

}  // namespace geocontainer_mpm::scene
