// A restored world continues to the bit like the saved one, and bytes that are no snapshot are refused.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <tuple>

#include "kinesphere/response.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"
#include "support/sealed_snapshot.hpp"
#include "support/test_size.hpp"

namespace kinesphere::snapshot_test {
namespace {

using Bytes = std::vector<std::byte>;

enum class Answer { pass_through, bounce };

/// A crowd with additions and removals, with all queries and all events.
class Crowd {
 public:
  Crowd(ContactEvents mode, Answer answer, int count, bool walls = true)
      : playground_(
            {.box = walls ? std::optional(Box{{0, 0, 0}, {8, 8, 8}}) : std::nullopt, .contacts = mode}),
        answer_(answer) {
    for (int k = 0; k < count; ++k) add();
    playground_.distort = [this](BodyId id, double time, State&) { asked_.emplace_back(id, time); };
  }

  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  /// Calls `at_stop` at every stop: before the response to an event, after it, and between events.
  template <class AtStop>
  void go(double until, AtStop at_stop) {
    const double start = playground_.world.time();
    for (int step = 1; step <= 50; ++step) {
      while (const auto event = playground_.advance(start + (until - start) * step / 50)) {
        told_.push_back(*event);
        at_stop(playground_.world);
        if (told_.size() % 64 == 0 && told_.back().second != no_body) come_and_go();
        if (answer_ == Answer::bounce) bounce_off(*event);
        at_stop(playground_.world);
      }
      at_stop(playground_.world);
    }
  }

  const std::vector<Event>& reported() const { return told_; }
  const std::vector<std::pair<BodyId, double>>& asked() const { return asked_; }
  std::uint64_t hash() const { return playground_.hash.value(); }
  World& world() { return playground_.world; }
  auto probe() { return playground_.probe(); }

 private:
  void add() {
    const double limit = playground_.world.size() % 4 == 0 ? 0.0 : 3.0;
    const auto within = [this] { return random_.uniform(1.0, 7.0); };
    const BodyDefinition body{.radius = random_.uniform(0.2, 0.7),
                              .acceleration_limit = limit,
                              .position = {within(), within(), within()},
                              .velocity = 3.0 * random_.point_in_ball()};
    playground_.add(body, 0.99 * limit * random_.point_in_ball());
  }

  void come_and_go() {
    const auto bodies = playground_.world.bodies();
    playground_.world.remove(bodies[random_.bits() % bodies.size()]).value();
    if (told_.size() % 128 == 0) add();
  }

  void bounce_off(const Event& event) {
    if (event.approach_speed <= 0.0 || !playground_.world.contains(event.first)) return;
    const Bounce after = bounce(event, 1.0, 1.0, 0.9);
    playground_.set_velocity(event.first, after.first_velocity);
    if (playground_.world.contains(event.second))
      playground_.set_velocity(event.second, after.second_velocity);
  }

  Random random_{4711};
  Playground playground_;
  Answer answer_;
  std::vector<Event> told_;
  std::vector<std::pair<BodyId, double>> asked_;
};

void expect_same(Crowd& found, Crowd& expected) {
  EXPECT_EQ(found.hash(), expected.hash());
  EXPECT_EQ(found.reported().size(), expected.reported().size());
  EXPECT_EQ(found.asked(), expected.asked());
  // Counters and everything else are equal.
  EXPECT_EQ(found.world().save().value(), expected.world().save().value());
}

class Snapshot : public testing::TestWithParam<std::tuple<ContactEvents, Answer>> {
 protected:
  Crowd crowd(int count = 60) const { return {std::get<0>(GetParam()), std::get<1>(GetParam()), count}; }
};

INSTANTIATE_TEST_SUITE_P(Modes, Snapshot,
                         testing::Combine(testing::Values(ContactEvents::begin_and_end,
                                                          ContactEvents::impacts),
                                          testing::Values(Answer::pass_through, Answer::bounce)));

TEST_P(Snapshot, RestoredAtAHundredMomentsGoesOnTheSame) {
  Crowd expected = crowd();
  int stops = 0;
  expected.go(4.0, [&](const World&) { ++stops; });
  ASSERT_GT(stops, 300);
  Crowd found = crowd();
  Random random(99);
  int restored = 0;
  found.go(4.0, [&](World& world) {
    if (random.uniform() * stops > 130.0) return;
    const Bytes bytes = world.save().value();
    World back = World::restore(bytes).value();
    EXPECT_EQ(back.save().value(), bytes);
    EXPECT_TRUE(is_clean(back));
    world = std::move(back);
    ++restored;
  });
  EXPECT_GE(restored, 100);
  expect_same(found, expected);
}

TEST_P(Snapshot, RestoredAtEveryStopGoesOnTheSame) {
  Crowd expected = crowd(20);
  expected.go(1.0, [](const World&) {});
  Crowd found = crowd(20);
  found.go(1.0, [](World& world) { world = World::restore(world.save().value()).value(); });
  expect_same(found, expected);
}

TEST_P(Snapshot, ACloneGoesOnTheSameAndAlone) {
  Crowd expected = crowd();
  expected.go(1.5, [](const World&) {});
  Crowd found = crowd();
  int stop = 0;
  found.go(1.5, [&](World& world) {
    if (++stop % 7 != 0) return;
    World clone = world.clone().value();
    // The original may change meanwhile.
    for (const BodyId id : world.bodies()) world.remove(id).value();
    world = std::move(clone);
  });
  expect_same(found, expected);
}

TEST_P(Snapshot, SavingChangesNothing) {
  Crowd expected = crowd();
  expected.go(1.0, [](const World&) {});
  Crowd found = crowd();
  found.go(1.0, [](const World& world) { EXPECT_TRUE(world.save()); });
  expect_same(found, expected);
}

/// The bytes must not depend on addresses of this process.
TEST_P(Snapshot, TheSameWorldGivesTheSameBytes) {
  Crowd first = crowd();
  const Bytes padding(12345);
  Crowd second = crowd();
  first.go(1.0, [](const World&) {});
  second.go(1.0, [](const World&) {});
  EXPECT_EQ(first.world().save().value(), second.world().save().value());
}

TEST(SnapshotOfAWorld, KeepsIdsAndTheirGenerations) {
  Playground p;
  const BodyId first = p.add({.position = {0, 0, 0}});
  const BodyId second = p.add({.position = {9, 0, 0}});
  p.add({.position = {18, 0, 0}});
  p.world.remove(first).value();
  p.world.remove(second).value();
  World back = World::restore(p.world.save().value()).value();
  EXPECT_EQ(back.body(first).error().code, ErrorCode::stale_body);
  const BodyDefinition body{.position = {5, 5, 5}};
  for (int k = 0; k < 3; ++k) EXPECT_EQ(back.add(body).value(), p.world.add(body).value());
}

TEST(SnapshotOfAWorld, KeepsAKickThatNoReportHasShownYet) {
  Playground p;
  const BodyId body = p.add({.velocity = {1, 0, 0}});
  ASSERT_FALSE(p.advance(1.0));
  p.set_velocity(body, {0, 5, 0});
  p.world = World::restore(p.world.save().value()).value();
  EXPECT_FALSE(p.advance(2.0)) << "the kick is taken for a broken promise";
}

/// Their first windows would take them farther than the computation is exact.
TEST(SnapshotOfAWorld, MayHoldOneThatSensesNobodyBesideOneThatDoes) {
  World world = World::create({.allow_overlap = false}).value();
  world.set_sensor(1, {.distances = {1.0}}).value();
  world.add({.radius = 0.1, .sensor_class = 1}).value();
  world.add({.radius = 0.1, .position = {5, 0, 0}}).value();
  const auto restored = World::restore(world.save().value());
  EXPECT_TRUE(restored) << restored.error().message;
  const auto added = world.add({.radius = 0.1, .position = {5.15, 0, 0}});
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::overlapping);
}

TEST(SnapshotOfAWorld, MayHoldBodiesThatAreVeryFarFromEachOther) {
  for (const double distance : {1e4, 1e5, 1e6, 2e6}) {
    Playground p;
    p.add({.radius = 1, .position = {-distance, 0, 0}, .velocity = {1, 0, 0}});
    p.add({.radius = 1, .position = {distance, 0, 0}});
    p.advance(1.0);
    const Bytes bytes = p.world.save().value();
    auto restored = World::restore(bytes);
    ASSERT_TRUE(restored) << distance;
    EXPECT_EQ(restored->save().value(), bytes);
  }
}

TEST(SnapshotOfAWorld, GoesOnTheSameWithThePairFilterThatItHad) {
  const auto odd_pairs = [](BodyId a, BodyId b) { return (a.index + b.index) % 2 == 1; };
  const auto finish = [&](bool restore) {
    Crowd crowd(ContactEvents::begin_and_end, Answer::pass_through, 60);
    crowd.world().set_pair_filter(odd_pairs).value();
    crowd.go(1.0, [](const World&) {});
    if (restore) crowd.world() = World::restore(crowd.world().save().value(), odd_pairs).value();
    crowd.go(2.0, [](const World&) {});
    return std::tuple(crowd.hash(), crowd.asked(), crowd.world().save().value());
  };
  EXPECT_EQ(finish(true), finish(false));
}

TEST(SnapshotOfAWorld, NeedsThePairFilterThatItHad) {
  World world = World::create({}).value();
  EXPECT_TRUE(World::restore(world.save().value()));
  world.set_pair_filter([](BodyId, BodyId) { return false; }).value();
  expect_error(World::restore(world.save().value()), ErrorCode::bad_snapshot, "pair_filter",
               "World::restore");
  EXPECT_TRUE(World::restore(world.save().value(), [](BodyId, BodyId) { return false; }));
  world.set_pair_filter({}).value();
  EXPECT_TRUE(World::restore(world.save().value()));
}

TEST(SnapshotOfAWorld, AfterABadAnswerGoesOnTheSame) {
  const auto finish = [](bool restore) {
    Crowd crowd(ContactEvents::begin_and_end, Answer::pass_through, 40);
    for (int k = 1; k < 20; ++k) {
      int asked = 0;
      const auto fails = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
        if (++asked > 3) throw std::runtime_error("no answer");
        crowd.probe()(ids, time, states);
      };
      try {
        while (crowd.world().advance(0.1 * k, fails).value()) {
        }
      } catch (const std::runtime_error&) {
      }
      if (restore) crowd.world() = World::restore(crowd.world().save().value()).value();
    }
    crowd.go(3.0, [](const World&) {});
    return std::tuple(crowd.hash(), crowd.asked(), crowd.world().save().value());
  };
  EXPECT_EQ(finish(true), finish(false));
}

// Bytes that are no snapshot.

/// Returns a snapshot in mid-contact, between two events of one instant, with unprocessed velocity changes
/// and additions.
Bytes rich_snapshot(ContactEvents mode, const Axes& periodic = {}) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = periodic, .contacts = mode});
  for (int k = 0; k < 4; ++k) {
    const double y = 2.0 + 2.0 * k;
    p.add({.acceleration_limit = 1, .position = {3, y, 5}, .velocity = {1, 0, 0}});
    p.add({.acceleration_limit = 1, .position = {7, y, 5}, .velocity = {-1, 0, 0}});
  }
  p.add({.position = {8.5, 5, 8}, .velocity = {1, 0, 0}});
  const BodyId gone = p.add({.position = {2, 2, 1}});
  // The bodies at height 5 touch the floor.
  const BodyId ball = p.world.add_static({.shape = Ball{{1, 1, 9}, 0.5}}).value();
  if (!periodic.any()) {
    p.world.add_static({.shape = HalfSpace{{0, 0, 1}, 4.0}}).value();
    const BodyId box = p.world.add_static({.shape = Box{{1, 1, 8}, {2, 2, 9}}}).value();
    p.world.add_static({.shape = Triangle{{4, 0, 6}, {6, 0, 6}, {5, 9, 6}}}).value();
    p.world.disable(box).value();
  }
  p.world.remove(ball).value();
  p.world.set_sensor(1, {.distances = {0.5, 0.1}}).value();
  p.add({.position = {5, 5, 2.5}, .solid = false, .sensor_class = 1});
  auto event = p.advance(2.0);
  // Two begin in the floor and in the box.
  while (event && event->time == 0.0) event = p.advance(2.0);
  if (event) p.advance(2.0);
  p.world.remove(gone).value();
  p.add({.position = {5, 5, 2}});
  p.world.remove(p.add({.position = {5, 8, 2}})).value();
  if (event) p.set_velocity(event->first, {0, 1, 0});
  return p.world.save().value();
}

testing::AssertionResult is_refused(const Bytes& bytes, const std::string& why) {
  const auto restored = World::restore(bytes);
  if (restored) return testing::AssertionFailure() << "accepted";
  const Error& error = restored.error();
  if (error.code == ErrorCode::bad_snapshot && error.argument == "snapshot" &&
      error.message.starts_with("World::restore: snapshot must ") &&
      error.message.find(why) != std::string::npos)
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << error.message;
}

TEST(BadSnapshot, EveryTruncationIsRefused) {
  const Bytes bytes = rich_snapshot(ContactEvents::begin_and_end);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    ASSERT_TRUE(is_refused({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)},
                           length < 8 ? "mark" : "whole"))
        << length;
}

TEST(BadSnapshot, EveryTruncationIsRefusedThoughItBeSealed) {
  const Bytes bytes = rich_snapshot(ContactEvents::begin_and_end);
  for (std::size_t length = snapshot_frame_size; length < bytes.size(); ++length)
    ASSERT_TRUE(is_refused(sealed({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}), ""))
        << length;
}

TEST(BadSnapshot, AnythingMoreIsRefused) {
  Bytes bytes = rich_snapshot(ContactEvents::begin_and_end);
  bytes.push_back(std::byte{0});
  EXPECT_TRUE(is_refused(bytes, "whole"));
  EXPECT_TRUE(is_refused(sealed(bytes), "form"));
}

TEST(BadSnapshot, EveryFlippedBitIsRefused) {
  const Bytes bytes = rich_snapshot(ContactEvents::impacts);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    Bytes changed = bytes;
    changed[k] ^= static_cast<std::byte>(1u << (k % 8));
    ASSERT_TRUE(is_refused(changed, "")) << k;
  }
}

/// Sums over whole words do not detect changes of their highest bits.
TEST(BadSnapshot, AnyTwoFlippedHighestBitsAreRefused) {
  Playground p;
  for (int k = 0; k < 2; ++k)
    p.add({.radius = 0.4, .acceleration_limit = 1, .position = {3.0 * k, 1, 2}, .velocity = {1, -1, 0.5}});
  p.advance(0.5);
  Bytes bytes = p.world.save().value();
  constexpr std::byte highest{0x80};
  int accepted = 0;
  for (std::size_t first = 0; first < bytes.size(); ++first) {
    bytes[first] ^= highest;
    for (std::size_t second = first + 1; second < bytes.size(); ++second) {
      bytes[second] ^= highest;
      accepted += static_cast<bool>(World::restore(bytes));
      bytes[second] ^= highest;
    }
    bytes[first] ^= highest;
  }
  EXPECT_EQ(accepted, 0);
}

TEST(BadSnapshot, SaysWhatIsWrong) {
  const Bytes bytes = rich_snapshot(ContactEvents::impacts);
  EXPECT_TRUE(is_refused({}, "mark"));
  EXPECT_TRUE(is_refused(Bytes(1000, std::byte{'x'}), "mark of a world"));
  Bytes newer = bytes;
  newer[8] = std::byte{200};
  EXPECT_TRUE(is_refused(newer, "format version 35, but is of version 200"));
  Bytes damaged = bytes;
  damaged[bytes.size() / 2] ^= std::byte{1};
  EXPECT_TRUE(is_refused(damaged, "checksum"));
  Bytes impossible = bytes;  // the contact tolerance stands behind box, axes, wall filter and dimensions
  write_number(impossible, snapshot_header_size + 1 + 48 + 3 + 1 + 4, 0);
  EXPECT_TRUE(is_refused(sealed(impossible), "definition"));
}

TEST(BadSnapshot, SealedNonsenseIsRefusedOrHarmless) {
  int accepted = 0;
  for (const auto& [mode, periodic] :
       {std::pair(ContactEvents::begin_and_end, Axes{}), std::pair(ContactEvents::impacts, Axes{}),
        std::pair(ContactEvents::begin_and_end, Axes{true, true, true}),
        std::pair(ContactEvents::impacts, Axes{true, false, true})}) {
    const Bytes bytes = rich_snapshot(mode, periodic);
    for (std::uint64_t seed = 0; seed < rounds_of<std::uint64_t>(6000); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      Bytes changed = bytes;
      const std::uint64_t changes = 1 + random.bits() % 3;
      for (std::uint64_t k = 0; k < changes; ++k) {
        const std::size_t at = snapshot_header_size + random.bits() % (bytes.size() - snapshot_frame_size);
        switch (random.bits() % 4) {
          case 0:
            changed[at] = static_cast<std::byte>(random.bits());
            break;
          case 1:
            changed[at] ^= static_cast<std::byte>(1u << (random.bits() % 8));
            break;
          case 2:
            changed[at] = std::byte{0xff};
            break;
          default:
            changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(at),
                           static_cast<std::byte>(random.bits()));
        }
      }
      auto restored = World::restore(sealed(changed));
      if (!restored) {
        EXPECT_EQ(restored.error().code, ErrorCode::bad_snapshot);
        continue;
      }
      ++accepted;
      ASSERT_NO_THROW(use_for_a_while(std::move(*restored), random));
    }
  }
  EXPECT_GT(accepted, rounds_of(500)) << "the test has nothing to use";
}

TEST(WrongCalls, AProbeMayNeitherSaveNorClone) {
  Playground p;
  p.add({});
  int calls = 0;
  p.distort = [&](BodyId, double, State&) {
    const auto saved = p.world.save();
    const auto cloned = p.world.clone();
    ++calls;
    ASSERT_FALSE(saved);
    ASSERT_FALSE(cloned);
    EXPECT_EQ(saved.error().code, ErrorCode::probe_in_progress);
    EXPECT_EQ(cloned.error().code, ErrorCode::probe_in_progress);
    EXPECT_EQ(saved.error().message, "save: a probe may not call the world that asked it");
    EXPECT_EQ(cloned.error().message, "clone: a probe may not call the world that asked it");
  };
  p.set_velocity({0, 0}, {1, 0, 0});
  p.advance(1.0);
  p.set_velocity({0, 0}, {2, 0, 0});
  p.advance(2.0);
  EXPECT_GT(calls, 0);
}

}  // namespace
}  // namespace kinesphere::snapshot_test
