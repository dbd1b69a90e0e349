// `kinesphere watch --same` and `--ignore`: ids by the user's word.
#include <nlohmann/json.hpp>
#include <string>

#include "program/support.hpp"

namespace kinesphere::program::watched_ids_test {
namespace {

using Json = nlohmann::json;

class WatchedIds : public ProgramTest {
 protected:
  /// Returns the ids that have alerts, and sets the summary.
  std::string told(const std::string& options) {
    const ProgramRun result =
        run("watch " + path("s") + promises_ + options + " --quiet --summary '" + path("summary.json") + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    summary_ = Json::parse(read_text(path("summary.json")));
    std::filesystem::remove(path("summary.json"));
    std::string ids;
    std::istringstream text(result.out);
    for (std::string line; std::getline(text, line);) {
      const Json alert = Json::parse(line);
      ids += alert["first"].get<std::string>() + "-" + alert["second"].get<std::string>() + " ";
    }
    return ids;
  }
  std::string promises_ =
      " --separation sphere:20 --acceleration 5 --position-error 2 --velocity-error 0.3 --only within ";
  Json summary_;
};

TEST_F(WatchedIds, AreThoseOfBodiesByTheUsersWord) {
  write("s",
        "id,time,x,y,z,vx,vy,vz\nA1,0,0,0,9,0,0,0\nb,0,3,0,9,0,0,0\nc,0,9,0,9,0,0,0\n"
        "A1,1,0,0,9,0,0,0\nb,1,3,0,9,0,0,0\nc,1,9,0,9,0,0,0\n");
  EXPECT_EQ(told(""), "A1-b b-c A1-c ");
  EXPECT_EQ(told("--ignore b"), "A1-c ");
  EXPECT_EQ(summary_["filtered"], 2);
  EXPECT_EQ(summary_["tracks"], 2);
  EXPECT_EQ(told("--ignore a1 --ignore B"), "");
  EXPECT_EQ(summary_["reports"], 2);
  EXPECT_EQ(told("--ignore '@" + write("list", "# mine\n\"A1\",x\n\nc\n") + "'"), "");
  // The reports of both count as those of one: b is 3 m from A1.
  EXPECT_EQ(told("--same b=A1"), "A1-c ");
  EXPECT_EQ(summary_["tracks"], 2);
  EXPECT_EQ(summary_["reports"], 6);
  EXPECT_EQ(told("--same b=a1 --same c=b"), "");
  EXPECT_EQ(summary_["tracks"], 1);
  EXPECT_EQ(told("--same '@" + write("pairs", "b,c\n# c is A1\nc=A1\n") + "'"), "");
  EXPECT_EQ(summary_["tracks"], 1);
  // The own track may be said by any of its ids.
  EXPECT_EQ(told("--own b --same b=A1"), "A1-c ");
}

TEST_F(WatchedIds, AreThoseOfMessages) {
  write("s", R"({"now": 1700000000, "aircraft": [
{"hex": "3c65a1", "lat": 50, "lon": 8, "alt_baro": 5500, "gs": 0, "track": 0, "baro_rate": 0, "rc": 75, "sil": 3, "seen_pos": 0},
{"hex": "~3c65a1", "lat": 50, "lon": 8, "alt_baro": 5500, "gs": 0, "track": 0, "baro_rate": 0, "rc": 75, "sil": 3, "seen_pos": 0}]}
)");
  promises_ = " --separation cylinder:5NM:1000ft ";
  EXPECT_EQ(told(""), "3c65a1-~3c65a1 ");
  EXPECT_EQ(told("--ignore '~3C65A1'"), "");
  EXPECT_EQ(summary_["filtered"], 1);
  EXPECT_EQ(told("--same '~3c65a1=3c65a1'"), "");
  EXPECT_EQ(summary_["tracks"], 1);
}

TEST_F(WatchedIds, NamesWhatIsWrong) {
  write("s", "id,time,x,y,z\na,0,0,0,9\n");
  const std::string options = "watch " + path("s") + promises_;
  for (const char* wrong : {"a", "a=", "=b", "a=A", "''"})
    expect_wrong_input(options + "--same " + wrong, {"--same: expected two ids as in A=B"});
  expect_wrong_input(options + "--same b=a --same B=c",
                     {"--same: expected 'B' to be the same as one id, but it is 'a' and 'c'"});
  expect_wrong_input(options + "--same a=b --same b=a", {"is the same as itself"});
  expect_wrong_input(options + "--same @" + write("none", "# nothing\n"),
                     {"--same: expected ids in", "none"});
  expect_wrong_input(options + "--ignore @" + path("absent"), {"absent"});
  expect_wrong_input(options + "--ignore ''", {"--ignore: expected an id, but got nothing"});
}

}  // namespace
}  // namespace kinesphere::program::watched_ids_test
