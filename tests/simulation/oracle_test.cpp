// The world and the oracle agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/random.hpp"
#include "simulation/oracle/oracle.hpp"
#include "support/detector_runs.hpp"
#include "support/playground.hpp"

namespace kinesphere::oracle_test {
namespace {

TEST(Oracle, AgreesWithTheWorldOnBouncesUntilChaosParts) {
  for (const bool forces : {false, true})
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
      const Scene scene = dense_scene(SceneResponse::bounce, forces, seed);
      const auto world = events_of(scene, make_world_detector, 400);
      const auto oracle = events_of(scene, make_oracle, 400);
      std::size_t same = 0;
      while (same < std::min(world.size(), oracle.size()) &&
             std::abs(world[same].time - oracle[same].time) <= 1e-6) {
        ASSERT_EQ(world[same].kind, oracle[same].kind) << seed << ": " << world[same] << "\n" << oracle[same];
        ASSERT_EQ(world[same].first, oracle[same].first) << seed << ": " << world[same] << "\n"
                                                         << oracle[same];
        ASSERT_EQ(world[same].second, oracle[same].second);
        ASSERT_EQ(world[same].wall, oracle[same].wall);
        ++same;
      }
      EXPECT_GE(same, 50u) << "forces " << forces << ", seed " << seed;
    }
}

TEST(Oracle, AgreesWithTheWorldOnBodiesThatComeAndGo) {
  for (const bool forces : {false, true}) {
    Scene scene = dense_scene(SceneResponse::pass_through, forces, 9);
    scene.world.box.reset();  // some appear where it would be too late
    Random random(10);
    for (SceneBody& body : scene.bodies) {
      body.radius *= 2.0;  // so that some overlap when they appear or vanish
      if (random.uniform() < 0.6) body.appears = 3.0 * random.uniform();
      if (random.uniform() < 0.6) body.vanishes = body.appears + 2.0 * random.uniform();
    }
    const auto world = by_pair(events_of(scene, make_world_detector));
    const auto oracle = by_pair(events_of(scene, make_oracle));
    std::size_t common = 0;
    ASSERT_GT(oracle.size(), 30u);
    for (const auto& [key, truth] : oracle) {
      const auto found = world.find(key);
      ASSERT_NE(found, world.end()) << truth;
      ASSERT_EQ(found->second.size(), truth.size()) << truth << found->second;
      for (std::size_t k = 0; k < truth.size(); ++k, ++common) {
        EXPECT_EQ(found->second[k].kind, truth[k].kind);
        const double speed = std::max(1e-3, std::abs(truth[k].approach_speed));
        EXPECT_NEAR(found->second[k].time, truth[k].time, 1e-8 / speed) << truth[k];
      }
    }
    EXPECT_EQ(world.size(), oracle.size());
    EXPECT_GT(common, 60u);
  }
}

TEST(Lifetimes, EveryDetectorEndsTheContactsOfTheVanished) {
  for (const DetectorMaker& make : {DetectorMaker(make_world_detector), DetectorMaker(make_oracle)}) {
    expect_ends_of_contacts_of_the_vanished(make);
  }
}

TEST(WorldDetector, NumbersStayTheirsThroughReuseOfIndices) {
  // Bodies appear in the reverse of their numbers, and indices are used again.
  Scene scene;
  std::vector<State> start;
  for (int k = 0; k < 6; ++k) start.push_back({{10.0 * k, 0, 0}, {}});
  start[0] = {{-30, 0, 0}, {20, 0, 0}};
  scene.motion = std::make_unique<Ballistic>(Ballistic::create({.start = start}).value());
  for (int k = 0; k < 6; ++k) scene.bodies.push_back({.radius = 1, .appears = 0.25 * (5 - k)});
  scene.bodies[5].vanishes = 0.3;
  scene.bodies[4].vanishes = 3.55;  // in mid-contact: 0 is there at 3.5
  scene.end_time = 6.0;
  const auto world = events_of(scene, make_world_detector);
  const auto oracle = events_of(scene, make_oracle);
  ASSERT_EQ(world.size(), oracle.size()) << world << oracle;
  ASSERT_EQ(world.size(), 8u);
  for (std::size_t k = 0; k < world.size(); ++k) {
    EXPECT_EQ(world[k].first, oracle[k].first);
    EXPECT_EQ(world[k].second, oracle[k].second);
    EXPECT_EQ(world[k].kind, oracle[k].kind);
    EXPECT_NEAR(world[k].time, oracle[k].time, 1e-6);
    EXPECT_NEAR(norm(world[k].normal - oracle[k].normal), 0.0, 1e-12) << world[k];
    EXPECT_NEAR(world[k].approach_speed, oracle[k].approach_speed, 1e-12) << world[k];
  }
}

TEST(AllDetectors, HeadOnBounceOnceAndGoOn) {
  for (const DetectorMaker& make : {DetectorMaker(make_world_detector), DetectorMaker(make_oracle)}) {
    expect_one_head_on_bounce(make);
  }
}

TEST(AllDetectors, RefuseAWrongWorld) {
  const auto motion = Ballistic::create({.start = {{}}}).value();
  const WorldDefinition wrong{.contact_tolerance = -1};
  EXPECT_FALSE(make_world_detector(wrong, motion));
  EXPECT_FALSE(make_oracle(wrong, motion));
}

}  // namespace
}  // namespace kinesphere::oracle_test
