// The contact log, and its rows of CSV and JSON lines.
#include "scenes/contact_log.hpp"

#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support.hpp"

namespace kinesphere::program::contact_log_test {
namespace {

using ContactLogTest = FolderTest;

Event contact() {
  return {.kind = EventKind::contact_begin,
          .time = 0.1,
          .first = {3, 0},
          .second = {7, 0},
          .repeated = true,
          .point = {1, 2, 3},
          .normal = {0, 0, 1},
          .gap = 1e-7,
          .approach_speed = 1.0 / 3.0};
}

Event wall_contact() {
  return {
      .kind = EventKind::wall_begin, .time = 2, .first = {3, 0}, .wall = Wall::x_upper, .normal = {1, 0, 0}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> logged(const std::string& path) {
  ContactLog log(path);
  log.write(contact());
  log.write(wall_contact());
  log.commit();
  return lines_of(read_text(path));
}

TEST_F(ContactLogTest, WritesCsv) {
  const auto lines = logged(path("log.csv"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "time,kind,first,second,wall,gap,approach_speed,point_x,point_y,point_z,normal_x,normal_y,normal_"
            "z,repeated,"
            "already_touching,position_excess,velocity_excess");
  EXPECT_EQ(lines[1], "0.1,contact_begin,3,7,,1e-07,0.3333333333333333,1,2,3,0,0,1,true,false,0,0");
  EXPECT_EQ(lines[2], "2,wall_begin,3,,x_upper,0,0,0,0,0,1,0,0,false,false,0,0");
}

TEST_F(ContactLogTest, WritesJsonLines) {
  const auto lines = logged(path("log.jsonl"));
  ASSERT_EQ(lines.size(), 2u);
  const auto first = nlohmann::json::parse(lines[0]);
  EXPECT_EQ(first.at("time").get<double>(), 0.1);
  EXPECT_EQ(first.at("kind"), "contact_begin");
  EXPECT_EQ(first.at("second"), 7);
  EXPECT_TRUE(first.at("wall").is_null());
  EXPECT_EQ(first.at("approach_speed").get<double>(), 1.0 / 3.0);
  EXPECT_EQ(first.at("repeated"), true);
  const auto second = nlohmann::json::parse(lines[1]);
  EXPECT_TRUE(second.at("second").is_null());
  EXPECT_EQ(second.at("wall"), "x_upper");
}

TEST_F(ContactLogTest, WantsAnEndingThatItKnows) {
  const std::string name = path("log.txt");
  EXPECT_EQ(error_of([&] { ContactLog log(name); }), name + ": expected a name that ends in .csv or .jsonl");
  EXPECT_TRUE(names().empty());
}

TEST_F(ContactLogTest, QuotesTexts) {
  const std::vector<Cell> cells{std::string("a,\"b\""), std::numeric_limits<double>::infinity()};
  for (const char* name : {"t.csv", "t.jsonl"}) {
    TableFile table(path(name), {"id", "value"});
    table.write(cells);
    table.commit();
  }
  EXPECT_EQ(read_text(path("t.csv")), "id,value\n\"a,\"\"b\"\"\",\n");
  EXPECT_EQ(read_text(path("t.jsonl")), "{\"id\": \"a,\\\"b\\\"\", \"value\": null}\n");
}

TEST_F(ContactLogTest, DoublesComeBackToTheLastBit) {
  const double value = 0.1 + 0.2;
  TableFile table(path("t.csv"), {"value"});
  table.write(std::vector<Cell>{value});
  table.commit();
  EXPECT_EQ(std::strtod(lines_of(read_text(path("t.csv")))[1].c_str(), nullptr), value);
}

}  // namespace
}  // namespace kinesphere::program::contact_log_test
