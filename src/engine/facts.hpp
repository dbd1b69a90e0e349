// What is certain of bodies at an instant: until when their capsules hold them, and how long nothing changes
// between two of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "contact/outlook.hpp"
#include "engine/beside.hpp"
#include "engine/tables.hpp"
#include "window/agenda.hpp"
#include "window/neighbour_search.hpp"

namespace kinesphere {

/// The hot pairs that searches have found, and what they have cost. One for each thread.
struct alignas(128) FoundPairs {
  std::vector<HotPair> hot;
  NeighbourSearch search;
  std::uint64_t searches = 0;
  std::uint64_t candidates = 0;
  std::uint64_t near = 0;   ///< of them, those that may meet before a window ends
  std::uint64_t pairs = 0;  ///< that have become hot

  void forget() {
    hot.clear();
    searches = candidates = near = pairs = 0;
  }
  /// Nothing is left here then.
  void hand_over(Agenda& agenda, Counters& counters) {
    counters.searches += searches;
    counters.candidates += candidates;
    counters.hot_pairs += pairs;
    agenda.add_all(hot);
    forget();
  }
};

/// A body that can move: its bound, until when its capsule holds it and, where space repeats, the middle of
/// its way.
struct Known {
  std::uint32_t number;
  const Bound* bound;
  double end;
  const Vec3* middle;
};

/// As Facts::apart_until(), of two that may meet and of which one has a window that ends. The same, to the
/// last bit, in whichever order they are given.
double apart_until(const Bodies& bodies, const Known& a, const Known& b, double now);

/// Reads the tables and, of an island beside others, the capsules that its bodies have got in this part, and
/// the bodies of other islands as they were when it began.
class Facts {
 public:
  Facts(const Tables& tables, double time, const Beside* beside)
      : tables_(tables), time_(time), beside_(beside) {}

  /// The body stays in its capsule until then.
  double end_of(std::uint32_t number) const {
    const BodyKick* kick = beside_ ? beside_->last_kick(number) : nullptr;
    return kick != nullptr ? kick->window.end : tables_.windows.end_of(number);
  }
  /// Both do.
  double windows_end(std::uint32_t a, std::uint32_t b) const { return std::min(end_of(a), end_of(b)); }
  /// The window that the body is in, if it is in any.
  std::optional<Window> window_of(std::uint32_t number) const;

  bool is_void(const HotPair& pair) const {
    return stamp_of(pair.first) != pair.first_stamp ||
           (pair.has_second() && stamp_of(pair.second) != pair.second_stamp);
  }
  /// Calls visit(pair) for those of the agenda that hold.
  template <class Visit>
  void for_each_hot_pair(const Agenda& agenda, Visit visit) const {
    agenda.for_each([&](const HotPair& pair) {
      if (!is_void(pair)) visit(pair);
    });
  }
  /// Two bodies, or a body and HotPair::walls or HotPair::renewal, to be looked at then.
  HotPair hot_pair(double time, std::uint32_t a, std::uint32_t b) const;

  /// Whether the two touch or sense each other.
  bool are_linked(std::uint32_t a, std::uint32_t b) const {
    return book().touch(a, b) || !book().crossings_of(a, b).empty();
  }
  /// Calls visit(threshold) for what comes next between two bodies that may meet: their contact, the next
  /// sensor distance inward, and the next one outward.
  template <class Visit>
  void for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const;
  /// Two that neither touch nor sense each other do not before this time, or not before a window ends
  /// (+infinity); now, if that takes fresh reports.
  double apart_until(std::uint32_t a, std::uint32_t b) const;
  /// The same by the rules of contacts, for any pair; +infinity for ever.
  double unchanged_until_by_thresholds(std::uint32_t a, std::uint32_t b) const;
  /// The same of a body and its walls, in a world that has any.
  double walls_unchanged_until(std::uint32_t number) const;

  // The hot pairs of a body that has got a capsule.
  /// With one whom a search has found to be near, if they may meet before a window ends: when they may, or
  /// +infinity. Of two that touch or sense each other, find_known_pairs() takes care.
  double find_hot_pair(std::uint32_t a, std::uint32_t b, FoundPairs& found) const;
  /// With those that it touches or senses.
  void find_known_pairs(std::uint32_t number, FoundPairs& found) const;
  /// With the walls, which it may reach or leave before its window ends.
  void find_walls(std::uint32_t number, FoundPairs& found) const;

 private:
  const Bodies& bodies() const { return tables_.bodies; }
  const ContactBook& book() const { return tables_.book; }
  /// A body of another island that may be changing it now; null for all others.
  const Kept* as_it_began(std::uint32_t number) const {
    return beside_ ? beside_->as_it_began(number) : nullptr;
  }
  Known known(std::uint32_t number) const {
    const bool repeats = bodies().space().repeats();
    if (const Kept* const kept = as_it_began(number))
      return {number, &kept->body.body.bound, end_of(number), repeats ? &kept->body.home.middle : nullptr};
    return {number, &bodies()[number].bound, end_of(number),
            repeats ? &bodies().homes[number].middle : nullptr};
  }
  std::uint32_t stamp_of(std::uint32_t number) const {
    const Kept* const kept = as_it_began(number);
    return kept != nullptr ? kept->body.body.stamp : bodies()[number].stamp;
  }

  const Tables& tables_;
  double time_;
  const Beside* beside_;  ///< null for an island with all bodies
};

template <class Visit>
void Facts::for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const {
  if (bodies()[a].solid && bodies()[b].solid) visit(Threshold{.within = book().touch(a, b)});
  if (!bodies().sensors.any()) return;
  const Crossings::List crossed = book().crossings_of(a, b);
  if (const auto next =
          bodies().sensors.next_inward(sensing_of(bodies(), a), sensing_of(bodies(), b), crossed))
    visit(Threshold{false, *next, true});
  if (!crossed.empty()) visit(Threshold{true, crossed.back().distance, true});
}

}  // namespace kinesphere
