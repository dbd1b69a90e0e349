// The clock: what comes next.
#include "engine/engine.hpp"

#include <algorithm>

#include "number/infinity.hpp"

namespace kinesphere {

World::Engine::Engine(const WorldDefinition& definition)
    : tables_(definition), everybody_(tables_, definition.start_time) {}

World::Engine::Engine(const Engine& other) : tables_(other.tables_), everybody_(other.everybody_, tables_) {}

Result<std::optional<Event>> World::Engine::advance(double until, const Probe& probe) {
  everybody_.reports().ask(probe, "advance");
  Shift alone;
  for (;;) {
    if (everybody_.is_gathering()) {
      if (auto gathered = gather(); !gathered) return gathered.error();
    }
    if (!everybody_.instant().is_quiet()) {
      if (std::optional<Event> event = everybody_.deliver()) return event;
    }
    if (auto settled = settle(alone); !settled) return settled.error();
    if (!everybody_.instant().pending().empty()) continue;
    const double next = std::min(everybody_.phase_end(), everybody_.next_time());
    if (next > until) {
      everybody_.move_on_to(until);
      return std::optional<Event>();
    }
    everybody_.come_to(next);
  }
}

Result<bool> World::Engine::run_phase(double until, const Probe& probe, Shift& shift, Islands& islands,
                                      std::deque<Event>& events) {
  everybody_.reports().ask(probe, "advance");
  if (everybody_.is_gathering() || !everybody_.instant().is_quiet()) return false;
  if (everybody_.phase_end() <= time()) {
    if (auto started = start_windows(shift, false); !started) return started.error();
    if (!everybody_.instant().is_quiet()) {
      // All events of an instant are known before the first is told, as in advance().
      everybody_.come_to(time());
      return false;
    }
  }
  if (auto settled = settle(shift); !settled) return settled.error();
  return everybody_.is_settled() && islands.run(until, events);
}

/// Windows that end at this instant, and all that is due.
Result<void> World::Engine::gather() {
  Shift alone;
  if (everybody_.phase_end() <= time()) {
    if (auto started = start_windows(alone, false); !started) return started;
  }
  if (auto settled = settle(alone); !settled) return settled;
  return everybody_.gather();
}

/// Where many have arrived, all others start anew with them; else each is settled by itself.
Result<void> World::Engine::settle(Shift& shift) {
  everybody_.settle_changed();
  if (!everybody_.unsettled().empty()) {
    if (auto started = start_with_arrivals(shift); !started) return started;
  }
  return everybody_.settle();
}

Activity World::Engine::activity() const {
  if (everybody_.reports().is_asking()) return Activity::probing;
  return bodies().filters.is_filtering() ? Activity::filtering : Activity::idle;
}

std::vector<HotPair> World::Engine::hot_pairs(std::optional<std::uint32_t> number) const {
  std::vector<HotPair> pairs;
  everybody_.facts().for_each_hot_pair(everybody_.agenda(), [&](const HotPair& pair) {
    if (!number || pair.first == *number || pair.second == *number) pairs.push_back(pair);
  });
  return pairs;
}

Result<bool> World::Engine::probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask,
                                        std::string_view call) {
  everybody_.reports().ask(ask, call);
  Shift alone;
  return everybody_.probe_stale(numbers, alone);
}

}  // namespace kinesphere
