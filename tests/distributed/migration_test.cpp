// Bodies migrate from one rank to another with their motion, contacts and certificates.
#include "distributed/migration.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "archive/archive.hpp"
#include "bodies/shaped_body.hpp"
#include "kinesphere/motion/ballistic.hpp"

namespace kinesphere::migration_test {
namespace {

/// The state of one rank, without the others.
struct Rank {
  explicit Rank(int rank) : local({}, rank), migration(motion, local) {}

  std::uint32_t add(std::uint32_t name, const State& state) {
    const std::uint32_t number = local.bodies().add_named({.radius = 0.5}, 0.0, name);
    local.state.contacts.add(number, 0.0);
    local.directory.add(name, number, 0);
    local.directory[number].in_motion = motion.add(0.0, state).value();
    Body& body = local.bodies()[number];
    body.bound.position = state.position;
    body.bound.velocity = state.velocity;
    return number;
  }
  void touch(std::uint32_t a, std::uint32_t b) {
    local.state.contacts.set_touching({.kind = EventKind::contact_begin,
                                       .first = local.bodies().id_of(a),
                                       .second = local.bodies().id_of(b)},
                                      true);
  }
  void install(std::vector<BodyMessage> messages) {
    beginning = migration.install(messages, nullptr).value();
  }
  /// Returns the names of the touching bodies that are known here.
  std::vector<std::uint32_t> partners_of(std::uint32_t name) const {
    std::vector<std::uint32_t> names;
    for (const ContactRecord& contact : local.state.contacts.partners_of(*local.directory.find(name)))
      names.push_back(local.name_of(contact.partner));
    return names;
  }

  Ballistic motion = Ballistic::create({}).value();
  RankState local;
  Migration migration;
  InitialWork beginning;
};

TEST(Migration, BringsABodyAndItsMotion) {
  Rank one(0);
  Rank other(1);
  const State state{{1, 2, 3}, {4, 5, 6}};
  const std::uint32_t number = one.add(70, state);
  other.install({one.migration.pack(number)});
  const auto found = other.local.directory.find(70);
  ASSERT_TRUE(found);
  EXPECT_FALSE(other.local.directory.is_own(*found));
  EXPECT_EQ(other.local.directory[*found].owner, 0);
  EXPECT_EQ(other.local.bodies()[*found].bound.velocity, state.velocity);
  EXPECT_EQ(other.motion.state(other.local.directory[*found].in_motion, 2.0).position, (Vec3{9, 12, 15}));
}

TEST(Migration, BringsPartsAndRotationOfARigidBody) {
  Rank one(0);
  Rank other(1);
  const RigidBody definition{.parts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}, box_part({{0, 0, 0}, {1, 2, 3}}, 0.1)},
                             .rotation = {rotation_by({1, 2, 3}), {4, 5, 6}},
                             .largest_angular_speed = 100.0,
                             .inertia = {1, 2, 3}};
  const std::uint32_t number = one.add(70, {});
  one.local.bodies().make_rigid(number, record_of(definition, 0.0));
  other.add(10, {});
  const auto expect_equal = [&] {
    const std::uint32_t there = *other.local.directory.find(70);
    EXPECT_EQ(rigid_body(other.local.bodies(), there).parts, definition.parts);
    ByteWriter bytes[2];
    bytes[0](one.local.bodies().rigid[one.local.bodies()[number]]);
    bytes[1](other.local.bodies().rigid[other.local.bodies()[there]]);
    EXPECT_EQ(bytes[0].bytes(), bytes[1].bytes());
  };
  other.install({one.migration.pack(number)});
  expect_equal();
  one.local.main.advance_clock(1.5);
  one.local.bodies()[number].bound.time = 1.5;
  one.local.main.set_angular_velocity(number, {0, 7, 0});
  other.install({one.migration.pack(number)});
  expect_equal();
  other.migration.drop(*other.local.directory.find(70));
  EXPECT_FALSE(other.local.bodies().rigid.any()) << "its record is free again";
}

TEST(Migration, BringsAShapeThatABodyCarries) {
  Rank one(0);
  Rank other(1);
  const Shape plate = Box{{-1, -1, 0}, {1, 1, 0.1}};
  const std::uint32_t number = one.add(70, {});
  one.local.bodies().give_shape(number, plate, true);
  one.local.state.contacts.set_shape(number, false);
  other.add(10, {});
  for (int time = 0; time < 2; ++time) {
    other.install({one.migration.pack(number)});
    const std::uint32_t there = *other.local.directory.find(70);
    const Body& body = other.local.bodies()[there];
    ASSERT_TRUE(body.has_shape() && !body.is_static());
    EXPECT_EQ(other.local.bodies().shapes.of(body), plate);
    EXPECT_TRUE(other.local.state.contacts.has_form_of(there, true, false));
  }
  other.migration.drop(*other.local.directory.find(70));
  EXPECT_FALSE(other.local.bodies().shapes.any()) << "its place is free again";
}

TEST(Migration, KeepsLinksToBodiesThatAreNotThereYet) {
  Rank one(0);
  Rank other(1);
  const std::uint32_t a = one.add(70, {});
  const std::uint32_t b = one.add(60, {{1, 0, 0}, {}});
  one.touch(a, b);
  other.install({one.migration.pack(a)});
  EXPECT_TRUE(other.partners_of(70).empty());
  EXPECT_EQ(other.migration.pack(*other.local.directory.find(70)).contacts.partners.all().size(), 1u)
      << "a copy of a copy has the link, too";
  other.install({one.migration.pack(b)});
  EXPECT_EQ(other.partners_of(70), std::vector<std::uint32_t>{60});
  EXPECT_EQ(other.partners_of(60), std::vector<std::uint32_t>{70});
  EXPECT_EQ(other.migration.pack(*other.local.directory.find(70)).contacts.partners.all().size(), 1u)
      << "the link dangles no longer";
  other.migration.drop(*other.local.directory.find(70));
  EXPECT_FALSE(other.local.directory.find(70));
  EXPECT_TRUE(other.partners_of(60).empty());
  other.install({one.migration.pack(a)});
  EXPECT_EQ(other.partners_of(60), std::vector<std::uint32_t>{70});
}

TEST(Migration, BringsHotPairsOfKnownBodiesOnce) {
  Rank one(0);
  Rank other(1);
  const std::vector<std::uint32_t> numbers{one.add(70, {}), one.add(60, {}), one.add(50, {})};
  const PairCertifier certifier = one.local.main.certifier();
  one.local.main.queue().add(certifier.certificate(1.5, numbers[0], numbers[1]));
  one.local.main.queue().add(certifier.certificate(2.5, numbers[0], numbers[2]));
  std::vector<BodyMessage> messages{one.migration.pack(numbers[0]), one.migration.pack(numbers[1])};
  one.migration.add_due(messages, std::span(numbers).first(2), nullptr);
  EXPECT_EQ(messages[0].due.size(), 2u);
  EXPECT_EQ(messages[1].due.size(), 1u);
  other.install(messages);
  ASSERT_EQ(other.beginning.due.size(), 1u) << "that with an unknown body is left out";
  EXPECT_EQ(other.beginning.due[0].failure_time, 1.5);
  EXPECT_FALSE(other.local.main.certifier().is_stale(other.beginning.due[0]));
}

TEST(Migration, RenewedCopyKeepsHotPairsUnlessTheyAreVoid) {
  Rank one(0);
  Rank other(1);
  const std::uint32_t a = one.add(70, {});
  other.install({one.migration.pack(a), one.migration.pack(one.add(60, {}))});
  const PairCertificate pair = other.local.main.certifier().certificate(1.5, *other.local.directory.find(70),
                                                                        *other.local.directory.find(60));
  BodyMessage renewed = one.migration.pack(a);
  renewed.body.revision = 30;  // revisions are a rank's own
  other.install({renewed});
  EXPECT_FALSE(other.local.main.certifier().is_stale(pair));
  renewed.is_stale = true;
  other.install({renewed});
  EXPECT_TRUE(other.local.main.certifier().is_stale(pair));
}

/// Clusters of two ranks have changed one body each. One has certified its body with the other as it was when
/// the batch began.
TEST(Migration, LeavesOutPairsOfBodiesThatAnotherClusterHasChanged) {
  Rank one(0);
  const std::uint32_t a = one.add(70, {});
  const std::uint32_t b = one.add(60, {});
  for (const bool is_changed : {false, true}) {
    Rank other(1);
    other.install({one.migration.pack(a), one.migration.pack(b)});
    BodyMessage first = one.migration.pack(a);
    first.is_stale = true;
    first.due = {{.time = 1.5, .other = 60, .is_of_batch_start = true}, {.time = 2.5, .other = 60}};
    BodyMessage second = one.migration.pack(b);
    second.is_stale = is_changed;
    other.install({first, second});
    EXPECT_EQ(other.beginning.due.size(), is_changed ? 1u : 2u);
    EXPECT_EQ(other.beginning.due.back().failure_time, 2.5);
  }
}

/// The third body comes later, from another rank, which needs the certificate: the order of a read
/// checkpoint.
TEST(Migration, KeepsLoosePairs) {
  Rank one(0);
  Rank other(1);
  const std::vector<std::uint32_t> numbers{one.add(70, {}), one.add(60, {})};
  one.local.main.queue().add(one.local.main.certifier().certificate(1.5, numbers[0], numbers[1]));
  std::vector<BodyMessage> messages{one.migration.pack(numbers[0])};
  one.migration.add_due(messages, std::span(numbers).first(1), nullptr);
  other.migration.keep_loose_pairs();
  other.install(messages);
  const std::vector<std::uint32_t> there{*other.local.directory.find(70)};
  std::vector<BodyMessage> onward{other.migration.pack(there[0])};
  other.migration.add_due(onward, there, nullptr);
  ASSERT_EQ(onward[0].due.size(), 1u);
  EXPECT_EQ(onward[0].due[0].other, 60u);
  other.migration.forget_loose_pairs();
  onward[0].due.clear();
  other.migration.add_due(onward, there, nullptr);
  EXPECT_TRUE(onward[0].due.empty());
}

}  // namespace
}  // namespace kinesphere::migration_test
