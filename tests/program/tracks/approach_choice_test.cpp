// Which approaches are told: --from, --until, --only, --min-duration.
#include <algorithm>

#include "program/support.hpp"

namespace kinesphere::program::approach_choice_test {
namespace {

/// Ann and bob meet head-on and are closer than 2 from 4 s to 6 s; "c, jr" follows bob at a distance of 1.
constexpr std::string_view walk =
    "id,t,x,y\nann,0,0,0\nann,5,5,0\nann,10,10,0\nbob,0,10,0\nbob,5,5,0\nbob,10,0,0\n"
    "\"c, jr\",0,10,1\n\"c, jr\",5,5,1\n\"c, jr\",10,0,1\n";

class ApproachChoiceOf : public ProgramTest {
 protected:
  /// Returns the rows of --contacts, without the header: begin,end,first,second,begins,ends.
  std::vector<std::string> contacts(const std::string& options) const {
    const ProgramRun result = run("tracks '" + path("t.csv") + "' --distance 2 --quiet --contacts '" +
                                  path("a.csv") + "' " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::vector<std::string> rows;
    std::string text = read_text(path("a.csv"));
    for (text.erase(0, text.find('\n') + 1); !text.empty(); text.erase(0, text.find('\n') + 1)) {
      const std::string row = text.substr(0, text.find('\n'));
      std::size_t end = 0;
      const bool quoted = row.find('"') != std::string::npos;
      for (int comma = 0; comma < (quoted ? 7 : 6); ++comma) end = row.find(',', end + 1);
      rows.push_back(row.substr(0, end));
    }
    std::sort(rows.begin(), rows.end());
    return rows;
  }
};

TEST_F(ApproachChoiceOf, WindowsCutApproachesAndLeaveCurvesAlone) {
  write("t.csv", walk);
  EXPECT_EQ(contacts("--from 4.5 --until 5.5 --only ann").at(1), "4.5,5.5,ann,bob,true,true");
  const auto begun = contacts("--until 5.5 --only ann");
  ASSERT_EQ(begun.size(), 2u);
  EXPECT_TRUE(begun[0].starts_with("3.99999") || begun[0].starts_with("4")) << begun[0];
  EXPECT_TRUE(begun[0].ends_with(",5.5,ann,bob,false,true")) << begun[0];
  // A window before the approach has none, and one between two samples is enough.
  EXPECT_EQ(contacts("--until 3 --only ann").size(), 0u);
  EXPECT_EQ(contacts("--from 5.1 --until 5.2 --only ann --interpolate linear --verify").size(), 2u);
}

TEST_F(ApproachChoiceOf, TimesAreThoseOfTheFile) {
  const std::string dates = write("d.csv",
                                  "id,time,x,y\na,2024-05-01T08:00:00Z,0,0\na,2024-05-01T08:00:10Z,10,0\n"
                                  "b,2024-05-01T08:00:00Z,10,0\nb,2024-05-01T08:00:10Z,0,0\n");
  const std::string options = " --distance 20 --contacts " + path("a.csv");
  ASSERT_EQ(run("tracks " + dates + options + " --from 2024-05-01T10:00:02+02:00").exit_code, 0);
  EXPECT_NE(read_text(path("a.csv")).find("\n2024-05-01T08:00:02Z,2024-05-01T08:00:10Z,a,b,true,true"),
            std::string::npos);
  expect_wrong_input("tracks " + dates + options + " --from 5", {"--from", "a date with a zone", "'5'"});
  expect_wrong_input("tracks " + dates + options + " --until 2024-05-01T08:00:02",
                     {"--until", "a date with a zone", "'2024-05-01T08:00:02'"});
  const std::string film = write("f.csv", "id,frame,x,y\na,0,0,0\na,100,10,0\nb,0,10,0\nb,100,0,0\n");
  ASSERT_EQ(run("tracks " + film + options + " --frame-rate 25 --from 50").exit_code, 0);
  EXPECT_NE(read_text(path("a.csv")).find("\n2,4,a,b,true,true"), std::string::npos);
}

TEST_F(ApproachChoiceOf, EmptyWindowsAreNamed) {
  const std::string file = "tracks " + write("t.csv", walk) + " --distance 2";
  expect_wrong_input(file + " --from 10", {"--from", "before the recording's end 10", "'10'"});
  expect_wrong_input(file + " --until 0", {"--until", "after the recording's begin 0", "'0'"});
  expect_wrong_input(file + " --from 6 --until 5", {"--until", "after --from 6", "'5'"});
  expect_wrong_input(file + " --from noon", {"--from", "a number", "'noon'"});
}

TEST_F(ApproachChoiceOf, OnlyHasApproachesWithOneOfTheIds) {
  write("t.csv", walk);
  const auto all = contacts("");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(contacts("--only ann").size(), 2u);
  EXPECT_EQ(contacts("--only ann,bob"), all);
  EXPECT_EQ(contacts("--only ann --only 'c, jr'"), all);
  EXPECT_EQ(contacts("--only 'c, jr'").size(), 2u);
  expect_wrong_input("tracks " + path("t.csv") + " --distance 2 --only ann,zoe", {"--only", "'zoe'"});
}

TEST_F(ApproachChoiceOf, ShortApproachesAreLeftOutAndCounted) {
  const std::string file = write("t.csv", walk);
  const auto lasting = contacts("--min-duration 2.5");
  ASSERT_EQ(lasting.size(), 1u);
  EXPECT_EQ(lasting[0], "0,10,bob,\"c, jr\",true,true");
  EXPECT_EQ(contacts("--min-duration 1").size(), 3u);
  const std::string text = run("tracks " + file + " --distance 2 --only ann --min-duration 1.9").out;
  for (const char* part :
       {"\nleft out          1 ", "  approaches without ann\n", "  approaches shorter than 1.9 s\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
  expect_wrong_input("tracks " + file + " --distance 2 --min-duration -1", {"--min-duration", ">= 0"});
}

}  // namespace
}  // namespace kinesphere::program::approach_choice_test
