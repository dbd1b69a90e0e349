// Worlds on the core tell what worlds in windows do: random worlds with bodies of all kinds, changed by the
// caller now and then, on both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <tuple>
#include <vector>

#include "support/in_windows.hpp"
#include "support/playground.hpp"

namespace kinesphere::two_engines_test {
namespace {

constexpr double tolerance = 1e-6;

/// What a world holds, apart from balls.
struct Scene {
  const char* name;
  WorldDefinition definition;
  bool has_shapes = false;
  bool has_sensors = false;
  bool has_errors = false;
};

std::vector<Scene> scenes() {
  const Box box{{0, 0, 0}, {10, 10, 10}};
  WorldDefinition repeated{.box = box, .periodic = {true, true, true}, .contact_tolerance = tolerance};
  WorldDefinition flat{.box = box, .dimensions = 2, .contact_tolerance = tolerance};
  const WorldDefinition walls{.box = box, .contact_tolerance = tolerance};
  return {{"walls", walls},
          {"unbounded", {.contact_tolerance = tolerance}},
          {"periodic", repeated},
          {"flat", flat},
          {.name = "shapes", .definition = walls, .has_shapes = true},
          {.name = "sensors", .definition = walls, .has_sensors = true},
          {.name = "periodic sensors", .definition = repeated, .has_sensors = true},
          {.name = "all", .definition = walls, .has_shapes = true, .has_sensors = true}};
}

/// A world with this scene, and the same random draws for both engines.
class Play {
 public:
  Play(const Scene& scene, std::uint64_t seed, bool on_core)
      : scene_(scene), random_(seed), ground_(scene.definition), flat_(scene.definition.dimensions == 2) {
    if (!on_core) use_windows(ground_.world);
    if (scene.has_sensors) {
      ground_.world.set_sensor(1, {.distances = {0.0, 0.3}}).value();
      ground_.world.set_sensor(2, {.distances = {0.5}, .mask = 2}).value();
    }
    for (int k = 0; k < 24; ++k) add();
    if (scene.has_shapes) add_shapes();
  }

  std::vector<Event> run() {
    std::vector<Event> told;
    for (int step = 1; step <= 40; ++step) {
      const auto some = ground_.run(0.1 * step);
      told.insert(told.end(), some.begin(), some.end());
      if (step % 4 == 0) {
        const auto finding = ground_.world.inspection().audit();
        EXPECT_FALSE(finding) << "at " << ground_.world.time() << ": " << finding->what;
      }
      change();
    }
    return told;
  }
  const Counters& counters() const { return ground_.world.counters(); }

 private:
  Vec3 vector(double length) {
    Vec3 drawn = random_.point_in_ball() * length;
    if (flat_) drawn.z = 0.0;
    return drawn;
  }
  Vec3 place() {
    Vec3 drawn{random_.uniform(1.0, 9.0), random_.uniform(1.0, 9.0), random_.uniform(1.0, 9.0)};
    if (flat_) drawn.z = 0.0;
    return drawn;
  }
  BodyDefinition drawn() {
    const double limit = random_.bits() % 3 == 0 ? 0.0 : random_.uniform(0.1, 2.0);
    BodyDefinition body{.radius = 0.05 * std::pow(12.0, random_.uniform())};
    body.position = place();
    body.velocity = vector(2.0);
    body.acceleration_limit = limit;
    body.planned_acceleration = random_.bits() % 3 == 0 ? vector(1.0) : Vec3{};
    body.filter.category = 1u + static_cast<std::uint32_t>(random_.bits() % 3);
    body.solid = random_.bits() % 8 != 0;
    if (scene_.has_sensors) body.sensor_class = static_cast<SensorClass>(random_.bits() % 3);
    return body;
  }
  void add() {
    const BodyDefinition body = drawn();
    balls_.push_back(ground_.add(body, body.planned_acceleration + vector(0.99 * body.acceleration_limit)));
  }
  void add_shapes() {
    World& world = ground_.world;
    world.add_static({.shape = HalfSpace{{0, 0.6, 0.8}, 1.0}}).value();
    world.add_static({.shape = Box{{3, 3, 3}, {4, 5, 6}}}).value();
    world.add_static({.shape = Triangle{{6, 6, 1}, {9, 6, 2}, {6, 9, 3}}}).value();
    world.add_static({.shape = Ball{{7, 2, 7}, 0.7}}).value();
    for (int k = 0; k < 4; ++k) {
      RigidBody rigid{.body = drawn(), .parts = {{.a = {-0.3, 0, 0}, .b = {0.3, 0, 0}, .radius = 0.1}}};
      rigid.body.acceleration_limit = 0.0;
      rigid.rotation.angular_velocity = vector(2.0);
      ground_.add_rigid_body(rigid);
    }
  }
  /// One ball gets another velocity or another place, or goes, or another one comes.
  void change() {
    const std::size_t which = random_.bits() % balls_.size();
    const BodyId id = balls_[which];
    switch (random_.bits() % 4) {
      case 0:
        return ground_.set_velocity(id, vector(2.0));
      case 1:
        ground_.teleport(id, {place(), vector(2.0)});
        return;
      case 2:
        ground_.world.remove(id).value();
        balls_.erase(balls_.begin() + static_cast<std::ptrdiff_t>(which));
        return;
      default:
        return add();
    }
  }

  const Scene& scene_;
  Random random_;
  Playground ground_;
  bool flat_;
  std::vector<BodyId> balls_;
};

auto without_time(const Event& event) {
  return std::tuple(event.first.index, event.first.generation, event.second.index, event.wall, event.kind,
                    event.distance);
}

/// Expects the same events, at times that differ by what it takes to go twice the tolerance.
void expect_same(std::vector<Event> windows, std::vector<Event> core) {
  const auto order = [](const Event& a, const Event& b) {
    return without_time(a) != without_time(b) ? without_time(a) < without_time(b) : a.time < b.time;
  };
  // Of two that were put into each other, an approach is told when it is found.
  const auto is_deep = [](const Event& event) { return event.gap < -2.0 * tolerance; };
  std::erase_if(windows, is_deep);
  std::erase_if(core, is_deep);
  std::sort(windows.begin(), windows.end(), order);
  std::sort(core.begin(), core.end(), order);
  ASSERT_EQ(windows.size(), core.size());
  for (std::size_t k = 0; k < windows.size(); ++k) {
    ASSERT_EQ(without_time(windows[k]), without_time(core[k])) << windows[k] << "\n" << core[k];
    const double closing = std::max(std::abs(windows[k].approach_speed), 0.01);
    EXPECT_NEAR(windows[k].time, core[k].time, 8.0 * tolerance / closing) << windows[k] << "\n" << core[k];
  }
}

std::vector<Event> played(const Scene& scene, std::uint64_t seed, bool on_core, std::uint64_t& probes) {
  Play play(scene, seed, on_core);
  std::vector<Event> told = play.run();
  probes += play.counters().probes;
  return told;
}

TEST(TwoEngines, TellTheSameEvents) {
  constexpr std::uint64_t first = 4100;
  std::size_t events = 0;
  for (const Scene& scene : scenes()) {
    std::uint64_t in_windows = 0, on_core = 0;
    for (std::uint64_t seed = first; seed < first + 12; ++seed) {
      SCOPED_TRACE(testing::Message() << scene.name << ", seed " << seed);
      const std::vector<Event> windows = played(scene, seed, false, in_windows);
      expect_same(windows, played(scene, seed, true, on_core));
      if (testing::Test::HasFatalFailure()) return;
      events += windows.size();
    }
    std::cout << scene.name << ": probes in windows " << in_windows << ", on the core " << on_core << "\n";
  }
  EXPECT_GT(events, 3000u);
}

}  // namespace
}  // namespace kinesphere::two_engines_test
