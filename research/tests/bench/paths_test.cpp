// `kinesphere-bench paths`: arcs of satellites, and the table.
#include <cmath>
#include <regex>

#include "program/support.hpp"
#include "research/bench/arcs.hpp"

namespace kinesphere::program::bench_paths_test {
namespace {

class BenchPaths : public ProgramTest {};

double value_of(const Arcs& arcs, std::size_t arc, std::size_t axis, double u) {
  double sum = 0.0;
  for (std::size_t k = 0; k < arcs.terms; ++k)
    sum += arcs.coefficients[(3 * arc + axis) * arcs.terms + k] *
           std::cos(static_cast<double>(k) * std::acos(u));
  return sum;
}

TEST_F(BenchPaths, ArcsOfSatellitesFollowEachOther) {
  const Arcs arcs = satellite_arcs(40, 20'000.0, 3);
  ASSERT_EQ(arcs.errors.size(), 40u);
  std::size_t joints = 0;
  for (std::size_t arc = 0; arc + 1 < arcs.bodies.size(); ++arc) {
    if (arcs.bodies[arc] != arcs.bodies[arc + 1]) {
      EXPECT_EQ(arcs.ends[arc], 20'000.0);
      EXPECT_EQ(arcs.begins[arc + 1], 0.0);
      continue;
    }
    ++joints;
    EXPECT_EQ(arcs.ends[arc], arcs.begins[arc + 1]);
    double height = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double end = value_of(arcs, arc, axis, 1.0);
      EXPECT_NEAR(end, value_of(arcs, arc + 1, axis, -1.0), arcs.errors[0]);
      height = std::hypot(height, end);
    }
    EXPECT_GT(height, 6600.0);
  }
  EXPECT_GT(joints, 1000u);
}

TEST_F(BenchPaths, OneThreadAndTwoFindTheSame) {
  const std::string options = "paths --satellites 300 --seed 5 --hours 3 --distance 30 --turns 1";
  const ProgramRun drawn = run(options);
  EXPECT_EQ(drawn.exit_code, 0) << drawn.out << drawn.err;
  const std::regex facts("300 objects, .* arcs of 12 terms; 3 h within 30 km: [^\n]*|hash [0-9a-f]{16}");
  const auto facts_of = [&](const std::string& text) {
    std::vector<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), facts), end; match != end; ++match)
      found.push_back(match->str());
    return found;
  };
  EXPECT_EQ(facts_of(drawn.out).size(), 2u) << drawn.out;
  EXPECT_EQ(facts_of(drawn.out), facts_of(run(options).out));
  EXPECT_NE(drawn.out.find("times as fast"), std::string::npos) << drawn.out;
}

}  // namespace
}  // namespace kinesphere::program::bench_paths_test
