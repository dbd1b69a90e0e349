// Files in `kinesphere watch` whose rows are not in the order of their times, or are of one moment.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/support.hpp"

namespace kinesphere::program::ordered_test {
namespace {

using Json = nlohmann::json;

/// Three tracks; the second one comes near the others, at times that reports until the end do not tell.
std::vector<std::string> rows(double seconds, bool is_table) {
  std::vector<std::string> rows;
  for (int second = 0; second < seconds; ++second)
    for (int track = 0; track < 3; ++track) {
      const double phase = 6.283 * second / seconds;
      const double x = track == 1 ? 100.0 * std::sin(phase) : 60.0 * (track - 1);
      const double speed = track == 1 ? 628.3 / seconds * std::cos(phase) : 0.0;
      rows.push_back(is_table ? fmt::format("t{},{},{:.3f},0,5,{:.4f},0,0\n", track, second, x, speed)
                              : fmt::format("{{\"id\": \"t{}\", \"stamp\": {}, \"position\": [{:.3f}, 0, 5], "
                                            "\"velocity\": [{:.4f}, 0, 0]}}\n",
                                            track, second, x, speed));
    }
  return rows;
}

class OrderedFile : public ProgramTest {
 protected:
  std::string joined(std::vector<std::string> rows, bool is_grouped, bool is_table) const {
    if (is_grouped)
      std::stable_sort(rows.begin(), rows.end(), [](const std::string& a, const std::string& b) {
        return a[a.find('t')] == b[b.find('t')] && a[a.find('t') + 1] < b[b.find('t') + 1];
      });
    std::string text = is_table ? "id,time,x,y,z,vx,vy,vz\n" : "";
    for (const std::string& row : rows) text += row;
    return text;
  }
  const std::string promises_ =
      " --separation sphere:20 --acceleration 5 --largest-speed 30 --position-error 0.5 --velocity-error "
      "0.1 ";
};

TEST_F(OrderedFile, IsSortedWhereItIsGroupedById) {
  for (const bool is_table : {true, false})
    for (const double seconds : {40.0, 900.0}) {
      const auto all = rows(seconds, is_table);
      const ProgramRun in_order =
          run("watch " + write("in_order", joined(all, false, is_table)) + promises_ + "--only all");
      EXPECT_EQ(in_order.exit_code, 0) << in_order.err;
      EXPECT_EQ(in_order.err.find("sorted"), std::string::npos) << in_order.err;
      EXPECT_NE(in_order.out.find("within"), std::string::npos);
      write("grouped", joined(all, true, is_table));
      const ProgramRun grouped = run("watch " + path("grouped") + promises_ + "--only all");
      EXPECT_EQ(grouped.exit_code, 0) << grouped.err;
      EXPECT_EQ(grouped.out, in_order.out) << seconds;
      EXPECT_NE(grouped.err.find("grouped: the reports of one track stand behind those of another"),
                std::string::npos)
          << grouped.err;
      EXPECT_EQ(run("watch" + promises_ + "--only all <" + path("grouped")).out, in_order.out);
      // As of other files, a later run with the snapshot finds all that was told.
      const std::string kept = "watch " + path("grouped") + promises_ + "--only all --quiet --snapshot '" +
                               path("state") + "' --alerts '" + path("alerts") + "'";
      for (int k = 0; k < 2; ++k) {
        const ProgramRun again = run(kept);
        EXPECT_EQ(again.exit_code, 0) << again.err;
        EXPECT_EQ(read_text(path("alerts")), in_order.out);
      }
      std::filesystem::remove(path("state"));
      std::filesystem::remove(path("alerts"));
    }
}

TEST_F(OrderedFile, IsAnErrorWhereMostIsTooOldAndCannotBeSorted) {
  // Two tracks are in order first.
  std::string text = "id,time,x,y\n";
  for (const char* pair : {"ab", "cd", "ef", "gh"})
    for (int time = 0; time < 2000; time += 10)
      for (int k = 0; k < 2; ++k) text += fmt::format("{},{},{},0\n", pair[k], time, 50 * k);
  const ProgramRun result = run("watch " + write("s.csv", text) +
                                " --separation sphere:5 --largest-speed 1 --position-error 0.1 --summary '" +
                                path("summary.json") + "'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("s.csv: expected rows in the order of their times, but "), std::string::npos)
      << result.err;
  EXPECT_GT(Json::parse(read_text(path("summary.json")))["too_old"], 800);
}

TEST_F(OrderedFile, SaysThatItIsOfOneMoment) {
  const std::string moment = "it has one report of each track, as of one moment";
  const std::string options = " --separation sphere:50 --largest-speed 1 --position-error 0.1 ";
  const std::string once = "id,time,x,y\na,5,0,0\nb,5,30,0\nc,6,900,0\n";
  EXPECT_NE(run("watch " + write("s.csv", once) + options).err.find(moment), std::string::npos);
  EXPECT_EQ(run("watch " + write("s.csv", once + "a,7,0,0\n") + options).err.find(moment), std::string::npos);
  EXPECT_EQ(run("watch --quiet " + write("s.csv", once) + options).err, "");
  // What comes through a pipe may be all that there is so far.
  EXPECT_EQ(run("watch" + options, "cat " + path("s.csv") + " | ").err.find(moment), std::string::npos);
}

}  // namespace
}  // namespace kinesphere::program::ordered_test
