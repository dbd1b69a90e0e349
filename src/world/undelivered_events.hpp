// Events that wait for their delivery by a run.
#pragma once

#include <deque>
#include <optional>

#include "kinesphere/world.hpp"

namespace kinesphere {

/// Events that the engine has delivered, but that run() has not completely processed.
struct World::UndeliveredEvents {
  std::deque<Event> events{};         ///< responses applied, not yet delivered to the sink; in order
  std::optional<Event> unanswered{};  ///< response not applied; comes after `events`
  bool delivering = false;            ///< true inside the sink
  bool ended = false;                 ///< the sink has called World::end_run()

  bool empty() const { return events.empty() && !unanswered; }
  /// Removes and returns the first event, or nullopt if there is none.
  std::optional<Event> take();
};

}  // namespace kinesphere
