// Random tracks with random, late and noisy reports: no certain answer is ever wrong, and none is left open
// that the latest reports decide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <tuple>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::random_sky_test {
namespace {

struct Sky {
  std::string name;
  int dimensions = 3;
  std::size_t tracks = 40;
  double size = 60.0;
  double speed = 5.0;
  double limit = 2.0;
  double error = 0.3;
  double velocity_error = 0.2;
  double interval = 1.0;  ///< mean time between reports
  double delay = 0.5;     ///< at most
  double window = 1.0;
  std::vector<Separation> levels{Separation::sphere(8.0), Separation::sphere(3.0)};

  friend std::ostream& operator<<(std::ostream& out, const Sky& sky) { return out << sky.name; }
};

struct Arrival {
  double time;
  TrackId id;
  TrackReport report;
  friend bool operator<(const Arrival& a, const Arrival& b) { return a.time > b.time; }
};

class RandomSky : public testing::TestWithParam<Sky> {
 protected:
  static RandomForces motion(const Sky& sky, std::uint64_t seed) {
    Random random(seed);
    std::vector<State> start(sky.tracks);
    for (State& state : start) {
      state = {0.5 * sky.size * random.point_in_ball(), sky.speed * random.point_in_ball()};
      if (sky.dimensions == 2) state.position.z = state.velocity.z = 0.0;
    }
    return RandomForces::create({.start = start,
                                 .acceleration_limits = std::vector(sky.tracks, sky.limit),
                                 .interval = 0.7,
                                 .seed = seed})
        .value();
  }

  /// Returns the horizontal part of a state.
  static State seen(const Sky& sky, State state) {
    if (sky.dimensions == 2) state.position.z = state.velocity.z = 0.0;
    return state;
  }

  static std::priority_queue<Arrival> arrivals(const Sky& sky, std::uint64_t seed, double until) {
    RandomForces truth = motion(sky, seed);
    Random random(seed + 1000);
    std::priority_queue<Arrival> all;
    std::vector<double> next(sky.tracks);
    for (double& time : next) time = sky.interval * random.uniform(0.0, 1.0);
    for (std::uint32_t k = 0; k < sky.tracks; ++k) {
      for (double time = next[k]; time < until; time += sky.interval * random.uniform(0.2, 1.8)) {
        const State exact = seen(sky, truth.state(k, time));
        TrackReport report{.timestamp = time, .state = exact};
        report.position_error = sky.error;
        report.velocity_error = sky.velocity_error;
        report.state.position += seen(sky, {sky.error * random.point_in_ball(), {}}).position;
        report.state.velocity += seen(sky, {sky.velocity_error * random.point_in_ball(), {}}).position;
        const double delay = sky.delay * random.uniform(0.0, 1.0);
        all.push({time + delay, 100 + k, report});
        if (random.uniform(0.0, 1.0) < 0.1) all.push({time + delay + 0.3, 100 + k, report});
      }
    }
    return all;
  }

  /// `way` and `speed` are the position and velocity of one relative to the other.
  static bool is_within(const Separation& separation, int dimensions, const Vec3& way, const Vec3& speed,
                        double tolerance) {
    const double flat = std::hypot(way.x, way.y);
    if (separation.shape == Separation::Shape::well_clear) {
      if (dimensions == 3 && std::abs(way.z) > separation.vertical + tolerance) return false;
      const double distance = separation.horizontal + tolerance;
      const double closing = way.x * speed.x + way.y * speed.y;
      return flat <= distance ||
             (closing < 0.0 &&
              std::abs(way.x * speed.y - way.y * speed.x) <= distance * std::hypot(speed.x, speed.y) &&
              (distance * distance - flat * flat) / closing <= separation.modified_tau);
    }
    if (dimensions == 2) return flat <= separation.horizontal + tolerance;
    if (separation.shape == Separation::Shape::cylinder)
      return flat <= separation.horizontal + tolerance && std::abs(way.z) <= separation.vertical + tolerance;
    const double stretch = separation.horizontal / separation.vertical;
    return std::hypot(flat, stretch * way.z) <= separation.horizontal + tolerance;
  }
};

TEST_P(RandomSky, IsNeverWrongWhereItIsCertain) {
  const Sky& sky = GetParam();
  std::map<Verdict, int> seen_verdicts;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double until = 20.0;
    RandomForces truth = motion(sky, seed);
    std::priority_queue<Arrival> arrivals = RandomSky::arrivals(sky, seed, until);
    Monitor monitor = Monitor::create({.dimensions = sky.dimensions,
                                       .classes = {{.acceleration_limit = sky.limit}},
                                       .separations = {{0, 0, sky.levels}},
                                       .window = sky.window})
                          .value();
    std::map<std::tuple<TrackId, TrackId, std::uint32_t>, Verdict> verdicts;
    std::map<TrackId, TrackReport> latest;
    int undecided_needlessly = 0;
    // Limits of the truth from earlier answers, which stay valid whatever the monitor answers later.
    struct Promise {
      Verdict verdict;
      double until;
    };
    std::map<std::tuple<TrackId, TrackId, std::uint32_t>, Promise> promises;
    const auto go_to = [&](double time) {
      for (const MonitorEvent& event : monitor.events(time)) {
        ASSERT_EQ(event.kind, MonitorEventKind::verdict);
        Verdict& verdict = verdicts[{event.first, event.second, event.level}];
        ASSERT_EQ(verdict, event.before);
        verdict = event.verdict;
      }
    };
    const auto check = [&](double time) {
      for (const auto& [id, report] : latest)
        for (const auto& [other, other_report] : latest) {
          if (other <= id) continue;
          const State x = seen(sky, truth.state(static_cast<std::uint32_t>(id - 100), time));
          const State y = seen(sky, truth.state(static_cast<std::uint32_t>(other - 100), time));
          const auto ahead = [&](const TrackReport& last) {
            return last.state.position + last.state.velocity * (time - last.timestamp);
          };
          const auto radius = [&](const TrackReport& last) {
            const double s = time - last.timestamp;
            return sky.error + (sky.velocity_error + 0.5 * sky.limit * s) * s;
          };
          const double doubt = radius(report) + radius(other_report);
          const double between = norm(ahead(report) - ahead(other_report));
          for (std::uint32_t level = 0; level < sky.levels.size(); ++level) {
            const Separation& separation = sky.levels[level];
            const auto at = verdicts.find({id, other, level});
            const Verdict verdict = at == verdicts.end() ? Verdict::apart : at->second;
            ++seen_verdicts[verdict];
            const Vec3 way = x.position - y.position, speed = x.velocity - y.velocity;
            if (const auto promised = promises.find({id, other, level});
                promised != promises.end() && time < promised->second.until) {
              EXPECT_EQ(is_within(separation, sky.dimensions, way, speed,
                                  promised->second.verdict == Verdict::apart ? -1e-9 : 1.01e-3),
                        promised->second.verdict == Verdict::within)
                  << id << " and " << other << " at " << time;
            } else if (const PairAnswer answer = monitor.answer(id, other, level).value();
                       answer.verdict != Verdict::undecided) {
              promises[{id, other, level}] = {answer.verdict, answer.until};
            }
            if (verdict == Verdict::apart) {
              EXPECT_FALSE(is_within(separation, sky.dimensions, way, speed, -1e-9))
                  << id << " and " << other << " at " << time << ", " << norm(way) << " apart";
            }
            if (verdict == Verdict::within) {
              EXPECT_TRUE(is_within(separation, sky.dimensions, way, speed, 1.01e-3))
                  << id << " and " << other << " at " << time << ", " << norm(way) << " apart";
            }
            if (separation == Separation::sphere(separation.horizontal) && verdict == Verdict::undecided) {
              // Speeds are below 40, so that no verdict lasts less than the resolution.
              if (between - doubt > separation.horizontal + 0.2 ||
                  between + doubt < separation.horizontal - 0.2)
                ++undecided_needlessly;
            }
          }
        }
    };
    double next_check = 0.0;
    while (!arrivals.empty() && !HasFailure()) {
      const Arrival arrival = arrivals.top();
      arrivals.pop();
      while (next_check < arrival.time) {
        go_to(next_check);
        check(next_check);
        next_check += 0.11;
      }
      go_to(arrival.time);
      monitor.report(arrival.id, arrival.report).value();
      TrackReport& last = latest[arrival.id];
      if (last.timestamp <= arrival.report.timestamp) last = arrival.report;
      go_to(arrival.time);
    }
    EXPECT_EQ(undecided_needlessly, 0);
    EXPECT_EQ(monitor.counters().contradictions, 0u);
    EXPECT_GT(monitor.counters().repeated, 0u);
    if (sky.delay > 0.0) {
      EXPECT_GT(monitor.counters().late, 0u);
    }
  }
  for (const Verdict verdict : {Verdict::apart, Verdict::undecided, Verdict::within})
    EXPECT_GT(seen_verdicts[verdict], 10) << name_of(verdict);
}

INSTANTIATE_TEST_SUITE_P(
    , RandomSky,
    testing::Values(
        Sky{.name = "spheres"}, Sky{.name = "plane", .dimensions = 2, .tracks = 25},
        Sky{.name = "fast", .speed = 30.0, .limit = 10.0, .delay = 0.2},
        Sky{.name = "dense", .tracks = 80, .size = 30.0, .speed = 2.0, .limit = 0.5},
        Sky{.name = "long_windows", .window = 9.0}, Sky{.name = "short_windows", .window = 0.1},
        Sky{.name = "cylinders", .levels = {Separation::cylinder(8.0, 4.0), Separation::cylinder(5.0, 2.0)}},
        Sky{.name = "ellipsoids",
            .levels = {Separation::ellipsoid(8.0, 4.0), Separation::ellipsoid(3.0, 6.0)}},
        Sky{.name = "well_clear",
            .levels = {Separation::well_clear(6.0, 4.0, 1.5), Separation::well_clear(3.0, 3.0, 0.5)}},
        Sky{.name = "well_clear_in_the_plane",
            .dimensions = 2,
            .tracks = 25,
            .speed = 12.0,
            .error = 0.01,
            .velocity_error = 0.01,
            .interval = 0.4,
            .delay = 0.1,
            .window = 0.3,
            .levels = {Separation::well_clear(4.0, 4.0, 2.0)}},
        Sky{.name = "exact", .error = 0.0, .velocity_error = 0.0, .interval = 0.4, .delay = 0.6}),
    [](const auto& sky) { return sky.param.name; });

}  // namespace
}  // namespace kinesphere::random_sky_test
