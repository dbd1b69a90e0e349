// DirtyList lists the bodies that must be recertified before time advances.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "bodies/bodies.hpp"

namespace kinesphere {

/// Sorts numbers in ascending order, and removes those that repeat. Most have been in order before.
inline void make_ascending(std::vector<std::uint32_t>& numbers) {
  if (std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal()) == numbers.end()) return;
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Contains all dirty bodies in the order in which they became dirty, and possibly some that are no longer
/// dirty.
class DirtyList {
 public:
  void reserve(std::size_t bodies) { numbers_.reserve(bodies); }
  bool empty() const { return numbers_.empty(); }
  const std::vector<std::uint32_t>& numbers() const { return numbers_; }
  /// Returns true if the body is dirty. Cost: its record is not accessed while the list is empty.
  bool lists(const Bodies& bodies, std::uint32_t number) const {
    return !numbers_.empty() && bodies[number].dirty;
  }
  /// `turns`: its velocity changes from now on, and nothing else (Body::turned).
  void add(Bodies& bodies, std::uint32_t number, bool turns = false) {
    Body& body = bodies[number];
    const bool turns_alone = turns && (body.turned || !body.dirty);
    if (!turns_alone && (!body.dirty || body.turned)) moved_.push_back(number);
    if (!body.dirty) numbers_.push_back(number);
    body.dirty = true;
    body.turned = turns_alone;
  }
  /// Makes room for so many bodies at once. Returns the place of the first. put_turned() has to follow for
  /// each.
  std::size_t extend(std::size_t more) {
    numbers_.resize(numbers_.size() + more);
    return numbers_.size() - more;
  }
  /// Lists a clean body as add() does, of which the velocity changes alone. Threads may call it for different
  /// bodies and places.
  void put_turned(Body& body, std::uint32_t number, std::size_t place) {
    numbers_[place] = number;
    body.dirty = body.turned = true;
  }
  /// A body need not be recertified any more.
  void forget(Body& body) {
    body.mark_recertified();
    may_list_clean_ = true;
  }
  /// Returns all bodies of which more than the velocity has changed, so that they may be elsewhere than the
  /// core knows, and possibly some that are clean.
  std::span<const std::uint32_t> moved() const { return moved_; }
  /// Returns true if more than the velocity of the body has changed: it is in `moved()`.
  static bool may_have_moved(const Body& body) { return body.dirty && !body.turned; }
  /// Sorts the list in ascending order and removes duplicates and bodies that are not dirty. Returns the
  /// list. Cost: O(n log n).
  const std::vector<std::uint32_t>& sort(const Bodies& bodies) {
    make_ascending(numbers_);
    if (may_list_clean_) std::erase_if(numbers_, [&](std::uint32_t number) { return !bodies[number].dirty; });
    return numbers_;
  }
  void clear() {
    numbers_.clear();
    moved_.clear();
    may_list_clean_ = false;
  }

  template <class Self>
  static void serialize(Self& self, auto& archive) {
    archive(self.numbers_);
    if constexpr (!std::is_const_v<Self>) {
      self.moved_ = self.numbers_;
      self.may_list_clean_ = true;
    }
  }

 private:
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> moved_;
  bool may_list_clean_ = false;
};

}  // namespace kinesphere
