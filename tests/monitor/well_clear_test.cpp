// Well clear with modified tau: proofs about discs of states, verdicts and predictions, and two scenarios of
// DAIDALUS.
#include "monitor/well_clear.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::well_clear_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// DO-365's definition, in the plane.
bool is_lost(const Vec3& s, const Vec3& v, double distance, double modified_tau) {
  const double r2 = s.x * s.x + s.y * s.y, v2 = v.x * v.x + v.y * v.y, sv = s.x * v.x + s.y * v.y;
  if (r2 <= distance * distance) return true;
  if (!(sv < 0.0)) return false;
  const double cross = s.x * v.y - s.y * v.x;
  return cross * cross <= distance * distance * v2 && (distance * distance - r2) / sv <= modified_tau;
}

Vec3 in_disc(Random& random, double radius) {
  const double angle = random.uniform(0.0, 6.2832);
  // Mostly at the edge.
  const double length = radius * std::min(1.0, random.uniform(0.0, 1.5));
  return {length * std::cos(angle), length * std::sin(angle), 0.0};
}

/// Returns discs whose sizes are spread over the ranges in which a proof may succeed or fail.
RelativeDiscs random_discs(Random& random, const WellClearLimits& limits, double error) {
  RelativeDiscs discs;
  const double speed = limits.distance * std::exp(random.uniform(-3.0, 1.0));
  discs.velocity = in_disc(random, speed);
  discs.position = in_disc(random, 1.5 * limits.distance + 1.2 * speed * limits.modified_tau);
  discs.acceleration = random.bits() % 2 == 0 ? 0.0 : 0.1 * speed * random.uniform();
  discs.position_error = error * limits.distance * random.uniform();
  discs.velocity_error = error * speed * random.uniform();
  discs.velocity_growth = random.bits() % 3 == 0 ? 0.0 : error * speed * random.uniform();
  return discs;
}

/// The discs after a time, with an acceleration in some direction.
RelativeDiscs later(RelativeDiscs discs, const Vec3& acceleration, double t) {
  discs.position += (discs.velocity + acceleration * (0.5 * t)) * t;
  discs.velocity += acceleration * t;
  if (discs.grows) {
    discs.position_error += (discs.velocity_error + discs.velocity_growth * (0.5 * t)) * t;
    discs.velocity_error += discs.velocity_growth * t;
  }
  return discs;
}

TEST(WellClear, ProofsHoldForAllStatesAsLongAsTheySay) {
  std::size_t clear = 0, lost = 0, open = 0;
  for (std::uint64_t run = 0; run < 6000; ++run) {
    SCOPED_TRACE(run);
    Random random = Random::at(365, 0, run);
    const WellClearLimits limits{std::exp(random.uniform(-1.0, 7.0)), std::exp(random.uniform(-2.0, 4.0))};
    RelativeDiscs discs = random_discs(random, limits, std::exp(random.uniform(-5.0, 0.0)));
    const Vec3 direction = in_disc(random, 1.0);
    const Vec3 acceleration =
        norm(direction) > 0.0 ? direction * (discs.acceleration / norm(direction)) : Vec3{};
    discs.acceleration = norm(acceleration);
    const double clear_for = clear_by_tau_for(discs, limits), lost_time = lost_for(discs, limits);
    clear += clear_for > 0.0 ? 1u : 0u;
    lost += lost_time > 0.0 ? 1u : 0u;
    open += clear_for <= 0.0 && lost_time <= 0.0 ? 1u : 0u;
    for (int sample = 0; sample < 60; ++sample) {
      const double part = sample == 0 ? 0.0 : random.uniform();
      const auto state_at = [&](double time) {
        const RelativeDiscs then = later(discs, acceleration, time);
        return std::pair(then.position + in_disc(random, then.position_error),
                         then.velocity + in_disc(random, then.velocity_error));
      };
      if (clear_for > 0.0) {
        const auto [s, v] = state_at(part * std::min(clear_for, 1e3 * limits.modified_tau));
        ASSERT_TRUE(norm(s) <= limits.distance || !is_lost(s, v, limits.distance, limits.modified_tau));
      }
      if (lost_time > 0.0) {
        const auto [s, v] = state_at(part * std::min(lost_time, 1e3 * limits.modified_tau));
        ASSERT_TRUE(is_lost(s, v, limits.distance, limits.modified_tau));
      }
    }
    // No proof comes sooner than told.
    RelativeDiscs still = discs;
    still.grows = false;
    const double not_clear_for = -clear_by_tau_for(still, limits), not_lost_for = -lost_for(still, limits);
    for (int sample = 0; sample < 20; ++sample) {
      const double part = random.uniform() * (1.0 - 1e-9);
      if (not_clear_for > 0.0) {
        ASSERT_LE(clear_by_tau_for(later(still, acceleration, part * std::min(1e9, not_clear_for)), limits),
                  0.0);
      }
      if (not_lost_for > 0.0) {
        ASSERT_LE(lost_for(later(still, acceleration, part * std::min(1e9, not_lost_for)), limits), 0.0);
      }
    }
  }
  EXPECT_GT(clear, 1000u);
  EXPECT_GT(lost, 700u);
  EXPECT_GT(open, 400u);
}

TEST(WellClear, SmallErrorsLeaveNothingOpenButTheBoundary) {
  Random random(366);
  std::size_t clear = 0, lost = 0;
  for (int k = 0; k < 20'000; ++k) {
    const WellClearLimits limits{std::exp(random.uniform(-1.0, 7.0)), std::exp(random.uniform(-2.0, 4.0))};
    const RelativeDiscs discs = random_discs(random, limits, 1e-6);
    const auto is_lost_by = [&](double factor) {
      return is_lost(discs.position, discs.velocity, factor * limits.distance, factor * limits.modified_tau);
    };
    if (is_lost_by(0.999)) {
      EXPECT_GT(lost_for(discs, limits), 0.0);
      ++lost;
    }
    if (!is_lost_by(1.001)) {
      EXPECT_GT(clear_by_tau_for(discs, limits), 0.0);
      ++clear;
    }
  }
  EXPECT_GT(lost, 3000u);
  EXPECT_GT(clear, 5000u);
}

TrackReport at(double time, const Vec3& position, const Vec3& velocity) {
  return {.timestamp = time, .state = {position, velocity}};
}

struct Flight {
  Vec3 position{}, velocity{};
  Vec3 position_at(double time) const { return position + velocity * time; }
};

TEST(WellClear, IsDecidedByExactReportsWhenStraightPathsLoseIt) {
  std::size_t changes = 0;
  for (std::uint64_t run = 0; run < 200; ++run) {
    SCOPED_TRACE(run);
    Random random = Random::at(367, 0, run);
    const int dimensions = run % 2 == 0 ? 2 : 3;
    const double distance = 10.0, height = 4.0, modified_tau = 5.0;
    Flight one{20.0 * random.point_in_ball(), 4.0 * random.point_in_ball()};
    Flight other{60.0 * random.point_in_ball(), 3.0 * random.point_in_ball()};
    // Most of them meet.
    other.velocity += (one.position - other.position) / 12.0 + one.velocity;
    other.position.z = random.uniform(-6.0, 6.0);
    one.velocity.z = 0.3 * random.uniform();
    other.velocity.z = 0.3 * random.uniform();
    Monitor monitor =
        Monitor::create({.dimensions = dimensions,
                         .classes = {{.acceleration_limit = 1e-7}},
                         .separations = {{0, 0, {Separation::well_clear(distance, height, modified_tau)}}},
                         .tolerance = 1e-4})
            .value();
    monitor.report(1, at(0.0, one.position, one.velocity)).value();
    monitor.report(2, at(0.0, other.position, other.velocity)).value();
    Verdict verdict = Verdict::apart;
    double at_rest = 0.0;
    for (double time = 0.0; time < 30.0; time += 0.05) {
      for (const MonitorEvent& event : monitor.events(time)) {
        verdict = event.verdict;
        ++changes;
        at_rest = event.time;
      }
      const auto is_within = [&](double t, double more) {
        const Vec3 s = one.position_at(t) - other.position_at(t), v = one.velocity - other.velocity;
        return (dimensions == 2 || std::abs(s.z) <= height + more) &&
               is_lost(s, v, distance + more, modified_tau + more);
      };
      bool all = true, any = false;
      for (const double t : {time - 0.01, time, time + 0.01})
        for (const double more : {-0.01, 0.01}) {
          all = all && is_within(t, more);
          any = any || is_within(t, more);
        }
      if (all) {
        EXPECT_EQ(verdict, Verdict::within) << time << " since " << at_rest;
      }
      if (!any) {
        EXPECT_EQ(verdict, Verdict::apart) << time << " since " << at_rest;
      }
    }
  }
  EXPECT_GT(changes, 120u);
}

TEST(WellClear, IsPredictedWhenItsLossComesInTheLookAheadTime) {
  std::size_t seen = 0, predicted_count = 0;
  for (std::uint64_t run = 0; run < 4; ++run) {
    SCOPED_TRACE(run);
    Random random = Random::at(368, 0, run);
    const int dimensions = run % 2 == 0 ? 3 : 2;
    const double distance = 4.0, height = 2.0, modified_tau = run % 3 == 0 ? 6.0 : 1.5, look_ahead = 2.0;
    Monitor monitor =
        Monitor::create(
            {.dimensions = dimensions,
             .classes = {{.acceleration_limit = 1e5}},
             .separations = {{0, 0, {Separation::well_clear(distance, height, modified_tau, look_ahead)}}},
             .window = 0.25})
            .value();
    std::map<TrackId, std::pair<double, Flight>> tracks;
    std::map<std::pair<TrackId, TrackId>, bool> told;
    double time = 0.0;
    for (int step = 0; step < 200; ++step) {
      const TrackId id = random.bits() % 16;
      Flight flight{40.0 * random.point_in_ball(), 6.0 * random.point_in_ball()};
      flight.velocity.z *= random.bits() % 2 == 0 ? 1.0 : 0.1;
      if (const auto known = tracks.find(id); known != tracks.end() && random.bits() % 4 != 0)
        flight.position = known->second.second.position_at(time - known->second.first);
      if (dimensions == 2) flight.position.z = flight.velocity.z = 0.0;
      TrackReport report = at(time, flight.position, flight.velocity);
      report.position_error = report.velocity_error = 100.0;
      monitor.report(id, report).value();
      tracks[id] = {time, flight};
      time += random.bits() % 8 == 0 ? 1.5 * random.uniform() : 0.05 * random.uniform();
      for (const MonitorEvent& event : monitor.events(time)) {
        if (event.kind == MonitorEventKind::predicted) told[{event.first, event.second}] = true;
        if (event.kind == MonitorEventKind::prediction_ended) told[{event.first, event.second}] = false;
      }
      for (const auto& [a, first] : tracks)
        for (const auto& [b, second] : tracks) {
          if (b <= a) continue;
          // clang++ 14 cannot capture structured bindings.
          const auto& from = first.first;
          const auto& one = first.second;
          const auto& since = second.first;
          const auto& other = second.second;
          const Vec3 v = one.velocity - other.velocity;
          const auto is_within = [&](double t, double factor) {
            const Vec3 s = one.position_at(t - from) - other.position_at(t - since);
            return std::abs(s.z) <= factor * height &&
                   is_lost(s, v, factor * distance, factor * modified_tau);
          };
          const bool is_predicted = told[{a, b}];
          EXPECT_EQ(is_predicted, monitor.answer(a, b)->predicted);
          constexpr int samples = 60;
          bool surely = false, possibly = false;
          for (int k = 0; k <= samples; ++k) {
            const double ahead = look_ahead * k / samples;
            surely = surely || is_within(time + 0.99 * ahead, 0.99);
            // A loss that is shorter than the samples are apart may be missed.
            possibly = possibly || is_within(time + 1.01 * ahead, 1.04);
          }
          if (surely) {
            EXPECT_TRUE(is_predicted) << a << ' ' << b << " at " << time;
          }
          if (!possibly) {
            EXPECT_FALSE(is_predicted) << a << ' ' << b << " at " << time;
          }
          ++seen;
          predicted_count += is_predicted ? 1u : 0u;
        }
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(predicted_count, seen / 100);
  EXPECT_GT(seen, 40'000u);
}

constexpr double foot = 0.3048, mile = 1852.0, knot = mile / 3600.0;

struct Scenario {
  std::string name;
  Flight own, intruder;
  // When DAIDALUS 2.0.4 alerts, and when well clear is lost (DO_365B_no_SUM, once a second).
  double corrective, warning, lost;

  friend std::ostream& operator<<(std::ostream& out, const Scenario& scenario) {
    return out << scenario.name;
  }
};

/// The flights of DAIDALUS's Scenarios/C0_0_120.daa and H0_0_120.daa from their first rows, around that of
/// the own aircraft, in a plane with 60 nautical miles to a degree.
std::vector<Scenario> scenarios() {
  const auto place = [](double latitude, double longitude, double around_latitude, double around_longitude) {
    const double shrinking = std::cos(0.5 * (latitude + around_latitude) * std::acos(-1.0) / 180.0);
    return Vec3{60.0 * mile * shrinking * (longitude - around_longitude),
                60.0 * mile * (latitude - around_latitude), 15000.0 * foot};
  };
  const auto flight = [](const Vec3& position, double degrees, double knots) {
    const double course = degrees * std::acos(-1.0) / 180.0;
    return Flight{position, Vec3{std::sin(course), std::cos(course), 0.0} * (knots * knot)};
  };
  const double c0[] = {40.588997, -74.04466}, h0[] = {40.672307, -74.117909};
  return {{"crossing", flight(place(c0[0], c0[1], c0[0], c0[1]), 0.0, 150.0),
           flight(place(40.672297, -74.132559, c0[0], c0[1]), 90.0, 120.0), 28.0, 58.0, 81.0},
          {"head_on", flight(place(h0[0], h0[1], h0[0], h0[1]), 90.0, 120.0),
           flight(place(40.680611, -73.934773, h0[0], h0[1]), 270.0, 180.0), 11.0, 41.0, 64.3}};
}

class WellClearScenarios : public testing::TestWithParam<Scenario> {};

TEST_P(WellClearScenarios, AreToldNoLaterThanByDaidalus) {
  const Scenario& scenario = GetParam();
  const auto volume = [](double look_ahead) {
    return Separation::well_clear(0.66 * mile, 450.0 * foot, 35.0, look_ahead);
  };
  Monitor monitor =
      Monitor::create(
          {.classes = {{.acceleration_limit = 1.0, .largest_speed = ErrorBound::cylinder(250, 30)}},
           .separations = {{0, 0, {volume(55.0), volume(25.0)}}},
           .prediction_hold = 5.0})
          .value();
  double predicted[] = {infinity, infinity}, undecided = infinity, within = infinity;
  std::size_t predictions = 0;
  for (int second = 0; second <= 120; ++second) {
    for (const MonitorEvent& event : monitor.events(second)) {
      if (event.kind == MonitorEventKind::predicted) {
        predicted[event.level] = event.time;
        EXPECT_NEAR(event.likely_time, scenario.lost, 1.0);
        ++predictions;
      }
      if (event.kind == MonitorEventKind::verdict && event.level == 0) {
        if (event.before == Verdict::apart) undecided = std::min(undecided, event.time);
        if (event.verdict == Verdict::within) within = std::min(within, event.time);
      }
    }
    for (const auto& [id, flight] : {std::pair(TrackId{1}, scenario.own), {2, scenario.intruder}}) {
      TrackReport report = at(second, flight.position_at(second), flight.velocity);
      report.position_error = 10.0;
      report.velocity_error = 1.0;
      monitor.report(id, report).value();
    }
  }
  EXPECT_EQ(predictions, 2u);
  EXPECT_LE(predicted[0], scenario.corrective);
  EXPECT_GE(predicted[0], scenario.corrective - 3.0);
  EXPECT_LE(predicted[1], scenario.warning);
  EXPECT_GE(predicted[1], scenario.warning - 3.0);
  EXPECT_LE(undecided, scenario.lost);
  EXPECT_GE(undecided, scenario.lost - 15.0);
  EXPECT_GE(within, scenario.lost);
  EXPECT_LE(within, scenario.lost + 15.0);
}

INSTANTIATE_TEST_SUITE_P(, WellClearScenarios, testing::ValuesIn(scenarios()),
                         [](const auto& scenario) { return scenario.param.name; });

TEST(WellClear, HasAModifiedTauThatCanBe) {
  const auto made = [](const Separation& separation) {
    return Monitor::create({.classes = {{.acceleration_limit = 1.0}}, .separations = {{0, 0, {separation}}}});
  };
  EXPECT_TRUE(made(Separation::well_clear(10.0, 3.0, 0.0)));
  for (const double wrong : {-1.0, infinity, std::nan("")})
    expect_error(made(Separation::well_clear(10.0, 3.0, wrong)),
                 std::isfinite(wrong) ? ErrorCode::out_of_range : ErrorCode::not_finite, "separations",
                 "Monitor::create");
  Separation sphere = Separation::sphere(10.0);
  sphere.modified_tau = 1.0;
  expect_error(made(sphere), ErrorCode::out_of_range, "separations", "Monitor::create");
}

}  // namespace
}  // namespace kinesphere::well_clear_test
