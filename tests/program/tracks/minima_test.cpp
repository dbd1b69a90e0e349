// All local minima of distance (--minima), the frames of moving bodies, and marks of absurd speeds.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "program/support.hpp"
#include "tracks/own_frame.hpp"

namespace kinesphere::program::minima_test {
namespace {

class MinimaOf : public ProgramTest {
 protected:
  std::vector<nlohmann::json> minima(const std::string& file, const std::string& options) const {
    const ProgramRun result =
        run("tracks '" + file + "' --quiet --minima '" + path("m.jsonl") + "' " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::istringstream lines(read_text(path("m.jsonl")));
    std::vector<nlohmann::json> rows;
    for (std::string line; std::getline(lines, line);) rows.push_back(nlohmann::json::parse(line));
    return rows;
  }
};

TEST_F(MinimaOf, OneApproachMayHaveManyMinima) {
  // The second turns around the first 12 times, never farther than 20.
  std::string text = "id,t,x,y\n";
  for (int k = 0; k <= 480; ++k) {
    const double phase = 2.0 * std::numbers::pi * 12.0 * k / 480.0;
    text += "a," + std::to_string(k) + "," + std::to_string(2 * k) + ",0\n";
    text += "b," + std::to_string(k) + "," + std::to_string(2 * k + 8 + 2 * std::sin(phase)) + "," +
            std::to_string(std::cos(phase)) + "\n";
  }
  const auto rows = minima(write("t.csv", text), "--distance 20");
  // The distance falls toward neither end: it rises from the first sample on.
  ASSERT_EQ(rows.size(), 13u);
  EXPECT_EQ(rows[0]["time"], 0);
  EXPECT_EQ(rows[0]["cut_off"], true);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k]["cut_off"], false);
    EXPECT_EQ(rows[k]["approach"], 1);
    EXPECT_NEAR(rows[k]["time"].get<double>(), 40.0 * static_cast<double>(k) - 10.0, 1e-3) << k;
    EXPECT_NEAR(rows[k]["distance"].get<double>(), 6.0, 1e-4) << k;
    EXPECT_NEAR(rows[k]["from_first_along"].get<double>(), 6.0, 1e-4) << k;
    EXPECT_NEAR(rows[k]["from_first_right"].get<double>(), 0.0, 1e-3) << k;
  }
}

TEST_F(MinimaOf, EachBodySeesTheOtherInItsOwnFrame) {
  // The first goes north and climbs, the second goes east, 5 east and 3 above it at 10 s; no unit is known.
  const std::string file = write("t.csv",
                                 "id,t,x,y,z\na,0,0,-10,-10\na,10,0,0,0\na,20,0,10,10\n"
                                 "b,0,-5,0,3\nb,10,5,0,3\nb,20,15,0,3\nc,0,0,0,0\nc,10,0,0,0\nc,20,0,0,0\n");
  const auto rows = minima(file, "--distance 20 --from 10 --until 10.0001 --only a");
  ASSERT_EQ(rows.size(), 2u);
  const nlohmann::json& row = rows[0]["second"] == "b" ? rows[0] : rows[1];
  const nlohmann::json& other = rows[0]["second"] == "b" ? rows[1] : rows[0];
  const double root = std::sqrt(0.5);
  for (const auto& [column, value] :
       std::initializer_list<std::pair<const char*, double>>{{"relative_x", 5},
                                                             {"relative_y", 0},
                                                             {"relative_z", 3},
                                                             {"relative_vx", 1},
                                                             {"relative_vy", -1},
                                                             {"relative_vz", -1},
                                                             {"from_first_along", 3 * root},
                                                             {"from_first_right", 5},
                                                             {"from_first_up", 3 * root},
                                                             {"from_first_v_along", -2 * root},
                                                             {"from_first_v_right", 1},
                                                             {"from_first_v_up", 0},
                                                             {"from_second_along", -5},
                                                             {"from_second_right", 0},
                                                             {"from_second_up", -3},
                                                             {"from_second_v_along", -1},
                                                             {"from_second_v_right", -1},
                                                             {"from_second_v_up", 1}})
    EXPECT_NEAR(row[column].get<double>(), value, 1e-3) << column;
  // Who is at rest sees nothing along.
  EXPECT_TRUE(other["from_second_along"].is_null());
  EXPECT_FALSE(other["from_first_along"].is_null());
}

TEST_F(MinimaOf, PlacesOnTheEarthAreEastNorthAndUp) {
  // Far from the middle of the data the axes of the plane are not those of the place.
  const std::string file = write(
      "t.csv",
      "id,time,lon,lat,alt\na,0,5,60,1000\na,60,5,60.01,1000\nb,0,5.01,60.005,1100\nb,60,5.01,60.005,1100\n"
      "c,0,15,60,0\nc,60,15,60.01,0\n");
  for (const char* projection : {"plane", "earth"}) {
    const auto rows =
        minima(file, "--distance 3km --interpolate linear --projection " + std::string(projection));
    ASSERT_EQ(rows.size(), 1u) << projection;
    EXPECT_NEAR(rows[0]["relative_x_m"].get<double>(), 558, 2) << projection;
    EXPECT_NEAR(rows[0]["relative_y_m"].get<double>(), 0, 2) << projection;
    EXPECT_NEAR(rows[0]["relative_z_m"].get<double>(), 100, 1) << projection;
    EXPECT_NEAR(rows[0]["from_first_right_m"].get<double>(), 558, 2) << projection;
    EXPECT_NEAR(rows[0]["from_first_up_m"].get<double>(), 100, 1) << projection;
  }
}

TEST(OwnFrame, HasNoRightWhereABodyMovesVertically) {
  EXPECT_FALSE(own_frame({0, 0, 0}, {0, 0, 1}, 1.0));
  const auto climbs = own_frame({0, 0, 2}, {0, 0, 1}, 1.0);
  ASSERT_TRUE(climbs);
  EXPECT_EQ(climbs->along, (Vec3{0, 0, 1}));
  EXPECT_FALSE(climbs->right || climbs->up);
}

TEST_F(MinimaOf, AbsurdSpeedsAreMarkedInTheTable) {
  // Of a, one sample lies 500 km off, beside c; d is fast, but always.
  std::string text = "id,t,x,y\n";
  for (int k = 0; k < 20; ++k) {
    const std::string t = std::to_string(10 * k), x = std::to_string(100 * k);
    text += "a," + t + "," + (k == 10 ? "500000" : x) + ",0\n";
    text += "b," + t + "," + x + ",400\n";
    text += "c," + t + ",500000," + std::to_string(10 * k - 95) + "\n";
    text += "d," + t + "," + std::to_string(3000 * k - 30000) + ",600\n";
  }
  const std::string file = write("t.csv", text);
  const ProgramRun result = run("tracks " + file + " --distance 500 --interpolate linear");
  EXPECT_NE(result.out.find("  a (?) c\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("  a b\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("  b d\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\n(?) samples around that time imply"), std::string::npos) << result.out;
  const std::string usual =
      run("tracks " + file + " --distance 500 --interpolate linear --max-speed 400").out;
  EXPECT_EQ(usual.find("(?)"), std::string::npos) << usual;
}

}  // namespace
}  // namespace kinesphere::program::minima_test
