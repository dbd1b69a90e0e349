#include "processor/responses.hpp"

#include <span>

#include "bodies/validation.hpp"
#include "space/space.hpp"

namespace kinesphere {
namespace {

/// Returns the position from which a motion goes on. In periodic space a position beyond half the coordinate
/// limit of other axes is wrapped into the box, so that a long run loses no precision. Nearer ones stay as
/// they are, with the same bits as in a shorter run.
Vec3 origin_of(const Vec3& position, const WorldDefinition& world) {
  if (!world.periodic.any() || fits(position, 0.5 * coordinate_limit(world))) return position;
  return Space(world).wrapped(position).position;
}

}  // namespace

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
    source.set_origin(ids[k], {event.time, {origin_of(states[k].position, world), velocities[k]}});
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
