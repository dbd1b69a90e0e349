// Sleeping handles bodies that the caller put to sleep, and what wakes them.
//
// A sleeping body has a bound that stands still: no velocity, planned acceleration, growth or limits. The
// rest follows from the general rules: its report never becomes old, its own time never comes, and neither
// have certificates with other bodies that stand still. The motion limits that apply after it wakes are in a
// side table.
//
// Bodies in contact wake together, as an island. Contact is decided from current gaps, not from the contact
// graph, which drops bouncing bodies that do not approach. The search includes bodies that were changed since
// the last advance.
#pragma once

#include <cstdint>
#include <vector>

#include "processor/world_state.hpp"

namespace kinesphere {

class EventProcessor;

class Sleeping {
 public:
  Sleeping(WorldState& state, EventProcessor& processor) : state_(state), processor_(processor) {}

  /// Puts the body to sleep from the current time on.
  void sleep(std::uint32_t number);
  /// Wakes a sleeping body at its position, with zero velocity and its earlier motion limits, without an
  /// event.
  void resume(std::uint32_t number);
  /// Wakes the body if it sleeps, and all sleeping bodies connected to it by contacts. Queues an event for
  /// each body that wakes. Cost: one search per body.
  void wake(std::uint32_t number);
  /// Wakes sleeping bodies of a contact begin or end, as wake() does; the event then says that they are
  /// awake.
  void wake_by(Event& event);

 private:
  Bodies& bodies() { return state_.bodies; }
  const Bodies& bodies() const { return state_.bodies; }
  void wake_one(std::uint32_t number);
  std::vector<std::uint32_t> sleeping_in_touch(std::uint32_t number) const;

  WorldState& state_;
  EventProcessor& processor_;
};

}  // namespace kinesphere
