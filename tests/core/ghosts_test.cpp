// What a core that has a part of a world notes of its balls, for others to compare.
#include "core/ghosts.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "core/core.hpp"

namespace kinesphere::core_test {
namespace {

using core::Ball;

/// A ball in its safe region, as another core knows it, and what it reports.
struct Known {
  core::Core::Record record{.ball = {.position = {4.5, 5, 5},
                                     .velocity = {0.5, 0, 0},
                                     .radius = 0.25,
                                     .due = 2.0,
                                     .second = 3.0,
                                     .own = 3.0,
                                     .acceleration_limit = 0.125,
                                     .centre = {2.0F, 3.0F, 4.0F},
                                     .region = 1.0F,
                                     .flags = Ball::present | Ball::plain},
                            .change = 7,
                            .reach = 2.0F};
  double time = 1.0;
  State report{.position = {5, 5, 5}, .velocity = {0.5, 0, 0}};
};

std::uint64_t course_of(const Known& known) {
  core::Core core({.box = Box{{0, 0, 0}, {10, 10, 10}}, .contact_tolerance = 1e-6});
  core::Ghosts ghosts(1);
  core.adopt(0, known.record);
  core.be_part(ghosts, 1.0, true, false);
  core.set_time(known.time);
  core.report(0, known.report);
  return ghosts.course_of(0);
}

TEST(Ghosts, HaveACourseThatTellsAllThatOthersSeeOfABall) {
  const std::vector<std::function<void(Known&)>> differences{
      [](Known& known) { known.report.position.x += 0x1p-40; },
      [](Known& known) { known.report.position.y += 0x1p-40; },
      [](Known& known) { known.report.position.z += 0x1p-40; },
      [](Known& known) { known.report.velocity.x += 0x1p-40; },
      [](Known& known) { known.report.velocity.y += 0x1p-40; },
      [](Known& known) { known.report.velocity.z += 0x1p-40; },
      [](Known& known) { known.time += 0x1p-40; },
      [](Known& known) { known.record.ball.radius += 0x1p-40; },
      [](Known& known) { known.record.ball.due += 0x1p-40; },
      [](Known& known) { known.record.ball.own += 0x1p-40; },
      [](Known& known) { known.record.ball.acceleration_limit += 0x1p-40; },
      [](Known& known) { known.record.ball.centre[0] += 0x1p-20F; },
      [](Known& known) { known.record.ball.centre[1] += 0x1p-20F; },
      [](Known& known) { known.record.ball.centre[2] += 0x1p-20F; },
      [](Known& known) { known.record.ball.region += 0x1p-20F; },
      [](Known& known) { known.record.ball.walls = 1; },
      [](Known& known) { known.record.ball.set(Ball::linked, true); },
      [](Known& known) { ++known.record.change; },
  };
  std::set<std::uint64_t> courses{course_of({})};
  EXPECT_TRUE(courses.contains(course_of({})));
  for (std::size_t k = 0; k < differences.size(); ++k) {
    Known known;
    differences[k](known);
    EXPECT_TRUE(courses.insert(course_of(known)).second) << "difference " << k;
  }
}

}  // namespace
}  // namespace kinesphere::core_test
