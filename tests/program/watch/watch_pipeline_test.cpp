// Flights over the real earth, reported late and with errors: no certain verdict is wrong, on the ellipsoid.
#include "watch/watch_pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <queue>
#include <tuple>

#include "formats/fields/json_reading.hpp"
#include "formats/fields/separations.hpp"
#include "kinesphere/random.hpp"

#ifdef KINESPHERE_WITH_GEOGRAPHICLIB
#include <GeographicLib/Geodesic.hpp>

namespace kinesphere::program::watch_pipeline_test {
namespace {

using GeographicLib::Geodesic;

constexpr double degree = 3.14159265358979323846 / 180.0;
constexpr double tick = 0.05;

/// A flight along the ellipsoid, with turns and climbs.
struct Flight {
  double latitude = 0, longitude = 0, azimuth = 0, height = 0;
  double speed = 0;  ///< over ground
  double turn = 0;   ///< degrees per second
  double climb = 0;

  void go_on() {
    Geodesic::WGS84().Direct(latitude, longitude, azimuth, speed * tick, latitude, longitude, azimuth);
    azimuth += turn * tick;
    height += climb * tick;
  }
  /// At its height it is faster than the point below.
  Vec3 velocity() const {
    const double there = speed * (1.0 + height / 6380e3);
    return {there * std::sin(azimuth * degree), there * std::cos(azimuth * degree), climb};
  }
};

double distance_between(const Flight& a, const Flight& b) {
  double distance = 0;
  Geodesic::WGS84().Inverse(a.latitude, a.longitude, b.latitude, b.longitude, distance);
  return distance;
}

struct Place {
  double latitude, longitude, radius;
};

class FlightsOverTheEarth : public testing::TestWithParam<Place> {};

TEST_P(FlightsOverTheEarth, AreToldOfWithCertainty) {
  const Place& place = GetParam();
  constexpr double error = 60.0, velocity_error = 2.0, height_error = 30.0, climb_error = 1.0,
                   stamp_error = 0.2;
  WatchSettings settings{
      .separations = {parse_separation("cylinder:5NM:1000ft"), parse_separation("cylinder:3NM:700ft")},
      .kinds = {.undecided = true},
      .dimensions = 3,
      .classes = TrackClasses({ErrorBound::cylinder(5.0, 1.0), ErrorBound::cylinder(300.0, 30.0)}),
      .position_error = {error, "test"},
      .height_error = {height_error, "test"},
      .velocity_error = {velocity_error, "test"},
      .climb_error = {climb_error, "test"},
      .stamp_error = stamp_error,
      .silence = 20.0,
      .forget = 60.0,
      .origin = WatchSettings::Origin{place.latitude, place.longitude},
      .radius = place.radius,
      .source = "test"};
  std::map<std::tuple<std::string, std::string, int>, std::string> verdicts;
  std::map<std::string, int> reported;
  Random random(11);
  std::vector<Flight> flights(30);
  for (Flight& flight : flights) {
    // Some flights are near the middle, most near the rim, with the largest errors of the map.
    const bool in_the_middle = random.uniform(0.0, 1.0) < 0.2;
    Geodesic::WGS84().Direct(place.latitude, place.longitude, 23.0, in_the_middle ? 0.0 : 0.9 * place.radius,
                             flight.latitude, flight.longitude);
    Geodesic::WGS84().Direct(flight.latitude, flight.longitude, random.uniform(-180.0, 180.0),
                             25e3 * random.uniform(0.0, 1.0), flight.latitude, flight.longitude);
    flight.azimuth = random.uniform(-180.0, 180.0);
    flight.height = 9000.0 + 600.0 * std::floor(random.uniform(0.0, 3.0));
    flight.speed = random.uniform(120.0, 280.0);
    flight.turn = random.uniform(-1.0, 1.0) * 4.5 / flight.speed / degree;
    flight.climb = random.uniform(-3.0, 3.0);
  }
  WatchPipeline pipeline(settings, [&](std::uint64_t, std::string_view line) {
    const auto alert = nlohmann::json::parse(line);
    ASSERT_EQ(alert["event"], "verdict") << line;
    std::string& verdict = verdicts[{alert["first"], alert["second"], alert["level"]}];
    ASSERT_EQ(alert["before"], verdict.empty() ? "apart" : verdict);
    verdict = alert["verdict"];
    // The two flights are at most a tick ahead.
    const auto flight = [&](const char* which) {
      return flights[std::stoul(alert[which].get<std::string>().substr(7)) - 10];
    };
    const double truth = distance_between(flight("first"), flight("second")), gone = 2 * 300.0 * tick;
    EXPECT_LE(alert["distance"][0], truth + gone) << line;
    EXPECT_GE(alert["distance"][1], truth - gone) << line;
    ++reported[verdict];
  });

  struct Waiting {
    double arrival;
    std::string id;
    SourceReport report;
    bool operator<(const Waiting& other) const { return arrival > other.arrival; }
  };
  std::priority_queue<Waiting> waiting;
  std::vector<std::vector<Vec3>> past(flights.size());
  int checked = 0, decided = 0;
  for (int k = 0; k < 1200; ++k) {
    const double time = 1000.0 + k * tick;
    for (std::size_t n = 0; n < flights.size(); ++n) {
      Flight& flight = flights[n];
      if (k > 0) flight.go_on();
      past[n].push_back(flight.velocity());
      if (random.uniform(0.0, 1.0) > tick) continue;
      // About once a second, with errors in every part, and a delay of up to a second.
      Flight seen = flight;
      Geodesic::WGS84().Direct(seen.latitude, seen.longitude, random.uniform(-180.0, 180.0),
                               error * random.uniform(0.0, 1.0), seen.latitude, seen.longitude);
      const double direction = random.uniform(-180.0, 180.0) * degree,
                   wrong = velocity_error * random.uniform(0.0, 1.0);
      SourceReport report{.stamp = time_of(time + stamp_error * random.uniform(-1.0, 1.0)),
                          .geographic = true};
      report.arrival = time_of(time + random.uniform(0.2, 1.0));
      report.position = {seen.longitude, seen.latitude,
                         seen.height + height_error * random.uniform(-1.0, 1.0)};
      report.has_height = report.has_climb = true;
      // Some velocities are older than the position.
      const std::size_t age =
          std::min<std::size_t>(random.uniform(0.0, 1.0) < 0.5 ? 0 : 20, past[n].size() - 1);
      report.velocity_age = static_cast<double>(age) * tick;
      report.velocity =
          past[n][past[n].size() - 1 - age] + Vec3{wrong * std::sin(direction), wrong * std::cos(direction),
                                                   climb_error * random.uniform(-1.0, 1.0)};
      waiting.push({seconds_between({}, *report.arrival), "flight " + std::to_string(10 + n), report});
    }
    while (!waiting.empty() && waiting.top().arrival <= time) {
      Waiting next = waiting.top();
      waiting.pop();
      next.report.id = next.id;
      pipeline.take(next.report);
      pipeline.end_record();
    }
    // The clock is a little behind.
    pipeline.time_is(time_of(time), TimeKind::number);
    pipeline.end_record();
    if (k % 4 != 0 || pipeline.view().tracks.names().size() < flights.size()) continue;
    for (std::size_t a = 0; a < flights.size(); ++a)
      for (std::size_t b = a + 1; b < flights.size(); ++b)
        for (int level = 0; level < 2; ++level) {
          const Separation& separation = settings.separations[static_cast<std::size_t>(level)].separation;
          const auto at =
              verdicts.find({"flight " + std::to_string(10 + a), "flight " + std::to_string(10 + b), level});
          const std::string verdict = at == verdicts.end() ? "apart" : at->second;
          const double flat = distance_between(flights[a], flights[b]);
          const double upright = std::abs(flights[a].height - flights[b].height);
          ++checked;
          if (verdict == "undecided") continue;
          ++decided;
          const double stretch = pipeline.view().tracks.map().frame()->stretch();
          const double tolerance = verdict == "within" ? 0.05 : 0.0;
          const bool within =
              flat <= (verdict == "within" ? stretch : 1.0) * separation.horizontal + tolerance &&
              upright <= separation.vertical + tolerance;
          ASSERT_EQ(within, verdict == "within")
              << time << ": " << a << " and " << b << " " << flat << " " << upright;
        }
  }
  EXPECT_EQ(pipeline.view().counts.outside, 0u);
  EXPECT_EQ(pipeline.view().counts.malformed, 0u);
  EXPECT_GT(reported["within"], 20);
  EXPECT_GT(reported["apart"], 20);
  EXPECT_GT(decided, 0.9 * checked);
}

INSTANTIATE_TEST_SUITE_P(Everywhere, FlightsOverTheEarth,
                         testing::Values(Place{51.5, -0.5, 500e3}, Place{-5.0, 179.0, 1500e3},
                                         Place{78.0, 20.0, 4500e3}, Place{86.0, 20.0, 500e3}));

}  // namespace
}  // namespace kinesphere::program::watch_pipeline_test

#endif
