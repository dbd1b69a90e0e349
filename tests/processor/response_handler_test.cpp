// A response sets the origins of both bodies, or of none.
#include "processor/responses.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/expect_error.hpp"

namespace kinesphere::responses_test {
namespace {

constexpr double now = 3.0;

/// Two bodies that fly straight on.
struct Source : MotionSource {
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const MotionOrigin& from = origins[ids[k].index];
      states[k] = {from.state.position + from.state.velocity * (time - from.time), from.state.velocity};
    }
  }
  MotionOrigin origin(BodyId body) const override { return origins[body.index]; }
  void set_origin(BodyId body, const MotionOrigin& origin) override {
    if (body.index == fails) throw std::runtime_error("no");
    origins[body.index] = origin;
  }

  MotionOrigin origins[2] = {{0.0, {{0, 0, 0}, {1, 0, 0}}}, {0.0, {{9, 0, 0}, {-1, 0, 0}}}};
  std::uint32_t fails = 9;
};

const Event event{.time = now, .first = {0, 0}, .second = {1, 0}};

TEST(ApplyResponse, SetsVelocitiesWhereTheBodiesAre) {
  Source source;
  ASSERT_TRUE(apply_response(source, {}, event, {.first_velocity = Vec3{0, 2, 0}}));
  EXPECT_EQ(source.origins[0], (MotionOrigin{now, {{3, 0, 0}, {0, 2, 0}}}));
  EXPECT_EQ(source.origins[1].time, 0.0) << "no response, no change";
  ASSERT_TRUE(
      apply_response(source, {}, event, {.first_velocity = Vec3{0, 1, 0}, .second_velocity = Vec3{4, 0, 0}}));
  EXPECT_EQ(source.origins[1], (MotionOrigin{now, {{6, 0, 0}, {4, 0, 0}}}));
  ASSERT_TRUE(apply_response(source, {}, event, {}));
}

TEST(ApplyResponse, SetsNoneIfAStateIsInvalid) {
  Source source;
  source.origins[1].state.position.x = std::numeric_limits<double>::infinity();
  const auto refused =
      apply_response(source, {}, event, {.first_velocity = Vec3{0, 1, 0}, .second_velocity = Vec3{4, 0, 0}});
  expect_error(refused, ErrorCode::not_finite, "position", "run: ", {1, 0});
  EXPECT_EQ(source.origins[0].time, 0.0);
}

TEST(ApplyResponse, SetsNoneIfTheSourceThrowsAtTheSecond) {
  Source source;
  source.fails = 1;
  EXPECT_THROW((void)apply_response(source, {}, event,
                                    {.first_velocity = Vec3{0, 1, 0}, .second_velocity = Vec3{4, 0, 0}}),
               std::runtime_error);
  EXPECT_EQ(source.origins[0].time, 0.0) << "the first one went back";
}

}  // namespace
}  // namespace kinesphere::responses_test
