// PreparedStart does the work of a window start in slices, within the windows before it, so that no instant
// has all of it.
//
// Most windows end together, at end(). The bodies in them get their next windows earlier than that, all at
// one instant, entry_time(). Until then their next swept spheres are made, for one part of the bodies after
// the other; these hold from entry_time() until the next windows end. Then their cells are chosen, and they
// are sorted into grid levels, which at entry_time() replace those of the present windows
// (BroadPhase::take_over). From then on they are searched, one part after the other, and pairs are certified
// from end() on. When a pair is certified depends on the slots of swept spheres, so these must not depend on
// the number of threads.
//
// A bound holds at all later times. So a swept sphere and a certificate that were made from an earlier bound
// are right until a discontinuity of their bodies. A body that changes before entry_time() gets another swept
// sphere in its present window at once (EventProcessor::recertify), and another next one with the next slice
// or, after the last of these, at entry_time(). A body that changes later enters its next window at once,
// and is certified with all others until that ends: slices pass it over. A certificate also presumes what two
// bodies are to each other. So those that touch or sense each other, or walls, are certified at end().
//
// Invariant from entry_time() to end(), of any two bodies in windows that last beyond end(), one of which
// starts:
// - one has changed since entry_time(), and was then certified with the other, or
// - BroadPhase::pair_awaits_search(): they are certified until end(), and
//   - a slice has certified them from end() on, or a later one will, or
//   - the two touched or sensed each other when a slice found them, and are in the list linked_.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "processor/window_start.hpp"

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

  /// Time of the next slice of work, at most end(); +infinity if all are done.
  double next_slice() const;
  /// Does the slice that is due. Errors: those of a probe; the slice then stays due.
  Result<void> prepare_slice(const Work& work);
  bool is_done() const { return slice_ > last_slice(); }

  /// True if the deserialized state is consistent with that of the world.
  bool is_valid(const WorldState& state) const;
  static void serialize(auto& self, auto& archive) {
    auto& [present, begin, slices, slice, numbers, has_begun, near, policy, next, linked, at_walls] = self;
    archive(present, begin, slices, slice, numbers, has_begun, near, policy, next, linked, at_walls);
  }

 private:
  /// Time at which the present windows end and the next ones begin.
  double end() const { return present_.end; }
  double entry_time() const;
  double time_of(std::size_t slice) const;
  // Slices in their order: parts of the bodies, the survey, the choice of cells, the sort, the entry, parts
  // of the sorted slots, the end.
  std::size_t survey_slice() const { return slices_; }
  std::size_t cells_slice() const { return slices_ + 1; }
  std::size_t sort_slice() const { return slices_ + 2; }
  std::size_t entry_slice() const { return slices_ + 3; }
  std::size_t last_slice() const { return 2 * slices_ + 4; }
  bool have_entered() const { return slice_ > entry_slice(); }
  /// Returns the number of the first body of a slice.
  std::uint32_t begun(std::size_t slice) const {
    return static_cast<std::uint32_t>(numbers_ * slice / slices_);
  }
  static bool is_dirty(const Work& work, std::uint32_t number);
  static bool awaits_search(const Work& work, std::uint32_t number);
  static bool pair_awaits_search(const Work& work, std::uint32_t a, std::uint32_t b);
  std::vector<int> lasting_rungs(const Work& work) const;
  bool starts(const Work& work, std::uint32_t number) const;
  void begin(const Work& work);
  Result<void> add_slice(const Work& work);
  void add(const Work& work, std::vector<std::uint32_t> numbers, WindowPolicy::Sample& sample);
  void update(const Work& work);
  void survey(const Work& work);
  void enter_changed(const Work& work);
  void enter_windows(const Work& work);
  std::vector<std::uint32_t> awaiting_part(const Work& work, std::size_t part) const;
  void find_walls(const Work& work, std::span<const std::uint32_t> starters);
  void search_slice(const Work& work);
  void search_sorted(const Work& work, std::size_t part);
  void search_alone(const Work& work, std::span<const std::uint32_t> starters);
  void finish(const Work& work);

  Window present_;
  double begin_ = 0.0;         ///< time of the first slice
  std::size_t slices_ = 1;     ///< parts of the bodies, and of the sorted slots
  std::size_t slice_ = 0;      ///< index of the next slice
  std::uint32_t numbers_ = 0;  ///< numbers below this are those of bodies in the slices
  bool has_begun_ = false;
  std::uint64_t near_ = 0;  ///< near pairs found
  WindowPolicy policy_;     ///< of the next windows, until these are entered
  /// The next swept spheres; once these have entered, a copy of the grid levels that are searched.
  BroadPhase next_;
  // Found in touch or sensing each other, or at walls; certified at end().
  std::vector<PairCertificate> linked_;
  std::vector<std::uint32_t> at_walls_;
};

}  // namespace kinesphere
