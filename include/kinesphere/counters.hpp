// What a world has done so far: the figures behind every summary.
#pragma once

#include <array>
#include <cstdint>

#include "kinesphere/event.hpp"

namespace kinesphere {

struct Counters {
  /// Events delivered, by EventKind.
  std::array<std::uint64_t, event_kind_count> events{};
  /// States asked for, one per body and call.
  std::uint64_t probes = 0;
  /// Scheduled times that came due, and those of them that found nothing left to do.
  std::uint64_t wakes = 0;
  std::uint64_t stale_wakes = 0;
  /// Why a body woke: its box ran out, a certificate of a pair did, a wall came within reach.
  std::uint64_t box_ends = 0;
  std::uint64_t pair_checks = 0;
  std::uint64_t wall_checks = 0;
  /// Searches of the grid, and candidate pairs they gave.
  std::uint64_t searches = 0;
  std::uint64_t candidates = 0;
  /// Certificates of pairs that were computed.
  std::uint64_t certificates = 0;
  /// Looks at a contact that the Zeno guard put off to the smallest step.
  std::uint64_t zeno_steps = 0;
  /// Contacts that came within the Zeno interval of an earlier one of the same body.
  std::uint64_t repeated_contacts = 0;

  std::uint64_t count(EventKind kind) const { return events[static_cast<std::size_t>(kind)]; }
};

}  // namespace kinesphere
