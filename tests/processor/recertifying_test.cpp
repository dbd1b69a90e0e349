// Single bodies get new swept spheres and certificates.
#include <gtest/gtest.h>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::recertifying_test {
namespace {

constexpr std::uint64_t seed = 5203;

/// Balls in a box that move at random.
void add_some(SmallWorld& world, Random& random, int count) {
  for (int k = 0; k < count; ++k)
    world.add({.radius = 0.1,
               .acceleration_limit = 0.2 * random.uniform(),
               .position = 3.0 * random.point_in_ball(),
               .velocity = random.point_in_ball()});
}

TEST(Recertifying, LeavesNoPairWithoutAReason) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 20; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    SmallWorld world;
    add_some(world, random, 30);
    ASSERT_TRUE(world.main.recertify());
    const BroadPhase& windows = world.state.broad_phase;
    const Bodies& bodies = world.state.bodies;
    std::vector<PairCertificate> pairs;
    world.main.certifier().for_each_certificate(world.main.queue(),
                                                [&](const PairCertificate& pair) { pairs.push_back(pair); });
    const CertificateTimes times(pairs);
    for (std::uint32_t a = 0; a < 30; ++a) {
      EXPECT_TRUE(windows.contains(a));
      EXPECT_FALSE(bodies[a].dirty || bodies[a].visited);
      for (std::uint32_t b = a + 1; b < 30; ++b) {
        const double end = std::min(windows.end_of(a), windows.end_of(b));
        const double until = std::min(times.of(a, b), end);
        if (until <= 0.0) continue;  // due at once: they touch
        EXPECT_GE(least_true_gap(bodies[a].bound, bodies[b].bound, 0.0, until), -1e-9)
            << a << ' ' << b << " before " << until;
      }
    }
  }
}

TEST(Recertifying, RenewsWindowsOneByOne) {
  SmallWorld world;
  world.add({.acceleration_limit = 0.5, .velocity = {1, 0, 0}});
  for (double time = 0.0; time < 20.0; time += 0.7) {
    ASSERT_EQ(world.advance(time), std::nullopt);
    ASSERT_TRUE(world.main.recertify());
    ASSERT_TRUE(world.state.broad_phase.contains(0));
    EXPECT_GT(world.state.broad_phase.end_of(0), time);
    const Box box = world.state.broad_phase.box_of(0, time);
    const Vec3 place = world.state_of(0, time).position;
    EXPECT_LE(box.lower.x, place.x - 1.0);
    EXPECT_GE(box.upper.x, place.x + 1.0);
  }
}

TEST(Recertifying, RestartsWithAnotherRevision) {
  SmallWorld world;
  world.add({.velocity = {1, 0, 0}});
  world.add({.position = {20, 0, 0}});
  ASSERT_TRUE(world.main.recertify());
  const std::uint32_t before = world.state.bodies[0].revision;
  const std::uint32_t numbers[] = {0};
  world.main.restart(numbers);
  EXPECT_EQ(world.state.bodies[0].revision, before + 1);
  EXPECT_TRUE(world.main.is_recertified());
}

}  // namespace
}  // namespace kinesphere::recertifying_test
