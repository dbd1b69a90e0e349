// What is certain of bodies at an instant: until when their capsules hold them, and how long nothing changes
// between two of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "broadphase/certificate_queue.hpp"
#include "broadphase/neighbour_search.hpp"
#include "contact/contact_predictor.hpp"
#include "engine/speculation_log.hpp"
#include "engine/world_state.hpp"

namespace kinesphere {

/// The hot pairs that searches have found, and what they have cost. One for each thread.
struct alignas(128) SearchResults {
  std::vector<PairCertificate> certificates;
  NeighbourSearch search;
  std::uint64_t searches = 0;
  std::uint64_t candidates = 0;
  std::uint64_t near = 0;       ///< of them, those that may meet before a window ends
  std::uint64_t certified = 0;  ///< that have become hot

  void clear() {
    certificates.clear();
    searches = candidates = near = certified = 0;
  }
  /// Nothing is left here then.
  void hand_over(CertificateQueue& queue, Counters& counters) {
    counters.searches += searches;
    counters.candidates += candidates;
    counters.hot_pairs += certified;
    queue.add_all(certificates);
    clear();
  }
};

/// A body that can move: its bound, until when its capsule holds it and, where space repeats, the middle of
/// its way.
struct BoundRef {
  std::uint32_t number;
  const Bound* bound;
  double end;
  const Vec3* middle;
};

/// As Facts::apart_until(), of two that may meet and of which one has a window that ends. The same, to the
/// last bit, in whichever order they are given.
double apart_until(const Bodies& bodies, const BoundRef& a, const BoundRef& b, double now);

/// Reads the tables and, of an island beside others, the capsules that its bodies have got in this part, and
/// the bodies of other islands as they were when it began.
class PairCertifier {
 public:
  PairCertifier(const WorldState& tables, double time, const SpeculationLog* log)
      : state_(tables), time_(time), log_(log) {}

  /// The body stays in its capsule until then.
  double window_end_of(std::uint32_t number) const {
    const SweptSphereUpdate* update = log_ ? log_->last_update(number) : nullptr;
    return update != nullptr ? update->window.end : state_.broad_phase.end_of(number);
  }
  /// Both do.
  double earliest_window_end(std::uint32_t a, std::uint32_t b) const {
    return std::min(window_end_of(a), window_end_of(b));
  }
  /// The window that the body is in, if it is in any.
  std::optional<Window> window_of(std::uint32_t number) const;

  bool is_stale(const PairCertificate& pair) const {
    return revision_of(pair.first) != pair.first_revision ||
           (pair.has_second() && revision_of(pair.second) != pair.second_revision);
  }
  /// Calls visit(pair) for those of the agenda that hold.
  template <class Visit>
  void for_each_certificate(const CertificateQueue& queue, Visit visit) const {
    queue.for_each([&](const PairCertificate& pair) {
      if (!is_stale(pair)) visit(pair);
    });
  }
  /// Two bodies, or a body and PairCertificate::walls or PairCertificate::window_end, to be looked at then.
  PairCertificate certificate(double time, std::uint32_t a, std::uint32_t b) const;

  /// Whether the two touch or sense each other.
  bool are_linked(std::uint32_t a, std::uint32_t b) const {
    return contacts().touch(a, b) || !contacts().overlaps_of(a, b).empty();
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
  double certify(std::uint32_t a, std::uint32_t b, SearchResults& found) const;
  /// With those that it touches or senses.
  void certify_linked(std::uint32_t number, SearchResults& found) const;
  /// With the walls, which it may reach or leave before its window ends.
  void certify_walls(std::uint32_t number, SearchResults& found) const;

 private:
  const Bodies& bodies() const { return state_.bodies; }
  const ContactGraph& contacts() const { return state_.contacts; }
  /// A body of another island that may be changing it now; null for all others.
  const BodyCheckpoint* checkpoint_of(std::uint32_t number) const {
    return log_ ? log_->checkpoint_of(number) : nullptr;
  }
  BoundRef bound_ref(std::uint32_t number) const {
    const bool repeats = bodies().space().repeats();
    if (const BodyCheckpoint* const checkpoint = checkpoint_of(number))
      return {number, &checkpoint->body.body.bound, window_end_of(number),
              repeats ? &checkpoint->body.image.middle : nullptr};
    return {number, &bodies()[number].bound, window_end_of(number),
            repeats ? &bodies().images[number].middle : nullptr};
  }
  std::uint32_t revision_of(std::uint32_t number) const {
    const BodyCheckpoint* const checkpoint = checkpoint_of(number);
    return checkpoint != nullptr ? checkpoint->body.body.revision : bodies()[number].revision;
  }

  const WorldState& state_;
  double time_;
  const SpeculationLog* log_;  ///< null for an island with all bodies
};

template <class Visit>
void PairCertifier::for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const {
  if (bodies()[a].solid && bodies()[b].solid) visit(Threshold{.within = contacts().touch(a, b)});
  if (!bodies().sensors.any()) return;
  const OverlapRecords::List crossed = contacts().overlaps_of(a, b);
  if (const auto next =
          bodies().sensors.next_inward(sensing_of(bodies(), a), sensing_of(bodies(), b), crossed))
    visit(Threshold{false, *next, true});
  if (!crossed.empty()) visit(Threshold{true, crossed.back().distance, true});
}

}  // namespace kinesphere
