// The clock: what comes next.
#include "engine/engine.hpp"

#include <algorithm>

#include "number/infinity.hpp"

namespace kinesphere {

World::Engine::Engine(const WorldDefinition& definition)
    : tables_(definition), everybody_(tables_, definition.start_time) {}

World::Engine::Engine(const Engine& other) : tables_(other.tables_), everybody_(other.everybody_) {
  everybody_.attach(tables_);
}

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
  if (!everybody_.dirty().empty()) {
    if (auto started = start_with_arrivals(shift); !started) return started;
  }
  return everybody_.settle();
}

Activity World::Engine::activity() const {
  if (everybody_.reports().is_asking()) return Activity::probing;
  return bodies().filters.is_filtering() ? Activity::filtering : Activity::idle;
}

double World::Engine::finest_length() const {
  const double tolerance = definition().contact_tolerance;
  return std::clamp(windows().least_width(), tolerance, 0x1p30 * tolerance);
}

/// Outside advance(): as Island::probe_stale().
Result<bool> World::Engine::probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask,
                                        std::string_view call) {
  everybody_.reports().ask(ask, call);
  Shift alone;
  return everybody_.probe_stale(numbers, alone);
}

/// The body with its last report in the primary box, wherever the engine keeps it.
BodyView World::Engine::view(std::uint32_t number) const {
  const Body& body = bodies()[number];
  const Space& space = bodies().space();
  BodyView view{bodies().definition_of(number),
                body.bound,
                {},
                time(),
                {},
                body.enabled,
                body.is_fixed(),
                body.is_resting()};
  if (windows().contains(number)) {
    view.box = box(number);
    view.box_end = windows().end_of(number);
  }
  if (!space.repeats()) return view;
  const auto [position, images] = space.wrapped(body.bound.position);
  const Vec3 shift = space.shift_of(images);
  view.definition.position = view.bound.position = position;
  view.box = {view.box.lower - shift, view.box.upper - shift};
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double limit = 0x1p62;
    view.image[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(
        std::clamp(bodies().homes[number].image[axis] + images[axis], -limit, limit));
  }
  return view;
}

}  // namespace kinesphere
