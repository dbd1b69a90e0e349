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
  /// Times at which windows ended, and bodies whose windows did: for each of them a new one started.
  std::uint64_t window_ends = 0;
  std::uint64_t starts = 0;
  /// Bodies about which nothing was known any more within their windows: new ones, kicked or changed ones,
  /// those that broke a promise.
  std::uint64_t restarts = 0;
  /// Certified times that came due: of a pair, of a body and the walls.
  std::uint64_t pair_checks = 0;
  std::uint64_t wall_checks = 0;
  /// Searches for all who may come near a body before a window ends, and how many they found; those of them
  /// that may change before it does.
  std::uint64_t searches = 0;
  std::uint64_t candidates = 0;
  std::uint64_t hot_pairs = 0;
  /// Certificates of pairs that were computed.
  std::uint64_t certificates = 0;
  /// Looks at a contact that the Zeno guard put off to the smallest step.
  std::uint64_t zeno_steps = 0;
  /// Contacts that came within the Zeno interval of an earlier one of the same body.
  std::uint64_t repeated_contacts = 0;

  Counters& operator+=(const Counters& more) {
    for (std::size_t kind = 0; kind < events.size(); ++kind) events[kind] += more.events[kind];
    probes += more.probes;
    window_ends += more.window_ends;
    starts += more.starts;
    restarts += more.restarts;
    pair_checks += more.pair_checks;
    wall_checks += more.wall_checks;
    searches += more.searches;
    candidates += more.candidates;
    hot_pairs += more.hot_pairs;
    certificates += more.certificates;
    zeno_steps += more.zeno_steps;
    repeated_contacts += more.repeated_contacts;
    return *this;
  }
  /// How often the world had to do something about a body, a pair or a body and the walls.
  std::uint64_t steps() const { return starts + restarts + pair_checks + wall_checks; }
  std::uint64_t count(EventKind kind) const { return events[static_cast<std::size_t>(kind)]; }
};

}  // namespace kinesphere
