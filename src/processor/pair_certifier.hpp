// PairCertifier computes what is certain of bodies at an instant: until when swept spheres contain them, and
// how long the contact state of a pair cannot change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "broadphase/certificate_queue.hpp"
#include "broadphase/neighbour_search.hpp"
#include "contact/contact_predictor.hpp"
#include "processor/speculation_log.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

/// The certificates that searches have found, and the cost of these searches. Each thread uses its own.
struct alignas(128) SearchResults {
  std::vector<PairCertificate> certificates;
  NeighbourSearch search;
  std::uint64_t searches = 0;
  std::uint64_t candidates = 0;
  std::uint64_t near = 0;       ///< candidates that may meet before the earlier window end
  std::uint64_t certified = 0;  ///< certificates created for candidates
  bool keeps_linked = false;    ///< linked pairs that are near go to `linked`
  std::vector<PairCertificate> linked;

  void clear() {
    certificates.clear();
    searches = candidates = near = certified = 0;
  }
  /// Moves all results to the queue and the counters, and clears this object.
  void hand_over(CertificateQueue& queue, Counters& counters) {
    counters.searches += searches;
    counters.candidates += candidates;
    counters.hot_pairs += certified;
    queue.add_all(certificates);
    clear();
  }
};

/// A body that is not static: its bound, the end of its window and, in periodic space, the centre of its
/// path.
struct BoundRef {
  std::uint32_t number;
  const Bound* bound;
  double end;
  const Vec3* middle;
};

/// Computes PairCertifier::apart_until() for two bodies that may meet. Precondition: at least one window is
/// finite. The result is bit-identical for either order of arguments.
double apart_until(const Bodies& bodies, const BoundRef& a, const BoundRef& b, double now);

/// Reads the world state. For a cluster (`log` is not null) it also reads the swept spheres that its bodies
/// got in this batch, and the checkpoints of bodies in other clusters.
class PairCertifier {
 public:
  PairCertifier(const WorldState& state, double time, const SpeculationLog* log)
      : state_(state), windows_(state.broad_phase), time_(time), log_(log) {}
  /// Certifies from `time` on, which may be later than the present, for windows that start then.
  PairCertifier(const WorldState& state, double time, const BroadPhase& windows)
      : state_(state), windows_(windows), time_(time), log_(nullptr) {}

  /// Returns the time until which the body stays in its swept sphere.
  double window_end_of(std::uint32_t number) const {
    if (state_.core) return state_.core->balls()[number].own;
    const SweptSphereUpdate* update = log_ ? log_->last_update(number) : nullptr;
    return update != nullptr ? update->window.end : windows_.end_of(number);
  }
  /// Returns the time at which the two bodies are searched for each other again if nothing changes: the
  /// earliest end of their windows or, before that, BroadPhase::search_begin().
  double earliest_window_end(std::uint32_t a, std::uint32_t b) const {
    const double end = std::min(window_end_of(a), window_end_of(b));
    return time_ < windows_.search_begin() ? until_search(a, b, end) : end;
  }
  /// Returns the time at which the body is certified with the walls again if nothing changes.
  double walls_end_of(std::uint32_t number) const {
    const double end = window_end_of(number);
    return time_ < windows_.search_begin() ? until_search(number, number, end) : end;
  }
  /// Returns the window of the body, or nullopt if it has none.
  std::optional<Window> window_of(std::uint32_t number) const;

  bool is_stale(const PairCertificate& pair) const {
    return revision_of(pair.first) != pair.first_revision ||
           (pair.has_second() && revision_of(pair.second) != pair.second_revision);
  }
  /// Calls visit(pair) for each certificate in the queue that is not stale.
  template <class Visit>
  void for_each_certificate(const CertificateQueue& queue, Visit visit) const {
    queue.for_each([&](const PairCertificate& pair) {
      if (!is_stale(pair)) visit(pair);
    });
  }
  /// Creates a certificate that fails at `time`, for two bodies, or for a body and PairCertificate::walls or
  /// PairCertificate::window_end.
  PairCertificate certificate(double time, std::uint32_t a, std::uint32_t b) const;

  /// Returns true if the two touch or sense each other.
  bool are_linked(std::uint32_t a, std::uint32_t b) const {
    return contacts().touch(a, b) || contacts().overlap(a, b);
  }
  /// Calls visit(threshold) for each threshold that two bodies can cross next: their contact, the next sensor
  /// distance inward, and the next one outward. Precondition: the two may meet.
  template <class Visit>
  void for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const;
  /// Returns the time before which two unlinked bodies neither touch nor sense each other; +infinity if they
  /// do not before the earlier window end. Returns the current time if only fresh reports can decide.
  double apart_until(std::uint32_t a, std::uint32_t b) const;
  /// Returns true if apart_until() needs more of the two bodies than their bounds. If they are in different
  /// clusters, that is unknown of the other one.
  bool needs_thresholds(std::uint32_t a, std::uint32_t b) const;
  /// Returns true if the next event of two near bodies would be an approach, and they recede for good: a
  /// response has just parted them.
  bool bounce_apart(std::uint32_t a, std::uint32_t b) const;
  /// Returns the time before which no threshold of the two is crossed, by the contact rules; +infinity if
  /// never. Valid for linked and unlinked pairs.
  double unchanged_until_by_thresholds(std::uint32_t a, std::uint32_t b) const;
  /// Returns the time before which the body neither touches nor leaves a wall; the current time if it touches
  /// one. Precondition: the world has walls.
  double walls_unchanged_until(std::uint32_t number) const;

  // Certificates of a body that has got a new swept sphere.
  /// Certifies a pair found by a search and adds a certificate to `found` if the two may meet before the
  /// earlier window end. Returns the failure time, or +infinity if none was added. Linked pairs are left to
  /// certify_linked().
  double certify(std::uint32_t a, std::uint32_t b, SearchResults& found) const;
  /// Certifies the body with each body that it touches or senses.
  void certify_linked(std::uint32_t number, SearchResults& found) const;
  /// Certifies the body with the walls that it may reach or leave before its window ends. A body that touches
  /// a wall gets a certificate that fails at once.
  void certify_walls(std::uint32_t number, SearchResults& found) const;

 private:
  double until_search(std::uint32_t a, std::uint32_t b, double end) const;
  std::optional<double> apart_by_balls(BoundRef a, BoundRef b) const;
  double apart_until(const BoundRef& a, const BoundRef& b) const;
  const Bodies& bodies() const { return state_.bodies; }
  const ContactGraph& contacts() const { return state_.contacts; }
  /// Returns the checkpoint of a body that another cluster may be changing concurrently; nullptr for all
  /// other bodies.
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
  /// Returns bound_ref() for the processor with all bodies, which has no log to search.
  BoundRef bound_ref_without_log(std::uint32_t number) const {
    return {number, &bodies()[number].bound, window_end_of(number),
            bodies().space().repeats() ? &bodies().images[number].middle : nullptr};
  }
  std::uint32_t revision_of(std::uint32_t number) const {
    const BodyCheckpoint* const checkpoint = checkpoint_of(number);
    return checkpoint != nullptr ? checkpoint->body.body.revision : bodies()[number].revision;
  }

  const WorldState& state_;
  const BroadPhase& windows_;
  double time_;
  const SpeculationLog* log_;  ///< nullptr for the processor with all bodies
};

template <class Visit>
void PairCertifier::for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const {
  if (bodies()[a].solid && bodies()[b].solid)
    visit(contacts().contact_threshold(a, b, bodies().wanted_of(a, b)));
  if (!bodies().sensors.any()) return;
  const OverlapRecords::List crossed = contacts().overlaps_of(a, b);
  if (const auto next =
          bodies().sensors.next_inward(sensing_of(bodies(), a), sensing_of(bodies(), b), crossed))
    visit(Threshold{.within = false, .distance = *next, .sensed = true});
  if (!crossed.empty()) visit(Threshold{.within = true, .distance = crossed.back().distance, .sensed = true});
}

}  // namespace kinesphere
