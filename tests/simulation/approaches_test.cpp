// Approaches from events: pairs of begin and end, and tracks that end first.
#include "simulation/tracks/approaches.hpp"

#include <gtest/gtest.h>

namespace kinesphere::approaches_test {
namespace {

Event event(EventKind kind, double time, std::uint32_t first, std::uint32_t second) {
  Event event;
  event.kind = kind;
  event.time = time;
  event.first = {first, 0};
  event.second = {second, 0};
  return event;
}

Event begin(double time, std::uint32_t first, std::uint32_t second) {
  return event(EventKind::contact_begin, time, first, second);
}

Event end(double time, std::uint32_t first, std::uint32_t second) {
  return event(EventKind::contact_end, time, first, second);
}

/// Body 0 during [0, 10], body 1 during [2, 8], body 2 during [0, 10].
Scene three_tracks() {
  Scene scene;
  scene.bodies = {{1, 0, 10}, {1, 2, 8}, {1, 0, 10}};
  scene.end_time = 10;
  return scene;
}

TEST(Approaches, PairBeginAndEnd) {
  const auto all = approaches_in(three_tracks(), {begin(3, 0, 1), begin(4, 0, 2), end(5, 0, 1),
                                                  begin(6, 0, 1), end(6.5, 0, 2), end(7, 0, 1)});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].begin, 3);
  EXPECT_EQ(all[0].end, 5);
  EXPECT_EQ(all[1].second, 2u);
  EXPECT_EQ(all[1].end, 6.5);
  EXPECT_EQ(all[2].begin, 6);
  EXPECT_EQ(all[2].end, 7);
  for (const Approach& approach : all) {
    EXPECT_FALSE(approach.begins_with_track);
    EXPECT_FALSE(approach.ends_with_track);
  }
}

TEST(Approaches, KnowWhenATrackBeginsOrEndsClose) {
  const auto all = approaches_in(three_tracks(), {begin(2, 0, 1), end(8, 0, 1), begin(9, 0, 2)});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(all[0].begins_with_track);
  EXPECT_TRUE(all[0].ends_with_track);
  EXPECT_FALSE(all[1].begins_with_track);
  EXPECT_TRUE(all[1].ends_with_track);
  EXPECT_EQ(all[1].end, 10);
}

}  // namespace
}  // namespace kinesphere::approaches_test
