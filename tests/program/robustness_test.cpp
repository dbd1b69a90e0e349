// Failures that must not destroy the work of hours: full disks, signals, and swapped files.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "support.hpp"

namespace kinesphere::program::robustness_test {
namespace {

using Names = std::vector<std::string>;

constexpr std::string_view small_scene = R"({
  "bodies": 40, "radius": [1, 5], "box": [[0, 0, 0], [60, 60, 60]], "seconds": 2, "response": "bounce" })";
constexpr std::string_view meeting =
    "id,time,x,y\n"
    "ann,0,0,0\nann,5,5,0\nann,10,10,0\n"
    "bob,0,10,0\nbob,5,5,0\nbob,10,0,0\n";

TEST_F(ProgramTest, RefusesScenesOfBracketsWithinBrackets) {
  for (const char* brackets : {"[", "{\"a\":"}) {
    std::string text = "{\"name\":";
    for (int k = 0; k < 100'000; ++k) text += brackets;
    expect_wrong_input("run " + write("deep.json", text), {"deep.json:1:", "at most 16 brackets"});
  }
  const std::string box = R"({"name": "\"[[[[[[[[[[[[[[[[[[[[[[", "bodies": 1, "seconds": 0})";
  EXPECT_EQ(run("run " + write("named.json", box)).exit_code, 0) << "these are text";
}

/// /dev/full acts like a full disk.
TEST_F(ProgramTest, NoticesThatStandardOutputCannotBeWritten) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  const std::string scene = write("s.json", small_scene);
  const std::string tracks = write("t.csv", meeting);
  const std::string recording = path("r.kin");
  ASSERT_EQ(run("run " + scene + " --quiet --record " + recording).exit_code, 0);
  const std::string commands[] = {"run " + scene,
                                  "run " + scene + " --hash-only",
                                  "verify " + scene + " --seconds 0.1",
                                  "replay " + recording,
                                  "replay " + recording + " --hash-only",
                                  "tracks " + tracks + " --distance 1",
                                  "scenes",
                                  "--help",
                                  "run --help",
                                  "--version"};
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    const std::string shell =
        "'" KINESPHERE_PROGRAM "' " + command + " >/dev/full 2>'" + path("err") + "' </dev/null";
    const int status = std::system(shell.c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_EQ(read_text(path("err")), "kinesphere: standard output: cannot write: No space left on device\n");
  }
}

/// Runs the program until it has begun to write a file, and stops it with a signal.
class InterruptedRun {
 public:
  InterruptedRun(const std::vector<std::string>& arguments, const std::filesystem::path& folder, int signal) {
    const pid_t child = ::fork();
    if (child == 0) {
      std::vector<char*> words;
      for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
      words.push_back(nullptr);
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDERR_FILENO);
      ::execv(KINESPHERE_PROGRAM, words.data());
      ::_exit(127);
    }
    for (int k = 0; k < 3000 && !has_part(folder); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    began_writing = has_part(folder);
    ::kill(child, signal);
    ::waitpid(child, &status, 0);
  }

  bool began_writing = false;
  int status = 0;

 private:
  static bool has_part(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().filename().string().find(".part-") != std::string::npos) return true;
    return false;
  }
};

TEST_F(ProgramTest, LeavesNothingHalfWrittenWhenItIsStopped) {
  const std::string scene = write("s.json", small_scene);
  write("c.csv", "old");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(signal);
    const InterruptedRun stopped({"kinesphere", "run", scene, "--seconds", "1e6", "--quiet", "--contacts",
                                  path("c.csv"), "--frames", path("f.xyz")},
                                 std::filesystem::path(scene).parent_path(), signal);
    EXPECT_TRUE(stopped.began_writing);
    EXPECT_TRUE(WIFSIGNALED(stopped.status)) << "a shell says 128 + signal";
    EXPECT_EQ(WTERMSIG(stopped.status), signal);
    EXPECT_EQ(names(), (Names{"c.csv", "s.json"}));
    EXPECT_EQ(read_text(path("c.csv")), "old");
  }
}

TEST_F(ProgramTest, NeverWritesOntoItsInput) {
  const std::string scene = write("s.json", small_scene);
  const std::string tracks = write("t.csv", meeting);
  std::filesystem::create_directory(path("folder"));
  std::filesystem::create_symlink("../t.csv", path("folder/link.csv"));
  std::filesystem::create_hard_link(tracks, path("other.csv"));
  for (const std::string& output :
       {tracks, path("folder/../t.csv"), path("folder/link.csv"), path("other.csv")})
    expect_wrong_input("tracks " + tracks + " --distance 1 --contacts " + output,
                       {"--contacts", "another file than the input", output});
  expect_wrong_input("tracks " + path("folder/link.csv") + " --distance 1 --contacts " + tracks,
                     {"--contacts", "another file than the input"});
  for (const std::string option : {"--frames", "--record"})
    expect_wrong_input("run " + scene + " " + option + " " + scene, {option, "another file than the input"});
  EXPECT_EQ(read_text(tracks), meeting);
  EXPECT_EQ(read_text(scene), small_scene);
}

TEST_F(ProgramTest, NeverWritesTwoOutputsIntoOneFile) {
  const std::string scene = write("s.json", small_scene);
  std::filesystem::create_directory(path("folder"));
  expect_wrong_input("run " + scene + " --contacts " + path("x.csv") + " --frames " + path("folder/../x.csv"),
                     {"--frames", "another file than that of --contacts"});
  expect_wrong_input("run " + scene + " --frames " + path("x") + " --record " + path("x"),
                     {"--record", "another file than that of --frames"});
  EXPECT_EQ(names(), (Names{"folder", "s.json"}));
}

/// Reading the input would take long: errors of the outputs are reported before.
TEST_F(ProgramTest, LooksAtItsOutputsBeforeItBegins) {
  const std::string scene = "run " + write("s.json", small_scene) + " --seconds 1e9 ";
  const std::string tracks = "tracks " + write("t.csv", "no table") + " --distance 1 ";
  for (const std::string& command : {scene, tracks}) {
    expect_wrong_input(command + "--contacts " + path("c.txt"), {"c.txt", "ends in .csv"});
    expect_wrong_input(command + "--contacts " + path("none/c.csv"), {"none/c.csv", "No such file"});
  }
  expect_wrong_input(scene + "--record " + path("none/r.kin"), {"none/r.kin", "No such file"});
  expect_wrong_input(scene + "--frames " + path("none/f.xyz"), {"none/f.xyz", "No such file"});
  EXPECT_EQ(names(), (Names{"s.json", "t.csv"}));
}

TEST_F(ProgramTest, GivesItsSummaryEvenIfAFileCouldNotBeWritten) {
  const std::string scene = write("s.json", small_scene);
  // A limit on the size of files acts as a full disk; it does not apply to the pipe.
  const std::string limit = "trap '' XFSZ; ulimit -f 8; ";
  const std::string shell = "(" + limit + "'" KINESPHERE_PROGRAM "' run " + scene + " --frames " +
                            path("f.xyz") + " 2>'" + path("err") + "'; echo exit $?) | cat >'" + path("out") +
                            "'";
  ASSERT_EQ(std::system(shell.c_str()), 0);
  const std::string out = read_text(path("out")), err = read_text(path("err"));
  EXPECT_NE(out.find("\nhash "), std::string::npos) << out;
  EXPECT_NE(out.find("\nexit 2\n"), std::string::npos) << out;
  EXPECT_NE(err.find("f.xyz: cannot write: File too large"), std::string::npos) << err;
  EXPECT_FALSE(std::filesystem::exists(path("f.xyz")));
}

}  // namespace
}  // namespace kinesphere::program::robustness_test
