// Inspection of a world: memory, timings, and data for drawing.
#include "kinesphere/inspection.hpp"

#include <algorithm>
#include <chrono>

#include "archive/heap_counter.hpp"
#include "engine/engine.hpp"
#include "recording/recorder.hpp"
#include "world/preconditions.hpp"

namespace kinesphere {
namespace {

/// Adds its own lifetime (s) to `sum` in the destructor, hence also when an exception is thrown.
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
  memory.pairs = core().due_bytes();
  memory.other = sizeof *this + main_.bytes();
  memory.bodies = heap_bytes(bodies());
  memory.contacts = heap_bytes(contacts());
  memory.windows = core().region_bytes();
  if (profile_) memory.other += profile_->bytes();
  return memory;
}

Memory World::Inspection::memory() const {
  Memory memory = world_->engine("memory").memory();
  if (world_->recorder_) memory.recording = world_->recorder_->memory();
  return memory;
}

std::vector<CellView> World::Inspection::cells() const {
  std::vector<CellView> all;
  for (const auto& [box, bodies] : world_->engine("cells").core().cells()) all.push_back({box, bodies});
  return all;
}

std::vector<Certificate> World::Inspection::certificates() const {
  const Engine& engine = world_->engine("certificates");
  std::vector<Certificate> all;
  for (std::uint32_t number = 0; number < engine.bodies().numbers(); ++number) {
    const auto found = engine.core().certificate_of(number);
    if (!found || engine.bodies()[number].dirty) continue;
    if (found->other != core::none && engine.bodies()[found->other].dirty) continue;
    const BodyId other = found->other == core::none ? no_body : engine.bodies().id_of(found->other);
    const auto [first, second] = std::minmax({engine.bodies().id_of(number), other});
    all.push_back({first, second, found->until});
  }
  return all;
}

Result<void> World::set_profiling(bool on) {
  auto valid = Preconditions(*this, "set_profiling").idle();
  if (!valid) return valid;
  if (on == profiling_) return valid;
  if (on) timings_ = std::make_unique<Timings>();
  changeable().set_profiling(on);
  profiling_ = on;
  return valid;
}

Timings World::Inspection::timings() const {
  (void)world_->engine("timings");
  return world_->timings_ ? *world_->timings_ : Timings{};
}

Result<std::vector<BusyBody>> World::Inspection::busiest(std::size_t count) const {
  const Engine& engine = world_->engine("busiest");
  if (engine.profile() == nullptr)
    return Error{ErrorCode::not_profiling, "world", no_body,
                 "busiest: the world counts probes while profiling is on: call set_profiling(true) first"};
  return engine.profile()->busiest(engine.bodies(), count);
}

bool World::Inspection::is_recording() const {
  (void)world_->engine("is_recording");
  return world_->recorder_ != nullptr;
}

std::optional<AuditFinding> World::Inspection::audit() const {
  const Engine& audited = world_->engine("audit");
  if (const auto idle = Preconditions(*world_, "audit").idle(); !idle)
    return AuditFinding{"call", idle.error().message};
  return audited.audit();
}

Result<std::optional<Event>> World::timed_advance(double until, const Probe& probe) {
  ++timings_->advances;
  const Stopwatch whole(timings_->advance);
  return recorded_advance(until, [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    const Stopwatch asking(timings_->probes);
    probe(ids, time, states);
  });
}

}  // namespace kinesphere
