#include "engine/answerer.hpp"

#include <span>

namespace kinesphere {

void turn(Mover& mover, const Event& event, const Answer& answer) {
  const auto turned = [&](BodyId body, const Vec3& velocity) {
    State state;
    mover.states(std::span(&body, 1), event.time, std::span(&state, 1));
    return Departure{event.time, {state.position, velocity}};
  };
  if (!answer.first_velocity || !answer.second_velocity) {
    if (answer.first_velocity) mover.depart(event.first, turned(event.first, *answer.first_velocity));
    if (answer.second_velocity) mover.depart(event.second, turned(event.second, *answer.second_velocity));
    return;
  }
  const Departure second = turned(event.second, *answer.second_velocity);
  const Departure before = mover.departure(event.first);
  mover.depart(event.first, turned(event.first, *answer.first_velocity));
  try {
    mover.depart(event.second, second);
  } catch (...) {
    mover.depart(event.first, before);
    throw;
  }
}

}  // namespace kinesphere
