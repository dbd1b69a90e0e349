// Recordings and their replays.
#include "exchange.hpp"

namespace kinesphere::browser {

KINESPHERE_EXPORT(world_start_recording) bool world_start_recording(World* world) {
  return is_good(world->start_recording());
}
KINESPHERE_EXPORT(world_set_profiling) bool world_set_profiling(World* world, bool on) {
  return is_good(world->set_profiling(on));
}
KINESPHERE_EXPORT(world_stop_recording) bool world_stop_recording(World* world) {
  auto recording = world->stop_recording();
  if (recording) answer_bytes() = std::move(*recording);
  return is_good(recording);
}

KINESPHERE_EXPORT(replay_open) Replay* replay_open(const std::byte* recording, std::size_t size) {
  auto replay = Replay::open({recording, size});
  return is_good(replay) ? new Replay(std::move(*replay)) : nullptr;
}
KINESPHERE_EXPORT(replay_free) void replay_free(Replay* replay) { delete replay; }
KINESPHERE_EXPORT(replay_advance) int replay_advance(Replay* replay) {
  return answer_event(replay->advance());
}
KINESPHERE_EXPORT(replay_finished) bool replay_finished(const Replay* replay) { return replay->finished(); }
KINESPHERE_EXPORT(replay_step) std::size_t replay_step(const Replay* replay) { return replay->step(); }
KINESPHERE_EXPORT(replay_step_count) std::size_t replay_step_count(const Replay* replay) {
  return replay->step_count();
}
/// Answers the lower and the upper half of the hash of all outcomes so far.
KINESPHERE_EXPORT(replay_hash) void replay_hash(const Replay* replay) {
  answer() = {static_cast<double>(replay->hash() & 0xffffffffu), static_cast<double>(replay->hash() >> 32)};
}
/// Read-only; valid while the replay exists and is not advanced.
KINESPHERE_EXPORT(replay_world) const World* replay_world(const Replay* replay) { return &replay->world(); }

}  // namespace kinesphere::browser
