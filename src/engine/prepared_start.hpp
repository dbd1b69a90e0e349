// PreparedStart does the work of a window start in slices, while the windows before it last, so that no
// instant has all of it.
//
// Most windows end together, at end(). What the broad phase will hold then is built beside the present one,
// which stays in force: the bodies in windows that last longer, as they are, and the others with their next
// swept spheres. These are made first, for one part of the bodies after the other; then they are sorted into
// grid levels; then each slot of these is searched for, one part of the slots after the other, and pairs are
// certified from end() on. At end() the next broad phase replaces the present one.
//
// A bound holds at all later times. So a swept sphere and a certificate that were made from an earlier bound
// are right until a discontinuity of their bodies. These get other ones in the present windows at once
// (EventProcessor::recertify), and here with the next slice. A certificate also presumes what two bodies are
// to each other. So those that touch or sense each other, or walls, are certified at end().
//
// Invariant between slices, once they are sorted, of any two bodies in the next broad phase one of which
// starts:
// - a search for one of them, since both were entered, has certified the pair from end() on, or
// - BroadPhase::will_find() tells that a later slice finds the pair, or
// - one has changed since the last slice, and is in the list BroadPhase::take_changes() or dirty, or
// - the two touched or sensed each other when they were found, and are in the list linked_.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/window_start.hpp"

namespace kinesphere {

class PreparedStart {
 public:
  /// What the slices work on.
  struct Work {
    WorldState& state;
    EventProcessor& main;
    PoolLease& lease;
    std::vector<SearchResults>& found;  ///< by worker, only to reuse its memory
  };

  /// Returns true if so many bodies start together that it pays to prepare their start.
  static constexpr bool pays(std::size_t bodies) { return bodies >= 16; }
  /// To be read from an archive.
  PreparedStart(const Space& space, const WindowPolicy& policy) : policy_(policy), next_(space) {}
  /// Prepares the start of about `bodies` bodies at the end of their window `present`, from `now` on.
  PreparedStart(const Space& space, const WindowPolicy& policy, const Window& present, double now,
                std::size_t bodies);

  /// Time at which the prepared windows start.
  double end() const { return present_.end; }
  /// Time of the next slice of work, before end(); +infinity if all are done.
  double next_slice() const;
  /// Does the slice that is due. Errors: those of a probe; the slice then stays due.
  Result<void> prepare_slice(const Work& work);

  // At end(), in this order. `numbers` are the bodies whose windows end.
  /// Brings the prepared windows up to date, while the present ones are still in force. Takes those of
  /// `numbers` out that have a prepared window, and returns them.
  std::vector<std::uint32_t> complete(const Work& work, std::vector<std::uint32_t>& numbers);
  /// Replaces the present windows. `started` is what complete() returned. Takes those of `numbers` out that
  /// join them. Precondition: `numbers` are not dirty.
  void take_over(const Work& work, std::vector<std::uint32_t> started, std::vector<std::uint32_t>& numbers);

  /// True if the deserialized state is consistent with that of the world.
  bool is_valid(const WorldState& state) const;
  static void serialize(auto& self, auto& archive) {
    auto& [present, begin, slices, slice, numbers, has_begun, searched, near, policy, next, waiting, linked,
           at_walls] = self;
    archive(present, begin, slices, slice, numbers, has_begun, searched, near, policy, next, waiting, linked,
            at_walls);
  }

 private:
  WindowStart start(const Work& work) {
    return {work.state, work.main, work.lease, work.found, next_, end()};
  }
  bool is_sorted() const { return slice_ > slices_; }
  /// Returns the number of the first body of a slice.
  std::uint32_t begun(std::size_t slice) const {
    return static_cast<std::uint32_t>(numbers_ * slice / slices_);
  }
  bool starts(const Work& work, std::uint32_t number) const;
  bool lasts(const Work& work, std::uint32_t number) const;
  void begin(const Work& work);
  Result<void> do_slice(const Work& work);
  Result<void> add(const Work& work, std::vector<std::uint32_t> numbers);
  void add_again(const Work& work, std::vector<std::uint32_t> numbers);
  void update(const Work& work);
  void enter(const Work& work, std::span<const std::uint32_t> numbers);
  void search(const Work& work, std::span<const std::uint32_t> entered);
  void search_slots(const Work& work, std::size_t last);
  void find_walls(const Work& work, std::span<const std::uint32_t> numbers);
  void hand_over(const Work& work);

  Window present_;
  double begin_ = 0.0;         ///< time of the first slice
  std::size_t slices_ = 1;     ///< parts of the bodies, and of the sorted slots
  std::size_t slice_ = 0;      ///< the next one: parts of the bodies, the sort, parts of the slots
  std::uint32_t numbers_ = 0;  ///< numbers below this are those of bodies in the slices
  bool has_begun_ = false;
  std::size_t searched_ = 0;  ///< started slots below this are searched for (BroadPhase::started_slots())
  std::uint64_t near_ = 0;    ///< near pairs found
  WindowPolicy policy_;       ///< of the prepared windows
  BroadPhase next_;
  std::vector<std::uint32_t> waiting_;  ///< bodies in lasting windows that changed before the sort
  // Found in touch or sensing each other, or at walls; certified at end().
  std::vector<PairCertificate> linked_;
  std::vector<std::uint32_t> at_walls_;
};

}  // namespace kinesphere
