// Counters of the work that a world has done so far.
#pragma once

#include <array>
#include <cstdint>

#include "kinesphere/event.hpp"

namespace kinesphere {

/// Counts of the work that a world has done since it was created. World::counters() returns them.
struct Counters {
  /// Events delivered, by EventKind.
  std::array<std::uint64_t, event_kind_count> events{};
  /// Probed states, one per body and call.
  std::uint64_t probes = 0;
  /// starts: bodies that got another safe region, since they might have left theirs. window_ends: always 0.
  std::uint64_t window_ends = 0;
  std::uint64_t starts = 0;
  /// Bodies whose certificates became invalid: bodies that were added, changed, given a new velocity, or that
  /// violated their motion limits.
  std::uint64_t restarts = 0;
  /// Certificates that reached their failure time: of pairs, and of bodies and the walls.
  std::uint64_t pair_checks = 0;
  std::uint64_t wall_checks = 0;
  /// searches: searches for the bodies that may come near a body while it is in its safe region. candidates:
  /// bodies found by them. hot_pairs: pairs whose certificate was found to fail while the body is there.
  std::uint64_t searches = 0;
  std::uint64_t candidates = 0;
  std::uint64_t hot_pairs = 0;
  /// Pair certificates that were computed.
  std::uint64_t certificates = 0;
  /// Rechecks of a contact that the Zeno guard delayed to its least step.
  std::uint64_t zeno_steps = 0;
  /// Contacts with Event::repeated: hops of bodies that rest or roll.
  std::uint64_t repeated_contacts = 0;
  /// Contacts with Event::jammed. bounce() and settle() part their bodies without speed, whatever the
  /// restitution, so energy is lost. In a gas or a crystal of elastic bodies it should be 0: otherwise gaps
  /// are within the contact tolerance, which should be smaller.
  std::uint64_t jammed_contacts = 0;

  /// Adds each count.
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
    jammed_contacts += more.jammed_contacts;
    return *this;
  }
  /// Returns the number of starts, restarts, pair checks and wall checks.
  std::uint64_t steps() const { return starts + restarts + pair_checks + wall_checks; }
  /// Returns the number of delivered events of one kind.
  std::uint64_t count(EventKind kind) const { return events[static_cast<std::size_t>(kind)]; }

  friend constexpr bool operator==(const Counters&, const Counters&) = default;
};

}  // namespace kinesphere
