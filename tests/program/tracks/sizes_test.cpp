// Bodies with a size (--sizes): distances between surfaces, times to collision, questions.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program/support.hpp"

namespace kinesphere::program::sizes_test {
namespace {

class SizesOf : public ProgramTest {};

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
  pair = nlohmann::json::parse(read_text(path("p.jsonl")));
  EXPECT_NEAR(pair["least_distance_m"].get<double>(), 12.5, 1e-9);
  EXPECT_NEAR(nlohmann::json::parse(read_text(path("m.jsonl")))["distance_m"].get<double>(), 12.5, 1e-9);
  // Just before it brakes at 2 s, 22.5 m are left at 10 m/s; later 12.5 m at 5 m/s.
  EXPECT_NEAR(pair["least_time_to_collision_s"].get<double>(), 2.25, 1e-9);
  EXPECT_NEAR(pair["time_of_that"].get<double>(), 2.0, 1e-9);
}

TEST_F(SizesOf, NeverOnACourseOfCollisionIsEmpty) {
  const std::string file = write("t.csv",
                                 "id,time,x_m,y_m,length_m,width_m\na,0,0,0,4,3\na,2,20,0,4,3\n"
                                 "b,0,0,20,4,3\nb,2,20,20,4,3\n");
  ASSERT_EQ(run("tracks " + file + " --sizes --distance 100 --pairs " + path("p.csv")).exit_code, 0);
  const std::string rows = read_text(path("p.csv"));
  EXPECT_NE(rows.find("\na,b,1,2,15,0,,,,\n"), std::string::npos) << rows;
}

TEST_F(SizesOf, PostEncroachmentTimeIsThatOfTheDiscs) {
  // Discs of radius 1; the second passes the crossing 3 s after the first, at half its speed.
  const std::string file = write("t.csv",
                                 "id,time,x_m,y_m,length_m,width_m\na,0,-10,0,1.6,1.2\na,10,10,0,1.6,1.2\n"
                                 "b,0,0,-8,1.6,1.2\nb,10,0,2,1.6,1.2\n");
  const std::string options = " --sizes --distance 100 --interpolate linear --pairs " + path("p.jsonl");
  ASSERT_EQ(run("tracks " + file + options).exit_code, 0);
  const auto pair = nlohmann::json::parse(read_text(path("p.jsonl")));
  EXPECT_NEAR(pair["post_encroachment_time_s"].get<double>(), 3.0 - std::sqrt(5.0), 1e-5);
  EXPECT_NEAR(pair["time_of_entry"].get<double>(), 8.0 - 4.0 / std::sqrt(5.0), 1e-2);
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
