// Time: the next event of a world, and runs.
#include <cmath>
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

bool begins(const Event& event) {
  return event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
}

/// The response of ks_bounce().
Response bounced(const Event& event, double restitution, double resting_speed) {
  if (!begins(event)) return {};
  return response_of(
      event, resting_speed > 0.0 ? settle(event, restitution, resting_speed) : bounce(event, restitution));
}

ks_response c_response(const Response& response) {
  const auto vector = [](const std::optional<Vec3>& given) { return c_vector(given.value_or(Vec3{})); };
  return {.struct_size = sizeof(ks_response),
          .stop = response.stop,
          .turns_first = response.first_velocity.has_value(),
          .turns_second = response.second_velocity.has_value(),
          .spins_first = response.first_angular_velocity.has_value(),
          .spins_second = response.second_angular_velocity.has_value(),
          .first_action = static_cast<ks_body_action>(response.first_action),
          .second_action = static_cast<ks_body_action>(response.second_action),
          .first_velocity = vector(response.first_velocity),
          .second_velocity = vector(response.second_velocity),
          .first_angular_velocity = vector(response.first_angular_velocity),
          .second_angular_velocity = vector(response.second_angular_velocity)};
}

static_assert(KS_ACTION_SLEEP == static_cast<ks_body_action>(BodyAction::sleep));

BodyAction action_of(const Event& event, BodyId body, ks_body_action action, const std::string& argument) {
  if (KS_ACTION_NONE <= action && action <= KS_ACTION_SLEEP) return static_cast<BodyAction>(action);
  detail::bad_result({ErrorCode::out_of_range, argument, body,
                      "run: respond: " + argument + " at " + std::string(name_of(event.kind)) +
                          " must be one of KS_ACTION_..., but is " + std::to_string(action)});
}

Response response_of_caller(std::string_view call, ks_respond respond, void* user, const Event& event) {
  const ks_event told = c_event(event);
  ks_response chosen = c_response({});
  require_success("respond", respond(&told, &chosen, user));
  require_record(call, &chosen, "response");
  Response response{.stop = chosen.stop != 0};
  response.first_action = action_of(event, event.first, chosen.first_action, "first_action");
  response.second_action = action_of(event, event.second, chosen.second_action, "second_action");
  if (chosen.turns_first) response.first_velocity = vector_of(chosen.first_velocity);
  if (chosen.turns_second) response.second_velocity = vector_of(chosen.second_velocity);
  if (chosen.spins_first) response.first_angular_velocity = vector_of(chosen.first_angular_velocity);
  if (chosen.spins_second) response.second_angular_velocity = vector_of(chosen.second_angular_velocity);
  return response;
}

/// Throws BadResult unless a bounce can have these numbers.
void require_bounce(std::string_view call, double restitution, double resting_speed) {
  InputCheck(call)
      .not_negative({"restitution"}, restitution)
      .require(restitution <= 1.0, ErrorCode::out_of_range, {"restitution"}, "must be at most 1", restitution)
      .not_negative({"resting_speed"}, resting_speed)
      .result()
      .value();
}

}  // namespace

GameResponse response_by(std::string_view call, ks_respond respond, void* user, double restitution,
                         double resting_speed) {
  if (respond != nullptr)
    return [=, name = std::string(call)](const Event& event) {
      return response_of_caller(name, respond, user, event);
    };
  if (std::isnan(restitution)) return {};
  require_bounce(call, restitution, resting_speed);
  return [=](const Event& event) { return bounced(event, restitution, resting_speed); };
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

ks_status ks_bounce(const ks_event* event, double restitution, double resting_speed, ks_response* response) {
  return guarded([&, call = __func__] {
    require_record(call, event, "event");
    require_record(call, response, "response");
    require_bounce(call, restitution, resting_speed);
    *response = c_response(bounced(event_of(call, *event), restitution, resting_speed));
  });
}
