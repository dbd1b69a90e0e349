// The textbook bounce: momentum, energy, restitution.
#include <gtest/gtest.h>

#include "contact/contact_event.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"

namespace kinesphere {
namespace {

TEST(Bounce, KeepsMomentumAndLosesWhatRestitutionSays) {
  Random random(4);
  for (int k = 0; k < 500; ++k) {
    const Vec3 normal = random.unit_vector();
    const Sphere a{{0, 0}, 0.5, {{}, 3.0 * random.point_in_ball() + normal}};
    const Sphere b{{1, 0}, 0.5, {normal, 3.0 * random.point_in_ball() - normal}};
    const double m = random.uniform(0.01, 10.0), n = random.uniform(0.01, 10.0);
    const double restitution = k % 3 == 0 ? 1.0 : k % 3 == 1 ? 0.0 : random.uniform();
    const Event event = contact_event(EventKind::contact_begin, 0.0, a, b);
    const auto [v, w] = bounce(event, m, n, restitution);
    const Vec3 momentum = a.state.velocity * m + b.state.velocity * n;
    EXPECT_NEAR(norm(v * m + w * n - momentum), 0.0, 1e-12);
    EXPECT_NEAR(dot(event.normal, w - v), restitution * event.approach_speed, 1e-12);
    // Frictionless: nothing changes across the normal.
    const Vec3 change = v - a.state.velocity;
    EXPECT_NEAR(norm(change - event.normal * dot(event.normal, change)), 0.0, 1e-12);
    const auto energy = [&](const Vec3& x, const Vec3& y) {
      return m * norm_squared(x) + n * norm_squared(y);
    };
    const double reduced = m * n / (m + n);
    const double loss =
        (1 - restitution * restitution) * reduced * event.approach_speed * event.approach_speed;
    EXPECT_NEAR(energy(v, w), energy(a.state.velocity, b.state.velocity) - loss, 1e-10);
  }
}

TEST(Bounce, EqualMassesSwapAndAHeavyOneStays) {
  const Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {2, 0, 0}}},
                                    {{1, 0}, 1, {{2, 0, 0}, {}}});
  const Bounce swapped = bounce(event, 1.0, 1.0, 1.0);
  EXPECT_EQ(swapped.first_velocity, (Vec3{}));
  EXPECT_EQ(swapped.second_velocity, (Vec3{2, 0, 0}));
  const Bounce heavy = bounce(event, 1.0, 1e30, 1.0);
  EXPECT_NEAR(heavy.first_velocity.x, -2.0, 1e-12);
  EXPECT_NEAR(heavy.second_velocity.x, 0.0, 1e-12);
}

TEST(Bounce, OffAWallReflects) {
  const Event event = wall_event(EventKind::wall_begin, 0.0, {{0, 0}, 1, {{9, 5, 5}, {3, 1, -2}}},
                                 Box{{0, 0, 0}, {10, 10, 10}}, Wall::x_upper);
  EXPECT_EQ(bounce(event, 1.0, 0.0, 1.0).first_velocity, (Vec3{-3, 1, -2}));
  EXPECT_EQ(bounce(event, 1.0, 0.0, 0.5).first_velocity, (Vec3{-1.5, 1, -2}));
  EXPECT_EQ(bounce(event, 1.0, 0.0, 0.0).first_velocity, (Vec3{0, 1, -2}));
  EXPECT_EQ(bounce(event, 1.0, 0.0, 0.0).second_velocity, (Vec3{}));
}

TEST(Bounce, RepeatedContactLosesNothing) {
  Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {2, 0, 0}}},
                              {{1, 0}, 1, {{2, 0, 0}, {}}});
  event.repeated = true;
  const Bounce after = bounce(event, 1.0, 3.0, 0.0);
  EXPECT_NEAR(norm_squared(after.first_velocity) + 3.0 * norm_squared(after.second_velocity), 4.0, 1e-12);
}

}  // namespace
}  // namespace kinesphere
