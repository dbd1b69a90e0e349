// Recordings: a replay is equal to the last bit for all operations; a divergence is reported with its place;
// bytes that are no recording are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "archive/checksum.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/recording.hpp"
#include "kinesphere/response.hpp"
#include "number/bit_cast.hpp"
#include "recording/step.hpp"
#include "support/expect_error.hpp"
#include "support/test_size.hpp"
#include "world/bustle.hpp"

namespace kinesphere::replay_test {
namespace {

using Bytes = std::vector<std::byte>;

std::vector<Event> events_of(Replay& replay) {
  std::vector<Event> events;
  while (!replay.finished()) {
    const auto event = replay.advance();
    if (!event) {
      ADD_FAILURE() << event.error().message;
      break;
    }
    if (*event) events.push_back(**event);
  }
  return events;
}

std::uint64_t hash_of(const std::vector<Event>& events) {
  EventHash hash;
  for (const Event& event : events) hash.add(event);
  return hash.value();
}

class Recording : public testing::TestWithParam<CrowdKind> {};
INSTANTIATE_TEST_SUITE_P(Crowds, Recording, crowd_kinds());

/// The replay of a busy crowd. `replay` finds its own world through `itself`, for the pair filter.
struct Replayed {
  explicit Replayed(const Bytes& bytes)
      : replay(Replay::open(bytes, [this](BodyId a, BodyId b) {
                 return filter_of(replay.world())(a, b);
               }).value()) {}
  Replayed(const Replayed&) = delete;
  Replayed& operator=(const Replayed&) = delete;
  Replay replay;
};

TEST_P(Recording, ReplaysToTheLastBitWhateverWasDone) {
  Bustle bustle(GetParam());
  bustle.world.start_recording().value();
  bustle.go(2.0);
  const Bytes bytes = bustle.world.stop_recording().value();
  Replayed again(bytes);
  const auto events = events_of(again.replay);
  EXPECT_GT(again.replay.step_count(), 50u);
  EXPECT_EQ(events.size(), bustle.events().size());
  EXPECT_EQ(hash_of(events), hash_of(bustle.events()));
  EXPECT_EQ(again.replay.world().save().value(), bustle.world.save().value());
  EXPECT_EQ(again.replay.step(), again.replay.step_count());
}

TEST_P(Recording, BeginsAndEndsAnywhere) {
  Bustle bustle(GetParam());
  bustle.go(0.5);
  for (int part = 0; part < 3; ++part) {
    const std::size_t before = bustle.events().size();
    bustle.world.start_recording().value();
    bustle.go(0.3);
    Replayed again(bustle.world.stop_recording().value());
    EXPECT_EQ(events_of(again.replay).size(), bustle.events().size() - before);
    EXPECT_EQ(again.replay.world().save().value(), bustle.world.save().value());
  }
}

TEST_P(Recording, ChangesNothing) {
  Bustle recorded(GetParam());
  recorded.world.start_recording().value();
  recorded.go(1.0);
  Bustle alone(GetParam());
  alone.go(1.0);
  EXPECT_EQ(hash_of(recorded.events()), hash_of(alone.events()));
  EXPECT_EQ(recorded.world.save().value(), alone.world.save().value());
}

TEST_P(Recording, HoldsTheStatesThatWereProbed) {
  Bustle bustle(GetParam());
  bustle.world.start_recording().value();
  const std::uint64_t probes = bustle.world.counters().probes;
  bustle.go(1.0);
  Replayed again(bustle.world.stop_recording().value());
  std::size_t states = 0;
  while (!again.replay.finished()) {
    again.replay.advance().value();
    states += again.replay.probed_states().size();
    for (const ProbedState& report : again.replay.probed_states())
      ASSERT_TRUE(is_finite(report.state.velocity));
  }
  // The rest are states of failed probes.
  EXPECT_LE(states, bustle.world.counters().probes - probes);
  EXPECT_GE(states, (bustle.world.counters().probes - probes) / 2);
}

/// Balls of two sizes that fall in a box, and answer their contacts with `answer`.
struct Falling : Playground {
  explicit Falling(std::function<Bounce(const Event&)> response)
      : Playground({.box = Box{{0, 0, 0}, {4, 4, 9}},
                    .contact_tolerance = 1e-3,
                    .contacts = ContactEvents::impacts,
                    .zeno_interval = 0.1}),
        answer(std::move(response)) {
    for (int k = 0; k < 48; ++k) {
      const double radius = k % 2 == 0 ? 0.3 : 0.4;
      add({.radius = radius,
           .planned_acceleration = {0, 0, -9.81},
           .position = {0.5 + k % 4, 0.5 + k / 4 % 4, 1.0 + 2.0 * (k / 16)},
           .velocity = {0.3 * (k % 5), -0.2 * (k % 7), 0.1 * k},
           .user_data = static_cast<std::uint64_t>(k % 2),
           .mass = radius});
    }
    distort = [this](BodyId body, double time, State& state) { probed.push_back({time, body, state}); };
    world.start_recording().value();
  }
  void go(double until) {
    while (const auto event = advance(until)) {
      events.push_back(*event);
      const Bounce after = answer(*event);
      set_velocity(event->first, after.first_velocity);
      if (event->second != no_body) set_velocity(event->second, after.second_velocity);
    }
    bytes = world.stop_recording().value();
  }

  std::function<Bounce(const Event&)> answer;
  std::vector<Event> events;
  std::vector<ProbedState> probed;
  Bytes bytes;
};

TEST(RecordingOfAWorld, IsReadAsAWhole) {
  Falling falling([](const Event& event) { return bounce(event, 0.7); });
  falling.go(2.0);
  const RecordedRun run = read_recording(falling.bytes).value();
  EXPECT_EQ(run.start_time, 0.0);
  EXPECT_EQ(run.end_time, 2.0);
  EXPECT_EQ(run.events, falling.events);
  EXPECT_EQ(run.probed_states, falling.probed);
}

TEST(RecordingOfAWorld, HoldsWhatIsExpectedInFewBytes) {
  const auto bytes_of_an_event = [](std::function<Bounce(const Event&)> answer) {
    Falling falling(std::move(answer));
    falling.go(8.0);
    EXPECT_GT(falling.events.size(), 2000u);
    Replay replay = Replay::open(falling.bytes).value();
    EXPECT_EQ(events_of(replay), falling.events);
    const std::size_t start = 48 * sizeof(BodyDefinition) + 1000;
    return static_cast<double>(falling.bytes.size() - start) / static_cast<double>(falling.events.size());
  };
  const auto volume = [](std::uint64_t data) { return data == 0 ? 0.3 * 0.3 * 0.3 : 0.4 * 0.4 * 0.4; };
  // A call of advance takes 5 bytes with its outcome, a state 1 and a velocity 3.
  EXPECT_LT(bytes_of_an_event([](const Event& event) { return bounce(event, 0.95); }), 13.0);
  EXPECT_LT(bytes_of_an_event([](const Event& event) { return settle(event, 0.7, 0.4); }), 13.0);
  EXPECT_LT(bytes_of_an_event([&](const Event& event) {
              return bounce(event, volume(event.first_user_data), volume(event.second_user_data), 0.95);
            }),
            13.0);
  // A restitution that nobody could guess: its speed has to be told.
  EXPECT_LT(
      bytes_of_an_event([](const Event& event) { return bounce(event, 0.9 + 0.1 / (1.0 + event.time)); }),
      30.0);
  // Velocities that follow from nothing.
  Random random(1);
  EXPECT_GT(bytes_of_an_event([&](const Event& event) {
              Bounce after = bounce(event, 0.9);
              after.first_velocity += 0.1 * random.unit_vector();
              return after;
            }),
            30.0);
}

TEST(Differences, RestoreEveryBitAndAreShort) {
  using Limits = std::numeric_limits<double>;
  const std::array numbers{0.0,
                           -0.0,
                           1.0,
                           -1.0,
                           1.0 / 3,
                           1e300,
                           -1e-300,
                           Limits::denorm_min(),
                           -Limits::denorm_min(),
                           Limits::max(),
                           Limits::lowest(),
                           Limits::infinity(),
                           -Limits::infinity(),
                           Limits::quiet_NaN(),
                           -Limits::quiet_NaN()};
  for (const double value : numbers) {
    for (const double expected : numbers) {
      Differences<2> told;
      told.set(1, value, expected);
      ByteWriter writer;
      writer(told);
      Differences<2> read;
      read.set(0, 1.0, 2.0);
      ByteReader reader(writer.bytes());
      reader(read);
      EXPECT_FALSE(reader.failed());
      EXPECT_EQ(reader.remaining(), 0u);
      EXPECT_EQ(read, told);
      EXPECT_EQ(bit_cast<std::uint64_t>(read.number(1, expected)), bit_cast<std::uint64_t>(value))
          << value << " " << expected;
      EXPECT_LE(writer.bytes().size(), 11u);
    }
    Differences<2> near;
    near.set(0, value, value);
    near.set(1, std::nextafter(value, 0.0), value);
    ByteWriter writer;
    writer(near);
    EXPECT_LE(writer.bytes().size(), 2u) << value;
  }
}

TEST(RecordingOfAWorld, HasProbesThatThrowWhereRotationsAreAskedFor) {
  struct NoAnswer {};
  World world = World::create({}).value();
  world
      .set_rotation_probe([](std::span<const BodyId>, double, std::span<Rotation> rotations) {
        for (Rotation& rotation : rotations) rotation = Rotation{};
      })
      .value();
  RigidBody body{.body = {.acceleration_limit = 1.0}, .parts = {{{-1, 0, 0}, {1, 0, 0}, 0.1}}};
  body.largest_angular_speed = body.angular_acceleration_limit = 1.0;
  world.add_rigid_body(body).value();
  body.body.position = {0, 3, 0};
  world.add_rigid_body(body).value();
  world.start_recording().value();
  int answers = 1;  // before one throws
  const auto probe = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    if (answers-- == 0) throw NoAnswer();
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = {{0, 3.0 * ids[k].index, 0}, {}};
  };
  EXPECT_THROW((void)world.advance(10.0, probe), NoAnswer);
  world.advance(10.0, probe).value();
  Replay replay = Replay::open(world.stop_recording().value()).value();
  (void)events_of(replay);
  EXPECT_EQ(replay.world().save().value(), world.save().value());
}

TEST(RecordingOfAWorld, GoesWithAWorldThatIsMovedAndNotWithAClone) {
  Playground p;
  p.add({});
  p.world.start_recording().value();
  const World copy = p.world.clone().value();
  EXPECT_FALSE(copy.inspection().is_recording());
  World moved = std::move(p.world);
  EXPECT_TRUE(moved.inspection().is_recording());
  p.world = std::move(moved);
  p.set_velocity({0, 0}, {1, 0, 0});
  Replay replay = Replay::open(p.world.stop_recording().value()).value();
  EXPECT_FALSE(p.world.inspection().is_recording());
  EXPECT_FALSE(replay.advance().value());
  EXPECT_TRUE(replay.finished());
  EXPECT_EQ(replay.world().body({0, 0})->definition.velocity, (Vec3{1, 0, 0}));
}

// Divergences.

/// Returns the recording of two bodies that meet at time 2 and pass, and then reach a wall.
Bytes meeting(bool with_kick = false) {
  Playground p({.box = Box{{-10, -10, -10}, {10, 10, 10}}});
  p.world.start_recording().value();
  p.add({.acceleration_limit = 1, .position = {-3, 0, 0}, .velocity = {1, 0, 0}});
  p.add({.acceleration_limit = 1, .position = {3, 0, 0}, .velocity = {-1, 0, 0}});
  EXPECT_TRUE(p.advance(20.0));
  if (with_kick) p.set_velocity({1, 0}, {0, 1, 0});
  while (p.advance(20.0)) {
  }
  return p.world.stop_recording().value();
}

/// Corrects length and checksum.
Bytes sealed(Bytes bytes) {
  const auto write = [&](std::size_t at, std::uint64_t number) {
    for (std::size_t k = 0; k < 8; ++k) bytes[at + k] = static_cast<std::byte>(number >> (8 * k));
  };
  write(12, bytes.size() - 28);
  write(bytes.size() - 8, checksum(std::span(bytes).first(bytes.size() - 8)));
  return bytes;
}

std::vector<Step> steps_of(const RecordingContent& content) {
  std::vector<Step> steps(content.step_count);
  ByteReader reader(content.steps);
  for (Step& step : steps) reader(step);
  return steps;
}

/// Returns the recording with changed steps.
template <class Change>
Bytes altered(const Bytes& bytes, Change change) {
  const RecordingContent content = read_content(bytes).value();
  std::vector<Step> steps = steps_of(content);
  change(steps);
  ByteWriter writer;
  writer(content.snapshot, content.has_pair_filter, content.has_rotation_probe);
  for (const Step& step : steps) writer(step);
  return recording_envelope.seal(writer.bytes());
}

std::string divergence(const Bytes& bytes) {
  Replay replay = Replay::open(bytes).value();
  for (std::size_t k = 0; k <= replay.step_count(); ++k) {
    const auto event = replay.advance();
    if (event) continue;
    EXPECT_EQ(event.error().code, ErrorCode::diverged);
    EXPECT_EQ(event.error().argument, "recording");
    EXPECT_FALSE(replay.finished());
    EXPECT_EQ(replay.advance().error().message, event.error().message) << "it stays diverged";
    return event.error().message;
  }
  ADD_FAILURE() << "went the same way";
  return {};
}

/// The steps of meeting(): two bodies are added, the first advance, and so on.
TEST(Divergence, IsNamedWithStepAndTime) {
  const Bytes bytes = meeting();
  const auto asking = [](std::vector<Step>& steps, std::size_t number = 2) -> step::Asking& {
    return std::get<step::Asking>(steps.at(number));
  };
  const auto expect = [&](const std::string& parts, auto change) {
    const std::string message = divergence(altered(bytes, change));
    EXPECT_TRUE(message.starts_with("Replay::advance: recording, step ")) << message;
    EXPECT_NE(message.find(parts), std::string::npos) << message << " instead of " << parts;
  };
  expect("step 3 of ", [](auto& steps) { std::get<step::Add>(steps[0]).body.position.x = -3.5; });
  expect("expected other work or another outcome, but found ",
         [](auto& steps) { std::get<step::Add>(steps[0]).body.acceleration_limit = 2; });
  expect("expected other work or another outcome, but found contact_begin of body 0 and body 1 at time ",
         [&](auto& steps) { asking(steps).answers[0].set(5, 1e-9, 0.0); });
  expect("expected no further probe, but found a probe of body ",
         [&](auto& steps) { asking(steps).answers.pop_back(); });
  expect(" probes, but found the end of the call after ",
         [&](auto& steps) { asking(steps).until.set(0, 0.5, 0.0); });
  expect("expected no event, but found contact_begin of body 0 and body 1 at time ",
         [&](auto& steps) { asking(steps).has_event = false; });
  expect("expected a refused answer of the probe, but found contact_begin", [&](auto& steps) {
    asking(steps).has_event = false;
    asking(steps).failed = true;
  });
  expect("expected other work or another outcome, but found ",
         [&](auto& steps) { asking(steps, 3).hash ^= 1; });
  expect("step 4 of ", [&](auto& steps) { asking(steps, 3).hash ^= 1; });
  expect("expected an event that turns a body, but found none",
         [](auto& steps) { steps.insert(steps.begin(), step::Rebound{}); });
  expect("expected the end to come at time 21, but found it at 20",
         [](auto& steps) { std::get<step::End>(steps.back()).time = 21.0; });
  expect("expected to end as the world with the checksum ",
         [](auto& steps) { std::get<step::End>(steps.back()).checksum ^= 1; });
  // A change that was never recorded.
  expect("expected to end as the world with the checksum ", [](auto& steps) {
    steps.insert(steps.end() - 1, step::SetUserData{{0, 0}, 5});
  });
}

TEST(Divergence, ShowsInAChangeThatCannotBeMade) {
  const Bytes bytes = altered(meeting(true), [](auto& steps) {
    for (Step& step : steps)
      if (std::holds_alternative<step::Rebound>(step)) step = step::SetVelocity{{9, 0}, {}};
  });
  const std::string message = divergence(bytes);
  EXPECT_NE(
      message.find(
          "expected a change that can be made, but found: set_velocity: body 9 was never in this world"),
      std::string::npos)
      << message;
}

TEST(Divergence, OfThePairFilterShows) {
  Playground p;
  p.add({.position = {-3, 0, 0}, .velocity = {1, 0, 0}});
  p.add({.position = {3, 0, 0}, .velocity = {-1, 0, 0}});
  p.world.set_pair_filter([](BodyId, BodyId) { return false; }).value();
  p.world.start_recording().value();
  EXPECT_FALSE(p.advance(5.0));
  const Bytes bytes = p.world.stop_recording().value();
  Replay same = Replay::open(bytes, [](BodyId, BodyId) { return false; }).value();
  EXPECT_TRUE(same.advance());
  Replay other = Replay::open(bytes, [](BodyId, BodyId) { return true; }).value();
  EXPECT_EQ(other.advance().error().code, ErrorCode::diverged);
  expect_error(Replay::open(bytes), ErrorCode::out_of_range, "pair_filter", "Replay::open");
}

// Bytes that are no recording.

testing::AssertionResult is_refused(const Bytes& bytes, const std::string& why) {
  for (const auto& error : {Replay::open(bytes).error(), read_recording(bytes).error()}) {
    if (error.code != ErrorCode::bad_recording || error.argument != "recording" ||
        !error.message.starts_with("Replay::open: recording must ") ||
        error.message.find(why) == std::string::npos)
      return testing::AssertionFailure() << error.message;
  }
  return testing::AssertionSuccess();
}

TEST(BadRecording, EveryTruncationIsRefused) {
  const Bytes bytes = meeting(true);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    ASSERT_TRUE(is_refused(cut, length < 8 ? "mark" : "whole")) << length;
    if (length < 28) continue;
    ASSERT_TRUE(is_refused(sealed(cut), "form")) << length;
  }
}

TEST(BadRecording, EveryFlippedBitIsRefused) {
  const Bytes bytes = meeting(true);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    Bytes changed = bytes;
    changed[k] ^= static_cast<std::byte>(1u << (k % 8));
    ASSERT_TRUE(is_refused(changed, "")) << k;
  }
}

TEST(BadRecording, SaysWhatIsWrong) {
  const Bytes bytes = meeting();
  EXPECT_TRUE(is_refused({}, "mark of a recording"));
  EXPECT_TRUE(is_refused(World::create({})->save().value(), "mark of a recording"));
  EXPECT_EQ(World::restore(bytes).error().code, ErrorCode::bad_snapshot);
  Bytes newer = bytes;
  newer[8] = std::byte{200};
  EXPECT_TRUE(is_refused(newer, "format version 15, but is of version 200"));
  Bytes more = bytes;
  more.push_back(std::byte{0});
  EXPECT_TRUE(is_refused(more, "whole"));
  // The snapshot inside is refused on its own.
  Bytes damaged = bytes;
  damaged[60] ^= std::byte{1};
  expect_error(Replay::open(sealed(damaged)), ErrorCode::bad_snapshot, "snapshot", "World::restore");
  expect_error(read_recording(sealed(damaged)), ErrorCode::bad_snapshot, "snapshot", "World::restore");
}

TEST(BadRecording, SealedNonsenseIsRefusedOrDivergesOrIsHarmless) {
  Bustle bustle({ContactEvents::begin_and_end, true, 0.0, 8, 11});
  bustle.world.start_recording().value();
  bustle.go(0.5);
  const Bytes bytes = bustle.world.stop_recording().value();
  // Changes in the snapshot are refused by its own checksum (see the tests of snapshots).
  const std::size_t steps = 20 + 8 + bustle.world.save().value().size() / 2;
  ASSERT_GT(bytes.size(), steps + 1000);
  int diverged = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < rounds_of<std::uint64_t>(3000); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Bytes changed = bytes;
    const std::uint64_t changes = 1 + random.bits() % 2;
    for (std::uint64_t k = 0; k < changes; ++k) {
      const std::size_t at = steps + random.bits() % (bytes.size() - steps - 8);
      if (random.bits() % 4 == 0)
        changed[at] = static_cast<std::byte>(random.bits());
      else
        changed[at] ^= static_cast<std::byte>(1u << (random.bits() % 8));
    }
    auto replay = Replay::open(sealed(changed), [](BodyId a, BodyId b) { return a.index + b.index != 3; });
    if (!replay) {
      ++refused;
      continue;
    }
    while (!replay->finished()) {
      const auto event = replay->advance();
      if (event) continue;
      ASSERT_EQ(event.error().code, ErrorCode::diverged);
      ++diverged;
      break;
    }
    // At each stop it must be a valid world.
    const auto filter = [](BodyId, BodyId) { return true; };
    ASSERT_TRUE(World::restore(replay->world().save().value(), filter));
  }
  EXPECT_GT(diverged, rounds_of(500));
  EXPECT_GT(refused, 50);
}

TEST(WrongCalls, OfRecording) {
  Playground p;
  p.add({});
  expect_error(p.world.stop_recording(), ErrorCode::not_recording, "world", "stop_recording");
  p.world.start_recording().value();
  expect_error(p.world.start_recording(), ErrorCode::recording, "world", "start_recording");
  int calls = 0;
  p.distort = [&](BodyId, double, State&) {
    ++calls;
    const auto started = p.world.start_recording();
    const auto stopped = p.world.stop_recording();
    ASSERT_FALSE(started);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(started.error().message, "start_recording: a probe may not call the world that asked it");
    EXPECT_EQ(stopped.error().message, "stop_recording: a probe may not call the world that asked it");
  };
  p.set_velocity({0, 0}, {1, 0, 0});
  p.advance(1.0);
  p.set_velocity({0, 0}, {2, 0, 0});
  p.advance(2.0);
  EXPECT_GT(calls, 0);
  EXPECT_TRUE(p.world.stop_recording());
  expect_error(p.world.stop_recording(), ErrorCode::not_recording, "world", "stop_recording");
}

}  // namespace
}  // namespace kinesphere::replay_test
