// Runs that are stopped and continued write and print what one run does.
#include "kinesphere/random.hpp"
#include "support.hpp"

namespace kinesphere::program::checkpoint_test {
namespace {

class MpiProgramCheckpoints : public MpiProgramTest {
 protected:
  using Names = std::vector<std::string>;

  std::string scene_ = "paper1 --bodies 300";
  std::string arguments(const std::string& seconds, const std::string& more = "") const {
    return "run " + scene_ + " --seconds " + seconds + " --hash-only --every 0.25 --checkpoint '" +
           path("checkpoints") + "' --contacts '" + path("all.csv") + "' " + more;
  }
  Names checkpoints() const {
    Names found;
    for (const auto& entry : std::filesystem::directory_iterator(path("checkpoints")))
      found.push_back(entry.path().filename());
    std::sort(found.begin(), found.end());
    return found;
  }
  void damage(const std::string& file) const {
    std::string text = read_text(path(file));
    ASSERT_GT(text.size(), 100u);
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    write(file, text);
  }
};

TEST_F(MpiProgramCheckpoints, GoOnWithOtherRanksAndForLonger) {
  const Expected one = expected(scene_ + " --seconds 1.5");
  EXPECT_EQ(run_mpi(3, arguments("0.6")).exit_code, 0);
  EXPECT_EQ(checkpoints(), (Names{"2", "3"}));
  // The state that a stopped run leaves.
  std::filesystem::rename(path("all.csv"), path("all.csv.unfinished"));
  write("all.csv.unfinished", read_text(path("all.csv.unfinished")) + "and more");
  const ProgramRun second = run_mpi(2, arguments("1.5", "--resume"));
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, one.hash);
  EXPECT_TRUE(read_text(path("all.csv")) == one.contacts);
  EXPECT_EQ(names(), (Names{"all.csv", "checkpoints"}));
  EXPECT_EQ(checkpoints(), (Names{"6", "7"}));
  // Nothing is left to do, and nothing changes.
  EXPECT_EQ(run_mpi(1, arguments("1.5", "--resume")).out, one.hash);
  EXPECT_TRUE(read_text(path("all.csv")) == one.contacts);
  EXPECT_EQ(checkpoints(), (Names{"6", "7"}));
}

TEST_F(MpiProgramCheckpoints, FallBackFromADamagedOne) {
  const Expected one = expected(scene_ + " --seconds 1");
  for (const std::string file : {"part-1", "run.json"}) {
    SCOPED_TRACE(file);
    std::filesystem::remove_all(path("checkpoints"));
    EXPECT_EQ(run_mpi(2, arguments("0.6")).exit_code, 0);
    damage("checkpoints/3/" + file);
    const ProgramRun second = run_mpi(2, arguments("1", "--resume"));
    EXPECT_EQ(second.out, one.hash);
    const std::vector<std::string> messages = messages_in(second.err);
    ASSERT_EQ(messages.size(), 1u) << second.err;
    EXPECT_NE(messages[0].find("checkpoints/3 is refused"), std::string::npos) << messages[0];
    EXPECT_TRUE(read_text(path("all.csv")) == one.contacts);
    EXPECT_EQ(checkpoints(), (Names{"3", "3.refused", "4"}));
  }
}

/// Killed five times, on one rank or another, and continued on other numbers of ranks.
TEST_F(MpiProgramCheckpoints, OfRunsThatWereKilled) {
  scene_ = "paper1 --bodies 1000";
  const Expected one = expected(scene_ + " --seconds 15");
  const std::string program = std::string("'") + KINESPHERE_MPI_PROGRAM + "'";
  // Returns the newest checkpoint; works with and without one.
  const std::string newest = "ls '" + path("checkpoints") + "' | grep -E '^[0-9]+$' | sort -n | tail -1";
  Random random(16);
  int killed = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const auto ranks = 1 + static_cast<int>(random.bits() % 3);
    const auto victim = random.bits() % static_cast<std::uint64_t>(ranks);
    const std::uint64_t more = 1 + random.bits() % 4;
    // Waits for that many more checkpoints, with a limit, and a little longer.
    const std::string wait = "first=$(" + newest + "); for k in $(seq 3000); do last=$(" + newest +
                             "); [ ${last:-0} -ge $((${first:-0} + " + std::to_string(more) +
                             ")) ] && break; [ -e '" + path("all.csv") +
                             "' ] && exit; sleep 0.01; done; sleep 0.0" + std::to_string(random.bits() % 10) +
                             "; kill -9 $$";
    const std::string script =
        write("killed.sh", "[ ${OMPI_COMM_WORLD_RANK:-$PMI_RANK} = " + std::to_string(victim) + " ] && { " +
                               wait + "; } 2>/dev/null &\nexec " + program + " \"$@\"\n");
    const ProgramRun run = run_shell(mpirun(ranks) + "sh '" + script + "' " + arguments("15", "--resume"));
    if (was_killed(run)) ++killed;
  }
  EXPECT_GE(killed, 3) << "the others were too fast";
  const ProgramRun last = run_mpi(2, arguments("15", "--resume"));
  EXPECT_EQ(last.out, one.hash) << last.err;
  EXPECT_TRUE(read_text(path("all.csv")) == one.contacts);
}

TEST_F(MpiProgramCheckpoints, GoOnWithFilesPerRank) {
  std::vector<std::string> of_one = lines_of(expected(scene_ + " --seconds 1").contacts);
  EXPECT_EQ(run_mpi(3, arguments("0.4", "--file-per-rank")).exit_code, 0);
  const ProgramRun second = run_mpi(2, arguments("0.7", "--file-per-rank --resume"));
  EXPECT_EQ(second.exit_code, 0) << second.err;
  const ProgramRun third = run_mpi(4, arguments("1", "--file-per-rank --resume"));
  EXPECT_EQ(third.exit_code, 0) << third.err;
  std::vector<std::string> of_all;
  for (const std::string& name : files_of(4)) {
    const std::vector<std::string> lines = lines_of(read_text(path(name)));
    ASSERT_FALSE(lines.empty());
    of_all.insert(of_all.end(), lines.begin() + 1, lines.end());
  }
  of_one.erase(of_one.begin());
  std::sort(of_one.begin(), of_one.end());
  std::sort(of_all.begin(), of_all.end());
  EXPECT_EQ(of_all, of_one);
}

TEST_F(MpiProgramCheckpoints, AreNotMixedUpWithThoseOfAnotherRun) {
  EXPECT_EQ(run_mpi(2, arguments("0.3")).exit_code, 0);
  const auto expect_refused = [&](const std::string& more, std::string_view part) {
    const ProgramRun refused = run_mpi(1, more);
    EXPECT_EQ(refused.exit_code, 2);
    const std::vector<std::string> messages = messages_in(refused.err);
    ASSERT_EQ(messages.size(), 1u) << refused.err;
    EXPECT_NE(messages[0].find(part), std::string::npos) << messages[0];
  };
  expect_refused(arguments("0.3"), "expected a folder without checkpoints, or --resume");
  expect_refused(arguments("0.3", "--resume --seed 5"), "with seed 1, but got seed 5");
  expect_refused(arguments("0.3", "--resume --file-per-rank"), "--contacts and --file-per-rank as in");
  expect_refused(arguments("0.1", "--resume"), "--seconds: expected no less than");
  EXPECT_EQ(checkpoints(), (Names{"1", "2"}));
}

}  // namespace
}  // namespace kinesphere::program::checkpoint_test
