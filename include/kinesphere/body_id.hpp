// Names of bodies.
//
//   std::unordered_map<BodyId, Drone> drones;        // ids hash, compare and sort
//   std::puts(to_string(event.first).c_str());       // "7", or "7 (generation 2)"
//   database.store(event.first.pack());              // 64 bits; BodyId::unpack() is the way back
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <limits>
#include <string>

namespace kinesphere {

/// Names a body for as long as it lives. When a body is removed its index may be used again, with
/// another generation, so an old id is recognised as stale and never mistaken for a newer body.
struct BodyId {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t generation = 0;
  /// The tag of the world that gave the id out, so that a call with an id of another world fails with
  /// foreign_body. 0: not said; every world takes such an id as one of its own. It takes no part in
  /// comparisons, hashes, pack() and recordings. Each world made by World::create() has a tag of its own, a
  /// clone that of its original. A restored world has 0: it takes all ids, and all worlds take those that it
  /// gives out, so that equal histories give equal snapshots.
  std::uint32_t world = 0;

  /// Index and generation in one number, for tables and files.
  constexpr std::uint64_t pack() const { return std::uint64_t{generation} << 32 | index; }
  /// The id that was packed, with world = 0.
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

/// The id that names no body: the second body of a wall event, for one.
inline constexpr BodyId no_body{};

/// "7", "7 (generation 2)" or, for no_body, "no_body".
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
