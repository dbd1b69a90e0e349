// Recordings: all input and output of a world, for replay.
//
//   world.start_recording().value();
//   // ... advance, change and query the world as usual
//   std::vector<std::byte> recording = world.stop_recording().value();
//
//   Replay replay = Replay::open(recording).value();
//   while (!replay.finished()) {
//     if (auto event = replay.advance().value()) ...  // replay.world() is as the world was then
//   }
//
// A recording holds the world as it was at the start, every change, every probed state and rotation, and for
// every call that could probe a hash of its outcome and of all work so far. A replay is a real world whose
// probes read from the recording: it needs nothing else, on any machine, and names the first step that
// differs. States and velocities are held, to the last bit, as differences from those that the world expects:
// where bodies move as planned and answer events with bounce() or settle(), 6 to 15 bytes an event.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/event.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// A state that a probe reported, with its time and body.
struct ProbedState {
  double time = 0.0;
  BodyId body = no_body;
  State state{};

  friend constexpr bool operator==(const ProbedState&, const ProbedState&) = default;
};

/// Repeats a recording of a world, and compares each outcome with the recorded one.
class Replay {
 public:
  /// Opens a recording; the bytes are copied. A world that was recorded with a pair filter needs a filter
  /// here that returns the recorded results; the filter may read world(). Errors: bad_recording for bytes
  /// that are foreign, truncated, damaged, of another format version, or that cannot have been recorded;
  /// bad_snapshot for an impossible world in them; out_of_range for a missing pair filter.
  static Result<Replay> open(std::span<const std::byte> recording, PairFilter pair_filter = {});

  Replay(Replay&&) noexcept;
  Replay& operator=(Replay&&) noexcept;
  ~Replay();

  /// Repeats everything up to the end of the next recorded advance(), or of the recording, and returns what
  /// that advance() returned (nothing if it failed). Errors: diverged, naming the step and its outcome; every
  /// further call returns it again.
  Result<std::optional<Event>> advance();
  /// True if no step is left and the world has ended as the recorded one did, to the last bit.
  bool finished() const;

  /// States that were probed during the last advance(), in order, without those of a probe that failed. Valid
  /// until the next one.
  std::span<const ProbedState> probed_states() const;
  /// Returns the world after the last repeated step, for reading.
  const World& world() const;
  /// Number of steps repeated so far, and in total; steps are changes and calls that could probe.
  std::size_t step() const;
  std::size_t step_count() const;
  /// Hash of all outcomes so far. After each step its lowest 16 bits are those that the recording holds for
  /// that step.
  std::uint64_t hash() const;

 private:
  class Player;
  explicit Replay(std::unique_ptr<Player> player);
  std::unique_ptr<Player> player_;
};

/// What happened in a recorded run.
struct RecordedRun {
  double start_time = 0.0;
  double end_time = 0.0;
  std::vector<Event> events{};
  /// In recorded order, without the states of probes that failed.
  std::vector<ProbedState> probed_states{};

  friend bool operator==(const RecordedRun&, const RecordedRun&) = default;
};

/// Replays a recording, and returns all that happened. Errors: as Replay::open() and Replay::advance(). Cost:
/// that of the run without its probes.
Result<RecordedRun> read_recording(std::span<const std::byte> recording, PairFilter pair_filter = {});

}  // namespace kinesphere
