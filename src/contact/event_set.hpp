// Set of events at one time in delivery order. It rarely holds more than one.
#pragma once

#include <algorithm>
#include <cassert>
#include <optional>
#include <set>
#include <utility>

#include "contact/contact_event.hpp"

namespace kinesphere {

/// Sorted set whose first element is stored inline, without heap allocation.
class EventSet {
 public:
  bool empty() const { return !first_; }
  void clear() {
    first_.reset();
    others_.clear();
  }
  bool contains(const Event& event) const {
    return first_ && (is_first(event) || (!others_.empty() && others_.contains(event)));
  }

  /// Inserts an event; an equivalent one that is already present stays.
  void insert(const Event& event) {
    if (!first_) {
      first_ = event;
    } else if (delivered_before(event, *first_)) {
      others_.insert(others_.begin(), std::exchange(*first_, event));
    } else if (delivered_before(*first_, event)) {
      others_.insert(event);
    }
  }

  void erase(const Event& event) {
    if (!first_) return;
    if (is_first(event)) {
      move_up();
    } else {
      others_.erase(event);
    }
  }

  template <class Predicate>
  void erase_if(Predicate predicate) {
    std::erase_if(others_, predicate);
    if (first_ && predicate(std::as_const(*first_))) move_up();
  }

  /// Removes and returns the first event. Precondition: !empty().
  Event take_first() {
    assert(!empty());
    const Event event = *first_;
    move_up();
    return event;
  }

  template <class Predicate>
  bool all_of(Predicate predicate) const {
    return (!first_ || predicate(*first_)) && std::all_of(others_.begin(), others_.end(), predicate);
  }
  template <class Visit>
  void for_each(Visit visit) const {
    all_of([&](const Event& event) {
      visit(event);
      return true;
    });
  }
  template <class Predicate>
  bool none_of(Predicate predicate) const {
    return all_of([&](const Event& event) { return !predicate(event); });
  }

  static void serialize(auto& self, auto& archive) {
    auto& [earliest, later] = self;
    archive(earliest, later);
  }
  /// Validates a set that was read from bytes.
  bool is_valid() const { return others_.empty() || (first_ && delivered_before(*first_, *others_.begin())); }

 private:
  bool is_first(const Event& event) const {
    return !delivered_before(event, *first_) && !delivered_before(*first_, event);
  }
  void move_up() {
    if (others_.empty()) {
      first_.reset();
    } else {
      first_ = others_.extract(others_.begin()).value();
    }
  }

  std::optional<Event> first_;
  std::set<Event, DeliveredBefore> others_;  ///< all but the first
};

}  // namespace kinesphere
