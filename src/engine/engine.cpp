// The clock of a world: the order of window starts, rechecks and events.
#include "engine/engine.hpp"

namespace kinesphere {

World::Engine::Engine(const WorldDefinition& definition, bool uses_core)
    : state_(definition), main_(state_, definition.start_time) {
  if (uses_core) state_.core.emplace(definition);
}

World::Engine::Engine(const Engine& other)
    : state_(other.state_), main_(other.main_, state_), prepared_(other.prepared_) {}

Result<std::optional<Event>> World::Engine::advance(double until, const Probe& probe, PoolLease& lease) {
  main_.reports().ask(probe, "advance");
  main_.note_response();
  for (;;) {
    if (main_.is_gathering()) {
      if (auto gathered = gather(until, lease); !gathered) return gathered.error();
    }
    if (!main_.events().is_quiet()) {
      if (std::optional<Event> event = main_.pop()) return event;
    }
    if (auto recertified = recertify(lease); !recertified) return recertified.error();
    if (!main_.events().pending().empty()) continue;
    const double next = std::min(main_.pause(), main_.next_time(until));
    if (next > until) {
      main_.advance_clock(until);
      return std::optional<Event>();
    }
    main_.begin_instant(next);
    if (auto noted = main_.note_instant(); !noted) return noted.error();
  }
}

Result<bool> World::Engine::prepare_batch(const Probe& probe, PoolLease& lease) {
  main_.reports().ask(probe, "advance");
  main_.note_response();
  if (main_.is_gathering() || !main_.events().is_quiet()) return false;
  if (main_.pause() <= time()) {
    if (auto noted = main_.note_instant(); !noted) return noted.error();
    if (auto ended = end_epoch(lease); !ended) return ended.error();
    if (!main_.events().is_quiet()) {
      // As in advance(), all events of an instant are known before the first is delivered.
      main_.begin_instant(time());
      return false;
    }
  }
  if (auto recertified = recertify(lease); !recertified) return recertified.error();
  if (main_.pause() <= time()) {
    // A spot check waits until all is recertified.
    if (auto checked = end_epoch(lease); !checked) return checked.error();
  }
  return main_.is_certified();
}

/// Starts the windows that end at this instant, then rechecks all certificates that are due, also those of
/// later instants (EventProcessor::gather).
Result<void> World::Engine::gather(double until, PoolLease& lease) {
  if (main_.pause() <= time()) {
    if (auto ended = end_epoch(lease); !ended) return ended;
  }
  if (auto recertified = recertify(lease); !recertified) return recertified;
  return main_.gather(until);
}

/// Restarts all windows if many bodies were relocated; otherwise recertifies dirty bodies one by one.
Result<void> World::Engine::recertify(PoolLease& lease) {
  if (main_.is_recertified()) return {};
  main_.recertify_changed();
  if (!state_.core && main_.dirty().has_arrivals(bodies())) {
    if (auto started = start_with_arrivals(lease); !started) return started;
  }
  return main_.recertify();
}

Box World::Engine::box(std::uint32_t number) const {
  if (!state_.core) return broad_phase().box_of(number, time());
  const Vec3 centre = state_.core->region_centre(number);
  const double reach = state_.core->region_reach(number);
  return bodies().space().within({centre - Vec3{reach, reach, reach}, centre + Vec3{reach, reach, reach}});
}

CallState World::Engine::activity() const {
  if (main_.reports().is_asking()) return CallState::probing;
  return bodies().filters.is_filtering() ? CallState::filtering : CallState::idle;
}

std::vector<PairCertificate> World::Engine::certificates(std::optional<std::uint32_t> number) const {
  std::vector<PairCertificate> pairs;
  main_.certifier().for_each_certificate(main_.queue(), [&](const PairCertificate& pair) {
    if (!number || pair.first == *number || pair.second == *number) pairs.push_back(pair);
  });
  return pairs;
}

void World::Engine::set_profiling(bool on) {
  if (on) profile_ = std::make_unique<ProbeProfile>();
  main_.reports().set_profile(on ? profile_.get() : nullptr);
}

Result<bool> World::Engine::probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask,
                                        std::string_view call) {
  main_.reports().ask(ask, call);
  PoolLease alone;
  return main_.probe_stale(numbers, ProbeCause::query, alone);
}

}  // namespace kinesphere
