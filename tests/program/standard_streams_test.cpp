// Standard streams that the caller has closed, or that accept nothing.
#include "support.hpp"

namespace kinesphere::program::standard_streams_test {
namespace {

const std::string promises = " --separation sphere:1 --acceleration 1 --position-error 1 --velocity-error 1";

TEST_F(ProgramTest, SaysThatStandardInputIsClosed) {
  // Without a file to read, each command would read whatever was opened first.
  const std::string scene = write("s.json", R"({"bodies": 3, "seconds": 1})");
  for (const std::string& command :
       {std::string("watch -") + promises, "watch" + promises, std::string("tracks - --distance 1"),
        "watch - --snapshot '" + path("state") + "'" + promises}) {
    SCOPED_TRACE(command);
    const ProgramRun result = run_shell("timeout 20 '" KINESPHERE_PROGRAM "' " + command + " <&-");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, "kinesphere: standard input: cannot read: it is closed\n");
  }
  EXPECT_EQ(run_shell("'" KINESPHERE_PROGRAM "' run " + scene + " <&-").exit_code, 0);
}

TEST_F(ProgramTest, SaysThatStandardOutputIsClosed) {
  const std::string scene = write("s.json", R"({"bodies": 3, "seconds": 1})");
  const ProgramRun result = run_shell("'" KINESPHERE_PROGRAM "' run " + scene + " >&-");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "kinesphere: standard output: cannot write: Bad file descriptor\n");
  // An output file must not become standard output.
  const std::string log = path("log.csv");
  run_shell("'" KINESPHERE_PROGRAM "' run " + scene + " --contacts '" + log + "' >&- <&-");
  EXPECT_EQ(read_text(log).find("bodies "), std::string::npos);
}

TEST_F(ProgramTest, GoesOnWithoutStandardError) {
  const std::string stream =
      write("s.jsonl",
            "{\"id\": \"a\", \"stamp\": 0, \"position\": [0, 0, 0], \"velocity\": [0, 0, 0]}\n{no report\n");
  EXPECT_EQ(run_shell("'" KINESPHERE_PROGRAM "' watch " + stream + promises + " 2>&-").exit_code, 0)
      << "who closes it wants no messages";
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  EXPECT_EQ(run_shell("'" KINESPHERE_PROGRAM "' watch " + stream + promises + " 2>/dev/full").exit_code, 2)
      << "a warning and the summary were lost";
  EXPECT_EQ(
      run_shell("'" KINESPHERE_PROGRAM "' watch " + stream + promises + " --quiet 2>/dev/full").exit_code, 0);
}

/// Covers every option that names an output file.
TEST_F(ProgramTest, NoticesThatAFileCannotBeWritten) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  const std::string scene = write("s.json", R"({"bodies": 40, "radius": [1, 5], "seconds": 1})");
  const std::string tracks = write("t.csv", "id,time,x,y\na,0,0,0\na,9,9,0\nb,0,9,0\nb,9,0,0\n");
  const std::string stream =
      write("s.jsonl", "{\"id\": \"a\", \"stamp\": 0, \"position\": [0, 0, 0], \"velocity\": [0, 0, 0]}\n");
  const std::string commands[] = {"run " + scene + " --contacts /dev/full",
                                  "run " + scene + " --record /dev/full",
                                  "run " + scene + " --frames /dev/full",
                                  "tracks " + tracks + " --distance 1 --contacts /dev/full",
                                  "tracks " + tracks + " --distance 1 --pairs /dev/full",
                                  "tracks " + tracks + " --distance 1 --plot /dev/full",
                                  "watch " + stream + promises + " --summary /dev/full",
                                  "watch " + stream + promises + " --alerts /dev/full",
                                  "watch " + stream + promises + " --snapshot /dev/full"};
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    const ProgramRun result = run(command);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find("/dev/full"), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace kinesphere::program::standard_streams_test
