// What a batch system does to a run: limits of time, signals, tasks that do not find each other, and runs
// that are started twice.
#include "support.hpp"

namespace kinesphere::program::batch_test {
namespace {

class MpiProgramInABatch : public MpiProgramTest {
 protected:
  std::string checkpoints() const { return "--checkpoint '" + path("checkpoints") + "' "; }
  /// Shell text that runs the program alone in the background, until it has written a checkpoint, and then
  /// `then`, which knows it as $run. Its scene takes longer than any test.
  ProgramRun during_a_run(const std::string& then) const {
    const std::string program = std::string("'") + KINESPHERE_MPI_PROGRAM + "'";
    return run_shell(
        "sh -c '" + program + " run paper1 --bodies 500 --seconds 100000 --quiet --checkpoint-every 0.1s " +
        "--checkpoint \"" + path("checkpoints") + "\" & run=$!; for k in $(seq 1000); do [ -e \"" +
        path("checkpoints") + "/1\" ] && break; sleep 0.01; done; " + then + "'");
  }
};

TEST_F(MpiProgramInABatch, StopsAtItsTimeLimitAndGoesOn) {
  const std::string scene = "paper1 --bodies 1000 --seconds 12";
  const Expected one = expected(scene);
  ProgramRun run;
  int stops = -1;
  do {
    run = run_mpi(1 + (stops + 1) % 3, "run " + scene + " --hash-only --resume --time-limit 0.05s " +
                                           checkpoints() + "--contacts '" + path("all.csv") + "'");
    ++stops;
    ASSERT_LT(stops, 200);
  } while (run.exit_code == 75);
  EXPECT_GE(stops, 2);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, one.hash);
  EXPECT_TRUE(read_text(path("all.csv")) == one.contacts);
}

TEST_F(MpiProgramInABatch, StopsAtASignal) {
  for (const std::string signal : {"TERM", "USR1"}) {
    SCOPED_TRACE(signal);
    std::filesystem::remove_all(path("checkpoints"));
    const ProgramRun run = during_a_run("kill -" + signal + " $run; wait $run");
    EXPECT_EQ(run.exit_code, 75) << run.err;
    const std::vector<std::string> messages = messages_in(run.err);
    ASSERT_EQ(messages.size(), 1u) << run.err;
    EXPECT_NE(messages[0].find("stopped at "), std::string::npos) << messages[0];
    EXPECT_NE(messages[0].find("--resume goes on"), std::string::npos) << messages[0];
  }
}

TEST_F(MpiProgramInABatch, KeepsItsFolderForItself) {
  const ProgramRun run = during_a_run(std::string("\"") + KINESPHERE_MPI_PROGRAM +
                                      "\" run paper1 --bodies 500 --seconds 1 --quiet --resume --every 1 "
                                      "--checkpoint \"" +
                                      path("checkpoints") + "\"; code=$?; kill -KILL $run; exit $code");
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_NE(run.err.find("another one uses " + path("checkpoints")), std::string::npos) << run.err;
  // The lock is gone with the one that was killed.
  EXPECT_EQ(run_mpi(1, "run paper1 --bodies 500 --seconds 100000 --quiet --resume --time-limit 0.1s " +
                           checkpoints())
                .exit_code,
            75);
}

TEST_F(MpiProgramInABatch, SaysHowFarItHasCome) {
  const ProgramRun run = run_mpi(2, "run paper1 --bodies 1000 --seconds 8 --quiet --progress 0.2s");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> messages = messages_in(run.err);
  ASSERT_FALSE(messages.empty()) << run.err;
  EXPECT_NE(messages[0].find(" of 8 s simulated, "), std::string::npos) << messages[0];
}

TEST_F(MpiProgramInABatch, SaysThatItIsAloneWhereThereShouldBeMore) {
  const std::string run =
      std::string("'") + KINESPHERE_MPI_PROGRAM + "' run paper1 --bodies 10 --seconds 0.1 --quiet";
  EXPECT_NE(run_shell("SLURM_STEP_NUM_TASKS=4 " + run).err.find("alone, but SLURM_STEP_NUM_TASKS says 4"),
            std::string::npos);
  EXPECT_EQ(run_shell("SLURM_STEP_NUM_TASKS=1 " + run).err, "");
}

TEST_F(MpiProgramInABatch, RefusesWrongLimits) {
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const ProgramRun run = run_mpi(1, "run paper1 --bodies 10 " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
  };
  refused("--time-limit 5s", "expected only with --checkpoint");
  refused("--checkpoint-every 5s", "expected only with --checkpoint");
  refused(checkpoints(), "expected with --every, --checkpoint-every or --time-limit");
  refused(checkpoints() + "--time-limit 5x", "x unit not recognized");
  refused(checkpoints() + "--time-limit 0s", "--time-limit");
}

}  // namespace
}  // namespace kinesphere::program::batch_test
