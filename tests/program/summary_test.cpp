// Figures in summaries.
#include "scenes/summary.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/chart.hpp"
#include "base/progress.hpp"
#include "base/standard_output.hpp"

namespace kinesphere::program::summary_test {
namespace {

TEST(Summary, GroupsThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(123456), "123,456");
  EXPECT_EQ(grouped(18446744073709551615u), "18,446,744,073,709,551,615");
}

TEST(Summary, SharesAndNumbers) {
  EXPECT_EQ(percent(1, 8), "12.5 %");
  EXPECT_EQ(percent(1, 0), "-");
  EXPECT_EQ(number(43.3012701892), "43.3");
  EXPECT_EQ(number(1e-6), "1e-06");
  EXPECT_EQ(number(15000.4), "15,000");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(Summary, AlignsColumns) {
  Summary summary;
  summary.row("a", "12", "notes");
  summary.row("longer", "1,234", "more");
  summary.space();
  summary.row("b", "a long value without a note");
  EXPECT_EQ(summary.text(),
            "a       12     notes\n"
            "longer  1,234  more\n"
            "\n"
            "b       a long value without a note\n");
}

TEST(Summary, HasColoursOnATerminalThatWantsThem) {
  Summary summary;
  summary.row("a", "12", "notes", Tone::strong);
  summary.row("b", "bad", "", Tone::bad);
  summary.row("longer", "1,234", "more");
  EXPECT_EQ(summary.text(true),
            "a       \x1b[1m12\x1b[0m     notes\n"
            "b       \x1b[1;31mbad\x1b[0m\n"
            "longer  1,234  more\n");
  EXPECT_EQ(summary.text().find('\x1b'), std::string::npos);
  EXPECT_TRUE(has_colour(true, nullptr, "xterm"));
  EXPECT_TRUE(has_colour(true, "", "xterm")) << "an empty NO_COLOR forbids nothing";
  EXPECT_FALSE(has_colour(true, "1", "xterm"));
  EXPECT_FALSE(has_colour(true, nullptr, "dumb"));
  EXPECT_FALSE(has_colour(true, nullptr, nullptr));
  EXPECT_FALSE(has_colour(false, nullptr, "xterm"));
}

TEST(Chart, CountsAsPeopleDo) {
  EXPECT_EQ(counted(1, "approach", "approaches"), "1 approach");
  EXPECT_EQ(counted(0, "approach", "approaches"), "0 approaches");
  EXPECT_EQ(counted(2000, "track"), "2,000 tracks");
}

TEST(Chart, HasTicksAtRoundTimes) {
  const auto texts = [](const std::vector<Tick>& ticks) {
    std::vector<std::string> result;
    for (const Tick& tick : ticks) result.push_back(tick.text);
    return result;
  };
  using Texts = std::vector<std::string>;
  // 1700000000 is 2023-11-14 22:13:20.
  EXPECT_EQ(texts(clock_ticks(0, 1800, 1700000000, 6)),
            (Texts{"22:15", "22:20", "22:25", "22:30", "22:35", "22:40"}));
  EXPECT_EQ(texts(clock_ticks(0, 100, 1700000000, 4)),
            (Texts{"22:13:30", "22:14:00", "22:14:30", "22:15:00"}));
  EXPECT_EQ(texts(clock_ticks(0, 4 * 86400.0, 1700000000, 6)), (Texts{"11-15", "11-16", "11-17", "11-18"}));
  EXPECT_EQ(clock_ticks(100, 130, 1700000000, 6).front().at, 100);
  EXPECT_EQ(texts(number_ticks(0, 1, 5)), (Texts{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
}

TEST(Progress, Line) {
  EXPECT_EQ(progress_line(0, 15, 0), "[..............................]   0 %  0 of 15 s");
  EXPECT_EQ(progress_line(5, 15, 2), "[##########....................]  33 %  5 of 15 s, 4 s left");
  EXPECT_EQ(progress_line(15, 15, 6), "[##############################] 100 %  15 of 15 s, 0 s left");
}

}  // namespace
}  // namespace kinesphere::program::summary_test
