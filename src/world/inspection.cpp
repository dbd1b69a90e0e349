// Seeing inside: memory, timings, and what there is to draw.
#include "kinesphere/inspection.hpp"

#include <algorithm>
#include <chrono>

#include "archive/fields.hpp"
#include "archive/heap_counter.hpp"
#include "engine/engine.hpp"
#include "recording/recorder.hpp"
#include "world/check.hpp"

namespace kinesphere {
namespace {

/// Adds the time that it lives to a sum of seconds, also while an exception passes.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { sum_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

Memory World::Engine::memory() const {
  Memory memory;
  memory.pairs = everybody_.agenda().bytes();
  memory.bodies = heap_bytes(bodies());
  memory.contacts = heap_bytes(book());
  memory.windows = heap_bytes(windows());
  memory.other = sizeof *this + everybody_.bytes() - memory.pairs;
  for (const FoundPairs& found : found_) memory.other += heap_bytes(found.hot);
  return memory;
}

Memory World::memory() const {
  Memory memory = engine("memory").memory();
  if (recorder_) memory.recording = recorder_->memory();
  return memory;
}

std::vector<CellView> World::cells() const {
  std::vector<CellView> all;
  for (const WindowLayer& layer : engine("cells").windows().layers())
    layer.for_each_cell([&](const Box& box, std::size_t bodies) { all.push_back({box, bodies}); });
  return all;
}

std::vector<Certificate> World::certificates() const {
  const Engine& engine = this->engine("certificates");
  std::vector<Certificate> all;
  for (const HotPair& pair : engine.hot_pairs()) {
    if (pair.second == HotPair::renewal) continue;
    const BodyId other = pair.second == HotPair::walls ? no_body : engine.bodies().id_of(pair.second);
    const auto [first, second] = std::minmax({engine.bodies().id_of(pair.first), other});
    all.push_back({first, second, pair.time});
  }
  return all;
}

Result<void> World::set_timing(bool on) {
  auto valid = Check(*this, "set_timing").idle();
  if (!valid) return valid;
  if (on && !timing_) timings_ = {};
  timing_ = on;
  return valid;
}

Timings World::timings() const {
  (void)engine("timings");
  return timings_;
}

Result<std::optional<Event>> World::timed_advance(double until, const Probe& probe) {
  ++timings_.advances;
  const Stopwatch whole(timings_.advance);
  return recorded_advance(until, [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    const Stopwatch asking(timings_.probes);
    probe(ids, time, states);
  });
}

}  // namespace kinesphere
