#pragma once
/// What the families of scenes share: numbers, solids, shapes, sheets and floors by chance, as YAML.
///
/// A seed is the same scene with every compiler: draws follow each other statement by statement, never as arguments of
/// one call, whose order is the compiler's choice.

#include <cmath>
#include <string>

#include "chance.h"

namespace geocontainer_mpm::stability {

constexpr double pi = 3.14159265358979323846;

/// Cells of the space and their size; what a family writes is in cells.
struct Space {
  double dx;
  int width, height;
};

std::string point(double y, double z);
std::string grid_text(const Space& space, const char* sides, const char* bottom);
std::string time_text(double end_s);

enum class Touching { no, yes };

/// Any method that a scene may have, any part of the stability bound.
std::string numerics_text(Chance& c, bool skip_resting, Touching touching);

/// Value of `particles_per_cell`, and a `jitter` with it or not.
std::string particles_text(Chance& c, int most);

struct Solid {
  double density, young, poisson;
  bool frictional;
  double constrained() const { return young * (1.0 - poisson) / (1.0 + poisson) / (1.0 - 2.0 * poisson); }
  double wave_speed() const { return std::sqrt(constrained() / density); }
};

Solid any_solid(Chance& c, double softest, double stiffest);

/// Stiff enough for a weight on it, Pa: small strain is what most laws are for, and what is crushed has no answer.
void carry(Solid& solid, double weight);

/// A solid of some law. Sand cannot stand on its own in the air, but may be given a cohesion.
std::string solid_text(Chance& c, const char* name, Solid& solid, bool sand);

/// A box, a disc, or a polygon; lower corner, width and height in cells.
std::string shape_text(Chance& c, const Space& space, double y, double z, double width, double height);

/// A gravity of any strength, leaning up to `lean_deg` to a side.
std::string gravity_text(Chance& c, double lean_deg, double& size);

double any_friction(Chance& c);

/// Stiffness, mass and segments of a sheet on soil of modulus M: J from 1 to 1e5 times M dx, segments of 0.2 to 4
/// cells. `length` is its unstretched length, m.
std::string sheet_text(Chance& c, const Space& space, const Solid& soil, double length, int least_segments);

/// A floor over the whole width, in cells; it may move: up and down, to and fro, or turn a little.
std::string floor_text(Chance& c, const Space& space, double level, double moving_s);

}  // namespace geocontainer_mpm::stability
