// Replay of a recorded simulation.
#include <map>

#include "kinesphere/event_hash.hpp"
#include "kinesphere/recording.hpp"
#include "simulation/detector/numbered_event.hpp"
#include "simulation/run/recorded_scene.hpp"
#include "simulation/run/run_scene.hpp"

namespace kinesphere {
namespace {

/// Maps ids to numbers, also for bodies that were removed before the event.
class Numbers {
 public:
  void see(const World& world) {
    for (const BodyId id : world.bodies())
      numbers_[id] = static_cast<std::uint32_t>(world.user_data(id).value());
  }
  std::uint32_t of(BodyId id, const World& world) {
    if (const auto data = world.user_data(id)) return static_cast<std::uint32_t>(*data);
    return numbers_[id];
  }

 private:
  std::map<BodyId, std::uint32_t> numbers_;
};

}  // namespace

Result<SceneResult> replay(std::span<const std::byte> recording) {
  auto opened = Replay::open(recording);
  if (!opened) return opened.error();
  const World& world = opened->world();
  const double start = world.time();
  Numbers numbers;
  EventHash hash;
  SceneResult result;
  while (!opened->finished()) {
    const double before = world.time();
    auto event = opened->advance();
    if (!event) return event.error();
    result.body_time += (world.time() - before) * static_cast<double>(world.size());
    // Bodies are added and removed between events only.
    if (*event) {
      number_bodies(**event, [&](BodyId id) { return numbers.of(id, world); });
      hash.add(**event);
    } else {
      numbers.see(world);
    }
  }
  result.counters = {world.counters()};
  result.simulated_time = world.time() - start;
  result.contact_hash = hash.value();
  return result;
}

}  // namespace kinesphere
