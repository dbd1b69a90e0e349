// `kinesphere-bench paper` with tiny sizes: every section leaves its tables, scripts and pictures.
#include <set>

#include "research/bench/report.hpp"
#include "research/tests/bench/bench_table.hpp"

namespace kinesphere::program::bench_paper_test {
namespace {

class BenchPaper : public BenchTest {
 protected:
  std::set<std::string> written() const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path("out-bench")))
      found.insert(entry.path().filename());
    return found;
  }

  /// Returns a table after checking that it is rectangular and has `rows` rows. Cells may be empty only where
  /// nothing was published or nothing happened.
  BenchRows table(const std::string& name, std::size_t rows) const {
    BenchRows found = BenchTest::table(name);
    EXPECT_EQ(found.size(), rows + 1) << name;
    for (const auto& row : found) {
      EXPECT_EQ(row.size(), found.front().size()) << name;
      for (std::size_t column = 0; column < row.size(); ++column) {
        const std::string& heading = found.front()[column];
        if (heading.starts_with("published") || heading == "speedup" || heading == "expected_to_measured")
          continue;
        EXPECT_NE(row[column], "") << name << ", " << heading;
      }
    }
    return found;
  }
};

TEST_F(BenchPaper, EverySectionWritesItsTables) {
  const ProgramRun result = bench("paper");
  for (const char* label : {"processor", "compiler", "flags", "version", "date"}) {
    EXPECT_NE(result.out.find(label), std::string::npos) << label;
    EXPECT_NE(read("machine.txt").find(label), std::string::npos) << label;
  }

  const auto figure5 = table("figure5.csv", 2);
  EXPECT_EQ(csv_cell(figure5, 0, "n"), "20");
  EXPECT_EQ(csv_cell(figure5, 1, "n"), "40");
  EXPECT_EQ(csv_cell(figure5, 0, "paper_hash").size(), 16u);
  const auto figure6 = table("figure6.csv", 2);
  EXPECT_EQ(csv_cell(figure6, 1, "hash"), csv_cell(figure5, 1, "paper_hash"))
      << "figures 5 and 6 are about the same runs";
  EXPECT_GT(std::stoi(csv_cell(figure6, 1, "colliding")), 0);
  table("table1.csv", 2);
  table("table1_others.csv", 2);
  const auto overlooked = table("table1_overlooked.csv", 4);
  EXPECT_EQ(csv_cell(overlooked, 0, "kind"), "two bodies");
  EXPECT_EQ(csv_cell(overlooked, 1, "kind"), "a wall");
  const auto circulation = table("circulation.csv", 2);
  EXPECT_EQ(csv_cell(circulation, 0, "detector"), "paper");
  EXPECT_EQ(csv_cell(circulation, 0, "ratio"), "1");
  table("growth.csv", 2);
  const auto trimming = table("trimming.csv", 2);
  EXPECT_EQ(csv_cell(trimming, 0, "hash"), csv_cell(trimming, 1, "hash"));
  EXPECT_LT(std::stoi(csv_cell(trimming, 0, "inserted")), std::stoi(csv_cell(trimming, 1, "inserted")));
  table("cells_sweep.csv", 3);
  table("cells_choice.csv", 1);
  table("cells_rates.csv", 5);

  EXPECT_EQ(result.out.find("gnuplot-nox") != std::string::npos, !has_gnuplot()) << result.out;
  for (const std::string name : {"figure5", "figure6", "growth"}) {
    const std::string script = read(name + ".gp");
    EXPECT_NE(script.find("'" + name + ".csv'"), std::string::npos) << script;
    EXPECT_EQ(written().count(name + ".svg"), has_gnuplot() ? 1u : 0u) << name;
    if (has_gnuplot()) {
      EXPECT_NE(read(name + ".svg").find("</svg>"), std::string::npos) << name;
    }
  }
  for (const std::string name : {"figure7a", "figure7b", "figure7c", "figure8_0", "figure8_2"}) {
    const auto spheres = table(name + ".csv", 50);
    EXPECT_GE(std::stod(csv_cell(spheres, 0, "y")), std::stod(csv_cell(spheres, 49, "y")))
        << "far ones first";
    EXPECT_NE(read(name + ".gp").find("'" + name + ".csv'"), std::string::npos);
    EXPECT_EQ(written().count(name + ".png"), has_gnuplot() ? 1u : 0u) << name;
  }
  EXPECT_EQ(read("figure7a.csv"), read("figure8_0.csv")) << "both at the start";
  EXPECT_NE(read("figure7b.csv"), read("figure7a.csv"));
}

TEST_F(BenchPaper, OnlyTheSectionsChosen) {
  bench("paper --only trimming,cells");
  EXPECT_EQ(written(), (std::set<std::string>{"cells_choice.csv", "cells_rates.csv", "cells_sweep.csv",
                                              "machine.txt", "trimming.csv"}));
}

TEST_F(BenchPaper, RefusesWrongOptions) {
  expect_wrong_input("paper --only figure5,figure9", {"--only", "figure5, figure6", "figure9"});
  expect_wrong_input("gas --quick --full", {"--full", "--quick"});
  const std::string file = write("file", "");
  expect_wrong_input("shapes --quick --output " + file, {"--output", file});
}

}  // namespace
}  // namespace kinesphere::program::bench_paper_test
