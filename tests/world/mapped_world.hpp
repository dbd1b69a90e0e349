// Bodies of a motion that bounce without loss, in `World::run`: with threads, from snapshots and in replays
// they do the same.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>

#include "kinesphere/body_map.hpp"
#include "kinesphere/event_hash.hpp"
#include "kinesphere/recording.hpp"
#include "kinesphere/response.hpp"
#include "support/playground.hpp"

namespace kinesphere {

/// A scene derives from it, and makes its motion, world and bodies in its constructor.
template <class OneMotion>
struct MappedWorld {
  /// Returns the hash of the events.
  std::uint64_t run(double until, Workers* workers = nullptr) {
    auto source = bodies.source();
    EventHash hash;
    const auto respond = [](const Event& event) {
      const bool meets = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
      return meets ? response_of(event, bounce(event, 1.0)) : Response{};
    };
    const auto receive = [&](const Event& event) {
      hash.add(event);
      ++events;
    };
    world.run(until, source, respond, receive, workers).value();
    return hash.value();
  }

  World world = World::create({}).value();
  std::unique_ptr<OneMotion> motion;
  BodyMap bodies;
  std::size_t events = 0;
};

/// Runs a scene to a time and on to twice that, on one thread and on several, and there from a snapshot, too.
template <class Scene>
void expect_the_same_with_threads_and_from_snapshots(int threads, double half, std::size_t least_events) {
  Scene alone, threaded;
  Workers workers = Workers::create(threads).value();
  EXPECT_EQ(alone.run(half), threaded.run(half, &workers));
  EXPECT_GT(alone.events, least_events);
  const auto snapshot = alone.world.save().value();
  const std::uint64_t rest = alone.run(2.0 * half);
  threaded.world = World::restore(snapshot).value();
  EXPECT_EQ(threaded.run(2.0 * half, &workers), rest);
  EXPECT_TRUE(is_clean(threaded.world));
}

/// Ends the recording of a world, which its replay has to reach to the last bit.
inline void expect_replay(World& world) {
  auto replay = Replay::open(world.stop_recording().value()).value();
  while (!replay.finished()) replay.advance().value();
  EXPECT_EQ(replay.world().save().value(), world.save().value());
}

}  // namespace kinesphere
