// docs/scene-reference.md is written from the grammar; this fails when the page is out of date.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "description_fixture.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {
namespace {

constexpr const char* renew = "GEOCONTAINER_MPM_RENEW_DOCS";

TEST(DescriptionReference, PageMatchesTheGrammar)
{
  const std::string path = source_dir + "/docs/scene-reference.md";
  if (std::getenv(renew)) {
    std::ofstream(path) << scene_reference();
  }
  std::ifstream file(path);
  ASSERT_TRUE(file) << path;
  std::ostringstream page;
  page << file.rdbuf();
  EXPECT_EQ(page.str(), scene_reference())
      << "The page is out of date. Renew it: " << renew << "=1 test_scene_description_reference";
}

TEST(DescriptionReference, TellsUnitRangeDefaultAndNeed)
{
  const std::string page = scene_reference();
  for (const char* row :
       { "| `end_s` | s | a number > 0 | *required* |", "| `time_step_factor` |  | a number in (0, 1] | `0.8` |",
         "## `materials.<name>`", "## `bodies.<name>.shape.hopper_fill`", "## `hull.signal`",
         "| `law` |  | one of linear_elastic, mohr_coulomb, neo_hookean, hencky, newtonian, bingham | *required* |",
         "only with law `mohr_coulomb`", "| `probe_interval_s` | s | a number > 0 | absent |",
         "| `between` |  | a list of 2 texts | *required* |", "## `geotextiles.<name>.start`",
         "| `table` | s, m, m, rad | a list of at least 1 rows [time_s, y, z, angle] | *required* |" })
    EXPECT_NE(page.find(row), std::string::npos) << row;
}

}  // namespace
}  // namespace geocontainer_mpm::scene
