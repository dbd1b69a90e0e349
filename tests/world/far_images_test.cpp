// Reports in images far from the periodic box, and runs in which bodies travel farther than coordinates
// reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/placement.hpp"

namespace kinesphere::far_images_test {
namespace {

constexpr std::size_t spheres = 60;
constexpr double radius = 0.5;
constexpr Axes everywhere{true, true, true};

struct Gas {
  Gas(double tolerance, const Vec3& drift, const Axes& periodic = everywhere)
      : width(std::cbrt(spheres * 0.5236 / 0.2)),
        box{{}, {width, width, width}},
        motion(Ballistic::create({.start = start(drift, periodic)}).value()),
        world(World::create({.box = box,
                             .periodic = periodic,
                             .contact_tolerance = tolerance,
                             .contacts = ContactEvents::impacts})
                  .value()) {
    for (std::uint32_t body = 0; body < spheres; ++body) {
      BodyDefinition sphere = motion.definition(body, 0.0);
      sphere.radius = radius;
      world.add(sphere).value();
    }
  }

  std::vector<State> start(const Vec3& drift, const Axes& periodic) const {
    std::vector<State> states;
    Random random(3);
    const std::vector<double> radii(spheres, radius);
    for (const Vec3& place : place_spheres(radii, box, {.periodic = periodic}).value())
      states.push_back({place, random.point_in_ball() + drift});
    return states;
  }
  /// Runs with elastic bounces.
  Result<void> run(double until, MotionSource& source, Workers* workers = nullptr) {
    return world.run(
        until, source, [](const Event& event) { return response_of(event, bounce(event, 1.0)); },
        [this](const Event& event) { events.push_back(event); }, workers);
  }
  Result<void> run(double until, Workers* workers = nullptr) {
    SingleMotionSource source(motion);
    return run(until, source, workers);
  }
  double energy() const {
    double sum = 0.0;
    for (std::uint32_t body = 0; body < spheres; ++body)
      sum += norm_squared(motion.state(body, world.time()).velocity);
    return sum;
  }

  double width;
  Box box;
  Ballistic motion;
  World world;
  std::vector<Event> events{};
};

/// A source that adds whole boxes to all positions.
class FarSource : public MotionSource {
 public:
  FarSource(Motion& motion, const Vec3& shift) : near_(motion), shift_(shift) {}
  void states(std::span<const BodyId> bodies, double time, std::span<State> states) override {
    near_.states(bodies, time, states);
    for (State& state : states) state.position += shift_;
  }
  MotionOrigin origin(BodyId body) const override { return near_.origin(body); }
  void set_origin(BodyId body, const MotionOrigin& origin) override { near_.set_origin(body, origin); }

 private:
  SingleMotionSource near_;
  Vec3 shift_;
};

// Coordinates reach to 6.6, a little farther than the box, and those of reports to 422.
TEST(FarImages, ARunGoesOnHoweverFarItsBodiesTravel) {
  Gas gas(3e-12, {4.0, 0.0, 0.0});
  const double energy = gas.energy();
  for (double time = 10.0; time <= 200.0; time += 10.0) {
    const auto result = gas.run(time);
    ASSERT_TRUE(result) << "at time " << gas.world.time() << ": " << result.error().message;
  }
  EXPECT_GT(gas.events.size(), 5000u);
  EXPECT_NEAR(gas.energy() / energy, 1.0, 1e-9);
  Gas other(3e-12, {4.0, 0.0, 0.0});
  Workers workers = Workers::create(2).value();
  ASSERT_TRUE(other.run(200.0, &workers));
  EventHash one, two;
  for (const Event& event : gas.events) one.add(event);
  for (const Event& event : other.events) two.add(event);
  EXPECT_EQ(one.value(), two.value()) << "with two threads";
  double farthest = 0.0;
  for (const BodyId id : gas.world.bodies())
    farthest = std::max(farthest, static_cast<double>(gas.world.body(id).value().image[0]));
  EXPECT_GT(farthest * gas.width, 600.0) << "images count the boxes that the origins have lost";
}

TEST(FarImages, EventsAMillionBoxesAwayAreThoseOfThePrimaryImage) {
  Gas near(1e-6, {});
  ASSERT_TRUE(near.run(2.0));
  for (const double boxes : {1e6, -1e6}) {
    Gas far(1e-6, {});
    FarSource source(far.motion, Vec3{boxes, -boxes, 0.0} * far.width);
    const auto result = far.run(2.0, source);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(far.events.size(), near.events.size());
    for (std::size_t k = 0; k < near.events.size(); ++k) {
      EXPECT_EQ(far.events[k].kind, near.events[k].kind) << k;
      EXPECT_EQ(far.events[k].first, near.events[k].first) << k;
      EXPECT_EQ(far.events[k].second, near.events[k].second) << k;
      EXPECT_NEAR(far.events[k].time, near.events[k].time, 1e-5) << k;
    }
  }
}

TEST(FarImages, APositionThatDoublesDoNotResolveIsRefused) {
  for (const Axes& periodic : {everywhere, Axes{true, false, false}}) {
    Gas gas(1e-6, {}, periodic);
    const auto asked = [&](const Vec3& shift) {
      FarSource source(gas.motion, shift);
      return gas.run(1e3, source);
    };
    const auto far = asked({1e9 * gas.width, 0.0, 0.0});
    ASSERT_FALSE(far);
    EXPECT_EQ(far.error().code, ErrorCode::out_of_range);
    EXPECT_EQ(far.error().argument, "position");
    EXPECT_NE(far.error().message.find("must be wrapped into the periodic box"), std::string::npos)
        << far.error().message;
    if (periodic.y) continue;
    const auto beyond = asked({0.0, 1e6 * gas.width, 0.0});
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().code, ErrorCode::out_of_range);
    EXPECT_NE(beyond.error().message.find("must lie within"), std::string::npos) << beyond.error().message;
  }
}

/// Single precision does not tell lengths of the period apart on the axes that do not repeat.
TEST(FarImages, FarAwayOnAnAxisThatDoesNotRepeat) {
  Playground p(
      {.box = Box{{0, -1e9, -1e9}, {3, 1e9, 1e9}}, .periodic = {.x = true}, .contact_tolerance = 1e-3});
  constexpr double far = 9.4e8;
  p.add({.radius = 0.2, .acceleration_limit = 0.1, .position = {0.5, far, -far}, .velocity = {-1, 0, 0}});
  p.add({.radius = 0.2, .acceleration_limit = 0.1, .position = {1.5, far, -far}, .velocity = {1, 0, 0}});
  const auto begins = of_kind(p.run(20.0), EventKind::contact_begin);
  ASSERT_FALSE(begins.empty()) << "they meet beyond the border";
  EXPECT_NEAR(begins[0].time, 0.8, 1e-3);
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_LT(p.world.counters().starts, 2000u);
}

/// Reports may move a bound out of the region in which the truth stays. The lengths are those of the proof in
/// docs/guarantee.md: whatever the reports say, two bodies are looked at in the image in which they can meet.
TEST(FarImages, RegionsLeaveRoomForTheErrorsOfReports) {
  constexpr double period = 3.0;
  for (const double size : {0.01, 0.1, 0.3, 0.5}) {
    const double error = (0.375 * period - 2.0 * size - 0.01) / 6.0;
    Playground p({.box = Box{{0, 0, 0}, {period, period, period}},
                  .periodic = {true, true, true},
                  .contact_tolerance = 1e-3});
    const BodyId body =
        p.add({.radius = size, .acceleration_limit = 0.1, .position_error = error, .velocity = {1, 0, 0}});
    p.run(2.0);
    const Box box = p.world.body(body).value().box;
    const double region = 0.5 * (box.upper.x - box.lower.x) - size - error;
    EXPECT_GT(region, 0.0);
    EXPECT_LE(region, (0.25 * period - (size + error) - 2.0 * error) / 3.0 + 0.002) << size;
  }
}

}  // namespace
}  // namespace kinesphere::far_images_test
