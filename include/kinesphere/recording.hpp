// Recordings: all that went into a world and came out of it, so that it can be gone through again.
//
//   world.start_recording().value();
//   // ... advance, change and ask the world as ever
//   std::vector<std::byte> recording = world.stop_recording().value();
//
//   Replay replay = Replay::open(recording).value();
//   while (!replay.finished()) {
//     if (auto event = replay.advance().value()) ...  // replay.world() is as the world was then
//   }
//
// A recording holds the world as it was at the start, every change, every state that a probe reported, and
// the outcome of every call that could probe, with a hash of the event and of all work done so far. A replay
// is a real world whose probe answers from the recording: nothing else is needed, on any machine, and the
// first step that goes another way is named.
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

/// A state that a probe reported.
struct ProbedState {
  double time = 0.0;
  BodyId body = no_body;
  State state{};
};

class Replay {
 public:
  /// A world that was recorded with a pair filter needs it again: one that answers as it did then. It may
  /// look at world(). The bytes are copied. Errors: bad_recording for bytes that are foreign, cut short,
  /// damaged, of another format version, or that cannot have been recorded; bad_snapshot for a world in them
  /// that cannot be; out_of_range for a pair filter that is missing.
  static Result<Replay> open(std::span<const std::byte> recording, PairFilter pair_filter = {});

  Replay(Replay&&) noexcept;
  Replay& operator=(Replay&&) noexcept;
  ~Replay();

  /// Repeats everything up to the end of the next recorded advance(), or of the recording, and returns what
  /// that advance() returned (nothing where it failed). Errors: diverged, naming the step, what was recorded
  /// and what came instead, the same at every further call.
  Result<std::optional<Event>> advance();
  /// Nothing is left, and the world has ended as the recorded one did, to the last bit.
  bool finished() const;

  /// As it is after the last step; for reading.
  const World& world() const;
  /// Steps repeated so far, and all there are: changes and calls that could probe.
  std::size_t step() const;
  std::size_t step_count() const;
  /// Of all outcomes so far. The per-step hash of the recording is what this was after the step.
  std::uint64_t hash() const;

 private:
  class Player;
  explicit Replay(std::unique_ptr<Player> player);
  std::unique_ptr<Player> player_;
};

/// What a viewer can draw without replaying.
struct RecordedRun {
  double start_time = 0.0;
  double end_time = 0.0;
  std::vector<Event> events{};
  /// In the order in which they came; states of probes that failed are left out.
  std::vector<ProbedState> probed_states{};
};

/// Reads a recording without repeating it. Errors: as Replay::open.
Result<RecordedRun> read_recording(std::span<const std::byte> recording);

}  // namespace kinesphere
