// Times of files: dates and numbers, exact at any distance from zero, and written in the file's form.
#include <gtest/gtest.h>

#include "formats/fields/time_scale.hpp"
#include "formats/fields/time_text.hpp"

namespace kinesphere::program::time_test {
namespace {

std::int64_t date_seconds(std::string_view text) {
  const auto date = parse_date_time(text);
  EXPECT_TRUE(date) << text;
  return date ? date->time.whole : -1;
}

TEST(TimeText, ReadsDates) {
  EXPECT_EQ(date_seconds("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(date_seconds("2000-02-29T12:00"), 951825600);
  EXPECT_EQ(date_seconds("2024-01-31 12:30:15Z"), 1706704215);
  EXPECT_EQ(date_seconds("20240131T123015Z"), 1706704215);
  EXPECT_EQ(date_seconds("2024-01-31T14:30:15+02:00"), 1706704215);
  EXPECT_EQ(date_seconds("2024-01-31T14:30:15+02"), 1706704215);
  EXPECT_EQ(date_seconds("2024-01-31T07:00:15 -0530"), 1706704215);
  EXPECT_EQ(date_seconds("2024-01-31"), 1706659200);
  EXPECT_EQ(date_seconds("1969-12-31T23:59:59Z"), -1);
  EXPECT_EQ(date_seconds("2016-12-31T23:59:60Z"), date_seconds("2017-01-01T00:00:00Z"));
  EXPECT_EQ(date_seconds("2016-12-31T24:00:00Z"), date_seconds("2017-01-01T00:00:00Z"));
  EXPECT_EQ(parse_date_time("2024-01-31T12:30:15.125Z")->time.fraction, 0.125);
  for (const char* same :
       {"2024-01-31 12:30:15 UTC", "2024-01-31 12:30:15 GMT", "20240131_123015Z", "2024-1-31 12:30:15Z",
        "31-Jan-2024 12:30:15", "31 January 2024 12:30:15", "Jan 31, 2024 12:30:15 PM",
        "Wed, 31 Jan 2024 12:30:15 GMT", "31.Jan.2024 12:30:15", "2024/1/31 12:30:15 pm",
        "2024-01-31 12:30:15 p.m.", "2024-01-31 12:30:15.000 +0000 UTC", "2024-01-31 13:30:15 UTC+1",
        "Wed Jan 31 2024 13:30:15 GMT+0100 (CET)"})
    EXPECT_EQ(date_seconds(same), 1706704215) << same;
  EXPECT_EQ(date_seconds("2024-1-31 9:30:15"), 1706704215 - 3 * 3600);
  EXPECT_EQ(date_seconds("2024-01-31 12:30:15 AM"), 1706704215 - 12 * 3600);
  EXPECT_EQ(date_seconds("2024-01-31 9:30:15 PM"), 1706704215 + 9 * 3600);
  EXPECT_TRUE(parse_date_time("2024-01-31 12:30:15 UTC")->has_offset);
  EXPECT_FALSE(parse_date_time("31-Jan-2024 12:30:15")->has_offset);
  EXPECT_EQ(parse_date_time("2024-01-31T12:30:15,5")->time.fraction, 0.5);
  EXPECT_TRUE(parse_date_time("2024-01-31T12:30:15Z")->has_offset);
  EXPECT_FALSE(parse_date_time("2024-01-31T12:30:15")->has_offset);
}

TEST(TimeText, RefusesWhatIsNoDate) {
  for (const char* wrong : {"",
                            "2024",
                            "20240131",
                            "2024-1-31T00:0",
                            "Thu 31 2024",
                            "31-Foo-2024",
                            "29-Feb-2023",
                            "31-Ja-2024",
                            "2024-01-31 13:30 PM",
                            "2023-02-29T00:00:00Z",
                            "2024-13-01T00:00",
                            "2024-00-10",
                            "2024-01-31T25:00",
                            "2024-01-31T24:01",
                            "2024-01-31T12",
                            "2024-01-31T12:60",
                            "2024-01-31T12:30:61",
                            "2024-01-31T12:30:15.",
                            "2024-01-31T12:30:15X",
                            "2024-01-31T12:30:15+1",
                            "2024-01-31T12:30:15+02:",
                            "2024-01-31T12:30:15+02:60",
                            "2024-01-31T12:30:15ZZ",
                            "2024-01-31 12:30:15 UTC+",
                            "2024-01-31 12:30:15 +0000 (UTC",
                            "31/01/2024 12:30",
                            "2024-01-31  12:30"}) {
    EXPECT_FALSE(parse_date_time(wrong)) << wrong;
  }
}

TEST(TimeText, ReadsNumbersExactly) {
  const auto check = [](std::string_view text, std::int64_t whole, double fraction) {
    const auto time = parse_decimal_time(text);
    ASSERT_TRUE(time) << text;
    EXPECT_EQ(time->whole, whole) << text;
    EXPECT_EQ(time->fraction, fraction) << text;
  };
  check("0", 0, 0);
  check("1700000000.123", 1700000000, 0.123);
  check("+1700000000123456789", 1700000000123456789, 0);
  check("-1.25", -2, 0.75);
  check("-3", -3, 0);
  check("1.5e3", 1500, 0);
  check("-2.5e-1", -1, 0.75);
  check(".5", 0, 0.5);
  check("7.", 7, 0);
  for (const char* wrong : {"", "x", "1e300", "9999999999999999999", "nan", "inf", "1 2", "--1", "1.2.3"})
    EXPECT_FALSE(parse_decimal_time(wrong)) << wrong;
}

std::string round_trip(TimeScale scale, std::string_view text, std::string_view other) {
  const FileTime time = *parse_decimal_time(text);
  scale.set_origin(time, *parse_decimal_time(other));
  return scale.text(scale.seconds(time));
}

TEST(TimeScale, TellsTimesAsTheFileDoes) {
  const TimeScale seconds;
  EXPECT_EQ(round_trip(seconds, "12.04", "99"), "12.04");
  EXPECT_EQ(round_trip(seconds, "1700000000.123", "1700000321"), "1700000000.123");
  EXPECT_EQ(round_trip(seconds, "-1700000000.123", "-1700000000"), "-1700000000.123");
  // A sum of rounded parts would end in ...0000000000002.
  for (const char* time :
       {"1.648337", "24.975016", "-1.648337", "1.2000000000000002", "0.30000000000000004", "54321.648337"})
    EXPECT_EQ(round_trip(seconds, time, "99999"), time);
  for (const char* time : {"1648.337", "24975.016", "1.1", "0.7"})
    EXPECT_EQ(round_trip(TimeScale(TimeKind::number, 1.0, 1e3), time, "99999"), time);
  const TimeScale milliseconds(TimeKind::number, 1.0, 1e3);
  EXPECT_EQ(round_trip(milliseconds, "1700000000123", "1700000321000"), "1700000000123");
  const TimeScale nanoseconds(TimeKind::number, 1.0, 1e9);
  EXPECT_EQ(round_trip(nanoseconds, "1700000000123456789", "1700000000123999999"), "1700000000123456789");
  const TimeScale days(TimeKind::number, 86400.0);
  EXPECT_EQ(round_trip(days, "45000.25", "45001"), "45000.25");
  const TimeScale frames(TimeKind::frames, 1.0, 25.0);
  EXPECT_EQ(round_trip(frames, "301", "400"), "12.04");
}

TEST(TimeScale, TellsDates) {
  const FileTime time = parse_date_time("2024-02-29T23:59:59.875Z")->time;
  TimeScale utc(TimeKind::utc);
  utc.set_origin(time, time);
  EXPECT_EQ(utc.text(utc.seconds(time)), "2024-02-29T23:59:59.875Z");
  EXPECT_EQ(utc.text(utc.seconds(time) + 0.125), "2024-03-01T00:00:00Z");
  EXPECT_EQ(utc.text(utc.seconds(time) + 0.25, 1), "2024-03-01T00:00:00.1Z");
  TimeScale local(TimeKind::date);
  local.set_origin(time, time);
  EXPECT_EQ(local.text(local.seconds(time)), "2024-02-29T23:59:59.875");
}

TEST(TimeScale, RoundsToTheDecimalsThatAreAskedFor) {
  const TimeScale seconds;
  EXPECT_EQ(seconds.text(1.0 / 3, 6), "0.333333");
  EXPECT_EQ(seconds.text(-1.0 / 3, 6), "-0.333333");
  EXPECT_EQ(seconds.text(0.9999999, 6), "1");
  EXPECT_EQ(seconds.text(-0.9999999, 6), "-1");
  EXPECT_EQ(seconds.text(-2.0, 6), "-2");
}

}  // namespace
}  // namespace kinesphere::program::time_test
