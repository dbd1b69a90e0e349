// `kinesphere tracks` in use: far origins, pipes, warnings, questions.
#include "program/support.hpp"

namespace kinesphere::program::tracks_program_test {
namespace {

class TracksProgram : public ProgramTest {};

/// Two bodies that meet head-on: closer than 2 from 4 s to 6 s.
constexpr std::string_view meeting =
    "id,t,x,y\nann,0,0,0\nann,5,5,0\nann,10,10,0\nbob,0,10,0\nbob,5,5,0\nbob,10,0,0\n";

/// The meeting in 2023, in UTM.
constexpr std::string_view far_meeting =
    "MMSI,Timestamp,Easting,Northing\n"
    "ann,1700000000.125,500000,5400000\nann,1700000005.125,500005,5400000\nann,1700000010.125,500010,"
    "5400000\n"
    "bob,1700000000.125,500010,5400000\nbob,1700000005.125,500005,5400000\nbob,1700000010.125,500000,"
    "5400000\n";

TEST_F(TracksProgram, VerifiesTimesAndPlacesFarFromZero) {
  const ProgramRun result = run("tracks " + write("far.csv", far_meeting) +
                                " --distance 2 --tolerance 1e-9 --verify --contacts " + path("a.csv"));
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_NE(result.out.find("detector and oracle agree"), std::string::npos) << result.out;
  const std::string rows = read_text(path("a.csv"));
  EXPECT_NE(rows.find("\n1700000004.12"), std::string::npos) << rows;
  EXPECT_NE(rows.find(",1700000006.12"), std::string::npos) << rows;
}

TEST_F(TracksProgram, ReadsStandardInput) {
  const std::string file = write("t.csv", meeting);
  const ProgramRun result = run("tracks - --distance 2", "cat '" + file + "' | ");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("ann bob"), std::string::npos) << result.out;
  EXPECT_TRUE(run("tracks - --distance 2", "printf 'id,t,x,y\\na,b,1,2\\n' | ")
                  .err.starts_with("kinesphere: standard input:2: expected a number as time"));
}

TEST_F(TracksProgram, JoinsFiles) {
  const std::string first = write("first.csv", "id,t,x,y\nann,0,0,0\nann,5,5,0\nbob,0,10,0\nbob,5,5,0\n");
  const std::string second = write("second.csv", "id,t,x,y\nann,10,10,0\nbob,10,0,0\n");
  const ProgramRun result = run("tracks " + first + " " + second + " --distance 2");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("of 6 rows"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("second.csv"), std::string::npos);
}

TEST_F(TracksProgram, CountsWhatItPassesOver) {
  const std::string file = write("t.csv", std::string(meeting) + "ann,7,nan,0\nbob,10,0,1\nbob,2,999,0\n");
  expect_wrong_input("tracks " + file + " --distance 2", {"t.csv:8:", "column 3", "--missing"});
  expect_wrong_input("tracks " + file + " --distance 2 --missing skip",
                     {"t.csv:9:", "'bob'", "t.csv:7", "--duplicates"});
  const ProgramRun result =
      run("tracks " + file + " --distance 2 --missing skip --duplicates first --max-speed 3");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* row : {"\nmissing values ", "\nduplicates ", "\ntoo fast "})
    EXPECT_NE(result.out.find(row), std::string::npos) << row << "\n" << result.out;
  for (const char* line : {"line 8", "line 9", "line 10"})
    EXPECT_NE(result.out.find(line), std::string::npos) << line << "\n" << result.out;
  EXPECT_NE(result.err.find("warning: 1 of 9 rows (11.1 %) were left out by --max-speed"), std::string::npos)
      << result.err;
}

TEST_F(TracksProgram, LinesOrCurves) {
  const std::string file = write("t.csv", meeting);
  const ProgramRun lines = run("tracks " + file + " --distance 2 --interpolate linear --verify");
  EXPECT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_NE(lines.out.find("detector and oracle agree"), std::string::npos);
  expect_wrong_input("tracks " + file + " --distance 2 --interpolate cubic",
                     {"--interpolate", "linear|spline", "'cubic'"});
  expect_wrong_input("tracks " + file + " --distance 2 --positions mars",
                     {"--positions", "lonlat", "'mars'"});
  expect_wrong_input("tracks " + file + " --distance 2 --unit furlong", {"--unit", "NM", "'furlong'"});
}

}  // namespace
}  // namespace kinesphere::program::tracks_program_test
