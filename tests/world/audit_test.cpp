// The audit finds each defect, and nothing else: also among boxes and triangles, where a new certificate may
// be shorter than the existing one.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "kinesphere/inspection.hpp"
#include "support/playground.hpp"
#include "support/sealed_snapshot.hpp"

namespace kinesphere::audit_test {
namespace {

TEST(Audit, TakesACertificateForWhatItIsThoughALaterOneIsShorter) {
  Playground p;
  p.world
      .add_static({.shape = Box{{-0.54111865268976456, -0.44610567298297532, -0.39046900397027673},
                                {-0.043652641637204836, -0.39482634089842472, -0.14837892360241645}}})
      .value();
  p.add({.radius = 0.65720095724683136,
         .planned_acceleration = {-0.032051213459653068, -0.053203662742914076, 0.025021271082702402},
         .position = {-0.5854408533312605, -0.45346483428223328, 0.38749354887213222},
         .velocity = {0.16675295969623391, 0.17554504298875764, -0.18001524245045639}});
  p.run(0.27463598588696508);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Audit, IsCleanAmongBoxesAndTriangles) {
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    Random random(seed);
    Playground p({.contacts = seed % 3 == 0 ? ContactEvents::impacts : ContactEvents::begin_and_end});
    const Vec3 at = random.point_in_ball();
    const Vec3 size{random.uniform(), random.uniform(), random.uniform()};
    Shape shape = Box{at, at + size};
    if (seed % 2 == 0) shape = Triangle{at, at + random.point_in_ball(), at + random.point_in_ball()};
    if (!p.world.add_static({.shape = shape})) continue;
    const double limit = seed % 5 == 0 ? 0.3 * random.uniform() : 0.0;
    p.add({.radius = random.uniform(),
           .acceleration_limit = limit,
           .planned_acceleration = 0.1 * random.point_in_ball(),
           .position = 2.0 * random.point_in_ball(),
           .velocity = 0.5 * random.point_in_ball()});
    for (int step = 1; step <= 6; ++step) {
      p.run(0.25 * step);
      ASSERT_TRUE(is_clean(p.world)) << "seed " << seed;
    }
  }
}

/// Returns the world of the snapshot with each occurrence of one number replaced by another.
World with_number(const World& world, double old_number, double new_number) {
  std::vector<std::byte> bytes = world.save().value();
  const auto pattern = std::bit_cast<std::array<std::byte, 8>>(old_number);
  int places = 0;
  for (auto at = bytes.begin();; ++places) {
    at = std::search(at, bytes.end(), pattern.begin(), pattern.end());
    if (at == bytes.end()) break;
    write_number(bytes, static_cast<std::size_t>(at - bytes.begin()),
                 std::bit_cast<std::uint64_t>(new_number));
  }
  EXPECT_GE(places, 1);
  return World::restore(sealed(std::move(bytes))).value();
}

std::optional<AuditFinding> audit(const World& world) { return world.inspection().audit(); }

struct Approaching : Playground {
  explicit Approaching(double radius_rate = 0.0) {
    a = add({.radius = 1, .acceleration_limit = 0.01, .velocity = {1, 0, 0}, .radius_rate = radius_rate});
    b = add({.radius = 1, .acceleration_limit = 0.01, .position = {2.5, 0.25, 0}});
    for (double t = 0.01; world.inspection().certificates().empty(); t += 0.01) run(t);
  }
  BodyId a, b;
};

TEST(Audit, FindsACertificateThatIsTooLate) {
  // Also one of a ball that grows or shrinks. The bound of a ball that shrinks is met before the ball.
  for (const auto& [radius_rate, late] : {std::pair{0.0, 0.02}, {0.25, 0.02}, {-0.01, 0.03}}) {
    Approaching p(radius_rate);
    const auto certificates = p.world.inspection().certificates();
    ASSERT_EQ(certificates.size(), 1u);
    ASSERT_TRUE(is_clean(p.world)) << radius_rate;
    const double until = certificates[0].until;
    const auto finding = audit(with_number(p.world, until, until + late));
    ASSERT_TRUE(finding) << radius_rate;
    EXPECT_EQ(finding->where, "certificate") << finding->what;
  }
}

/// Simulates a missed contact: all records stay valid for a while, but the bodies overlap now.
TEST(Audit, FindsAContactThatNoEventHasToldOf) {
  Playground p;
  p.add({.radius = 1, .position = {0.015625, 0, 0}});
  p.add({.radius = 1, .position = {2.03125, 0, 0}});
  p.run(1.0);
  ASSERT_TRUE(is_clean(p.world));
  const auto finding = audit(with_number(p.world, 2.03125, 1.984375));
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->where, "contact") << finding->what;
  EXPECT_NE(finding->what.find("no begin has been told"), std::string::npos) << finding->what;
}

TEST(Audit, FindsAContactWhoseEndNoEventHasToldOf) {
  Playground p;
  p.add({.radius = 1, .position = {0.015625, 0, 0}});
  p.add({.radius = 1, .position = {1.984375, 0, 0}});
  EXPECT_EQ(p.run(1.0).size(), 1u);
  ASSERT_TRUE(is_clean(p.world));
  const auto finding = audit(with_number(p.world, 1.984375, 2.03125));
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->where, "contact") << finding->what;
  EXPECT_NE(finding->what.find("no end has been told"), std::string::npos) << finding->what;
}

TEST(Audit, FindsASensorDistanceThatNoEventHasToldOf) {
  Playground p;
  p.world.set_sensor(0, {.distances = {0.5}}).value();
  p.add({.radius = 1, .position = {0.015625, 0, 0}});
  p.add({.radius = 1, .position = {2.75, 0, 0}});
  p.run(1.0);
  ASSERT_TRUE(is_clean(p.world));
  const auto finding = audit(with_number(p.world, 2.75, 2.25));
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->where, "sensor") << finding->what;
}

/// Returns a world with a body that moves along a period of 8, with a shortest window in which it goes no
/// farther than a few units.
World in_a_period(double time, double speed) {
  World world =
      World::create({.box = Box{{0, 0, 0}, {8, 8, 8}}, .periodic = {true, true, true}, .start_time = time})
          .value();
  const Vec3 position{4, 4, 4}, velocity{speed, 0, 0};
  world.add({.radius = 0.1, .position = position, .velocity = velocity}).value();
  const auto probe = [&](std::span<const BodyId>, double now, std::span<State> states) {
    for (State& state : states) state = {position + velocity * (now - time), velocity};
  };
  static_cast<void>(world.advance(time, probe).value());
  return world;
}

/// At 2^60 the least step of time is 2^8.
TEST(Audit, AllowsSafeRegionsForTheLeastStepThatThereIs) {
  EXPECT_EQ(audit(in_a_period(0x1p60, 0x1p-4)), std::nullopt);
  EXPECT_EQ(audit(in_a_period(-0x1p60, 0x1p-4)), std::nullopt);
}

}  // namespace
}  // namespace kinesphere::audit_test
