// `kinesphere-bench paths`: arcs of satellites, arcs from a file, and the table.
#include <cmath>
#include <cstring>
#include <regex>

#include "program/support.hpp"
#include "research/bench/arcs.hpp"

namespace kinesphere::program::bench_paths_test {
namespace {

class BenchPaths : public ProgramTest {
 protected:
  /// Writes a file as conjunctions.py does.
  std::string write_arcs(const Arcs& arcs, std::string_view rest = "") const {
    std::string bytes = "KSARCS01";
    const auto append = [&](const auto& numbers) {
      bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(numbers[0]));
    };
    append(std::vector<std::uint64_t>{arcs.errors.size(), arcs.bodies.size(), arcs.terms});
    append(arcs.errors);
    append(arcs.bodies);
    append(arcs.begins);
    append(arcs.ends);
    append(arcs.coefficients);
    return write("arcs", bytes.append(rest));
  }
};

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

TEST_F(BenchPaths, ArcsOfAFileGiveTheSameTable) {
  const Arcs arcs = satellite_arcs(300, 3 * 3600.0, 5);
  const ProgramRun drawn = run("paths --satellites 300 --seed 5 --hours 3 --distance 30 --turns 1");
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  const std::string file = write_arcs(arcs);
  const ProgramRun read = run("paths " + file + " --hours 3 --distance 30 --turns 1");
  EXPECT_EQ(read.exit_code, 0) << read.err;
  const std::regex facts("300 objects, .* arcs of 12 terms; 3 h within 30 km: [^\n]*|hash [0-9a-f]{16}");
  std::vector<std::string> found[2];
  for (int k = 0; k < 2; ++k) {
    const std::string& text = k == 0 ? drawn.out : read.out;
    for (std::sregex_iterator match(text.begin(), text.end(), facts), end; match != end; ++match)
      found[k].push_back(match->str());
  }
  EXPECT_EQ(found[0].size(), 2u) << drawn.out;
  EXPECT_EQ(found[0], found[1]);
  EXPECT_NE(drawn.out.find("times as fast"), std::string::npos) << drawn.out;
}

TEST_F(BenchPaths, DamagedFilesAreRefused) {
  const Arcs arcs = satellite_arcs(2, 600.0, 1);
  expect_wrong_input("paths " + path("none"), {path("none"), "cannot be read"});
  expect_wrong_input("paths " + write("text", "first,second\n1,2,3"), {"text", "begins otherwise"});
  expect_wrong_input("paths " + write_arcs(arcs, "x"), {"arcs", "goes on"});
  Arcs shorter = arcs;
  shorter.coefficients.pop_back();
  expect_wrong_input("paths " + write_arcs(shorter), {"arcs", "ends too early"});
}

}  // namespace
}  // namespace kinesphere::program::bench_paths_test
