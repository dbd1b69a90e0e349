// `run --record` and `replay`: equal hashes, complete files, and one clear line for each error.
#include "support.hpp"

namespace kinesphere::program::replay_test {
namespace {

constexpr std::string_view coming_and_going = R"({
  "bodies": 60, "radius": [1, 6], "box": [[0, 0, 0], [60, 60, 60]], "seconds": 3, "response": "bounce" })";

TEST_F(ProgramTest, ReplaysWhatItRecorded) {
  const std::string scene = write("s.json", coming_and_going);
  const std::string plain = run("run " + scene + " --hash-only").out;
  EXPECT_EQ(run("run " + scene + " --record " + path("r") + " --hash-only").out, plain);
  EXPECT_EQ(run("replay " + path("r") + " --hash-only").out, plain);
  const ProgramRun result = run("replay " + path("r"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const std::string& part : {plain, std::string("contacts "), std::string("verdict "),
                                  std::string("the same to the last bit"), std::string("180 body-seconds")})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << result.out;
}

TEST_F(ProgramTest, RefusesWhatIsNoRecording) {
  const std::string scene = write("s.json", coming_and_going);
  expect_wrong_input("replay", {"FILE"});
  expect_wrong_input("replay " + path("none"), {"none", "cannot read"});
  expect_wrong_input("replay " + scene, {scene, "must begin with the mark of a recording"});
  run("run " + scene + " --record " + path("r") + " --quiet");
  const std::string whole = read_text(path("r"));
  ASSERT_GT(whole.size(), 10000u);
  write("cut", whole.substr(0, whole.size() / 2));
  expect_wrong_input("replay " + path("cut"), {"cut: ", "must be whole"});
  std::string damaged = whole;
  damaged[damaged.size() / 2] ^= 1;
  write("damaged", damaged);
  expect_wrong_input("replay " + path("damaged"), {"damaged: ", "checksum"});
}

TEST_F(ProgramTest, RecordsWithTheWorldAloneAndIntoAFileOfItsOwn) {
  const std::string scene = write("s.json", coming_and_going);
  expect_wrong_input("run " + scene + " --record " + path("r.csv") + " --contacts " + path("r.csv"),
                     {"--record", "another file than that of --contacts"});
  expect_wrong_input("run " + scene + " --record " + path("no/r"), {"no/r", "cannot write"});
  EXPECT_EQ(names(), std::vector<std::string>{"s.json"}) << "nothing is left behind";
}

}  // namespace
}  // namespace kinesphere::program::replay_test
