#include "engine/answerer.hpp"

#include <optional>
#include <span>

#include "engine/validation.hpp"

namespace kinesphere {

Result<void> turn(Mover& mover, const WorldDefinition& world, const Event& event, const Answer& answer) {
  // Every state is known to be one before the first body departs.
  std::optional<Departure> first, second;
  const auto make = [&](BodyId body, const std::optional<Vec3>& velocity,
                        std::optional<Departure>& departure) -> Result<void> {
    if (!velocity) return {};
    State state = no_answer;
    mover.states(std::span(&body, 1), event.time, std::span(&state, 1));
    if (auto valid = check_report(state, body, event.time, world, "run"); !valid) return valid;
    departure = Departure{event.time, {state.position, *velocity}};
    return {};
  };
  auto made = make(event.second, answer.second_velocity, second);
  if (made) made = make(event.first, answer.first_velocity, first);
  if (!made) return made;
  if (!first || !second) {
    if (first) mover.depart(event.first, *first);
    if (second) mover.depart(event.second, *second);
    return {};
  }
  const Departure before = mover.departure(event.first);
  mover.depart(event.first, *first);
  try {
    mover.depart(event.second, *second);
  } catch (...) {
    mover.depart(event.first, before);
    throw;
  }
  return {};
}

}  // namespace kinesphere
