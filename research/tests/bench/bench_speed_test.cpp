// `kinesphere-bench speed` with tiny sizes: every scene leaves its rows, and all rivals at a rate have found
// equal contacts.
#include <map>
#include <set>
#include <sstream>

#include "research/bench/speed/speed_scenes.hpp"
#include "research/tests/bench/bench_table.hpp"

namespace kinesphere::program::bench_speed_test {
namespace {

class BenchSpeed : public BenchTest {};

std::vector<SpeedScene> quick_scenes() { return speed_scenes(speed_settings(Effort::quick)); }

TEST_F(BenchSpeed, EverySceneHasItsRows) {
  const ProgramRun result = bench("speed");
  const auto table = BenchTest::table("speed.csv");
  std::map<std::string, std::set<std::string>> detectors;
  for (std::size_t row = 0; row + 1 < table.size(); ++row) {
    ASSERT_EQ(table[row + 1].size(), table[0].size());
    detectors[csv_cell(table, row, "scene")].insert(csv_cell(table, row, "detector"));
    EXPECT_GT(csv_number(table, row, "us"), 0.0);
    EXPECT_GE(csv_number(table, row, "total_10us"), csv_number(table, row, "us"));
    EXPECT_EQ(csv_cell(table, row, "hash").size(), 16u);
  }
  for (const SpeedScene& scene : quick_scenes()) {
    EXPECT_NE(result.out.find(scene.name + ", "), std::string::npos) << scene.name;
    EXPECT_EQ(detectors[scene.name].count("world"), 1u) << scene.name;
    for (const char* name : {"tuned", "swept"})
      EXPECT_EQ(detectors[scene.name].count(name) != 0, !scene.rates.empty()) << scene.name << " " << name;
  }
  EXPECT_NE(result.out.find("compiler"), std::string::npos);
}

TEST_F(BenchSpeed, RivalsAtTheSameRateFindTheSame) {
  bench("speed --only sizes");
  const auto table = BenchTest::table("speed.csv");
  std::map<std::string, std::set<std::string>> hashes;
  for (std::size_t row = 0; row + 1 < table.size(); ++row) {
    const std::string detector = csv_cell(table, row, "detector");
    if (detector != "world" && detector != "swept")
      hashes[csv_cell(table, row, "rate")].insert(csv_cell(table, row, "hash"));
  }
  EXPECT_EQ(hashes.size(), 3u);
  for (const auto& [rate, found] : hashes) EXPECT_EQ(found.size(), 1u) << rate;
}

TEST_F(BenchSpeed, AlarmsAreThoseThatSpheresWithMoreRoomHaveAsContacts) {
  bench("speed --only drones");
  const auto table = BenchTest::table("speed.csv");
  ASSERT_EQ(csv_cell(table, 0, "detector"), "world");
  const double alarms = std::stod(csv_cell(table, 0, "contacts"));
  EXPECT_GT(alarms, 0.0);
  int safe = 0;
  for (std::size_t row = 1; row + 1 < table.size(); ++row) {
    if (csv_cell(table, row, "missed_percent") != "0") continue;
    EXPECT_NEAR(csv_number(table, row, "contacts"), alarms, 1e-9) << csv_cell(table, row, "detector");
    ++safe;
  }
  EXPECT_GT(safe, 2);
}

TEST_F(BenchSpeed, ComparesThreads) {
  bench("speed --threads 2");
  const auto table = BenchTest::table("threads.csv");
  ASSERT_EQ(table.size(), 4u) << "a million bodies are left out here";
  for (std::size_t row = 0; row + 1 < table.size(); ++row) {
    EXPECT_EQ(csv_cell(table, row, "threads"), "2");
    for (const char* column :
         {"loop_s", "one_s", "many_s", "one_to_loop", "one_to_many", "cpu_to_one", "events"})
      EXPECT_GT(csv_number(table, row, column), 0.0) << column;
  }
  EXPECT_EQ(csv_cell(table, 2, "scene"), "shooting");
}

TEST_F(BenchSpeed, RefusesWrongOptions) {
  expect_wrong_input("speed --only paper1-500,paper9", {"--only", "paper1-500, paper1-1000", "paper9"});
  expect_wrong_input("speed --only shooting", {"--only", "paper1-500", "shooting"});
  expect_wrong_input("speed --threads 0", {"--threads", "from 1 to 256"});
}

}  // namespace
}  // namespace kinesphere::program::bench_speed_test
