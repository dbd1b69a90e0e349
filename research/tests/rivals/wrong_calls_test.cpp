// Wrong calls of every detector return an error that names the argument, and change nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "kinesphere/motion/ballistic.hpp"
#include "research/rivals/rivals.hpp"

namespace kinesphere::wrong_calls_test {
namespace {

class WrongCalls : public ::testing::TestWithParam<DetectorEntry> {
 protected:
  WrongCalls()
      : settings{.step = GetParam().takes_step ? std::optional(0.1) : std::nullopt},
        motion(Ballistic::create({.start = {{{-2, 0, 0}, {1, 0, 0}}, {{2, 0, 0}, {-1, 0, 0}}}}).value()) {}

  Result<std::unique_ptr<Detector>> make(const WorldDefinition& definition) const {
    return GetParam().make(definition, motion, settings);
  }

  BodyDefinition body(std::uint32_t number) const {
    BodyDefinition definition = motion.definition(number, 0.0);
    definition.radius = 0.5;
    return definition;
  }

  template <class Value>
  static void expect_error(const Result<Value>& result, ErrorCode code, std::string_view argument) {
    ASSERT_FALSE(result) << argument;
    EXPECT_EQ(result.error().code, code) << result.error().message;
    EXPECT_EQ(result.error().argument, argument) << result.error().message;
    EXPECT_NE(result.error().message.find(argument), std::string::npos) << result.error().message;
  }

  DetectorSettings settings;
  Ballistic motion;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
};

TEST_P(WrongCalls, OfMake) {
  expect_error(make({.contact_tolerance = 0.0}), ErrorCode::out_of_range, "contact_tolerance");
  expect_error(make({.start_time = nothing}), ErrorCode::not_finite, "start_time");
}

TEST_P(WrongCalls, OfMakeForASpaceThatOnlyTheWorldKnows) {
  const WorldDefinition repeats{.box = Box{{-5, -5, -5}, {5, 5, 5}}, .periodic = {false, true, false}};
  const WorldDefinition plane{.dimensions = 2};
  if (GetParam().name == "world") {
    EXPECT_TRUE(make(repeats));
    EXPECT_TRUE(make(plane));
  } else {
    expect_error(make(repeats), ErrorCode::unsupported, "periodic");
    expect_error(make(plane), ErrorCode::unsupported, "dimensions");
  }
}

TEST_P(WrongCalls, AreAnsweredAndForgotten) {
  const auto made = make({});
  Detector& detector = **made;
  expect_error(detector.add(2, body(0)), ErrorCode::unknown_body, "body");
  expect_error(detector.remove(0), ErrorCode::stale_body, "body");
  expect_error(detector.remove(7), ErrorCode::unknown_body, "body");
  expect_error(detector.bound(0), ErrorCode::stale_body, "body");
  BodyDefinition wrong = body(0);
  wrong.radius = -1.0;
  expect_error(detector.add(0, wrong), ErrorCode::out_of_range, "radius");
  wrong = body(0);
  wrong.position.y = nothing;
  expect_error(detector.add(0, wrong), ErrorCode::not_finite, "position");
  for (const std::uint32_t number : {0u, 1u}) ASSERT_TRUE(detector.add(number, body(number)));
  expect_error(detector.add(1, body(1)), ErrorCode::out_of_range, "body");
  expect_error(detector.set_velocity(0, {nothing, 0, 0}), ErrorCode::not_finite, "velocity");
  expect_error(detector.set_velocity(2, {}), ErrorCode::unknown_body, "body");
  expect_error(detector.advance(nothing), ErrorCode::not_finite, "until");
  const auto contact = detector.advance(10.0);
  ASSERT_TRUE(contact && *contact);
  EXPECT_EQ((*contact)->kind, EventKind::contact_begin);
  EXPECT_NEAR((*contact)->time, 1.5, 0.11);
  expect_error(detector.advance(1.0), ErrorCode::time_backwards, "until");
  ASSERT_TRUE(detector.remove(0));
  expect_error(detector.set_velocity(0, {}), ErrorCode::stale_body, "body");
}

std::string name_of_detector(const ::testing::TestParamInfo<DetectorEntry>& detector) {
  std::string name(detector.param.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Detectors, WrongCalls, ::testing::ValuesIn(detector_table()), name_of_detector);

TEST(DetectorTable, RefusesWrongNamesAndSettings) {
  EXPECT_EQ(detector_maker("eye").error().argument, "name");
  EXPECT_NE(detector_maker("eye").error().message.find("world, paper"), std::string::npos);
  EXPECT_EQ(detector_maker("fixed-step").error().argument, "settings");
  EXPECT_EQ(detector_maker("world", {.step = 0.1}).error().argument, "settings");
  const Ballistic motion = Ballistic::create({.start = {{}}}).value();
  EXPECT_EQ(make_paper_detector({}, motion, {.cell_edge = -1.0}).error().argument, "options");
  EXPECT_EQ(make_fixed_step_detector({}, motion, 0.0).error().argument, "step");
}

}  // namespace
}  // namespace kinesphere::wrong_calls_test
