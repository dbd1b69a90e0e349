// Errors of positions that grow between samples (--error): what is possible, and what is certain.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "simulation/tracks/rectangle_approaches.hpp"
#include "simulation/tracks/scene_of_tracks.hpp"

namespace kinesphere::program::error_option_test {
namespace {

class ErrorOption : public ProgramTest {
 protected:
  /// The rows of --contacts.
  std::vector<nlohmann::json> approaches(const std::string& file, const std::string& options) {
    const ProgramRun result =
        run("tracks " + file + " --interpolate linear --contacts " + path("c.jsonl") + " " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    out_ = result.out;
    std::vector<nlohmann::json> rows;
    std::istringstream lines(read_text(path("c.jsonl")));
    for (std::string line; std::getline(lines, line);) rows.push_back(nlohmann::json::parse(line));
    return rows;
  }
  std::string out_;
};

/// Two pass each other 10 m apart at 10 s, in the middle between samples 20 s apart.
constexpr std::string_view passing = "id,time,x_m,y_m\na,0,-100,0\na,20,100,0\nb,0,100,10\nb,20,-100,10\n";

TEST_F(ErrorOption, SaysWhatIsPossibleAndWhatIsCertain) {
  const std::string file = write("t.csv", passing);
  EXPECT_EQ(approaches(file, "--distance 8").size(), 0u);
  EXPECT_EQ(approaches(file, "--distance 8 --error 0.9m").size(), 0u)
      << "10 m less twice 0.9 m are more than 8";
  const auto possible = approaches(file, "--distance 8 --error 1.1m");
  ASSERT_EQ(possible.size(), 1u);
  EXPECT_EQ(possible[0]["certain"], false);
  EXPECT_NEAR(possible[0]["distance_m"].get<double>(), 10.0, 1e-6) << "the distance is that of the positions";
  // 20 (t - 10) meters along: within 10.2 m where that is at most sqrt(10.2^2 - 10^2).
  EXPECT_NEAR(possible[0]["begin"].get<double>(), 10.0 - std::sqrt(10.2 * 10.2 - 100.0) / 20.0, 1e-4);
  EXPECT_NE(out_.find("\ncertain           0 "), std::string::npos) << out_;
  EXPECT_NE(out_.find(" (possible)\n"), std::string::npos) << out_;
  // Between samples 10 s away the error has grown by 1 m each.
  EXPECT_EQ(approaches(file, "--distance 8 --error 0.1m:0.08m/s").size(), 0u);
  EXPECT_EQ(approaches(file, "--distance 8 --error 0.1m:0.1m/s").size(), 1u);
  const auto certain = approaches(file, "--distance 12.3 --error 0.1m:0.1m/s");
  ASSERT_EQ(certain.size(), 1u);
  EXPECT_EQ(certain[0]["certain"], true);
  EXPECT_NE(out_.find("\ncertain           1 "), std::string::npos) << out_;
  EXPECT_EQ(approaches(file, "--distance 12.1 --error 0.1m:0.1m/s")[0]["certain"], false);
  EXPECT_FALSE(approaches(file, "--distance 12.3")[0].contains("certain"));
}

TEST_F(ErrorOption, CountsForBodiesWithASize) {
  const std::string file = write("t.csv",
                                 "id,time,x_m,y_m,length_m,width_m\na,0,-100,0,4,2\na,20,100,0,4,2\n"
                                 "b,0,100,10,4,2\nb,20,-100,10,4,2\n");
  EXPECT_EQ(approaches(file, "--distance 7 --sizes --error 0.4m").size(), 0u);
  EXPECT_EQ(approaches(file, "--distance 7 --sizes --error 0.6m").size(), 1u) << "8 m are between the two";
}

TEST_F(ErrorOption, WhatIsWrongIsNamed) {
  const std::string file = write("t.csv", passing);
  expect_wrong_input("tracks " + file + " --distance 8 --error near", {"--error", "near"});
  expect_wrong_input("tracks " + file + " --distance 8 --error -1", {"--error", "-1"});
  const std::string plain = write("p.csv", "id,time,x,y\na,0,0,0\na,1,0,0\nb,0,1,0\nb,1,1,0\n");
  expect_wrong_input("tracks " + plain + " --distance 8 --error 1m",
                     {"--error: expected numbers without a unit"});
  const std::string high =
      write("h.csv", "id,time,x_m,y_m,z_m\na,0,0,0,0\na,1,0,0,0\nb,0,1,0,0\nb,1,1,0,0\n");
  expect_wrong_input("tracks " + high + " --separation cylinder:5:5 --error 1m",
                     {"--error: expected --distance"});
}

/// Two stand 30 m apart, as both say each 10 s.
constexpr std::string_view standing = "id,time,x_m,y_m\na,0,0,0\na,10,0,0\nb,0,0,30\nb,10,0,30\n";

TEST_F(ErrorOption, LimitsBoundWhatABodyMayDoBetweenSamples) {
  const std::string file = write("t.csv", standing);
  // An acceleration of 1 m/s2 takes each 1/8 * 100 m from its straight way.
  EXPECT_EQ(approaches(file, "--distance 4.99 --acceleration 1m/s2").size(), 0u);
  const auto possible = approaches(file, "--distance 5.01 --acceleration 1m/s2");
  ASSERT_EQ(possible.size(), 1u);
  EXPECT_EQ(possible[0]["certain"], false);
  EXPECT_NEAR(possible[0]["begin"].get<double>(), 5.0, 0.2) << "in the middle alone";
  EXPECT_NE(out_.find("with positions off by nothing at samples, and accelerations up to 1m/s2"),
            std::string::npos)
      << out_;
  EXPECT_EQ(approaches(file, "--distance 30.01 --acceleration 1m/s2")[0]["certain"], true) << "at a sample";
  // A speed of 2 m/s takes each 10 m there and back.
  EXPECT_EQ(approaches(file, "--distance 9.99 --largest-speed 2m/s").size(), 0u);
  EXPECT_EQ(approaches(file, "--distance 10.01 --largest-speed 2m/s").size(), 1u);
  // Who goes at nearly that speed has little left for a detour: sqrt(10 * 10 * (10.5^2 - 10^2)) m.
  const std::string beside =
      write("beside.csv", "id,time,x_m,y_m\na,0,0,0\na,20,200,0\nb,0,0,80\nb,20,200,80\n");
  EXPECT_EQ(approaches(beside, "--distance 15.9 --largest-speed 10.5m/s").size(), 0u);
  EXPECT_EQ(approaches(beside, "--distance 16 --largest-speed 10.5m/s").size(), 1u);
  EXPECT_EQ(approaches(file, "--distance 9.99 --largest-speed 2m/s --acceleration 1m/s2").size(), 0u)
      << "the lesser of the two counts";
  EXPECT_EQ(approaches(file, "--distance 7.99 --largest-speed 2m/s --error 1m").size(), 0u);
  EXPECT_GT(approaches(file, "--distance 8.01 --acceleration 0.8m/s2 --error 1m").size(), 0u);
}

TEST_F(ErrorOption, LimitsThatSamplesBreakAreNamed) {
  const std::string file = write("t.csv", passing);
  const auto refused = [&](const std::string& options, std::initializer_list<std::string_view> parts) {
    expect_wrong_input("tracks " + file + " --distance 8 " + options, parts);
  };
  refused("--largest-speed 9m/s", {"--largest-speed: a moves by 10 at least around 0", "more than 9"});
  EXPECT_EQ(run("tracks " + file + " --distance 8 --largest-speed 9m/s --error 10m").exit_code, 0);
  refused("--largest-speed 20m/s --interpolate spline", {"--largest-speed: expected --interpolate linear"});
  refused("--acceleration 1m/s2 --outside stay", {"--acceleration: expected --outside vanish"});
  refused("--acceleration 1m/s2 --error 1m:1m/s", {"--error: expected LENGTH alone beside"});
  refused("--acceleration fast", {"--acceleration", "fast"});
  const std::string turn =
      write("turn.csv", "id,time,x_m,y_m\na,0,0,0\na,1,1,0\na,2,0,0\nb,0,9,9\nb,2,9,9\n");
  expect_wrong_input("tracks " + turn + " --distance 8 --acceleration 1.9m/s2",
                     {"--acceleration: a accelerates by 2 at least around 1"});
  EXPECT_EQ(run("tracks " + turn + " --distance 8 --acceleration 2m/s2").exit_code, 0);
  const std::string plain = write("p.csv", "id,time,x,y\na,0,0,0\na,1,0,0\nb,0,1,0\nb,1,1,0\n");
  expect_wrong_input("tracks " + plain + " --distance 8 --largest-speed 1kt",
                     {"--largest-speed: expected numbers without a unit"});
}

/// What a body does that keeps its limits: parts of a second with one acceleration or velocity each.
class LimitedWay {
 public:
  /// `by_speed`: `limit` is the largest speed, else the largest acceleration.
  LimitedWay(Random& random, bool by_speed, double limit, double end) {
    Vec3 position, velocity = random.unit_vector() * random.uniform(0.0, limit);
    for (double t = 0.0; t <= end; t += step) {
      positions_.push_back(position);
      const bool is_bold = random.uniform() < 0.7;
      const Vec3 drawn = random.unit_vector() * (is_bold ? limit : random.uniform(0.0, limit));
      if (random.uniform() < 0.1) push_ = drawn;
      velocity = by_speed ? push_ : velocity + push_ * step;
      position += by_speed ? velocity * step : (velocity - push_ * (0.5 * step)) * step;
    }
  }
  Vec3 at(double t) const { return positions_[static_cast<std::size_t>(std::lround(t / step))]; }
  static constexpr double step = 1.0 / 64;

 private:
  std::vector<Vec3> positions_;
  Vec3 push_;
};

TEST(PositionErrors, HoldForBodiesThatKeepTheirLimits) {
  constexpr std::uint64_t seed = 4711;
  Random random(seed);
  double nearest = 1.0;
  for (int round = 0; round < 400; ++round) {
    const bool by_speed = round % 2 == 0;
    const double limit = random.uniform(0.5, 3.0), off = round % 3 == 0 ? 0.0 : random.uniform(0.0, 0.3);
    const LimitedWay way(random, by_speed, limit, 16.0);
    PositionErrors errors{.at_samples = off, .samples = {{}}};
    (by_speed ? errors.speed_limit : errors.acceleration_limit) = limit;
    std::vector<TrackSample> samples;
    for (double t = 0.0; t < 16.0; t += std::ceil(random.uniform(0.1, 6.0) * 64) / 64)
      samples.push_back({t, way.at(t) + random.unit_vector() * (off * random.uniform())});
    for (std::size_t k = 0; k < samples.size(); ++k)
      errors.samples[0].push_back({samples[k].time, k + 1 < samples.size()
                                                        ? norm(samples[k + 1].position - samples[k].position)
                                                        : 0.0});
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
      const TrackSample &one = samples[k], &two = samples[k + 1];
      const double steepest = errors.steepest(0, one.time, two.time);
      for (double t = one.time; t < two.time; t += LimitedWay::step) {
        const double part = (t - one.time) / (two.time - one.time);
        const double away = norm(way.at(t) - (one.position * (1.0 - part) + two.position * part));
        ASSERT_LE(away, errors.at(0, t) + 1e-9) << "seed " << seed << ", round " << round << " at " << t;
        ASSERT_LE(errors.at(0, t), errors.largest(0, 0.0, samples.back().time) + 1e-12);
        ASSERT_LE(std::abs(errors.at(0, t + LimitedWay::step) - errors.at(0, t)),
                  steepest * LimitedWay::step + 1e-12);
        if (errors.at(0, t) > 0.1) nearest = std::min(nearest, 1.0 - away / errors.at(0, t));
      }
    }
  }
  EXPECT_LT(nearest, 0.02) << "the bounds are reached";
}

/// Random walks: an approach holds where errors may bring the two within the distance, and nowhere else.
TEST(PositionErrors, OfDenseSamplesAreThoseOfApproaches) {
  Random random(81);
  for (int round = 0; round < 20; ++round) {
    std::vector<Track> tracks(2);
    PositionErrors errors{.at_samples = 0.2, .growth = 0.5, .samples = {{}, {}}};
    for (std::size_t body = 0; body < 2; ++body) {
      for (double t = 0.0; t < 9.0; t += random.uniform(0.3, 2.0)) {
        tracks[body].push_back({t, {random.uniform(0, 6), random.uniform(0, 6), random.uniform(0, 3)}});
        errors.samples[body].push_back({t});
      }
    }
    const Scene scene = *scene_of_tracks(tracks, 1.0, Interpolation::spline);
    const double end = std::min(tracks[0].back().time, tracks[1].back().time);
    const std::vector<Approach> whole{{.first = 0, .second = 1, .begin = 0.0, .end = end}};
    const std::vector<RectangleBody> points(2);
    const auto found = approaches_of_rectangles(1.0, 1e-6, *scene.motion, points, whole, errors);
    for (double t = 0.0; t < end; t += 1e-3) {
      const double gap = distance_at(*scene.motion, points, 0, 1, t);
      const double off = errors.at(0, t) + errors.at(1, t);
      const auto holding =
          std::ranges::find_if(found, [t](const Approach& each) { return each.begin <= t && t <= each.end; });
      EXPECT_EQ(holding != found.end(), gap - off <= 1.0) << round << " at " << t;
      if (gap + off > 1.0 || holding == found.end()) continue;
      EXPECT_TRUE(holding->is_certain) << round << " at " << t;
    }
  }
}

}  // namespace
}  // namespace kinesphere::program::error_option_test
