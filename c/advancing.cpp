// Time: the next event of a world, and runs.
#include <limits>

#include "exchange.hpp"
#include "input/input_check.hpp"
#include "objects.hpp"
#include "probing.hpp"

namespace kinesphere::c {

void CombinedProbe::ask(std::span<const BodyId> ids, double time, std::span<State> states) const {
  if (probe_ == ks_probe_motions) {
    detail::bad_result({ErrorCode::unknown_body, "probe", ids[0],
                        "probe: no motion of the world moves " + text_of(ids[0]) +
                            ", and ks_probe_motions stands for no function that does"});
  }
  require_success("probe", probe_(c_ids(ids), ids.size(), time, c_states(states), user_));
}

void CombinedProbe::operator()(std::span<const BodyId> ids, double time, std::span<State> states) {
  others_.clear();
  places_.clear();
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (simulation_.find(ids[k])) {
      states[k] = simulation_.state(ids[k], time);
    } else {
      others_.push_back(ids[k]);
      places_.push_back(k);
    }
  }
  if (others_.empty()) return;
  if (others_.size() == ids.size()) return ask(ids, time, states);
  // A state that the function forgets is refused.
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  answers_.assign(others_.size(), State{{missing, missing, missing}, {missing, missing, missing}});
  ask(others_, time, answers_);
  for (std::size_t k = 0; k < places_.size(); ++k) states[places_[k]] = answers_[k];
}

namespace {

/// Returns workers with this number of threads, those of the last run if possible; null for one thread.
Workers* workers_for(WorldObject& object, int threads) {
  if (threads == 1) return nullptr;
  if (!object.workers || object.workers->count() != threads) {
    auto workers = Workers::create(threads).value();
    object.workers.emplace(std::move(workers));
  }
  return &*object.workers;
}

void run(std::string_view call, WorldObject& object, double until, const ks_run_definition& definition) {
  const GameResponse chosen = response_by(call, definition.respond, definition.respond_user,
                                          definition.restitution, definition.resting_speed);
  const auto respond = [&](const Event& event) { return chosen ? chosen(event) : Response{}; };
  const auto sink = [&](const Event& event) {
    if (!definition.sink) return;
    const ks_event told = c_event(event);
    require_success("sink", definition.sink(&told, definition.sink_user));
  };
  // Inside a callback the workers of the outer run must stay.
  require_idle(object.world());
  try {
    object.simulation().run(until, respond, sink, workers_for(object, definition.threads)).value();
  } catch (const BadResult& bad) {
    const Error& error = bad.error();
    if (error.code != ErrorCode::unknown_body || !object.world().contains(error.body) ||
        object.simulation().find(error.body))
      throw;
    detail::bad_result({ErrorCode::unknown_body, "body", error.body,
                        std::string(call) + ": no motion of the world moves " + text_of(error.body) +
                            ", as a run needs; a loop over the next events does without"});
  }
}

}  // namespace
}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

// A world does not call it: it recognises the address. A caller's own call finds no motion.
int32_t ks_probe_motions(const ks_body_id*, size_t, double, ks_state*, void*) { return 1; }

ks_status ks_world_advance(ks_world world, double until, ks_probe probe, void* user, ks_event* event) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_record(call, event, "event");
    const auto next = object.is_game() && probe == ks_probe_motions
                          ? object.game().advance(until).value()
                          : with_probe(call, object.simulation(), probe, user, [&](const Probe& combined) {
                              return object.world().advance(until, combined).value();
                            });
    write_next(next, object.world().time(), event);
  });
}

ks_status ks_run_definition_init(ks_run_definition* definition, uint32_t struct_size) {
  return initialise(__func__, definition, struct_size,
                    ks_run_definition{.struct_size = struct_size, .threads = 1, .restitution = 1.0});
}

ks_status ks_world_run(ks_world world, double until, const ks_run_definition* definition) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_record(call, definition, "definition");
    run(call, object, until, *definition);
  });
}

ks_status ks_world_use_threads(ks_world world, int32_t threads) {
  return changing(__func__, world, [&](WorldObject& object) {
    // One thread is no workers, but its number is checked.
    auto workers = std::make_unique<Workers>(Workers::create(threads).value());
    object.world().use_workers(threads > 1 ? workers.get() : nullptr).value();
    object.in_use = std::move(workers);
  });
}
