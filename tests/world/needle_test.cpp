// Bodies that fly through triangles as thin as a world allows: each passage is reported once, in time, at a
// cost that does not depend on the triangle.
#include <gtest/gtest.h>

#include <iomanip>
#include <limits>

#include "support/needles.hpp"
#include "world/surroundings.hpp"

namespace kinesphere::needle_test {
namespace {

constexpr std::uint64_t seed = 1403;
constexpr int worlds = 400;
constexpr double eps = 1e-6;
/// Slightly more than the rounding error of a gap at the limit of coordinates.
constexpr double rounding = 0.1 * eps;
constexpr std::uint64_t most_probes = 200;

/// The probe's next answer is none, which stops the world.
void give_up_after_many_probes(Surroundings& p) {
  p.distort = [&p](BodyId, double time, State& state) {
    if (p.world.counters().probes <= most_probes) return;
    ADD_FAILURE() << most_probes << " probes by time " << std::setprecision(17) << time;
    state.position.x = std::numeric_limits<double>::quiet_NaN();
  };
}

class FlightThroughNeedle : public testing::TestWithParam<double> {};

TEST_P(FlightThroughNeedle, IsToldInTime) {
  const double radius = GetParam();
  int flights = 0;
  for (std::uint64_t k = 0; k < worlds; ++k) {
    Random random = Random::at(seed, k, 0);
    // Leaves space for the flight before and after.
    const Needle needle = random_needle(random, 0x1p41 * eps - 10.0);
    const Vec3 hit = needle.point(random);
    const Vec3 velocity = 10.0 * random.unit_vector();
    const BodyDefinition body{.radius = radius, .position = hit - velocity * 0.25, .velocity = velocity};
    const Shape shape = needle.triangle;
    if (distance(shape, body.position) < radius + 5 * eps) continue;  // it flies along the needle
    ++flights;
    Surroundings p({.contact_tolerance = eps});
    const BodyId fixed = p.place(shape);
    const BodyId ball = p.add(body, Vec3{});
    give_up_after_many_probes(p);
    const auto gap_at = [&](double time) { return distance(shape, p.state(ball, time).position) - radius; };
    std::vector<Event> events;
    while (const auto event = p.advance(0.5)) {
      events.push_back(*event);
      ASSERT_TRUE(is_clean(p.world)) << "seed " << seed << ", world " << k << ", " << needle;
      if (event->kind != EventKind::contact_begin) continue;
      ASSERT_LE(std::abs(p.gap_to(ball, fixed)), eps + rounding)
          << "seed " << seed << ", world " << k << ", " << needle;
      for (int part = 1; part < 64; ++part) {
        const double time = event->time * part / 64.0;
        ASSERT_GT(gap_at(time), -eps - rounding)
            << "unseen at " << time << ", seed " << seed << ", world " << k << ", " << needle;
      }
    }
    // A point meets the place at which it was aimed, or one beside it within rounding.
    const bool leaves = gap_at(0.5) > 5 * eps + rounding;
    ASSERT_EQ(events.size(), leaves ? 2u : 1u)
        << events << "seed " << seed << ", world " << k << ", " << needle;
    ASSERT_EQ(events[0].kind, EventKind::contact_begin);
    ASSERT_TRUE(!leaves || events[1].kind == EventKind::contact_end) << events;
    ASSERT_LE(p.world.counters().steps(), 2 * most_probes)
        << "seed " << seed << ", world " << k << ", " << needle;
  }
  EXPECT_GT(flights, worlds / 2);
}

INSTANTIATE_TEST_SUITE_P(OfRadius, FlightThroughNeedle, testing::Values(0.0, 1e-2, 1.0));

/// A needle with a plane normal that errs by 41 tolerances as the cross product of two sides: a regression
/// with a million probes of the body, one unit in the last place of the time apart.
TEST(NeedleFlight, OfAMillionProbes) {
  Surroundings p({.contact_tolerance = eps});
  const Triangle needle{{0, 0, 0},
                        {653096.25878771953, 386278.80133781803, -651347.80601035454},
                        {390205.53762612765, 230788.87650349599, -389160.35839910724}};
  p.place(needle);
  const BodyDefinition body{.radius = 1e-2,
                            .position = {266300.52531611861, 157506.03895529651, -265587.25765584729},
                            .velocity = {-1.27945106000687, -9.9087841175335694, -0.42308663080003583}};
  p.add(body, Vec3{});
  give_up_after_many_probes(p);
  const std::vector<Event> events = p.run(0.2);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  EXPECT_EQ(events[1].kind, EventKind::contact_end);
}

}  // namespace
}  // namespace kinesphere::needle_test
