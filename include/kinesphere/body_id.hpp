// BodyId: the name of a body.
//
//   std::unordered_map<BodyId, Drone> drones;        // ids hash, compare and sort
//   std::puts(to_string(event.first).c_str());       // "7", or "7 (generation 2)"
//   database.store(event.first.pack());              // 64 bits; BodyId::unpack() is the inverse
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iosfwd>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

namespace kinesphere {

/// Names a body until it is removed. A later body may reuse the index of a removed one, with another
/// generation, so an old id is recognised as stale and never mistaken for a newer body.
struct BodyId {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t generation = 0;
  /// Tag of the world that issued the id; a call with an id of another world fails with foreign_body. 0
  /// means unspecified: every world accepts such an id as its own. Comparisons, hashes, pack() and
  /// recordings ignore the tag. Each world made by World::create() has its own tag, and a clone has that of
  /// its original. A restored world has tag 0: it accepts all ids, and all worlds accept the ids that it
  /// issues, so that equal histories give equal snapshots.
  std::uint32_t world = 0;

  /// Returns index and generation in one number, for tables and files.
  constexpr std::uint64_t pack() const { return std::uint64_t{generation} << 32 | index; }
  /// Returns the packed id, with world = 0.
  static constexpr BodyId unpack(std::uint64_t packed) {
    return {static_cast<std::uint32_t>(packed), static_cast<std::uint32_t>(packed >> 32)};
  }

  friend constexpr bool operator==(const BodyId& a, const BodyId& b) {
    return a.index == b.index && a.generation == b.generation;
  }
  friend constexpr std::strong_ordering operator<=>(const BodyId& a, const BodyId& b) {
    const std::strong_ordering by_index = a.index <=> b.index;
    return by_index != 0 ? by_index : a.generation <=> b.generation;
  }
};

/// The id that names no body, such as the second body of a wall event.
inline constexpr BodyId no_body{};

/// One body or several, as an argument of a call: an id, a list of ids in braces, or whatever std::span
/// takes. It refers to them, so it is valid within the call's expression.
class BodyIds : public std::span<const BodyId> {
 public:
  /// Refers to these bodies.
  BodyIds(const BodyId& body) : span(&body, 1) {}
  BodyIds(std::initializer_list<BodyId> bodies) : span(bodies.begin(), bodies.size()) {}
  template <class Bodies>
  requires std::is_constructible_v < std::span<const BodyId>,
  const Bodies& > BodyIds(const Bodies& bodies) : span(bodies) {}
};

/// Returns "7", "7 (generation 2)" or, for no_body, "no_body".
std::string to_string(const BodyId& body);

/// Prints to_string(). The caller includes <ostream>.
template <class Traits>
std::basic_ostream<char, Traits>& operator<<(std::basic_ostream<char, Traits>& out, const BodyId& body) {
  return out << to_string(body);
}

}  // namespace kinesphere

template <>
struct std::hash<kinesphere::BodyId> {
  std::size_t operator()(const kinesphere::BodyId& body) const noexcept {
    return std::hash<std::uint64_t>()(body.pack());
  }
};
