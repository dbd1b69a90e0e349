// Reports outside their bounds, and invalid reports, to every detector that probes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "kinesphere/motion/ballistic.hpp"
#include "research/rivals/rivals.hpp"

namespace kinesphere::reports_test {
namespace {

/// Two bodies far apart, at rest; the first jumps, or has invalid states, from time 1 on.
class Jumping final : public Motion {
 public:
  explicit Jumping(const Vec3& jump)
      : rest_(Ballistic::create({.start = {{{0, 0, 0}, {}}, {{50, 0, 0}, {}}}}).value()), jump_(jump) {}

  std::size_t size() const override { return 2; }
  BodyDefinition definition(std::uint32_t body, double t) const override {
    BodyDefinition changed = rest_.definition(body, t);
    changed.acceleration_limit = 8.0;
    return changed;
  }
  State state(std::uint32_t body, double t) const override {
    State state = rest_.state(body, t);
    if (body == 0 && t >= 1.0) state.position += jump_;
    return state;
  }
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override {
    return rest_.trajectory(body, begin, end);
  }
  Result<void> set_velocity(std::uint32_t, double, const Vec3&) override {
    return Error{ErrorCode::unsupported, "body", no_body, "set_velocity: not here"};
  }
  std::unique_ptr<Motion> clone() const override { return std::make_unique<Jumping>(jump_); }

 private:
  Ballistic rest_;
  Vec3 jump_;
};

class Reports : public ::testing::TestWithParam<std::string> {
 protected:
  static std::unique_ptr<Detector> detector_of(const Motion& motion) {
    auto detector = detector_maker(GetParam()).value()({}, motion).value();
    for (const std::uint32_t body : {0u, 1u}) detector->add(body, motion.definition(body, 0.0)).value();
    return detector;
  }
};

TEST_P(Reports, ThatBreakAPromiseAreToldAndTheDetectorGoesOn) {
  const Jumping motion({0, 120, 0});
  const auto detector = detector_of(motion);
  const auto event = detector->advance(10.0).value();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::bound_violation);
  EXPECT_EQ(event->first.index, 0u);
  EXPECT_GE(event->time, 1.0);
  // The bound is as old as the last report, and 4 t^2 wide at most.
  EXPECT_LE(event->position_excess, 120.0);
  EXPECT_GE(event->position_excess, 120.0 - 4.0 * event->time * event->time - 1e-6);
  EXPECT_FALSE(detector->advance(10.0).value());
  EXPECT_EQ(detector->bound(0)->position.y, 120.0);
}

TEST_P(Reports, ThatAreNotFitAreRefused) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& jump : {Vec3{nothing, 0, 0}, Vec3{1e300, 0, 0}}) {
    const Jumping motion(jump);
    const auto detector = detector_of(motion);
    for (int call = 0; call < 2; ++call) {
      const auto answer = detector->advance(10.0);
      ASSERT_FALSE(answer);
      EXPECT_EQ(answer.error().argument, "position") << answer.error().message;
      EXPECT_EQ(answer.error().body.index, 0u);
    }
    EXPECT_GE(detector->time(), 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Detectors, Reports, ::testing::Values("world", "paper", "hubbard", "hayward"),
                         [](const auto& detector) { return detector.param; });

}  // namespace
}  // namespace kinesphere::reports_test
