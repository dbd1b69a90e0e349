// Balls that turn, and bounce with friction.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "support/playground.hpp"

namespace kinesphere::rough_spheres_test {
namespace {

constexpr double radius = 0.5;

/// Balls in a periodic cube, each a rigid body of one part, or not.
struct Gas {
  Gas(std::uint32_t balls, double packing, bool turn, std::uint64_t seed) {
    const double width =
        std::cbrt(balls * 4.0 / 3.0 * 3.141592653589793 * radius * radius * radius / packing);
    const Box box{{}, {width, width, width}};
    const Axes periodic{true, true, true};
    Random random(seed);
    std::vector<State> start;
    for (const Vec3& place :
         place_spheres(std::vector<double>(balls, radius), box, {.periodic = periodic, .seed = seed}).value())
      start.push_back({place, random.point_in_ball()});
    motion = Ballistic::create({.start = start}).value();
    world = World::create({.box = box, .periodic = periodic, .contacts = ContactEvents::impacts}).value();
    for (std::uint32_t k = 0; k < balls; ++k) {
      BodyDefinition ball = motion.definition(k, 0.0);
      ball.radius = radius;
      if (turn)
        world.add_rigid_body({.body = ball, .parts = {{.radius = radius}}}).value();
      else
        world.add(ball).value();
    }
  }

  template <class Respond>
  std::uint64_t run(double until, Respond respond) {
    SingleMotionSource source(motion);
    EventHash hash;
    world.run(until, source, respond, [&](const Event& event) { hash.add(event); }).value();
    return hash.value();
  }
  Vec3 spin(BodyId id) const { return world.body(id).value().rigid->rotation.angular_velocity; }
  /// Energies of translation and of rotation of a ball, on average.
  std::pair<double, double> energies(double inertia) const {
    double moving = 0.0, turning = 0.0;
    const auto ids = world.bodies();
    for (const BodyId id : ids) {
      moving += 0.5 * norm_squared(motion.state(id.index, world.time()).velocity);
      turning += 0.5 * inertia * radius * radius * norm_squared(spin(id));
    }
    const double balls = static_cast<double>(ids.size());
    return {moving / balls, turning / balls};
  }

  World world = World::create({}).value();
  Ballistic motion = Ballistic::create({}).value();
};

Event off_centre() {
  Event contact{.kind = EventKind::contact_begin};
  contact.second = {1, 0, 0};
  contact.first = {0, 0, 0};
  contact.normal = Vec3{3.0, 4.0, 0.0} * 0.2;
  contact.first_state = {{0.0, 0.0, 0.0}, {2.0, 0.5, 0.25}};
  contact.second_state = {contact.normal * 3.0, {-1.0, 0.0, 0.5}};
  contact.point = contact.normal;  // the radii are 1 and 2
  contact.first_mass = 1.0;
  contact.second_mass = 3.0;
  contact.first_angular_velocity = {0.5, -1.0, 2.0};
  contact.second_angular_velocity = {1.0, 0.0, -0.5};
  contact.approach_speed = dot(contact.normal, contact.first_state.velocity - contact.second_state.velocity);
  return contact;
}

/// Velocity of the surfaces relative to each other at the contact.
Vec3 sliding(const Event& contact, const Bounce& with) {
  const Vec3 relative =
      with.first_velocity - with.second_velocity +
      cross(with.first_angular_velocity + with.second_angular_velocity * 2.0, contact.normal);
  return relative - contact.normal * dot(relative, contact.normal);
}
Bounce before(const Event& contact) {
  return {contact.first_state.velocity, contact.second_state.velocity, contact.first_angular_velocity,
          contact.second_angular_velocity};
}
double energy(const Event& contact, const Bounce& with, double inertia) {
  return 0.5 * contact.first_mass *
             (norm_squared(with.first_velocity) + inertia * norm_squared(with.first_angular_velocity)) +
         0.5 * contact.second_mass *
             (norm_squared(with.second_velocity) +
              inertia * 4.0 * norm_squared(with.second_angular_velocity));
}
Vec3 angular_momentum(const Event& contact, const Bounce& with, double inertia) {
  return (cross(contact.first_state.position, with.first_velocity) + with.first_angular_velocity * inertia) *
             contact.first_mass +
         (cross(contact.second_state.position, with.second_velocity) +
          with.second_angular_velocity * (4.0 * inertia)) *
             contact.second_mass;
}

TEST(RoughBounce, KeepsWhatPhysicsKeeps) {
  const Event contact = off_centre();
  for (const double tangential : {-1.0, -0.3, 0.5, 1.0}) {
    const Bounce after = bounce(contact, {.tangential_restitution = tangential});
    EXPECT_LT(norm(sliding(contact, after) + sliding(contact, before(contact)) * tangential), 1e-14);
    const Vec3 momentum = contact.first_state.velocity - after.first_velocity +
                          (contact.second_state.velocity - after.second_velocity) * 3.0;
    EXPECT_LT(norm(momentum), 1e-14);
    EXPECT_LT(norm(angular_momentum(contact, after, 0.4) - angular_momentum(contact, before(contact), 0.4)),
              1e-13);
    const double lost = energy(contact, before(contact), 0.4) - energy(contact, after, 0.4);
    if (std::abs(tangential) == 1.0)
      EXPECT_NEAR(lost, 0.0, 1e-13);
    else
      EXPECT_GT(lost, 0.1);
  }
  const Bounce smooth = bounce(contact, {.restitution = 0.7, .tangential_restitution = -1.0});
  EXPECT_LT(norm(smooth.first_velocity - bounce(contact, 0.7).first_velocity), 1e-15);
  EXPECT_EQ(smooth.first_angular_velocity, contact.first_angular_velocity);
}

TEST(RoughBounce, SlidesWhereFrictionIsLow) {
  const Event contact = off_centre();
  const double friction = 0.1;
  const Bounce after = bounce(contact, {.restitution = 0.8, .friction = friction});
  const Vec3 impulse = contact.first_state.velocity - after.first_velocity;
  const double along = dot(impulse, contact.normal);
  EXPECT_NEAR(norm(impulse - contact.normal * along), friction * along, 1e-15);
  EXPECT_GT(dot(sliding(contact, after), sliding(contact, before(contact))), 0.0) << "it slides on";
  EXPECT_NEAR(along, 1.8 * contact.approach_speed / (1.0 + 1.0 / 3.0), 1e-14);
}

/// A ball with top spin speeds up on the ground, and rolls after a bounce that takes all sliding away.
TEST(RoughBounce, RollsOnTheGround) {
  Event ground{.kind = EventKind::wall_begin, .wall = Wall::z_lower};
  ground.first = {0, 0, 0};
  ground.normal = {0.0, 0.0, -1.0};
  ground.first_state = {{0.0, 0.0, 2.0}, {0.0, 0.0, -1.0}};
  ground.second_mass = std::numeric_limits<double>::infinity();
  ground.approach_speed = 1.0;
  ground.first_angular_velocity = {0.0, 3.5, 0.0};
  const Bounce after = bounce(ground, {.restitution = 0.5, .tangential_restitution = 0.0});
  EXPECT_NEAR(after.first_velocity.z, 0.5, 1e-15);
  EXPECT_NEAR(after.first_velocity.x, 2.0, 1e-14) << "2/7 of the speed of the surface, 7";
  EXPECT_NEAR(after.first_angular_velocity.y, 1.0, 1e-14);
}

/// In balance each way to move and to turn has the same energy.
TEST(RoughSpheres, ShareTheirEnergyEvenly) {
  Gas gas(300, 0.2, true, 3);
  const auto respond = [](const Event& event) { return response_of(event, bounce(event, Roughness{})); };
  const auto [moving, none] = gas.energies(0.4);
  EXPECT_EQ(none, 0.0);
  double of_motion = 0.0, of_turning = 0.0;
  for (double time = 20.0; time < 60.0; time += 1.0) {
    gas.run(time, respond);
    const auto [now, turning] = gas.energies(0.4);
    EXPECT_NEAR(now + turning, moving, 1e-12) << "energy, at " << time;
    of_motion += now;
    of_turning += turning;
  }
  EXPECT_NEAR(of_turning / of_motion, 1.0, 0.03);
  EXPECT_TRUE(is_clean(gas.world));
}

/// A ball that turns meets others as one that does not.
TEST(RoughSpheres, MeetOthersAsBallsDo) {
  Gas balls(100, 0.2, false, 4), turning(100, 0.2, true, 4);
  const auto respond = [](const Event& event) { return response_of(event, bounce(event, 1.0)); };
  EXPECT_EQ(balls.run(3.0, respond), turning.run(3.0, respond));
  EXPECT_EQ(balls.world.counters().probes, turning.world.counters().probes);
}

TEST(RoughSpheres, GoOnFromSnapshotsAndInReplays) {
  Gas gas(60, 0.2, true, 5);
  const auto respond = [](const Event& event) {
    return response_of(event,
                       bounce(event, {.restitution = 0.95, .tangential_restitution = 0.4, .friction = 0.5}));
  };
  gas.run(2.0, respond);
  Gas again(60, 0.2, true, 5);
  again.run(2.0, respond);
  again.world = World::restore(gas.world.save().value()).value();
  gas.world.start_recording().value();
  EXPECT_EQ(gas.run(4.0, respond), again.run(4.0, respond));
  EXPECT_EQ(gas.energies(0.4), again.energies(0.4));
  auto replay = Replay::open(gas.world.stop_recording().value()).value();
  while (!replay.finished()) ASSERT_TRUE(replay.advance());
}

TEST(RoughSpheres, AskForBallsThatTurn) {
  Gas gas(20, 0.3, false, 6);
  SingleMotionSource source(gas.motion);
  const auto respond = [](const Event& event) { return response_of(event, bounce(event, Roughness{})); };
  const auto refused = gas.world.run(10.0, source, respond, [](const Event&) {});
  EXPECT_EQ(refused.error().argument, "first_angular_velocity");
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace kinesphere::rough_spheres_test
