// Figures in summaries.
#include "scenes/summary.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/progress.hpp"

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

TEST(Progress, Line) {
  EXPECT_EQ(progress_line(0, 15, 0), "[..............................]   0 %  0 of 15 s");
  EXPECT_EQ(progress_line(5, 15, 2), "[##########....................]  33 %  5 of 15 s, 4 s left");
  EXPECT_EQ(progress_line(15, 15, 6), "[##############################] 100 %  15 of 15 s, 0 s left");
}

}  // namespace
}  // namespace kinesphere::program::summary_test
