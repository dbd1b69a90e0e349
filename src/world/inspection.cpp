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
  memory.pairs = main_.queue().bytes();
  memory.other = sizeof *this + main_.bytes() - memory.pairs;
  memory.bodies = heap_bytes(bodies());
  memory.contacts = heap_bytes(contacts());
  memory.windows = heap_bytes(broad_phase());
  if (prepared_) memory.windows += heap_bytes(*prepared_);
  if (state_.core) {
    memory.pairs += state_.core->due_bytes();
    memory.windows += state_.core->region_bytes();
  }
  if (profile_) memory.other += profile_->bytes();
  for (const SearchResults& found : found_) memory.other += heap_bytes(found.certificates);
  return memory;
}

Memory World::Inspection::memory() const {
  Memory memory = world_->engine("memory").memory();
  if (world_->recorder_) memory.recording = world_->recorder_->memory();
  return memory;
}

std::vector<CellView> World::Inspection::cells() const {
  std::vector<CellView> all;
  const Engine& engine = world_->engine("cells");
  if (engine.state().core)
    for (const auto& [box, bodies] : engine.state().core->cells()) all.push_back({box, bodies});
  for (const GridLevel& level : engine.broad_phase().levels())
    level.for_each_cell([&](const Box& box, std::size_t bodies) { all.push_back({box, bodies}); });
  return all;
}

std::vector<Certificate> World::Inspection::certificates() const {
  const Engine& engine = world_->engine("certificates");
  std::vector<Certificate> all;
  if (const auto& core = engine.state().core) {
    for (std::uint32_t number = 0; number < engine.bodies().numbers(); ++number)
      if (const auto found = core->certificate_of(number)) {
        const bool waits = engine.bodies()[number].dirty ||
                           (found->other != core::none && engine.bodies()[found->other].dirty);
        if (waits) continue;
        const BodyId other = found->other == core::none ? no_body : engine.bodies().id_of(found->other);
        const auto [first, second] = std::minmax({engine.bodies().id_of(number), other});
        all.push_back({first, second, found->until});
      }
    return all;
  }
  for (const PairCertificate& pair : engine.certificates()) {
    if (pair.kind() == PairCertificate::Kind::window_end) continue;
    const BodyId other = pair.has_second() ? engine.bodies().id_of(pair.second) : no_body;
    const auto [first, second] = std::minmax({engine.bodies().id_of(pair.first), other});
    all.push_back({first, second, pair.failure_time});
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
