// kinesphere-mpi writes and prints what kinesphere does, on any number of ranks.
#include "support.hpp"

namespace kinesphere::program::contacts_test {
namespace {

class ContactsOfAllRanks : public MpiProgramTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(ContactsOfAllRanks, AreTheFileOfOneWorld) {
  const std::string scene = GetParam();
  const Expected one = expected(scene);
  ASSERT_GT(lines_of(one.contacts).size(), 50u);
  for (const int ranks : {1, 2, 3}) {
    SCOPED_TRACE(ranks);
    const ProgramRun all =
        run_mpi(ranks, "run " + scene + " --hash-only --contacts '" + path("all.csv") + "'");
    EXPECT_EQ(all.exit_code, 0) << all.err;
    EXPECT_EQ(all.out, one.hash);
    EXPECT_TRUE(read_text(path("all.csv")) == one.contacts);
    EXPECT_EQ(names(), std::vector<std::string>{"all.csv"});
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ContactsOfAllRanks,
                         ::testing::Values("paper1 --bodies 500 --seconds 1", "gas --bodies 500 --seconds 1",
                                           "paper2 --bodies 500 --seconds 1"),
                         [](const auto& tested) {
                           const std::string scene = tested.param;
                           return scene.substr(0, scene.find(' '));
                         });

/// More events at a time than the first rank takes from another at once; and two threads on each rank.
TEST_F(MpiProgramTest, ManyEventsAsJsonLines) {
  const std::string scene = "gas --bodies 4000 --seconds 1 --packing 0.4 --response pass_through";
  const Expected one = expected(scene, "jsonl");
  EXPECT_GT(lines_of(one.contacts).size(), 20000u);
  EXPECT_EQ(run("run " + scene + " --hash-only --threads 2").out, one.hash) << "one world, on two threads";
  const ProgramRun all =
      run_mpi(2, "run " + scene + " --hash-only --threads 2 --contacts '" + path("all.jsonl") + "'");
  EXPECT_EQ(all.out, one.hash) << all.err;
  EXPECT_TRUE(read_text(path("all.jsonl")) == one.contacts);
}

TEST_F(MpiProgramTest, FilesPerRankAddUpToTheFileOfOneWorld) {
  const std::string scene = "paper1 --bodies 500 --seconds 1";
  std::vector<std::string> of_one = lines_of(expected(scene).contacts);
  const ProgramRun all =
      run_mpi(3, "run " + scene + " --quiet --file-per-rank --contacts '" + path("all.csv") + "'");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(names(), files_of(3));
  std::vector<std::string> of_all{of_one[0]};
  for (const std::string& name : names()) {
    const std::vector<std::string> lines = lines_of(read_text(path(name)));
    ASSERT_GT(lines.size(), 1u);
    EXPECT_EQ(lines[0], of_one[0]);
    of_all.insert(of_all.end(), lines.begin() + 1, lines.end());
  }
  std::sort(of_one.begin(), of_one.end());
  std::sort(of_all.begin(), of_all.end());
  EXPECT_EQ(of_all, of_one);
}

TEST_F(MpiProgramTest, SummaryHasARowForEachRank) {
  const ProgramRun all = run_mpi(2, "run paper1 --bodies 300 --seconds 1");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(all.err, "");
  const std::vector<std::string> lines = lines_of(all.out);
  const auto table = std::find_if(lines.begin(), lines.end(),
                                  [](const std::string& line) { return line.starts_with("rank  bodies"); });
  ASSERT_EQ(lines.end() - table, 4) << all.out;
  EXPECT_TRUE(table[3].starts_with(" all     300 ")) << all.out;
  EXPECT_EQ(
      std::count_if(lines.begin(), lines.end(), [](const auto& line) { return line.starts_with("hash "); }),
      1);
}

TEST_F(MpiProgramTest, HelpAndVersionAreSaidOnce) {
  const ProgramRun version = run_mpi(2, "--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(lines_of(version.out).size(), 1u) << version.out;
  const ProgramRun help = run_mpi(2, "run --help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.out.find("Usage:"), help.out.rfind("Usage:"));
}

}  // namespace
}  // namespace kinesphere::program::contacts_test
