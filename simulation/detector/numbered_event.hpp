// Events of a world in the terms of a detector: bodies go by their number.
#pragma once

#include <cstdint>
#include <utility>

#include "kinesphere/event.hpp"

namespace kinesphere {

/// The event with numbers for ids, and the smaller number first. `number_of(id)` gives a number.
template <class NumberOf>
Event numbered(Event event, NumberOf number_of) {
  event.first = {number_of(event.first), 0};
  if (event.second == no_body) return event;
  event.second = {number_of(event.second), 0};
  if (event.second < event.first) {
    std::swap(event.first, event.second);
    std::swap(event.first_state, event.second_state);
    event.normal = -event.normal;
  }
  return event;
}

}  // namespace kinesphere
