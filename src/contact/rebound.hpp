// What an impulse along the normal of an event does to its bodies.
#pragma once

#include "kinesphere/response.hpp"

namespace kinesphere {

/// Returns the velocities after an impulse that lowers the approach speed by `change` (length / time), with
/// these masses, as bounce() uses them.
Bounce rebound(const Event& event, double first_mass, double second_mass, double change);

/// Returns by how much a unit impulse changes the approach speed of the two: the inverse of their effective
/// mass, with the masses of the event. 0 if none of them moves.
double inverse_effective_mass(const Event& event);

}  // namespace kinesphere
