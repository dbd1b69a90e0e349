// A call whose end is out of reach gets an error that names the promise at fault.
#include "processor/pace.hpp"

#include <gtest/gtest.h>

#include "bodies/body_bounds.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::pace_test {
namespace {

constexpr int block = 1 << 20;

class PaceTest : public testing::Test {
 protected:
  PaceTest() {
    add({.acceleration_limit = 1.0});
    add({.acceleration_limit = 1e30, .velocity = {5, 0, 0}});
    add({.velocity_error = 2.0});
  }
  void add(const BodyDefinition& body) {
    const std::uint32_t number = bodies.add(body, 0.0);
    bodies[number].bound = bound_now(body, 0.0);
  }
  /// Goes on from a time in instants of this length. Returns the first error.
  Result<void> go_on(Pace& pace, double time, double step, int instants = block) const {
    for (int k = 1; k <= instants; ++k)
      if (auto noted = pace.note_instant(bodies, time + k * step); !noted) return noted;
    return {};
  }

  Bodies bodies{WorldDefinition{}};
};

TEST_F(PaceTest, NamesTheBodyThatMakesItsWindowsShort) {
  Pace pace;
  pace.begin_call(0.0, 100.0);
  const auto noted = go_on(pace, 0.0, 1e-15);
  expect_error(noted, ErrorCode::out_of_range, "acceleration_limit", "advance: ", bodies.id_of(1));
  EXPECT_NE(noted.error().message.find("1e+30"), std::string::npos) << noted.error().message;
  EXPECT_NE(noted.error().message.find("reach 100"), std::string::npos) << noted.error().message;
}

TEST_F(PaceTest, AllowsWhatADayCanDo) {
  Pace pace;
  pace.begin_call(0.0, 100.0);
  EXPECT_TRUE(go_on(pace, 0.0, 1e-9));
  EXPECT_TRUE(go_on(pace, 1.0, 1e-9)) << "each block anew";
}

TEST_F(PaceTest, CountsAnewFromAnEventOn) {
  Pace pace;
  pace.begin_call(0.0, 100.0);
  EXPECT_TRUE(go_on(pace, 0.0, 1e-15, block - 1));
  pace.restart(1e-9);
  EXPECT_TRUE(go_on(pace, 1e-9, 1e-15, block - 1));
}

TEST_F(PaceTest, HasNoOpinionOnCallsWithoutAnEnd) {
  Pace pace;
  pace.begin_call(0.0, 1e7);
  EXPECT_TRUE(go_on(pace, 0.0, 1e-15)) << "to go on until an event";
  EXPECT_TRUE(go_on(pace, 0.0, 0.0)) << "before the first call";
}

TEST_F(PaceTest, NamesVelocitiesWhereTheyCountMost) {
  bodies[1].bound.acceleration_limit = 0.0;
  Pace pace;
  pace.begin_call(0.0, 100.0);
  expect_error(go_on(pace, 0.0, 1e-15), ErrorCode::out_of_range, "velocity", "advance: ", bodies.id_of(1));
}

}  // namespace
}  // namespace kinesphere::pace_test
