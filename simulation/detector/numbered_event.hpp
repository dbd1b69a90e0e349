// Events of a world as a detector reports them: with the numbers of bodies instead of their ids.
#pragma once

#include <cstdint>
#include <utility>

#include "kinesphere/event.hpp"

namespace kinesphere {

/// Puts numbers in place of the ids of an event, the smaller number first. `number_of(id)` returns the number
/// of a body.
template <class NumberOf>
void number_bodies(Event& event, NumberOf number_of) {
  event.first = {number_of(event.first), 0};
  if (event.second == no_body) return;
  event.second = {number_of(event.second), 0};
  if (event.first < event.second) return;
  std::swap(event.first, event.second);
  std::swap(event.first_state, event.second_state);
  std::swap(event.first_traits, event.second_traits);
  std::swap(event.first_mass, event.second_mass);
  std::swap(event.first_user_data, event.second_user_data);
  if (event.senses == Senses::first || event.senses == Senses::second)
    event.senses = event.senses == Senses::first ? Senses::second : Senses::first;
  event.normal = -event.normal;
}

}  // namespace kinesphere
