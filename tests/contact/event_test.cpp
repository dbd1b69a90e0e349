// Names of event kinds and walls.
#include "kinesphere/event.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

namespace kinesphere::event_test {
namespace {

TEST(EventNames, AreThoseOfTheEnumerators) {
  EXPECT_EQ(name_of(EventKind::bound_violation), "bound_violation");
  EXPECT_EQ(name_of(EventKind::contact_begin), "contact_begin");
  EXPECT_EQ(name_of(EventKind::contact_end), "contact_end");
  EXPECT_EQ(name_of(EventKind::wall_begin), "wall_begin");
  EXPECT_EQ(name_of(EventKind::wall_end), "wall_end");
  EXPECT_EQ(name_of(EventKind::zeno_guard), "zeno_guard");
  EXPECT_EQ(name_of(EventKind::woke), "woke");
  EXPECT_EQ(name_of(Wall::none), "none");
  EXPECT_EQ(name_of(Wall::x_lower), "x_lower");
  EXPECT_EQ(name_of(Wall::z_upper), "z_upper");
}

TEST(EventNames, AreAllDifferent) {
  std::set<std::string_view> names;
  for (int kind = 0; kind < event_kind_count; ++kind) names.insert(name_of(static_cast<EventKind>(kind)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(event_kind_count));
  std::set<std::string_view> of_walls;
  for (int wall = 0; wall <= wall_count; ++wall) of_walls.insert(name_of(static_cast<Wall>(wall)));
  EXPECT_EQ(of_walls.size(), static_cast<std::size_t>(wall_count + 1));
}

}  // namespace
}  // namespace kinesphere::event_test
