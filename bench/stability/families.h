#pragma once
/// The families of scenes, as YAML.

#include <string>

#include "chance.h"

namespace geocontainer_mpm::stability {

// draw_container.cpp: with a geotextile, or like it
std::string draw_drop(Chance& c);
std::string draw_sheet(Chance& c);
std::string draw_release(Chance& c);
// draw_plain.cpp: bodies without one
std::string draw_column(Chance& c);
std::string draw_stack(Chance& c);
std::string draw_bar(Chance& c);
std::string draw_fluid(Chance& c);
std::string draw_rest(Chance& c, double steps);

}  // namespace geocontainer_mpm::stability
