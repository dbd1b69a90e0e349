// Windows in periodic space far from its origin, with half a period below the resolution of single precision:
// bodies with swept spheres nearly as wide as allowed, which overlap by a sliver.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <ostream>

#include "support/playground.hpp"

namespace kinesphere::far_period_test {
namespace {

constexpr double eps = 1e-6;
constexpr double half_width = 0.1;  ///< half the width of each body

struct Place {
  double lower;
  double period;

  double upper() const { return lower + period; }
  double wrapped(double x) const { return x - std::floor((x - lower) / period) * period; }
  /// Returns the image in which a way is shortest, if its ends are rounded to single precision first.
  int image_in_single_precision(double from, double to) const {
    const float way = static_cast<float>(wrapped(to)) - static_cast<float>(wrapped(from));
    return image(static_cast<double>(way));
  }
  int image_of(double from, double to) const { return image(wrapped(to) - wrapped(from)); }

 private:
  int image(double way) const { return way > 0.5 * period ? -1 : way < -0.5 * period ? 1 : 0; }
};

std::ostream& operator<<(std::ostream& out, const Place& place) {
  return out << "period " << place.period << " from " << place.lower << " on";
}

class FarPeriod : public testing::TestWithParam<Place> {};

/// Returns the longest way of a body in a window: its swept sphere may be half a period wide, less rounding.
double longest_way(const Place& place) {
  return (0.5 - 0x1p-10) * place.period - 2.0 * half_width - 10.0 * eps;
}

/// Returns the longest window in which a body of a speed near 1 stays within that way.
double window_length(const Place& place) { return std::exp2(std::floor(std::log2(longest_way(place)))); }

/// One body moves along x, nearly as far in each window as allowed; the other waits, far from it on y, until
/// it is thrown towards the first, from a place at which its new swept sphere overlaps that of the first by
/// `depth`.
class Meeting : public Playground {
 public:
  Meeting(const Place& its_place, double start)
      : Playground({.box = Box{{its_place.lower, -1000, -1000}, {its_place.upper(), 1000, 1000}},
                    .periodic = {true, false, false},
                    .contact_tolerance = eps}),
        place(its_place),
        speed(0.99995 * longest_way(place) / window_length(place)),
        goer(add({.radius = half_width, .position = {place.lower + start, 0, 0}, .velocity = {speed, 0, 0}})),
        waiter(add({.radius = half_width, .position = {place.lower + 7, 900, 0}, .velocity = {-1, 0, 0}})) {
    distort = [this](BodyId, double, State& reported) {
      reported.position.x = place.wrapped(reported.position.x);
    };
  }

  /// Runs until the swept sphere of the first body is nearly half a period wide, and then until it lasts for
  /// a few more of its diameters.
  bool gets_ready() {
    const double length = window_length(place);
    const double start = std::ceil(400.0 / length) * length;
    run(start);
    box = world.body(goer).value().box;
    run(start + length - 3.7);
    left = world.body(goer).value().box_end - world.time();
    return box.upper.x - box.lower.x > 0.49 * place.period && left > 3.5 && left < 4.0;
  }

  /// Returns the place of the second body for an overlap of `depth`, if single precision would then name
  /// another image than the swept spheres do.
  std::optional<double> thrown_from(double depth) const {
    const double way = 0.99995 * longest_way(place);
    const double from = box.upper.x - depth + way + half_width;
    const double centre_of_goer = 0.5 * (box.lower.x + box.upper.x);
    const double centre = 0.5 * (from - way - half_width + from + half_width);
    if (place.image_of(centre_of_goer, centre) == place.image_in_single_precision(centre_of_goer, centre))
      return std::nullopt;
    return from;
  }

  /// Throws the second body, and runs until the two swept spheres have ended.
  void throw_from(double from) {
    const double thrown = 0.99995 * longest_way(place) / left;
    const State state{{from, 0, 0}, {-thrown, 0, 0}};
    world.teleport(waiter, {{place.wrapped(from), 0, 0}, state.velocity}).value();
    set_state(waiter, state);
    double ahead =
        place.wrapped(from) - place.wrapped(world.body(goer).value().bound.centre_at(world.time()).x);
    if (ahead < 0.0) ahead += place.period;
    const double contact = world.time() + (ahead - 2.0 * half_width) / (speed + thrown);
    const auto begins = of_kind(run(world.time() + left + 1.0), EventKind::contact_begin);
    ASSERT_FALSE(begins.empty()) << "never reported";
    EXPECT_LE(begins[0].time, contact + eps);
    EXPECT_GE(begins[0].gap, -eps);
    EXPECT_LE(begins[0].gap, eps);
  }

  Place place;
  double speed;
  BodyId goer, waiter;
  Box box{};
  double left = 0.0;
};

TEST_P(FarPeriod, NoContactIsLateWhereSinglePrecisionNamesAnotherImage) {
  int thrown = 0;
  for (int n = 0; n < 400 && thrown < 25; ++n) {
    Meeting meeting(GetParam(), 0.413 * n);
    if (!meeting.gets_ready()) continue;
    for (double depth = 0.2; depth > 0.0005; depth -= 0.0005) {
      const auto from = meeting.thrown_from(depth);
      if (!from) continue;
      ++thrown;
      SCOPED_TRACE(testing::Message() << GetParam() << ", start " << n << ", depth " << depth);
      meeting.throw_from(*from);
      EXPECT_TRUE(is_clean(meeting.world));
      break;
    }
  }
  EXPECT_GT(thrown, 5) << "a test that tests nothing";
}

INSTANTIATE_TEST_SUITE_P(Places, FarPeriod,
                         testing::Values(Place{2000000.0, 40.24}, Place{262200.0, 20.06},
                                         Place{-2000000.0, 40.24}, Place{1000000.5, 30.3}));

}  // namespace
}  // namespace kinesphere::far_period_test
