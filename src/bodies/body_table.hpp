// BodyTable assigns numbers to bodies. Freed numbers are reused, last freed first, with another generation,
// so that an id denotes one body forever.
//
// In a world that is distributed over several processes, each process numbers the bodies that it knows in
// order of arrival. There a body also has a name, equal in all processes, which is the index of its id. Names
// define the order of bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bodies/body.hpp"
#include "kinesphere/body_id.hpp"

namespace kinesphere {

class BodyTable {
 public:
  BodyTable();

  Body& operator[](std::uint32_t number) { return bodies_[number]; }
  const Body& operator[](std::uint32_t number) const { return bodies_[number]; }
  auto begin() const { return bodies_.begin(); }
  auto end() const { return bodies_.end(); }
  /// Returns a bound on all numbers: each is smaller.
  std::uint32_t numbers() const { return static_cast<std::uint32_t>(bodies_.size()); }
  /// Returns the number of live bodies.
  std::size_t live_count() const { return live_count_; }
  /// Returns the number of bodies that are live and enabled. Cost: O(n).
  std::size_t present_count() const;

  void reserve(std::size_t bodies) { bodies_.reserve(bodies); }
  /// Creates a live body with default fields. Returns its number.
  std::uint32_t take();
  /// Creates a live body with a name, as take() does. Precondition: all bodies of the table have names.
  std::uint32_t take(std::uint32_t name);
  void give_back(std::uint32_t number);

  /// Returns BodyId::world of all ids, if bodies have no names: a nonzero number assigned at construction, or
  /// 0 after reading a snapshot.
  std::uint32_t tag() const { return tag_; }
  /// Returns the id of a body. If bodies have names, BodyId::world is the number.
  BodyId id_of(std::uint32_t number) const {
    if (names_.empty()) return {number, bodies_[number].generation, tag_};
    return {names_[number], 0, number};
  }
  /// Returns the number of a body that is or was in the table.
  std::uint32_t number_of(BodyId id) const { return names_.empty() ? id.index : id.world; }
  /// Returns the id with this table's tag, as id_of() does; for ids that may come from a snapshot.
  BodyId tagged(BodyId id) const { return names_.empty() ? BodyId{id.index, id.generation, tag_} : id; }
  /// Returns names by number; empty if numbers serve as names.
  const std::vector<std::uint32_t>& names() const { return names_; }
  std::uint32_t name_of(std::uint32_t number) const { return names_.empty() ? number : names_[number]; }
  /// Compares two bodies in the order of their names.
  bool comes_before(std::uint32_t a, std::uint32_t b) const { return name_of(a) < name_of(b); }
  /// Returns the id that a body will get after `additions_before` other additions.
  BodyId next_id(std::size_t additions_before = 0) const;
  bool is_alive(BodyId id) const {
    return id.index < numbers() && bodies_[id.index].alive && bodies_[id.index].generation == id.generation;
  }
  bool was_given_out(BodyId id) const;

  /// Returns true if each number is either free or belongs to a live body. Call after reading.
  bool is_valid() const;

 private:
  friend class Bodies;  // Bodies::serialize() archives the fields

  std::vector<Body> bodies_;
  std::size_t live_count_ = 0;
  std::vector<std::uint32_t> free_;
  std::uint32_t tag_;
  std::vector<std::uint32_t> names_;  ///< by number; empty if numbers serve as names
};

}  // namespace kinesphere
