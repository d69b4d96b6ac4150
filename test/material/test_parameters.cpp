#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geocontainer_mpm/error.h"
#include "one_particle.h"

namespace geocontainer_mpm::material::testing {
namespace {

struct Bad {
  const char* name;
  double Parameters::*field;
  double value;
  const char* line;
};

class BadParameter : public ::testing::TestWithParam<Bad> {};

TEST_P(BadParameter, IsRefusedInOneLineThatNamesKeyValueAndRange)
{
  Parameters parameters = clayey();
  parameters.*GetParam().field = GetParam().value;
  try {
    parameters.validate("materials.fill");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), GetParam().line);
  }
  EXPECT_THROW(make_law<2>(parameters), InputError);
  EXPECT_THROW(make_law<3>(parameters), InputError);
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Each, BadParameter,
    ::testing::Values(
        Bad{ "density_missing", &Parameters::density_kg_per_m3, 0.0,
             "materials.fill.density_kg_per_m3 = 0: must be a finite density above 0 kg/m^3" },
        Bad{ "density_nan", &Parameters::density_kg_per_m3, nan,
             "materials.fill.density_kg_per_m3 = nan: must be a finite density above 0 kg/m^3" },
        Bad{ "stiffness_negative", &Parameters::young_modulus_pa, -1e6,
             "materials.fill.young_modulus_pa = -1000000: must be a finite stiffness above 0 Pa" },
        Bad{ "stiffness_infinite", &Parameters::young_modulus_pa, inf,
             "materials.fill.young_modulus_pa = inf: must be a finite stiffness above 0 Pa" },
        Bad{ "poisson_incompressible", &Parameters::poisson_ratio, 0.5,
             "materials.fill.poisson_ratio = 0.5: must be within [0, 0.49]" },
        Bad{ "poisson_nan", &Parameters::poisson_ratio, nan,
             "materials.fill.poisson_ratio = nan: must be within [0, 0.49]" },
        Bad{ "friction_none", &Parameters::friction_angle_deg, 0.0,
             "materials.fill.friction_angle_deg = 0: must be within (0, 60) degrees" },
        Bad{ "friction_nan", &Parameters::friction_angle_deg, nan,
             "materials.fill.friction_angle_deg = nan: must be within (0, 60) degrees" },
        Bad{ "friction_high", &Parameters::friction_angle_deg, 60.0,
             "materials.fill.friction_angle_deg = 60: must be within (0, 60) degrees" },
        Bad{ "dilation_above_friction", &Parameters::dilation_angle_deg, 26.0,
             "materials.fill.dilation_angle_deg = 26: must be within [0, friction_angle_deg = 25] degrees" },
        Bad{ "dilation_negative", &Parameters::dilation_angle_deg, -1.0,
             "materials.fill.dilation_angle_deg = -1: must be within [0, friction_angle_deg = 25] degrees" },
        Bad{ "cohesion_negative", &Parameters::cohesion_pa, -1.0,
             "materials.fill.cohesion_pa = -1: must be a finite cohesion of at least 0 Pa" },
        Bad{ "cohesion_infinite", &Parameters::cohesion_pa, inf,
             "materials.fill.cohesion_pa = inf: must be a finite cohesion of at least 0 Pa" },
        Bad{ "cutoff_beyond_apex", &Parameters::tension_cutoff_pa, 3e4,
             "materials.fill.tension_cutoff_pa = 30000: must be within [0, cohesion_pa / tan(friction_angle_deg) = "
             "21445.1] Pa" },
        Bad{ "cutoff_nan", &Parameters::tension_cutoff_pa, nan,
             "materials.fill.tension_cutoff_pa = nan: must be within [0, cohesion_pa / tan(friction_angle_deg) = "
             "21445.1] Pa" }),
    [](const auto& bad) { return bad.param.name; });

TEST(Parameters, AcceptTheirLimits)
{
  EXPECT_NO_THROW(clayey().validate("m"));
  EXPECT_NO_THROW(sand(33.0, 33.0).validate("m"));
  Parameters p = elastic_soil();
  p.poisson_ratio = 0.49;
  EXPECT_NO_THROW(p.validate("m"));
  p.poisson_ratio = 0.0;
  EXPECT_NO_THROW(p.validate("m"));
  EXPECT_NO_THROW(clayey(25.0, 5.0, 1e4, 1e4 / std::tan(25.0 * pi / 180.0)).validate("m"));
}

TEST(Parameters, AnElasticLawDoesNotAskForStrength)
{
  Parameters p = elastic_soil();
  p.friction_angle_deg = 0.0;
  EXPECT_NO_THROW(p.validate("m"));
}

void expect_refusal(const Parameters& parameters, const char* line)
{
  try {
    parameters.validate("m");
    FAIL() << "accepted: " << line;
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), line);
  }
}

TEST(Parameters, AFluidAsksForItsOwnAndNotForElasticity)
{
  EXPECT_NO_THROW(slurry(LawName::newtonian).validate("m"));
  EXPECT_NO_THROW(slurry(LawName::bingham).validate("m"));
  Parameters p = slurry(LawName::newtonian);
  p.viscosity_pa_s = 0.0;
  p.yield_stress_pa = -1.0;  // of bingham only
  EXPECT_NO_THROW(p.validate("m"));
  p.bulk_modulus_pa = 0.0;
  expect_refusal(p, "m.bulk_modulus_pa = 0: must be a finite stiffness above 0 Pa");
  p = slurry(LawName::newtonian);
  p.viscosity_pa_s = -1.0;
  expect_refusal(p, "m.viscosity_pa_s = -1: must be a finite viscosity of at least 0 Pa s");
  p = slurry(LawName::bingham);
  p.yield_stress_pa = nan;
  expect_refusal(p, "m.yield_stress_pa = nan: must be a finite stress of at least 0 Pa");
  p = slurry(LawName::bingham);
  p.regularisation_rate_per_s = 0.0;
  expect_refusal(p, "m.regularisation_rate_per_s = 0: must be a finite rate above 0 1/s");
}

TEST(Parameters, DampingIsATimeOfEverySolid)
{
  for (const LawName law : { LawName::linear_elastic, LawName::mohr_coulomb, LawName::neo_hookean, LawName::hencky }) {
    Parameters p = sand();
    p.law = law;
    EXPECT_NO_THROW(p.validate("m"));
    p.stiffness_damping_s = -1e-3;
    expect_refusal(p, "m.stiffness_damping_s = -0.001: must be a finite time of at least 0 s");
  }
}

TEST(Parameters, RefuseALawThatDoesNotExist)
{
  Parameters p = elastic_soil();
  p.law = static_cast<LawName>(7);
  EXPECT_THROW(p.validate("m"), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::material::testing
