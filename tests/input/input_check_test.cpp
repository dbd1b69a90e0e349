// Checks of input: the first that fails is the error, which names subject, expectation and value.
#include "input/input_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::input_check_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(InputCheck, TellsTheFirstFailure) {
  InputCheck check("call");
  EXPECT_TRUE(check.finite({"a"}, 1.0).positive({"b"}, 2.0).result());
  check.positive({"c"}, -1.0).finite({"d"}, nan);
  ASSERT_TRUE(check.error());
  EXPECT_EQ(check.error()->argument, "c");
  EXPECT_EQ(check.error()->code, ErrorCode::out_of_range);
  EXPECT_EQ(check.error()->message, "call: c must be > 0, but is -1");
  EXPECT_FALSE(check.result());
}

TEST(InputCheck, NamesBodiesPartsAndNumbers) {
  const auto message = [](const Subject& subject) {
    return InputCheck("call").finite(subject, nan).error()->message;
  };
  EXPECT_EQ(message({"start", {3, 0}}), "call: start of body 3 must be finite, but is nan");
  EXPECT_EQ(message({"start", {3, 2}, "velocity"}),
            "call: start of body 3 (generation 2), velocity, must be finite, but is nan");
  EXPECT_EQ(message({"paths", no_body, "arc", 7}), "call: paths, arc 7, must be finite, but is nan");
}

TEST(InputCheck, KnowsRanges) {
  const auto fails = [](auto check) { return !InputCheck(check(InputCheck("call"))).result(); };
  for (const double value : {0.0, 1.0, 5.0}) {
    EXPECT_FALSE(fails([=](InputCheck check) { return check.from_zero_to({"x"}, value, 5.0); }));
    EXPECT_FALSE(fails([=](InputCheck check) { return check.within({"x"}, -value, 5.0); }));
  }
  for (const double value : {-0.5, 5.5, nan, infinity})
    EXPECT_TRUE(fails([=](InputCheck check) { return check.from_zero_to({"x"}, value, 5.0); })) << value;
  for (const double value : {-5.5, 5.5, nan, -infinity}) {
    EXPECT_TRUE(fails([=](InputCheck check) { return check.within({"x"}, value, 5.0); })) << value;
    EXPECT_TRUE(fails([=](InputCheck check) {
      return check.within({"x"}, Vec3{0, value, 0}, 5.0);
    })) << value;
  }
  EXPECT_FALSE(fails([](InputCheck check) { return check.not_negative_or_infinite({"x"}, infinity); }));
  EXPECT_TRUE(fails([](InputCheck check) { return check.not_negative_or_infinite({"x"}, nan); }));
  EXPECT_TRUE(fails([](InputCheck check) { return check.box({"x"}, {{0, 0, 0}, {1, 0, 1}}); }));
  EXPECT_FALSE(fails([](InputCheck check) { return check.box({"x"}, {{0, 0, 0}, {1, 2, 1}}); }));
}

TEST(InputCheck, ListsNeedOneEntryPerBody) {
  EXPECT_EQ(InputCheck("call").acceleration_limits({1.0, 2.0}, 3).error()->code, ErrorCode::out_of_range);
  EXPECT_EQ(InputCheck("call").acceleration_limits({1.0, -2.0}, 2).error()->body.index, 1u);
  EXPECT_EQ(InputCheck("call").start({State{}, State{{0, nan, 0}, {}}}, 0.0).error()->body.index, 1u);
  EXPECT_TRUE(InputCheck("call").start({State{}}, 1.0).result());
}

TEST(TextOf, NumbersGiveThemBack) {
  Random random(6103);
  for (int k = 0; k < 1000; ++k) {
    const double number = std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.bits() % 600) - 300);
    EXPECT_EQ(std::strtod(text_of(number).c_str(), nullptr), number);
  }
  EXPECT_EQ(text_of(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(text_of(Vec3{1, 2, 0.5}), "(1, 2, 0.5)");
  EXPECT_EQ(text_of(BodyId{4, 1}), "body 4 (generation 1)");
}

}  // namespace
}  // namespace kinesphere::input_check_test
