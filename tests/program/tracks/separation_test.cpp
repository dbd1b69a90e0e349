// `tracks --separation`: cylinders on the earth and in plain coordinates, and what they ask for.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "program/support.hpp"

namespace kinesphere::program::separation_test {
namespace {

class SeparationOf : public ProgramTest {
 protected:
  std::string found(const std::string& file, const std::string& options) const {
    const ProgramRun result = run("tracks '" + file + "' --verify " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
    const std::size_t at = result.out.find("\napproaches ");
    return at == std::string::npos ? result.err
                                   : result.out.substr(at + 19, result.out.find(' ', at + 19) - at - 19);
  }
};

/// Two aircraft pass head-on, 0.005 degrees (556 m) beside and `feet` above each other, at 200 m/s each.
std::string head_on(int feet) {
  return fmt::format(
      "icao24,time,lat,lon,alt_ft\nup,0,48,11,{0}\nup,100,48,11.269,{0}\nup,200,48,11.538,{0}\n"
      "down,0,48.005,11.538,35000\ndown,100,48.005,11.269,35000\ndown,200,48.005,11,35000\n",
      35000 + feet);
}

TEST_F(SeparationOf, CylindersNeedBothLimitsAtOnce) {
  EXPECT_EQ(found(write("a.csv", head_on(900)), "--separation cylinder:5NM:1000ft"), "1");
  EXPECT_EQ(found(write("b.csv", head_on(1001)), "--separation cylinder:5NM:1000ft"), "0");
  // Rounding does not decide about those that keep the limit.
  EXPECT_EQ(found(write("c.csv", head_on(1000)), "--separation cylinder:5NM:1000ft"), "1");
  EXPECT_EQ(found(path("a.csv"), "--separation cylinder:500m:1000ft"), "0");
  EXPECT_EQ(found(path("a.csv"), "--separation sphere:5NM"), "1");
  EXPECT_EQ(found(path("a.csv"), "--separation sphere:600m"), "0");
  EXPECT_EQ(found(path("a.csv"), "--separation 'cylinder 1km 1000ft' --only up --interpolate linear"), "1");
  const ProgramRun run_of = run("tracks " + path("a.csv") +
                                " --quiet --separation cylinder:5NM:1000ft --contacts " + path("c.jsonl"));
  ASSERT_EQ(run_of.exit_code, 0) << run_of.err;
  const auto row = nlohmann::json::parse(read_text(path("c.jsonl")));
  EXPECT_NEAR(row["horizontal_distance_m"].get<double>(), 556, 1);
  EXPECT_NEAR(row["vertical_distance_m"].get<double>(), 900 * 0.3048, 1e-6);
  // Horizontally within 9260 m: 2 sqrt(9260^2 - 556^2) / 400 m/s.
  EXPECT_NEAR(row["end"].get<double>() - row["begin"].get<double>(), 46.1, 0.2);
}

TEST_F(SeparationOf, AClimbThroughTheCylinderIsAnApproachOfItsOwn) {
  // One stays; the other hovers 5 beside it and goes up and down through its level twice.
  const std::string file = write("t.csv",
                                 "id,t,x,y,z\na,0,0,0,0\na,40,0,0,0\nb,0,3,4,-10\nb,10,3,4,10\nb,20,3,4,-10\n"
                                 "b,30,3,4,10\nb,40,3,4,-10\n");
  const std::string options = " --interpolate linear --max-gap 50 --contacts " + path("c.csv");
  EXPECT_EQ(found(file, "--separation cylinder:5.1:2" + options), "4");
  const std::string rows = read_text(path("c.csv"));
  EXPECT_NE(rows.find("\n3.9999995,6.000001,"), std::string::npos) << rows;
  EXPECT_EQ(found(file, "--separation cylinder:4.9:2" + options), "0");
  // The least distance in each is at the same level.
  const ProgramRun table = run("tracks " + file + " --separation cylinder:5.1:2" + options);
  EXPECT_NE(table.out.find("  horizontally    vertically  "), std::string::npos) << table.out;
}

TEST_F(SeparationOf, WhatIsMissingIsAskedFor) {
  const std::string plain = write("p.csv", "id,t,x,y\na,0,0,0\na,1,0,0\nb,0,1,0\nb,1,1,0\n");
  const std::string plane = "tracks " + plain;
  expect_wrong_input(plane, {"--distance LENGTH", "--separation"});
  expect_wrong_input(plane + " --distance 1 --separation sphere:1", {"either --distance", "--separation"});
  expect_wrong_input(plane + " --separation cylinder:1:1", {"--separation", "heights (z or alt)"});
  expect_wrong_input(plane + " --separation sphere:1km", {"--separation", "'sphere:1km'", "--unit"});
  expect_wrong_input(plane + " --separation ellipsoid:1:1", {"--separation", "'ellipsoid:1:1'"});
  expect_wrong_input(plane + " --separation sphere:1:60", {"--separation", "no time", "'sphere:1:60'"});
  expect_wrong_input(plane + " --separation cube:1", {"--separation", "'cube:1'"});
  const std::string far = "tracks " + write("f.csv",
                                            "id,time,lat,lon,alt_ft\na,0,48,0,0\na,10,48,0.01,0\n"
                                            "b,0,48,20,0\nb,10,48,20.01,0\n");
  expect_wrong_input(far + " --separation cylinder:5NM:1000ft", {"--projection plane", "490 km"});
  EXPECT_EQ(run(far + " --separation cylinder:5NM:1000ft --projection plane").exit_code, 0);
  expect_wrong_input(far + " --separation cylinder:5NM:1000ft --projection earth", {"--projection", "plane"});
}

}  // namespace
}  // namespace kinesphere::program::separation_test
