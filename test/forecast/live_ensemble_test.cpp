/// Members that follow a log, against members that are run from its beginning.

#include "geocontainer_mpm/forecast/live_ensemble.h"

#include <gtest/gtest.h>

#include "geocontainer_mpm/error.h"
#include "release_fixture.h"

namespace geocontainer_mpm::forecast {
namespace {

const auto never = [] { return false; };

std::string distributions()
{
  return std::string(GEOCONTAINER_MPM_SOURCE_DIR) + "/config/ensembles/release.yaml";
}

EnsemblePlan plan(std::size_t members)
{
  return draw_members(release_path(), coarse_overrides(), distributions(), members, 7);
}

TEST(LiveEnsemble, FollowsTheLogInPiecesAsOneRunFromItsBeginningWould)
{
  LiveEnsemble pieces(plan(3), 2), whole(plan(3), 1);
  const scene::SceneDescription scene = coarse_release();
  const AssumedOpening& opening = planned();
  barge::OpeningSignal so_far(scene.hull->signal);
  std::vector<ensemble::Member> members;
  for (int i = 0; i <= 40; ++i) {
    so_far.add(sample_at(i));
    if (i == 15 || i == 30 || i == 40)
      members = pieces.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 8.0, 20.0 }, never);
  }
  EXPECT_GT(pieces.cost_s(), 0.0);
  const std::vector<ensemble::Member> at_once =
      whole.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 8.0, 20.0 }, never);
  ASSERT_EQ(members.size(), 3u);
  for (std::size_t i = 0; i < members.size(); ++i) {
    EXPECT_EQ(members[i].ending, ensemble::Ending::completed) << members[i].why;
    EXPECT_EQ(members[i].digest, at_once[i].digest);
    EXPECT_EQ(members[i].outcome, scene::Outcome::released);
  }
  EXPECT_NE(members[0].digest, members[1].digest);

  pieces.reset();  // another log begins
  const std::vector<ensemble::Member> again =
      pieces.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 8.0, 20.0 }, never);
  for (std::size_t i = 0; i < members.size(); ++i)
    EXPECT_EQ(again[i].digest, at_once[i].digest);
}

TEST(LiveEnsemble, SaysWhyAMemberIsMissing)
{
  EnsemblePlan two = plan(2);
  two.scenes[0].numerics.speed_jump = 1e-6;  // any motion is too fast
  LiveEnsemble ensemble(std::move(two), 1);
  const scene::SceneDescription scene = coarse_release();
  const AssumedOpening& opening = planned();
  barge::OpeningSignal so_far(scene.hull->signal);
  for (int i = 0; i <= 40; ++i)
    so_far.add(sample_at(i));
  const std::vector<ensemble::Member> members =
      ensemble.run_ahead(so_far, opening.continue_from(so_far, 1.0), { 4.0, 20.0 }, never);
  EXPECT_EQ(members[0].ending, ensemble::Ending::failed);
  EXPECT_NE(members[0].why.find("solver stopped"), std::string::npos) << members[0].why;
  EXPECT_EQ(members[1].ending, ensemble::Ending::completed);
}

TEST(LiveEnsemble, DoesNotTakeAnOverrideOfWhatIsDrawn)
{
  std::vector<std::string> overrides = coarse_overrides();
  overrides.push_back("hull.friction=0.3");
  EXPECT_THROW(draw_members(release_path(), overrides, distributions(), 2, 1), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::forecast
