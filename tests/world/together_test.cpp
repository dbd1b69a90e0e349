// Interactions of features: queries and snapshots of worlds with disabled and filtered bodies.
#include <gtest/gtest.h>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "number/infinity.hpp"
#include "support/playground.hpp"

namespace kinesphere::together_test {
namespace {

/// Four unit spheres in a row, 0 and 1 flying at each other, 2 disabled beside 1, 3 filtered from 0 and 1.
class Together : public ::testing::Test {
 protected:
  Together() {
    for (int k = 0; k < 4; ++k)
      ids.push_back(
          p.add({.radius = 1, .position = {4.0 * k, 0, 0}, .velocity = {k == 0 ? 1.0 : 0.0, 0, 0}}));
    p.world.disable(ids[2]).value();
    p.world.change(ids[3], {.filter = Filter{.category = 2, .mask = 0}}).value();
  }

  Playground p;
  std::vector<BodyId> ids;
};

TEST_F(Together, DisabledAndFilteredBodiesLimitNoAnswer) {
  EXPECT_NEAR(p.world.certificates().safe_until()->time, 2.0, 1e-3);
  EXPECT_EQ(p.world.certificates().earliest_contact(ids[0])->partner, ids[1]);
  EXPECT_EQ(p.world.certificates().safe_until(ids[0], ids[2])->time, infinity);
  EXPECT_EQ(p.world.certificates().safe_until(ids[0], ids[3])->time, infinity);
  EXPECT_EQ(p.world.certificates().safe_until(ids[2])->time, infinity);
  EXPECT_EQ(p.world.certificates().safe_until(ids[3])->time, infinity);
}

TEST_F(Together, DisabledBodiesAreNowhere) {
  const auto everywhere = p.world.queries().overlapping(Vec3{6, 0, 0}, 100.0).value();
  EXPECT_EQ(everywhere.size(), 3u);
  EXPECT_EQ(p.world.queries().nearest({8, 0, 0}, 4)->size(), 3u);
  p.world.enable(ids[2], {{8, 0, 0}, {}}).value();
  EXPECT_EQ(p.world.queries().nearest({8, 0, 0}, 1)->front().body, ids[2]);
}

TEST_F(Together, SnapshotsKeepThem) {
  World back = World::restore(p.world.save().value()).value();
  p.world.change(ids[1], {.user_data = 7}).value();
  for (int stop = 0; stop < 2; ++stop) {
    EXPECT_EQ(back.save().value() == p.world.save().value(), stop == 1) << "user data belong to it";
    back = p.world.clone().value();
  }
  EXPECT_EQ(back.user_data(ids[1]).value(), 7u);
  back.enable(ids[2], {{8, 0, 0}, {}}).value();
  const auto still = [](std::span<const BodyId> bodies, double time, std::span<State> states) {
    for (std::size_t k = 0; k < bodies.size(); ++k)
      states[k] =
          bodies[k].index == 0 ? State{{time, 0, 0}, {1, 0, 0}} : State{{4.0 * bodies[k].index, 0, 0}, {}};
  };
  const auto first = back.advance(10.0, still).value();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->kind, EventKind::contact_begin);
  EXPECT_NEAR(first->time, 2.0, 1e-5);
  EXPECT_EQ(first->second, ids[1]);
}

}  // namespace
}  // namespace kinesphere::together_test
