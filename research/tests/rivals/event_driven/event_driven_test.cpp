// The paper's algorithm and the ballistic one: their contacts are those of the world, and their events those
// that the papers describe.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/random.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::event_driven_test {
namespace {

DetectorMaker paper(const PaperOptions& options = {}) {
  return [options](const WorldDefinition& definition, const Motion& motion) {
    return make_paper_detector(definition, motion, options);
  };
}

struct Outcome {
  SceneResult result;
  std::vector<Event> events;
};

Outcome outcome_of(const Scene& scene, const DetectorMaker& make) {
  Outcome run;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) { run.events.push_back(event); };
  run.result = run_scene(scene, make, observer).value();
  return run;
}

Scene scene_of(const char* name, std::uint32_t bodies, double seconds, std::uint64_t seed = 1) {
  for (SceneParameters parameters : built_in_scenes()) {
    if (parameters.name != name) continue;
    parameters.bodies = bodies;
    parameters.seconds = seconds;
    parameters.seed = seed;
    return make_scene(parameters).value();
  }
  ADD_FAILURE() << "no scene " << name;
  return {};
}

/// Returns the number of leading events of two runs that are equal but for their times, which differ by at
/// most 1e-5.
std::size_t common_events(const Outcome& a, const Outcome& b) {
  std::size_t same = 0;
  while (same < std::min(a.events.size(), b.events.size())) {
    const Event& x = a.events[same];
    const Event& y = b.events[same];
    if (std::tie(x.kind, x.first, x.second, x.wall) != std::tie(y.kind, y.first, y.second, y.wall)) break;
    if (std::abs(x.time - y.time) > 1e-5) break;
    ++same;
  }
  return same;
}

Outcome expect_course_of_the_world(const Scene& scene, const DetectorMaker& make) {
  const Outcome world = outcome_of(scene, make_world_detector);
  Outcome run = outcome_of(scene, make);
  EXPECT_GE(common_events(world, run), 30u);
  const double expected = static_cast<double>(world.events.size());
  EXPECT_NEAR(static_cast<double>(run.events.size()), expected, 5.0 * std::sqrt(expected));
  return run;
}

class PaperDetector : public testing::TestWithParam<const char*> {};

TEST_P(PaperDetector, finds_the_same_contacts_with_and_without_trimming) {
  const Scene scene = scene_of(GetParam(), 150, 2.0);
  // Cells are small, so that bounds outgrow them.
  const Outcome trimmed = outcome_of(scene, paper({.cell_edge = 5.0, .trimming = true}));
  const Outcome full = outcome_of(scene, paper({.cell_edge = 5.0, .trimming = false}));
  EXPECT_EQ(trimmed.result.contact_hash, full.result.contact_hash);
  EXPECT_EQ(trimmed.result.counters.colliding, full.result.counters.colliding);
  EXPECT_LE(trimmed.result.counters.event_insertions, full.result.counters.event_insertions);
  EXPECT_LE(trimmed.result.counters.largest_queue, full.result.counters.largest_queue);
}

TEST_P(PaperDetector, begins_like_the_world_and_goes_on_with_as_many_contacts) {
  expect_course_of_the_world(scene_of(GetParam(), 200, 4.0), paper());
}

INSTANTIATE_TEST_SUITE_P(Scenes, PaperDetector, testing::Values("paper1", "paper2", "gas", "rain"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(PaperDetectorTrimming, spares_most_of_the_candidates_where_bounds_grow_fast) {
  const Scene scene = scene_of("paper1", 300, 1.0);
  const DetectorCounters trimmed = outcome_of(scene, paper({.cell_edge = 20.0})).result.counters;
  const DetectorCounters full =
      outcome_of(scene, paper({.cell_edge = 20.0, .trimming = false})).result.counters;
  EXPECT_LT(2 * trimmed.event_insertions, full.event_insertions);
  EXPECT_LT(2 * trimmed.event_removals, full.event_removals);
}

/// All counts follow from the course of one sphere.
TEST(PaperDetectorEvents, are_those_of_a_lonely_sphere) {
  RandomForcesDefinition lonely;
  lonely.start = {{{5.0, 5.0, 5.0}, {10.0, 0.0, 0.0}}};
  lonely.acceleration_limits = {0.5};
  const RandomForces motion = RandomForces::create(lonely).value();
  auto detector = make_paper_detector({}, motion, {.cell_edge = 10.0}).value();
  BodyDefinition body = motion.definition(0, 0.0);
  body.radius = 1.0;
  ASSERT_TRUE(detector->add(0, body));
  ASSERT_FALSE(detector->advance(4.2).value());
  // The bound grows from diameter 2 to 10 in 4 s, and the sphere moves by some 40 in this time.
  EXPECT_EQ(detector->counters().resetting, 1u);
  EXPECT_EQ(detector->counters().probes, 1u);
  EXPECT_GE(detector->counters().entering, 4u);
  EXPECT_LE(detector->counters().entering, 10u);
  EXPECT_EQ(detector->counters().colliding, 0u);
}

class BallisticDetector : public testing::TestWithParam<const char*> {};

TEST_P(BallisticDetector, begins_like_the_world_and_goes_on_with_as_many_contacts) {
  const Outcome run = expect_course_of_the_world(scene_of(GetParam(), 200, 4.0), make_ballistic_detector);
  EXPECT_EQ(run.result.counters.resetting, 0u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BallisticDetector, testing::Values("gas", "rain"),
                         [](const auto& scene) { return std::string(scene.param); });

/// A ballistic meeting is exact, so each is a contact but for those that graze.
TEST(BallisticDetectorEvents, are_contacts) {
  const Outcome run = outcome_of(scene_of("gas", 200, 4.0), make_ballistic_detector);
  const DetectorCounters& counters = run.result.counters;
  const auto contacts = counters.count(EventKind::contact_begin) + counters.count(EventKind::wall_begin);
  EXPECT_GE(counters.colliding, contacts);
  EXPECT_LE(counters.colliding, contacts + contacts / 100);
  EXPECT_EQ(counters.probes, 0u);
}

TEST(BallisticDetectorBodies, may_deviate_from_nothing_but_a_common_plan) {
  const Ballistic motion = Ballistic::create({.start = {{}, {}}, .gravity = {0, 0, -9.81}}).value();
  const auto refused = [&](const BodyDefinition& second) {
    auto detector = make_ballistic_detector({}, motion).value();
    BodyDefinition first = motion.definition(0, 0.0);
    EXPECT_TRUE(detector->add(0, first));
    const auto added = detector->add(1, second);
    if (added) return false;
    EXPECT_EQ(added.error().code, ErrorCode::unsupported);
    EXPECT_EQ(added.error().body.index, 1u);
    return true;
  };
  const BodyDefinition good = motion.definition(1, 0.0);
  EXPECT_FALSE(refused(good));
  BodyDefinition bad = good;
  bad.acceleration_limit = 1e-9;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.position_error = 0.1;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.velocity_error = 0.1;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.planned_acceleration.x = 1.0;
  EXPECT_TRUE(refused(bad));
}

/// A contact ends at the separation distance, however small the cells.
TEST(EventDriven, follows_a_contact_beyond_shared_cells) {
  for (const double limit : {0.0, 0.1}) {
    RandomForcesDefinition passing;
    passing.start = {{{0.0, 0.0, 0.0}, {}}, {{-5.0, 0.1, 0.0}, {4.0, 0.0, 0.0}}};
    passing.acceleration_limits = {limit, limit};
    Scene scene;
    scene.motion = std::make_unique<RandomForces>(RandomForces::create(passing).value());
    scene.bodies.assign(2, {.radius = 0.1});
    scene.world.separation_distance = 6.0;
    scene.end_time = 4.0;
    std::vector<DetectorMaker> makers{paper({.cell_edge = 0.5})};
    if (limit == 0.0) makers.emplace_back(make_ballistic_detector);
    for (const DetectorMaker& make : makers) {
      const Outcome run = outcome_of(scene, make);
      ASSERT_EQ(run.events.size(), 2u);
      EXPECT_EQ(run.events[1].kind, EventKind::contact_end);
      EXPECT_NEAR(run.events[1].gap, 6.0, 1e-5);
    }
  }
}

/// The bodies that come later are so many that they share the outermost cells, or move so fast that crossings
/// crowd. Cells that suit the first body alone would hold the whole crowd.
TEST(EventDriven, suits_a_crowd_that_comes_later) {
  Scene scene = scene_of("paper1", 600, 0.5);
  const auto together = outcome_of(scene, paper()).result.counters;
  for (std::uint32_t body = 1; body < 600; ++body) scene.bodies[body].appears = 1e-4;
  const auto later = outcome_of(scene, paper()).result.counters;
  EXPECT_LT(later.certificates, together.certificates + together.certificates / 2);
}

TEST(EventDriven, takes_bodies_far_away_and_in_a_hurry) {
  for (const double distance : {0.0, 1e3, 1e5}) {
    std::vector<State> start;
    for (int k = 0; k < 20; ++k) {
      Random random = Random::at(3106, static_cast<std::uint64_t>(k), 0);
      start.push_back(
          {Vec3{distance, -distance, distance} + 10.0 * random.point_in_ball(), 1e3 * random.unit_vector()});
    }
    Scene scene;
    scene.motion = std::make_unique<Ballistic>(Ballistic::create({.start = start, .gravity = {}}).value());
    scene.bodies.assign(start.size(), {.radius = 1.0});
    scene.end_time = 1.0;
    const Outcome world = outcome_of(scene, make_world_detector);
    for (const auto& make : {paper({.cell_edge = 1e-9}), paper(), DetectorMaker(make_ballistic_detector)}) {
      const Outcome run = outcome_of(scene, make);
      EXPECT_EQ(run.events.size(), world.events.size()) << distance;
      EXPECT_EQ(common_events(run, world), world.events.size()) << distance;
    }
  }
}

}  // namespace
}  // namespace kinesphere::event_driven_test
