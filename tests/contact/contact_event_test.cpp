// The content of a contact event, and the names of event kinds and walls.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <string_view>

#include "contact/contact_event.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::contact_event_test {
namespace {

TEST(ContactEvent, IsTheSameFromBothSides) {
  Random random(2);
  for (int k = 0; k < 200; ++k) {
    const Sphere a{{1, 4}, random.uniform(), {random.point_in_ball(), random.point_in_ball()}};
    const Sphere b{{2, 0}, random.uniform(), {random.point_in_ball(), random.point_in_ball()}};
    const Event one = contact_event(EventKind::contact_begin, 3.0, a, b);
    const Event other = contact_event(EventKind::contact_begin, 3.0, b, a);
    EXPECT_EQ(one.first, a.id);
    EXPECT_EQ(other.first, a.id);
    EXPECT_EQ(one.first_state, a.state);
    EXPECT_EQ(other.second_state, b.state);
    EXPECT_EQ(one.normal, other.normal);
    EXPECT_EQ(one.gap, other.gap);
    EXPECT_EQ(one.point, other.point);
    const Vec3 from_a = a.state.position + one.normal * a.radius;
    const Vec3 from_b = b.state.position - one.normal * b.radius;
    EXPECT_NEAR(norm(one.point - (from_a + from_b) * 0.5), 0.0, 1e-15);
    EXPECT_NEAR(dot(from_b - from_a, one.normal), one.gap, 1e-15);
    EXPECT_NEAR(one.approach_speed, dot(one.normal, a.state.velocity - b.state.velocity), 1e-15);
  }
}

TEST(WallEvent, SaysWhereEachWallIs) {
  const Box box{{-1, -2, -3}, {4, 5, 6}};
  const Sphere sphere{{7, 0}, 0.25, {{0.5, 1, 2}, {10, 20, 30}}};
  for (const Wall wall : walls) {
    const Event event = wall_event(EventKind::wall_begin, 1.0, sphere, box, wall);
    const int axis = (static_cast<int>(wall) - 1) / 2;
    const bool upper = static_cast<int>(wall) % 2 == 0;
    const double at = upper ? box.upper[axis] : box.lower[axis];
    EXPECT_EQ(event.wall, wall);
    EXPECT_EQ(event.second, no_body);
    EXPECT_EQ(event.normal[axis], upper ? 1.0 : -1.0);
    EXPECT_EQ(event.point[axis], at);
    EXPECT_EQ(event.gap, std::abs(at - sphere.state.position[axis]) - 0.25);
    EXPECT_EQ(event.approach_speed, event.normal[axis] * sphere.state.velocity[axis]);
    EXPECT_EQ(event.second_state, State{});
  }
}

TEST(WallBits, AreDifferent) {
  std::set<int> bits;
  for (const Wall wall : walls) bits.insert(wall_bit(wall));
  EXPECT_EQ(bits.size(), static_cast<std::size_t>(wall_count));
}

TEST(DeliveryOrder, IsKindThenFirstThenSecondThenWall) {
  const std::array<Event, 6> in_order{
      Event{.kind = EventKind::bound_violation, .first = {9, 0}},
      Event{.kind = EventKind::contact_begin, .first = {1, 0}, .second = {5, 0}},
      Event{.kind = EventKind::contact_begin, .first = {1, 1}, .second = {2, 0}},
      Event{.kind = EventKind::contact_begin, .first = {2, 0}, .second = {3, 0}},
      Event{.kind = EventKind::wall_begin, .first = {0, 0}, .wall = Wall::x_lower},
      Event{.kind = EventKind::wall_begin, .first = {0, 0}, .wall = Wall::z_upper}};
  for (std::size_t a = 0; a < in_order.size(); ++a)
    for (std::size_t b = 0; b < in_order.size(); ++b)
      EXPECT_EQ(delivered_before(in_order[a], in_order[b]), a < b);
}

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
}  // namespace kinesphere::contact_event_test
