// Events of a world as a detector reports them: with the numbers of bodies instead of their ids.
#pragma once

#include <cstdint>
#include <utility>

#include "kinesphere/event.hpp"

namespace kinesphere {

/// Returns the event with numbers in place of ids and the smaller number first. `number_of(id)` returns the
/// number of a body.
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
