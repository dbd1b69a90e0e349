// Going through events in a range-for: World::events().
#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "kinesphere/event.hpp"
#include "kinesphere/probe.hpp"

namespace kinesphere {

class World;

/// The events of a world up to a time, while it goes through them. A single-pass range: begin() and each
/// increment call World::advance(), so between two events everything is allowed that is allowed at a stop.
/// When the loop has run to its end, time() == until; when it is left early, the world stands at the last
/// event, and another range goes on from there. begin() and increments throw BadResult where advance() would
/// return an error (and abort with its message where exceptions are switched off); they may be repeated.
/// The world must outlive the range and stay where it is. The range owns a temporary probe.
class [[nodiscard]] EventRange {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Event;
    using difference_type = std::ptrdiff_t;
    using pointer = const Event*;
    using reference = const Event&;

    Iterator() = default;
    explicit Iterator(EventRange& range) : range_(&range) {}

    /// Good until the next increment.
    const Event& operator*() const { return *range_->event_; }
    const Event* operator->() const { return &*range_->event_; }
    Iterator& operator++() {
      range_->go_on();
      return *this;
    }
    void operator++(int) { range_->go_on(); }
    bool operator==(std::default_sentinel_t) const { return !range_->event_; }

   private:
    EventRange* range_ = nullptr;
  };

  EventRange(World& world, double until, Probe probe)
      : world_(&world), until_(until), probe_(std::move(probe)) {}

  Iterator begin() {
    go_on();
    return Iterator(*this);
  }
  std::default_sentinel_t end() const { return {}; }

 private:
  void go_on();

  World* world_;
  double until_;
  Probe probe_;
  std::optional<Event> event_;
};

}  // namespace kinesphere
