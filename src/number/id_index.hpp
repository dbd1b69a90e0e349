// A hash table from ids to small numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace kinesphere {

/// Numbers by 64-bit ids, with open addressing and linear probing: a lookup reads one cache line as a rule,
/// where std::unordered_map reads three. Cost of each call: O(1) expected.
class IdIndex {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::size_t size() const { return size_; }
  /// Returns the number of an id; `none` if it has none.
  std::uint32_t find(std::uint64_t id) const { return slots_.empty() ? none : slots_[slot_of(id)].number; }
  /// Gives an id a number. Returns false, and changes nothing, if it has one. Precondition: number != none.
  bool add(std::uint64_t id, std::uint32_t number) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[slot_of(id)];
    if (slot.number != none) return false;
    slot = {id, number};
    ++size_;
    return true;
  }
  /// Takes the number of an id away. Precondition: it has one.
  void remove(std::uint64_t id) {
    // Moves the ids behind it forward that would no longer be found across the free slot.
    std::size_t free = slot_of(id);
    for (std::size_t at = next(free); slots_[at].number != none; at = next(at)) {
      const std::size_t first = first_slot_of(slots_[at].id);
      if (distance(first, at) >= distance(free, at)) slots_[std::exchange(free, at)] = slots_[at];
    }
    slots_[free] = {};
    --size_;
  }
  void clear() { *this = {}; }

 private:
  struct Slot {
    std::uint64_t id = 0;
    std::uint32_t number = none;
  };

  std::size_t next(std::size_t at) const { return (at + 1) & (slots_.size() - 1); }
  std::size_t distance(std::size_t from, std::size_t to) const { return (to - from) & (slots_.size() - 1); }
  std::size_t first_slot_of(std::uint64_t id) const {
    // The mixing of splitmix64: ids may be alike in any of their bits.
    id = (id ^ (id >> 30)) * 0xbf58476d1ce4e5b9u;
    id = (id ^ (id >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>(id ^ (id >> 31)) & (slots_.size() - 1);
  }
  /// Returns the slot of an id, or the free one that it would get.
  std::size_t slot_of(std::uint64_t id) const {
    std::size_t at = first_slot_of(id);
    while (slots_[at].number != none && slots_[at].id != id) at = next(at);
    return at;
  }
  void grow() {
    constexpr std::size_t fewest = 16;
    const std::vector<Slot> before =
        std::exchange(slots_, std::vector<Slot>(std::max(fewest, 2 * slots_.size())));
    for (const Slot& slot : before)
      if (slot.number != none) slots_[slot_of(slot.id)] = slot;
  }

  std::vector<Slot> slots_;  ///< a power of two of them, at least half of them free
  std::size_t size_ = 0;
};

}  // namespace kinesphere
