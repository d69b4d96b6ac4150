#include "geocontainer_mpm/mpm/particles.h"

#include <gtest/gtest.h>

namespace geocontainer_mpm::mpm {
namespace {

TEST(Deformation, CostsNothingUnlessAskedFor)
{
  Particles<3> particles;
  particles.resize(4);
  std::size_t without = 0, with = 0;
  particles.for_each_column([&](Column&) { ++without; });
  EXPECT_EQ(particles.batch().deformation[0], nullptr);
  particles.permute({ 3, 2, 1, 0 });
  EXPECT_TRUE(particles.deformation[8].empty());
  particles.use_deformation();
  particles.for_each_column([&](Column&) { ++with; });
  EXPECT_EQ(with, without + 9);
  EXPECT_EQ(particles.batch().deformation[4], particles.deformation[4].data());
  particles.resize(4);
  EXPECT_EQ(particles.batch().deformation[0], nullptr);
}

TEST(Deformation, StartsAsIdentityAndMovesWithItsParticle)
{
  Particles<2> particles;
  particles.resize(3);
  particles.use_deformation();
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(particles.deformation[k], Column(3, k == 0 || k == 3 ? 1.0 : 0.0));
  particles.deformation[1] = { 0.1, 0.2, 0.3 };
  particles.permute({ 2, 0, 1 });
  EXPECT_EQ(particles.deformation[1], (Column{ 0.3, 0.1, 0.2 }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm
