// Bodies with a size (--sizes): distances between surfaces, times to collision, questions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "kinesphere/random.hpp"
#include "program/support.hpp"
#include "simulation/tracks/rectangles.hpp"

namespace kinesphere::program::sizes_test {
namespace {

class SizesOf : public ProgramTest {
 protected:
  nlohmann::json pair_;  ///< the last row of --pairs
};

/// A car brakes behind a standing one: 20 m at 10 m/s, then 5 m/s. Its diagonal is 5, that of the other 10.
constexpr std::string_view braking =
    "id,time,x_m,y_m,length_ft,width_m\n"
    "car,0,0,0,13.123359580052494,3\ncar,2,20,0,13.123359580052494,3\ncar,4,30,0,13.123359580052494,3\n"
    "bus,0,50,0,26.246719160104988,6\nbus,2,50,0,,6\nbus,4,50,0,26.246719160104988,0\n";

TEST_F(SizesOf, DistancesAreBetweenSurfaces) {
  const std::string file = write("t.csv", braking);
  const std::string options = " --distance 100 --interpolate linear --verify --pairs " + path("p.jsonl");
  ASSERT_EQ(run("tracks " + file + options).exit_code, 0);
  auto pair = nlohmann::json::parse(read_text(path("p.jsonl")));
  EXPECT_NEAR(pair["least_distance_m"].get<double>(), 20.0, 1e-9);
  EXPECT_FALSE(pair.contains("least_time_to_collision_s"));
  const ProgramRun sized = run("tracks " + file + options + " --sizes --minima " + path("m.jsonl"));
  ASSERT_EQ(sized.exit_code, 0) << sized.err << sized.out;
  EXPECT_NE(sized.out.find("\nsizes             2 "), std::string::npos) << sized.out;
  EXPECT_NE(sized.out.find("  of the tracks, the largest of radius 5;"), std::string::npos) << sized.out;
  EXPECT_NE(sized.out.find("\nheadings          1 "), std::string::npos) << sized.out;
  pair = nlohmann::json::parse(read_text(path("p.jsonl")));
  // The bus never moves, so that it may stand in any direction; the car is 2 m long before its middle.
  EXPECT_NEAR(pair["least_distance_m"].get<double>(), 13.0, 1e-9);
  EXPECT_NEAR(nlohmann::json::parse(read_text(path("m.jsonl")))["distance_m"].get<double>(), 13.0, 1e-9);
  // Just before it brakes at 2 s, 23 m are left at 10 m/s; later 13 m at 5 m/s.
  EXPECT_NEAR(pair["least_time_to_collision_s"].get<double>(), 2.3, 1e-6);
  EXPECT_NEAR(pair["time_of_that"].get<double>(), 2.0, 1e-6);
  EXPECT_NEAR(pair["deceleration_to_avoid_crash_mps2"].get<double>(), 10.0 / (2.0 * 2.3), 1e-6);
}

TEST_F(SizesOf, NeverOnACourseOfCollisionIsEmpty) {
  const std::string file = write("t.csv",
                                 "id,time,x_m,y_m,length_m,width_m\na,0,0,0,4,3\na,2,20,0,4,3\n"
                                 "b,0,0,20,4,3\nb,2,20,20,4,3\n");
  ASSERT_EQ(run("tracks " + file + " --sizes --distance 100 --pairs " + path("p.csv")).exit_code, 0);
  const std::string rows = read_text(path("p.csv"));
  EXPECT_NE(rows.find("\na,b,1,2,17,0,,,,,,\n"), std::string::npos) << rows;
}

/// Spheres with heights: a rectangle does not say how high it is.
/// Two bodies of 4 m by 3 m that go along x, beside and above each other.
TEST_F(SizesOf, WithHeightsAreUprightBoxes) {
  const auto least_distance = [&](double beside, double above, double height) {
    std::string rows = "id,time,x_m,y_m,z_m,length_m,width_m,body_height_m\n";
    for (int k = 0; k < 3; ++k)
      rows +=
          fmt::format("a,{0},{1},0,0,4,3,{3}\nb,{0},{1},{2},{4},4,3,{3}\n", k, 10 * k, beside, height, above);
    const ProgramRun result =
        run("tracks " + write("t.csv", rows) + " --sizes --distance 100 --pairs " + path("p.jsonl"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    pair_ = nlohmann::json::parse(read_text(path("p.jsonl")));
    return pair_["least_distance_m"].get<double>();
  };
  EXPECT_NEAR(least_distance(20.0, 0.0, 1.5), 17.0, 1e-9) << "a sphere around each would leave 15";
  EXPECT_NEAR(least_distance(0.5, 6.0, 1.5), 4.5, 1e-9) << "on a bridge";
  EXPECT_NEAR(least_distance(0.5, 6.0, 0.0), 6.0, 1e-9) << "of unknown heights";
  EXPECT_NEAR(least_distance(6.0, 5.5, 1.5), 5.0, 1e-9) << "3 m beside and 4 m above";
  EXPECT_NEAR(least_distance(2.0, 0.75, 1.5), -0.75, 1e-9)
      << "0.75 m upwards parts the two, 1 m to the side too";
  EXPECT_EQ(pair_["least_time_to_collision_s"], 0.0);
  // Towers whose middles are far apart.
  const std::string towers = write("h.csv",
                                   "id,time,x_m,y_m,z_m,length_m,width_m,body_height_m\na,0,0,0,0,1,1,20\n"
                                   "a,1,0,0,0,1,1,20\nb,0,0,0,25,1,1,20\nb,1,0,0,25,1,1,20\n");
  ASSERT_EQ(run("tracks " + towers + " --sizes --distance 6 --pairs " + path("p.jsonl")).exit_code, 0);
  EXPECT_NEAR(nlohmann::json::parse(read_text(path("p.jsonl")))["least_distance_m"].get<double>(), 5.0, 1e-9);
}

TEST_F(SizesOf, HeightsApartAreNoCourseOfCollision) {
  const auto seconds_left = [&](double above, const char* height) {
    std::string rows =
        fmt::format("id,time,x_m,y_m,z_m,length_m,width_m{}\n", *height == '\0' ? "" : ",body_height_m");
    for (int k = 0; k < 3; ++k)
      rows += fmt::format("a,{0},{1},0,0,4,2{3}\nb,{0},50,0,{2},4,2{3}\n", k, 10 * k, above, height);
    EXPECT_EQ(run("tracks " + write("t.csv", rows) + " --sizes --heading motion --distance 100 --pairs " +
                  path("p.jsonl"))
                  .exit_code,
              0);
    return nlohmann::json::parse(read_text(path("p.jsonl")))["least_time_to_collision_s"];
  };
  // b stands, and is a disc of its half diagonal: 50 m - 20 m - 2 m - sqrt(5) m at 10 m/s.
  EXPECT_NEAR(seconds_left(0.5, ",1.5").get<double>(), (28.0 - std::sqrt(5.0)) / 10.0, 1e-6);
  EXPECT_TRUE(seconds_left(2.0, ",1.5").is_null()) << "it passes below";
  EXPECT_NEAR(seconds_left(0.5, "").get<double>(), (28.0 - std::sqrt(5.0)) / 10.0, 1e-6)
      << "without heights of the bodies they are seen from above";
}

/// Points of two convex bodies that are projected upon the other in turn come to the nearest ones.
TEST(UprightBoxes, AreAsFarApartAsTheirNearestPoints) {
  Random random(19);
  const auto drawn = [&] { return random.uniform(0.2, 3.0); };
  int apart = 0, above = 0;
  for (int round = 0; round < 3000; ++round) {
    const RectangleBody first{.length = drawn(), .width = drawn(), .height = drawn()},
        second{.length = drawn(), .width = drawn(), .height = drawn()};
    const auto place = [&] { return Vec3{random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4)}; };
    const RectanglePose at{place(), {}, random.uniform(0, 6)}, other{place(), {}, random.uniform(0, 6)};
    const auto nearest_in = [](const RectangleBody& body, const RectanglePose& pose, const Vec3& point) {
      const Vec3 along{std::cos(pose.heading), std::sin(pose.heading), 0}, across{-along.y, along.x, 0};
      const Vec3 way = point - pose.position;
      return pose.position + std::clamp(dot(way, along), -0.5 * body.length, 0.5 * body.length) * along +
             std::clamp(dot(way, across), -0.5 * body.width, 0.5 * body.width) * across +
             Vec3{0, 0, std::clamp(way.z, -0.5 * body.height, 0.5 * body.height)};
    };
    Vec3 one = at.position, two = other.position;
    for (int step = 0; step < 4000; ++step) {
      two = nearest_in(second, other, one);
      one = nearest_in(first, at, two);
    }
    const double gap = gap_between(first, at, second, other), distance = norm(two - one);
    // They come slowly to where the two nearly touch.
    ASSERT_GE(distance, gap - 1e-9) << "round " << round;
    ASSERT_LE(distance, std::max(gap, 0.0) + 0.02) << "round " << round;
    ASSERT_NEAR(gap, gap_between(second, other, first, at), 1e-12);
    apart += gap > 0.0 ? 1 : 0;
    above += std::abs(at.position.z - other.position.z) > 0.5 * (first.height + second.height) ? 1 : 0;
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(above, 300);
  EXPECT_LT(apart, 2900);
}

/// SUMO writes sizes as attributes of vehicles, or has them in the types.
TEST_F(SizesOf, OfFcdInXmlAreThoseOfItsVehiclesOrTypes) {
#ifndef KINESPHERE_WITH_EXPAT
  GTEST_SKIP() << "built without expat";
#endif
  const auto least_distance = [&](const std::string& begin, const std::string& attributes) {
    std::string text = "<fcd-export>\n" + begin;
    for (int k = 0; k < 3; ++k)
      text += fmt::format(
          "<timestep time=\"{0}\"><vehicle id=\"a\" x=\"{1}\" y=\"0\" angle=\"90\" type=\"car\" "
          "speed=\"10\"{2}/>"
          "<vehicle id=\"b\" x=\"{3}\" y=\"0\" angle=\"90\" type=\"car\" speed=\"10\"{2}/></timestep>\n",
          k, 10 * k, attributes, 10 * k + 30);
    const ProgramRun result = run("tracks " + write("f.xml", text + "</fcd-export>\n") +
                                  " --sizes --unit m --distance 100 --pairs " + path("p.jsonl"));
    if (result.exit_code != 0) return result.err;
    return read_text(path("p.jsonl"));
  };
  const std::string behind = "\"least_distance_m\": 25,";
  const auto says = [](const std::string& text, std::string_view part) {
    return text.find(part) != text.npos ? std::string("yes") : text;
  };
  EXPECT_EQ(says(least_distance("", " length=\"5\" width=\"1.8\""), behind), "yes")
      << "from its tail to the next front";
  EXPECT_EQ(says(least_distance("<vType id=\"car\" length=\"5\" width=\"1.8\"/>\n", ""), behind), "yes");
  EXPECT_EQ(says(least_distance("", ""), "expected columns of length and width for --sizes"), "yes");
}

TEST_F(SizesOf, PostEncroachmentTimeIsThatOfTheRectangles) {
  // One is out of the other's lane at 5.7 s, which the other enters 1.4 m before the crossing at 8 s.
  const std::string file = write("t.csv",
                                 "id,time,x_m,y_m,length_m,width_m\na,0,-10,0,1.6,1.2\na,10,10,0,1.6,1.2\n"
                                 "b,0,0,-8,1.6,1.2\nb,10,0,2,1.6,1.2\n");
  const std::string options = " --sizes --distance 100 --interpolate linear --pairs " + path("p.jsonl");
  ASSERT_EQ(run("tracks " + file + options).exit_code, 0);
  const auto pair = nlohmann::json::parse(read_text(path("p.jsonl")));
  EXPECT_NEAR(pair["post_encroachment_time_s"].get<double>(), 6.6 - 5.7, 1e-4);
  EXPECT_NEAR(pair["time_of_entry"].get<double>(), 6.6, 1e-4);
}

/// Overtaking in the next lane is no collision, and one that follows enters no place of a conflict.
TEST_F(SizesOf, CarsInLanesAreNoConflict) {
  std::string table = "time,id,x_m,y_m,length_m,width_m\n";
  for (int k = 0; k <= 100; ++k) {
    const double t = 0.1 * k;
    table += fmt::format("{0},fast,{1},0,5,2\n{0},slow,{2},3.5,5,2\n{0},behind,{3},0,5,2\n", t, 20 * t,
                         50 + 10 * t, -30 + 20 * t);
  }
  const std::string file = write("t.csv", table), pairs = path("p.jsonl");
  ASSERT_EQ(run("tracks " + file + " --sizes --distance 40 --pairs " + pairs).exit_code, 0);
  std::istringstream lines(read_text(pairs));
  int seen = 0;
  for (std::string line; std::getline(lines, line); ++seen) {
    const auto pair = nlohmann::json::parse(line);
    const bool is_lane = pair["first"] != "slow" && pair["second"] != "slow";
    EXPECT_NEAR(pair["least_distance_m"].get<double>(), is_lane ? 25.0 : 1.5, 1e-9) << line;
    for (const char* never :
         {"least_time_to_collision_s", "post_encroachment_time_s", "deceleration_to_avoid_crash_mps2"})
      EXPECT_TRUE(pair[never].is_null()) << line;
  }
  EXPECT_EQ(seen, 3);
}

/// Two cars at 4 m: one crosses the other's front. Returns a table whose headings are told by `heading` from
/// radians counterclockwise from x.
std::string with_headings(const std::string& name, const std::function<double(double)>& heading) {
  std::string table = "id,time,x_m,y_m,length_m,width_m," + name + "\n";
  for (int k = 0; k <= 20; ++k) {
    const double t = 0.5 * k;
    table += fmt::format("a,{0},{1},0,4,2,{2}\nb,{0},40,{3},4,2,{4}\n", t, 3 * t, heading(0.0), 20 - 3 * t,
                         heading(-1.5707963267948966));
  }
  return table;
}

TEST_F(SizesOf, HeadingsCountAsTheMotionShows) {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  const std::pair<std::string, std::function<double(double)>> kinds[] = {
      {"heading", [](double angle) { return angle / degree; }},
      {"heading", [](double angle) { return angle; }},
      {"yaw_deg", [](double angle) { return angle / degree; }},
      {"psi_rad", [](double angle) { return angle + 6.283185307179586; }},
      {"heading", [](double angle) { return 90.0 - angle / degree; }},
      {"course", [](double angle) { return 450.0 - angle / degree; }}};
  const auto least_distance = [&](const std::string& options) {
    const ProgramRun result = run("tracks " + path("t.csv") + " --sizes --distance 50 --interpolate linear " +
                                  options + " --pairs " + path("p.jsonl"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(read_text(path("p.jsonl")))["least_distance_m"].get<double>();
  };
  for (const auto& [name, heading] : kinds) {
    write("t.csv", with_headings(name, heading));
    EXPECT_NEAR(least_distance(""), least_distance("--heading motion"), 1e-6) << name;
  }
  // A car that slides sideways fits nothing: the program asks, and an option answers.
  write("t.csv", with_headings("heading", [&](double angle) { return angle / degree + 45.0; }));
  expect_wrong_input("tracks " + path("t.csv") + " --sizes --distance 50",
                     {"column 'heading' may count from the x axis", "--heading x-axis or --heading compass"});
  write("t.csv", with_headings("heading_deg", [&](double angle) { return angle / degree + 45.0; }));
  EXPECT_GT(std::abs(least_distance("--heading x-axis") - least_distance("--heading motion")), 0.1);
  write("t.csv", braking);
  expect_wrong_input("tracks " + path("t.csv") + " --sizes --distance 50 --heading compass",
                     {"--heading: expected a column of headings"});
}

TEST_F(SizesOf, QuaternionsAreHeadings) {
  // Two boxes of 4 m by 2 m that slide to the side, turned by 90 degrees: 10 m apart along x.
  std::string rows;
  for (int k = 0; k <= 10; ++k) {
    const double w = std::sqrt(0.5), t = 0.1 * k, x = 2.0 * k;
    rows += fmt::format(
        "{{\"id\":\"a\",\"time\":{0},\"translation\":[{1},0,0.7],\"size\":[2,4,1.5],\"rotation\":[{2},0,0,{2}"
        "]}}\n"
        "{{\"id\":\"b\",\"time\":{0},\"translation\":[{3},0,0.7],\"size\":[2,4,1.5],\"rotation\":[{2},0,0,{2}"
        "]}}\n",
        t, x, w, x + 10.0);
  }
  const std::string file = write("n.json", rows);
  const std::string options =
      " --columns id=id,time=time,x=translation.0:m,y=translation.1:m,length=size.1:m,width=size.0:m --sizes "
      "--distance 20 --pairs " +
      path("p.jsonl");
  ASSERT_EQ(run("tracks " + file + options).exit_code, 0);
  EXPECT_NEAR(nlohmann::json::parse(read_text(path("p.jsonl")))["least_distance_m"].get<double>(), 8.0, 1e-6);
  ASSERT_EQ(run("tracks " + file + options + " --heading motion").exit_code, 0);
  EXPECT_NEAR(nlohmann::json::parse(read_text(path("p.jsonl")))["least_distance_m"].get<double>(), 6.0, 1e-6);
}

/// Positions of SUMO are those of the front, of highD those of a corner; cars on one spot stand in a column.
TEST_F(SizesOf, PresetsKnowWhereOnTheCarItsPositionIs) {
  std::string sumo =
      "timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_angle;vehicle_length;vehicle_width\n";
  std::string highd = "frame,id,x,y,width,height,xVelocity,yVelocity\n";
  for (int k = 0; k <= 20; ++k) {
    sumo += fmt::format("{0};a;{1};0;90;5;2\n{0};b;{2};0;90;15;2\n", k, 10 * k, 40 + 10 * k);
    highd += fmt::format("{0},1,{1},10,5,2,10,0\n{0},2,{2},12,15,3,10,0\n", k, k, 8 + k);
  }
  const auto least_distance = [&](const std::string& file, const std::string& options) {
    const ProgramRun result =
        run("tracks " + file + " --sizes --distance 50 --pairs " + path("p.jsonl") + " " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(read_text(path("p.jsonl")))["least_distance_m"].get<double>();
  };
  EXPECT_NEAR(least_distance(write("s.csv", sumo), "--positions plane --unit m"), 40.0 - 15.0, 1e-6);
  // 0 to 5 and 8 to 23 along, 10 to 12 and 12 to 15 across.
  EXPECT_NEAR(least_distance(write("h.csv", highd), ""), 3.0, 1e-6);
}

TEST_F(SizesOf, WhatIsMissingIsAskedFor) {
  const std::string plain = write("p.csv", "id,time,x,y\na,0,0,0\na,1,0,0\nb,0,1,0\nb,1,1,0\n");
  expect_wrong_input("tracks " + plain + " --distance 1 --sizes", {"p.csv", "length and width", "--sizes"});
  const std::string unit = write("u.csv", "id,time,x_m,y_m,length,width\na,0,0,0,1,1\na,1,0,0,1,1\n");
  expect_wrong_input("tracks " + unit + " --distance 1 --sizes", {"'length' does not say its unit"});
  const std::string ships =
      write("s.csv",
            "MMSI,BaseDateTime,LAT,LON,Length,Width\n1,2024-05-01T00:00:00,54,8,100,20\n"
            "1,2024-05-01T00:01:00,54,8,100,20\n");
  expect_wrong_input("tracks " + ships +
                         " --distance 1 --sizes --columns "
                         "id=MMSI,time=BaseDateTime,lon=LON,lat=LAT,length=Length,width=Width",
                     {"antenna"});
  // Without --sizes such columns are not used, whatever their units.
  EXPECT_EQ(run("tracks " + unit + " --distance 1").exit_code, 0);
}

}  // namespace
}  // namespace kinesphere::program::sizes_test
