// The event that an interrupted run leaves behind.
#pragma once

#include <optional>
#include <utility>

#include "kinesphere/world.hpp"

namespace kinesphere {

/// What a run leaves behind, and what it is doing.
struct World::UndeliveredEvents {
  std::optional<Event> unanswered{};  ///< delivered by the engine, but its response has not been applied
  bool delivering = false;            ///< true inside the sink
  bool ended = false;                 ///< the sink has called World::end_run()

  bool empty() const { return !unanswered; }
  /// Removes and returns the event, or nullopt if there is none.
  std::optional<Event> take() { return std::exchange(unanswered, std::nullopt); }
};

}  // namespace kinesphere
