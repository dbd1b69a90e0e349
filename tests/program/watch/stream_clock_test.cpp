// Which times the clock accepts.
#include "watch/clock/stream_clock.hpp"

#include <gtest/gtest.h>

namespace kinesphere::program::stream_clock_test {
namespace {

using Source = StreamClock::Source;

FileTime at(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  return {whole, seconds - static_cast<double>(whole)};
}

TEST(StreamClock, GoesOnWithTheLatest) {
  StreamClock clock(Source::stamps, 60.0);
  EXPECT_FALSE(clock.believes(at(100))) << "nothing confirms the first";
  clock.go_on(at(100));
  EXPECT_TRUE(clock.believes(at(160)));
  EXPECT_FALSE(clock.believes(at(160.5)));
  clock.go_on(at(90));
  EXPECT_EQ(seconds_between(at(100), clock.now()), 0.0);
}

TEST(StreamClock, BelievesThreeStampsOfTwoTracks) {
  StreamClock clock(Source::stamps, 60.0);
  clock.go_on(at(0));
  EXPECT_FALSE(clock.confirms(at(1000), "a", true));
  EXPECT_FALSE(clock.confirms(at(1001), "a", true));
  EXPECT_TRUE(clock.confirms(at(1002), "b", true));
}

TEST(StreamClock, BelievesTenStampsOfOne) {
  StreamClock clock(Source::stamps, 60.0);
  clock.go_on(at(0));
  for (int k = 1; k < 10; ++k) EXPECT_FALSE(clock.confirms(at(1000 + k), "a", true)) << k;
  EXPECT_TRUE(clock.confirms(at(1010), "a", true));
  clock.interrupt();
  EXPECT_FALSE(clock.confirms(at(1000), "a", false));
  EXPECT_FALSE(clock.confirms(at(1001), "a", false));
  EXPECT_TRUE(clock.confirms(at(1002), "a", false)) << "there is no other track";
}

TEST(StreamClock, BeginsAgainWhereTimesGoBack) {
  StreamClock clock(Source::stamps, 60.0);
  clock.go_on(at(0));
  EXPECT_FALSE(clock.confirms(at(5000), "a", true));
  EXPECT_FALSE(clock.confirms(at(1000), "b", true));
  EXPECT_EQ(clock.in_a_row(), 1u);
  EXPECT_FALSE(clock.confirms(at(1001), "b", true));
  EXPECT_TRUE(clock.confirms(at(1002), "c", true));
  clock.interrupt();
  EXPECT_FALSE(clock.confirms(at(1000), "d", true));
}

/// Times of a sparse stream confirm each other, however far apart they are.
TEST(StreamClock, BelievesSparseTimesInOrder) {
  StreamClock clock(Source::stamps, 60.0);
  clock.go_on(at(0));
  EXPECT_FALSE(clock.confirms(at(400), "a", true));
  EXPECT_FALSE(clock.confirms(at(800), "b", true));
  EXPECT_FALSE(clock.confirms(at(500), "c", true)) << "it begins again";
  EXPECT_FALSE(clock.confirms(at(900), "a", true));
  EXPECT_TRUE(clock.confirms(at(890), "b", true)) << "a little disorder does not count";
}

/// One of three clocks is an hour ahead when the stream begins.
TEST(StreamClock, BeginsWithoutAWrongClock) {
  StreamClock clock(Source::stamps, 60.0);
  EXPECT_FALSE(clock.confirms(at(0), "a", false));
  EXPECT_FALSE(clock.confirms(at(3600), "wrong", false));
  EXPECT_FALSE(clock.confirms(at(1), "c", false)) << "the one before does not count";
  EXPECT_EQ(clock.in_a_row(), 2u);
  EXPECT_TRUE(clock.confirms(at(2), "a", false));
  EXPECT_FALSE(clock.is_confirmed(at(3600)));
  // A sparse stream begins with six.
  StreamClock sparse(Source::stamps, 60.0);
  for (int k = 0; k < 5; ++k) EXPECT_FALSE(sparse.confirms(at(1200 * k), k % 2 == 0 ? "a" : "b", false)) << k;
  EXPECT_TRUE(sparse.confirms(at(6000), "b", false));
}

TEST(StreamClock, BelievesTwoArrivalsThatDiffer) {
  StreamClock clock(Source::arrivals, 60.0);
  clock.go_on(at(0));
  for (int k = 0; k < 20; ++k)
    EXPECT_FALSE(clock.confirms(at(1000), std::to_string(k), true)) << "one document";
  EXPECT_TRUE(clock.confirms(at(1001), "a", true));
}

}  // namespace
}  // namespace kinesphere::program::stream_clock_test
