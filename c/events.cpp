// Events: their names and hashes, and responses to them: bounces, potentials, and those of callers.
#include "kinesphere/response.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "exchange.hpp"
#include "input/input_check.hpp"
#include "kinesphere/event_hash.hpp"
#include "objects.hpp"

namespace kinesphere::c {
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
          .second_angular_velocity = vector(response.second_angular_velocity),
          .turned_back = response.turned_back,
          .sets_pair_state = response.pair_state.has_value(),
          .pair_state = response.pair_state.value_or(0)};
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
  chosen = read_record(chosen, c_response({}));
  Response response{.turned_back = chosen.turned_back != 0, .stop = chosen.stop != 0};
  if (chosen.sets_pair_state) response.pair_state = chosen.pair_state;
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

/// Writes a response to a record of the caller, which may be shorter.
void write_response(const Response& response, ks_response* caller) {
  write_record(c_response(response), caller, caller->struct_size);
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

}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

const char* ks_event_kind_name(ks_event_kind kind) {
  if (kind == KS_EVENT_NONE) return "none";
  if (kind < KS_EVENT_BOUND_VIOLATION || kind > KS_EVENT_TIMER) return "";
  return name_of(static_cast<EventKind>(kind - KS_EVENT_BOUND_VIOLATION)).data();
}

ks_status ks_event_hash_add(ks_event_hash* hash, const ks_event* event) {
  return guarded([&, call = __func__] {
    require_pointer(call, hash, "hash");
    require_record(call, event, "event");
    EventHash parts = EventHash::of({hash->sum, hash->count});
    parts.add(event_of(call, *event));
    *hash = {parts.parts()[0], parts.parts()[1]};
  });
}

ks_status ks_event_hash_value(const ks_event_hash* hash, uint64_t* value) {
  return guarded([&, call = __func__] {
    require_pointer(call, hash, "hash");
    require_pointer(call, value, "value");
    *value = EventHash::of({hash->sum, hash->count}).value();
  });
}

ks_status ks_bounce(const ks_event* event, double restitution, double resting_speed, ks_response* response) {
  return guarded([&, call = __func__] {
    require_record(call, event, "event");
    require_record(call, response, "response");
    require_bounce(call, restitution, resting_speed);
    write_response(bounced(event_of(call, *event), restitution, resting_speed), response);
  });
}

ks_status ks_roughness_init(ks_roughness* roughness, uint32_t struct_size) {
  const Roughness defaults;
  return initialise(__func__, roughness, struct_size,
                    ks_roughness{.struct_size = struct_size,
                                 .restitution = defaults.restitution,
                                 .tangential_restitution = defaults.tangential_restitution,
                                 .friction = defaults.friction,
                                 .inertia = defaults.inertia});
}

ks_status ks_bounce_rough(const ks_event* event, const ks_roughness* roughness, ks_response* response) {
  return guarded([&, call = __func__] {
    require_record(call, event, "event");
    require_record(call, roughness, "roughness");
    require_record(call, response, "response");
    const auto& [size, reserved, restitution, tangential, friction, inertia] = *roughness;
    InputCheck(call)
        .require(restitution >= 0.0 && restitution <= 1.0, ErrorCode::out_of_range, {"restitution"},
                 "must be in [0, 1]", restitution)
        .require(std::abs(tangential) <= 1.0, ErrorCode::out_of_range, {"tangential_restitution"},
                 "must be in [-1, 1]", tangential)
        .require(friction >= 0.0, ErrorCode::out_of_range, {"friction"}, "must be >= 0", friction)
        .require(inertia > 0.0 && std::isfinite(inertia), ErrorCode::out_of_range, {"inertia"},
                 "must be > 0 and finite", inertia)
        .result()
        .value();
    const Event contact = event_of(call, *event);
    const Roughness rough{restitution, tangential, friction, inertia};
    write_response(begins(contact) ? response_of(contact, bounce(contact, rough)) : Response{}, response);
  });
}

ks_status ks_step_potential_definition_init(ks_step_potential_definition* definition, uint32_t struct_size) {
  return initialise(__func__, definition, struct_size,
                    ks_step_potential_definition{.struct_size = struct_size, .restitution = 1.0});
}

ks_status ks_step_potential_create(ks_world world, const ks_step_potential_definition* definition,
                                   ks_step_potential* potential) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_record(call, definition, "definition");
    const auto& [size, reserved, count, distances, energies, outside, restitution] = *definition;
    require_array(call, distances, count, "distances");
    require_array(call, energies, count, "energies");
    create<StepPotentialObject>(call, potential,
                                StepPotential::create({.distances = {distances, distances + count},
                                                       .energies = {energies, energies + count},
                                                       .outside = outside,
                                                       .restitution = restitution},
                                                      object.world().definition())
                                    .value());
  });
}

ks_status ks_step_potential_destroy(ks_step_potential potential) { return destroy(__func__, potential); }

ks_status ks_step_potential_respond(ks_step_potential potential, const ks_event* event,
                                    ks_response* response) {
  return reading(__func__, potential, [&, call = __func__](const StepPotentialObject& object) {
    require_record(call, event, "event");
    require_record(call, response, "response");
    write_response(object.potential.respond(event_of(call, *event)), response);
  });
}

ks_status ks_step_potential_energy(ks_step_potential potential, double gap, double* energy) {
  return reading(__func__, potential, [&, call = __func__](const StepPotentialObject& object) {
    require_pointer(call, energy, "energy");
    *energy = object.potential.energy(gap);
  });
}
