// The table of bodies: each has a number; numbers that were given back are taken again, last come first, by
// another generation, so that an id stands for one body for ever.
//
// Where a world is spread over several processes, each of them numbers the bodies that it knows as they come,
// and a body has a name beside, the same everywhere, which is the index of its id. What comes first is
// decided by names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/body.hpp"
#include "kinesphere/body_id.hpp"

namespace kinesphere {

class BodyTable {
 public:
  BodyTable();

  Body& operator[](std::uint32_t number) { return bodies_[number]; }
  const Body& operator[](std::uint32_t number) const { return bodies_[number]; }
  auto begin() const { return bodies_.begin(); }
  auto end() const { return bodies_.end(); }
  /// All numbers are smaller than this.
  std::uint32_t numbers() const { return static_cast<std::uint32_t>(bodies_.size()); }
  /// That live.
  std::size_t live_count() const { return live_count_; }
  /// That live and are enabled. Cost: O(n).
  std::size_t present_count() const;

  void reserve(std::size_t bodies) { bodies_.reserve(bodies); }
  /// The number of a body that lives and has nothing else yet.
  std::uint32_t take();
  /// The same in a table where all bodies have names.
  std::uint32_t take(std::uint32_t name);
  void give_back(std::uint32_t number);

  /// The sum of what all worlds of this program that were made before count: of BodyId::world.
  std::uint32_t tag() const { return tag_; }
  /// Of a body with a name, the number is in BodyId::world.
  BodyId id_of(std::uint32_t number) const {
    if (names_.empty()) return {number, bodies_[number].generation, tag_};
    return {names_[number], 0, number};
  }
  /// Of a body that is or was in the table.
  std::uint32_t number_of(BodyId id) const { return names_.empty() ? id.index : id.world; }
  /// As id_of() has it, of an id that a snapshot may have held.
  BodyId tagged(BodyId id) const { return names_.empty() ? BodyId{id.index, id.generation, tag_} : id; }
  /// By number; empty where numbers are names.
  const std::vector<std::uint32_t>& names() const { return names_; }
  bool have_names() const { return !names_.empty(); }
  std::uint32_t name_of(std::uint32_t number) const { return names_.empty() ? number : names_[number]; }
  /// The order of the bodies.
  bool comes_before(std::uint32_t a, std::uint32_t b) const { return name_of(a) < name_of(b); }
  /// The ids that the next bodies added will have, in their order.
  BodyId next_id(std::size_t additions_before = 0) const;
  bool is_alive(BodyId id) const {
    return id.index < numbers() && bodies_[id.index].alive && bodies_[id.index].generation == id.generation;
  }
  bool was_given_out(BodyId id) const;

  /// Of one that was read: each number is free or that of a body that lives.
  bool is_valid() const;

 private:
  friend class Bodies;  // its serialize() archives the fields

  std::vector<Body> bodies_;
  std::size_t live_count_ = 0;
  std::vector<std::uint32_t> free_;
  std::uint32_t tag_;
  std::vector<std::uint32_t> names_;  ///< by number; empty where numbers are names
};

}  // namespace kinesphere
