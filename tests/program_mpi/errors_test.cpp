// An error is printed once, and all ranks end.
#include "support.hpp"

namespace kinesphere::program::errors_test {
namespace {

class MpiProgramErrors : public MpiProgramTest {
 protected:
  void expect_one_message(const ProgramRun& failed, int exit_code, std::string_view part) const {
    EXPECT_EQ(failed.exit_code, exit_code);
    EXPECT_EQ(failed.out, "");
    const std::vector<std::string> messages = messages_in(failed.err);
    ASSERT_EQ(messages.size(), 1u) << failed.err;
    EXPECT_NE(messages[0].find(part), std::string::npos) << messages[0];
  }
};

TEST_F(MpiProgramErrors, OfOptions) {
  expect_one_message(run_mpi(3, "run nowhere"), 2, "'nowhere' is neither a file nor a built-in scene");
  expect_one_message(run_mpi(2, "run paper1 --contacts all.txt"), 2, "ends in .csv or .jsonl");
  expect_one_message(run_mpi(1, "run paper1 --file-per-rank"), 2, "--file-per-rank: expected only with");
  expect_one_message(run_mpi(2, "run paper1 --every 1"), 2,
                     "--every, --checkpoint-every and --time-limit: expected only with");
  expect_one_message(run_mpi(1, ""), 2, "expected a command");
}

TEST_F(MpiProgramErrors, OfFilesThatCannotBeWritten) {
  const std::string file = path("nowhere/all.csv");
  const std::string arguments = "run paper1 --bodies 100 --seconds 1 --contacts '" + file + "'";
  expect_one_message(run_mpi(2, arguments), 1, file + ": cannot write: No such file or directory");
  expect_one_message(run_mpi(2, arguments + " --file-per-rank"), 1, "No such file or directory");
  const std::string plain_file = write("plain", "");
  expect_one_message(
      run_mpi(2, "run paper1 --bodies 100 --seconds 1 --every 1 --checkpoint '" + plain_file + "/folder'"), 1,
      "Not a directory");
}

/// A limit of some blocks for a file acts as a full disk.
TEST_F(MpiProgramErrors, OfAFullDiskOnOneRank) {
  if (is_mpich())
    GTEST_SKIP() << "the shared memory of MPICH is in files, too, so it does not start with such a limit";
  const std::string program = std::string("'") + KINESPHERE_MPI_PROGRAM + "'";
  const std::string limited =
      write("limited.sh", "trap '' XFSZ\n[ ${OMPI_COMM_WORLD_RANK:-$PMI_RANK} = 1 ] && ulimit -f 1\nexec " +
                              program + " \"$@\"\n");
  const ProgramRun failed = run_shell(
      mpirun(2) + "sh '" + limited +
      "' run paper1 --bodies 300 --seconds 1 --quiet --file-per-rank --contacts '" + path("all.csv") + "'");
  expect_one_message(failed, 1, "rank 1: " + path("all.csv.1") + ": cannot write: File too large");
}

/// No other rank waits for it.
TEST_F(MpiProgramErrors, OfARankThatIsKilled) {
  const std::string program = std::string("'") + KINESPHERE_MPI_PROGRAM + "'";
  const std::string killed =
      write("killed.sh", "[ ${OMPI_COMM_WORLD_RANK:-$PMI_RANK} = 1 ] && { sleep 1; kill -9 $$; } &\nexec " +
                             program + " \"$@\"\n");
  const ProgramRun failed =
      run_shell(mpirun(2) + "sh '" + killed + "' run paper1 --bodies 1000 --seconds 1000 --quiet");
  EXPECT_TRUE(was_killed(failed)) << failed.exit_code << "\n" << failed.err;
}

}  // namespace
}  // namespace kinesphere::program::errors_test
