// EventRange: iterates over events in a range-for (World::events()).
#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "kinesphere/event.hpp"
#include "kinesphere/probe.hpp"

namespace kinesphere {

class World;

/// Iterator of a single-pass range over events, whose private go_on() sets its event_ to the next event, or
/// to nothing at the end.
template <class Range>
class EventIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = Event;
  using difference_type = std::ptrdiff_t;
  using pointer = const Event*;
  using reference = const Event&;

  EventIterator() = default;
  explicit EventIterator(Range& range) : range_(&range) {}

  /// Returns the current event; the reference is valid until the next increment.
  const Event& operator*() const { return *range_->event_; }
  const Event* operator->() const { return &*range_->event_; }
  EventIterator& operator++() {
    range_->go_on();
    return *this;
  }
  void operator++(int) { range_->go_on(); }
  bool operator==(std::default_sentinel_t) const { return !range_->event_; }

 private:
  Range* range_ = nullptr;
};

/// Single-pass range over the events of a world up to a time. begin() and each increment call
/// World::advance(), so everything that is allowed at a stop is allowed between two events. After the loop
/// has finished, time() == until; after an early exit, the world is at the last event, and another range
/// continues from there. begin() and increments throw BadResult where advance() would return an error
/// (without exceptions they print its message and abort); they may be repeated. The world must outlive the
/// range and keep its address. The range owns a temporary probe.
class [[nodiscard]] EventRange {
 public:
  /// Single-pass; the end is std::default_sentinel.
  using Iterator = EventIterator<EventRange>;

  /// World::events() makes a range.
  EventRange(World& world, double until, Probe probe)
      : world_(&world), until_(until), probe_(std::move(probe)) {}

  /// Advances to the first event.
  Iterator begin() {
    go_on();
    return Iterator(*this);
  }
  /// The end of every range.
  std::default_sentinel_t end() const { return {}; }

 private:
  friend Iterator;
  void go_on();

  World* world_;
  double until_;
  Probe probe_;
  std::optional<Event> event_;
};

}  // namespace kinesphere
