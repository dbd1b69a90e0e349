// Errors of positions that grow between samples (--error): what is possible, and what is certain.
#include <fmt/format.h>

#include <cmath>
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

/// Random walks: an approach holds where errors may bring the two within the distance, and nowhere else.
TEST(PositionErrors, OfDenseSamplesAreThoseOfApproaches) {
  Random random(81);
  for (int round = 0; round < 20; ++round) {
    std::vector<Track> tracks(2);
    PositionErrors errors{.at_samples = 0.2, .growth = 0.5, .samples = {{}, {}}};
    for (std::size_t body = 0; body < 2; ++body) {
      for (double t = 0.0; t < 9.0; t += random.uniform(0.3, 2.0)) {
        tracks[body].push_back({t, {random.uniform(0, 6), random.uniform(0, 6), random.uniform(0, 3)}});
        errors.samples[body].push_back(t);
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
