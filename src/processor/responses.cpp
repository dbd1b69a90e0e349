#include "processor/responses.hpp"

#include <span>
#include <string>
#include <string_view>

#include "bodies/validation.hpp"
#include "space/space.hpp"

namespace kinesphere {
namespace {

/// Returns the position from which a motion goes on. In periodic space a position beyond half the coordinate
/// limit of other axes is wrapped into the box, so that a long run loses no precision. Nearer ones stay as
/// they are, with the same bits as in a shorter run. Where images slide, it stays in its row.
Vec3 origin_of(const Vec3& position, const WorldDefinition& world, double time) {
  if (!world.periodic.any() || fits(position, 0.5 * coordinate_limit(world))) return position;
  const Space space(world);
  if (!space.slides()) return space.wrapped(position, time).position;
  const Vec3 in_row = space.wrapped({position.x, world.box->lower.y, position.z}, time).position;
  return {in_row.x, position.y, in_row.z};
}

}  // namespace

void move_to_images_of(MotionSource& source, const Space& space, const Event& event, Response& answer) {
  const auto move = [&](BodyId body, const State& seen, std::optional<Vec3>& velocity) {
    if (!velocity) return;
    State state = no_answer;
    source.states(std::span(&body, 1), event.time, std::span(&state, 1));
    *velocity = space.velocity_in_row(*velocity, seen.position, state.position);
  };
  move(event.first, event.first_state, answer.first_velocity);
  move(event.second, event.second_state, answer.second_velocity);
}

Result<void> check_pair_response(const Event& event, const Response& answer) {
  const auto refused = [&](std::string_view argument, std::string_view what) -> Result<void> {
    return Error{ErrorCode::unsupported, std::string(argument), event.first,
                 "run: respond: " + std::string(argument) + " at " + std::string(name_of(event.kind)) +
                     ": must be given only at " + std::string(what)};
  };
  if (answer.pair_state && event.second == no_body) return refused("pair_state", "an event of two bodies");
  if (answer.turned_back && !is_of_sensor(event.kind))
    return refused("turned_back", "a sensor_enter or a sensor_leave");
  return {};
}

Result<void> apply_response(MotionSource& source, const WorldDefinition& world, const Event& event,
                            const Response& answer) {
  std::array<BodyId, 2> ids;
  std::array<Vec3, 2> velocities;
  std::array<State, 2> states{no_answer, no_answer};
  std::size_t count = 0;
  for (const BodyResponse& part : parts_of(event, answer)) {
    if (!part.velocity) continue;
    ids[count] = part.body;
    velocities[count++] = *part.velocity;
  }
  if (count == 0) return {};
  source.states(std::span(ids).first(count), event.time, std::span(states).first(count));
  // All states are validated before the first origin is set.
  for (std::size_t k = 0; k < count; ++k)
    if (auto valid = check_report(states[k], ids[k], event.time, world, "run"); !valid) return valid;
  const auto set = [&](std::size_t k) {
    const Vec3 place = origin_of(states[k].position, world, event.time);
    source.set_origin(ids[k], {event.time, {place, velocities[k]}});
  };
  if (count == 1) {
    set(0);
    return {};
  }
  const MotionOrigin before = source.origin(ids[0]);
  set(0);
  try {
    set(1);
  } catch (...) {
    source.set_origin(ids[0], before);
    throw;
  }
  return {};
}

}  // namespace kinesphere
