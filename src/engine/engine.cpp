// The clock of a world: the order of what is due, events, and changes.
#include "engine/engine.hpp"

#include <numeric>

namespace kinesphere {

World::Engine::Engine(const WorldDefinition& definition)
    : state_(definition), main_(state_, definition.start_time) {}

World::Engine::Engine(const Engine& other) : state_(other.state_), main_(other.main_, state_) {}

Result<std::optional<Event>> World::Engine::advance(double until, const Probe& probe, PoolLease* lease) {
  main_.reports().ask(probe, "advance", lease);
  main_.note_response();
  for (;;) {
    if (main_.is_gathering()) {
      if (auto gathered = gather(until); !gathered) return gathered.error();
    }
    if (!main_.events().is_quiet()) {
      if (std::optional<Event> event = main_.pop()) return event;
    }
    if (auto recertified = main_.recertify(); !recertified) return recertified.error();
    if (!main_.events().pending().empty()) continue;
    const double next = std::min(state_.spot_checks.next(), main_.next_time(until));
    if (state_.timers.next() < next && state_.timers.next() <= until) {
      main_.advance_clock(state_.timers.next());
      return std::optional(main_.take_timer());
    }
    if (next > until) {
      main_.advance_clock(until);
      return std::optional<Event>();
    }
    main_.begin_instant(next);
    if (auto noted = main_.note_instant(); !noted) return noted.error();
  }
}

/// Handles all that is due at this instant, and what is due later as long as no event is known
/// (EventProcessor::gather).
Result<void> World::Engine::gather(double until) {
  if (state_.spot_checks.next() <= time()) {
    if (auto checked = spot_check(); !checked) return checked;
  }
  if (auto recertified = main_.recertify(); !recertified) return recertified;
  return main_.gather(until);
}

/// Checks exact bodies when that is due, but not before bodies that have arrived are recertified.
Result<void> World::Engine::spot_check() {
  if (!main_.is_recertified()) return {};
  std::vector<std::uint32_t> all(bodies().numbers());
  std::iota(all.begin(), all.end(), 0u);
  const std::uint64_t& probes = counters().probes;
  const auto census = main_.spot_check_due(all, probes);
  if (!census) return census.error();
  state_.spot_checks.note_check(state_.core.count_stays().median(), time(), *census, probes);
  return {};
}

Box World::Engine::box(std::uint32_t number) const {
  const Vec3 centre = core().region_centre(number);
  const double reach = core().region_reach(number) + left_out_of_extents(bodies());
  return bodies().space().within({centre - Vec3{reach, reach, reach}, centre + Vec3{reach, reach, reach}});
}

CallState World::Engine::activity() const {
  if (main_.reports().is_asking()) return CallState::probing;
  return bodies().filters.is_filtering() ? CallState::filtering : CallState::idle;
}

void World::Engine::set_profiling(bool on) {
  if (on) profile_ = std::make_unique<ProbeProfile>();
  main_.reports().set_profile(on ? profile_.get() : nullptr);
}

Result<bool> World::Engine::probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask,
                                        std::string_view call) {
  main_.reports().ask(ask, call);
  return main_.probe_stale(numbers, ProbeCause::query);
}

}  // namespace kinesphere
