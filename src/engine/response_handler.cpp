#include "engine/response_handler.hpp"

#include <optional>
#include <span>

#include "engine/validation.hpp"

namespace kinesphere {

Result<void> apply_response(MotionSource& source, const WorldDefinition& world, const Event& event,
                            const Response& answer) {
  // All states are validated before the first origin is set.
  std::optional<MotionOrigin> first, second;
  const auto make = [&](BodyId body, const std::optional<Vec3>& velocity,
                        std::optional<MotionOrigin>& origin) -> Result<void> {
    if (!velocity) return {};
    State state = no_answer;
    source.states(std::span(&body, 1), event.time, std::span(&state, 1));
    if (auto valid = check_report(state, body, event.time, world, "run"); !valid) return valid;
    origin = MotionOrigin{event.time, {state.position, *velocity}};
    return {};
  };
  auto made = make(event.second, answer.second_velocity, second);
  if (made) made = make(event.first, answer.first_velocity, first);
  if (!made) return made;
  if (!first || !second) {
    if (first) source.set_origin(event.first, *first);
    if (second) source.set_origin(event.second, *second);
    return {};
  }
  const MotionOrigin before = source.origin(event.first);
  source.set_origin(event.first, *first);
  try {
    source.set_origin(event.second, *second);
  } catch (...) {
    source.set_origin(event.first, before);
    throw;
  }
  return {};
}

}  // namespace kinesphere
