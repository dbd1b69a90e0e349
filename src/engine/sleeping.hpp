// Rest: bodies whose caller says that they stay where they are, and what wakes them.
//
// A body at rest has a bound that stands still, without velocity, plan, growth or limits. Everything else
// follows from that by the common rules: its report never becomes old, its window has no end, and neither
// have facts about it and others that stand still. What it promises once it is awake waits in a table of its
// own.
//
// Bodies in touch wake together. That is decided by their gaps now, not by the contacts in the book, which
// forgets bouncing bodies that do not approach; and by a search, to which bodies that were changed since the
// last advance are added.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/world_state.hpp"

namespace kinesphere {

class EventProcessor;

class Sleeping {
 public:
  Sleeping(WorldState& tables, EventProcessor& island) : state_(tables), processor_(island) {}

  /// The body rests from now on.
  void sleep(std::uint32_t number);
  /// A body that rests is awake: from here, without velocity, with the limits that it had.
  void resume(std::uint32_t number);
  /// The body, if it rests, and all resting bodies in touch with it, with those, and so on, are awake; the
  /// caller will be told. Cost: a search for each of them.
  void wake(std::uint32_t number);
  /// The same where something has touched or left a body.
  void wake_by(const Event& event);

 private:
  Bodies& bodies() { return state_.bodies; }
  const Bodies& bodies() const { return state_.bodies; }
  void wake_one(std::uint32_t number);
  std::vector<std::uint32_t> sleeping_in_touch(std::uint32_t number) const;

  WorldState& state_;
  EventProcessor& processor_;
};

}  // namespace kinesphere
