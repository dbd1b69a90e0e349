// The broad phase: registers each body, with a swept sphere, in one window of time until that window ends.
// The window suits the body's speed; bodies that stand still get the window that never ends. Bodies with one
// window and about one size share a grid level.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "broadphase/grid_level.hpp"
#include "number/infinity.hpp"
#include "space/space.hpp"

namespace kinesphere {

class BroadPhase {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

 public:
  explicit BroadPhase(const Space& space) : space_(space) {}

  void reserve(std::size_t bodies) { registrations_.reserve(bodies); }
  const Space& space() const { return space_; }
  /// Grid levels in no particular order; some may be empty. Invalidated by enter(), enter_all() and start(),
  /// which may add levels.
  std::span<const GridLevel> levels() const { return levels_; }
  bool contains(std::uint32_t number) const {
    return number < registrations_.size() && registrations_[number].level != none;
  }
  /// Returns the end of the body's window, until which its swept sphere contains the body. Precondition:
  /// contains(number).
  double end_of(std::uint32_t number) const { return registrations_[number].end; }
  /// Returns the window in which the body is registered. Precondition: contains(number).
  Window window_of(std::uint32_t number) const { return level_of(number).window; }
  /// Returns the grid level that holds the body. Precondition: contains(number). Invalidated as levels() are.
  const GridLevel& level_of(std::uint32_t number) const { return levels_[registrations_[number].level]; }
  /// Returns the swept sphere of the body, in the frame of level_of(). Precondition: contains(number).
  SweptSphere swept_sphere_of(std::uint32_t number) const {
    return level_of(number).spheres.table().swept_sphere_at(registrations_[number].slot);
  }
  /// Returns a box that contains the body from `now` until its window ends. Precondition: contains(number).
  Box box_of(std::uint32_t number, double now) const;
  /// Number of registered bodies.
  std::size_t size() const;
  /// Number of bodies registered in a window.
  std::size_t size_of(const Window& window) const;
  /// Number of registered bodies in windows that end.
  std::size_t moving() const;
  /// Lower bound on the end of every window that holds a body; +infinity if there is none. A window that
  /// bodies have left still counts until the next end_windows().
  double next_end() const { return next_end_; }
  /// Returns the least of the levels' greatest swept-sphere widths (length), about the width of the smallest
  /// swept spheres; +infinity if no body is registered.
  double least_width() const;

  /// Registers a body in a window from `now` on. An earlier registration of the body is replaced.
  void enter(std::uint32_t number, const InflatedBound& bound, double now, const Window& window);
  /// Argument of enter_all(): a body, the time at which it enters, and its window.
  struct Arrival {
    std::uint32_t number;
    double time;
    Window window;
  };
  /// Registers many bodies as enter() does; no body may occur twice. bound_of(k) returns the bound of the
  /// k-th arrival at its time, and is called by several threads concurrently.
  template <class BoundOf>
  void enter_all(std::span<const Arrival> arrivals, BoundOf bound_of, PoolLease& lease);
  /// Removes the body's registration. Precondition: contains(number).
  void leave(std::uint32_t number);
  /// Sorts each grid level that many bodies have entered or left one by one, so that searches are fast again.
  /// Slots in these levels change.
  void tidy(PoolLease& lease);
  void tidy() {
    PoolLease alone;
    tidy(alone);
  }

  // Bulk restart of windows: end_windows(), then start().

  /// Returns the numbers, in ascending order, of the bodies whose windows end at `now` or before or, if
  /// `all`, end at all. Bodies that start in this order make equal grid levels, whatever the history.
  std::vector<std::uint32_t> ended(double now, bool all) const;
  /// Unregisters the bodies that ended(now, all) returns; start() registers them again. From then on the
  /// merged size classes that the last start chose are in use.
  void end_windows(double now, bool all);
  /// Returns the rungs of the windows that hold bodies and were not ended by end_windows(). A rung may occur
  /// several times.
  std::vector<int> held_rungs() const;
  /// Argument of start(): a body, its size class (SizeClasses::size_class_of) and its window.
  struct Starter {
    std::uint32_t number;
    int size_class;
    Window window;
  };
  /// Registers the starters in the given order. Preconditions: end_windows() came before; the windows are
  /// free (Window::free_at). bound_of(number) is called by several threads concurrently.
  template <class BoundOf>
  void start(std::span<const Starter> starters, double now, BoundOf bound_of, PoolLease& lease) {
    add_starters(starters, now, bound_of, lease);
    finish_start(lease);
  }
  /// The steps of start(), for starters that come in groups: their swept spheres, group by group, and the
  /// sorting of all into grid levels. In between nothing may enter, and nothing can be searched.
  template <class BoundOf>
  void add_starters(std::span<const Starter> starters, double now, BoundOf bound_of, PoolLease& lease);
  void finish_start(PoolLease& lease);
  // The first steps of finish_start(), which may be called before it, in this order. From survey() on no
  // starter may be added or taken back.
  void survey(PoolLease& lease);
  void choose_cells(PoolLease& lease);
  /// True if the body, or any, was added since the last finish_start().
  bool is_starter(std::uint32_t number) const {
    return contains(number) && opening_of(registrations_[number].level) != nullptr;
  }
  bool has_starters() const { return !filling_.openings.empty(); }
  /// Takes a starter back. Precondition: is_starter(number).
  void remove_starter(std::uint32_t number);
  /// Number of sorted slots of the grid levels in which bodies have started since the last end_windows().
  std::size_t started_slots() const;

  // Windows whose start is prepared in another broad phase, a successor, while the present ones last.

  /// Returns an empty broad phase in which windows that begin at `begin` can start, to be taken over at
  /// `entry`. `changes`, the number of bodies that have changed within the last windows, decides whether it
  /// has spare slots.
  BroadPhase successor(double begin, double entry, std::uint64_t changes) const;
  /// Registers the starters of a successor, and the bodies that have entered it since, in their windows
  /// before these begin, at `entry`. All of them, and bodies that have windows beyond their begin, then await
  /// a search from then on. Precondition: finish_start() for the successor. Returns a copy of the grid levels
  /// of these bodies to be searched, without registrations; those of the successor are fresh.
  BroadPhase take_over(BroadPhase&& successor);
  /// Time from which pairs that await a search are certified by it; -infinity if none do. Begin of the
  /// windows of a successor.
  double search_begin() const { return search_begin_; }
  /// True if the pair was registered at take_over() and is unchanged since, and one of the two came from the
  /// successor: they are certified until search_begin() at most, and a search for that one finds them.
  bool pair_awaits_search(std::uint32_t a, std::uint32_t b) const {
    return search_of(a) != Search::none && search_of(b) != Search::none &&
           (awaits_search(a) || awaits_search(b));
  }
  /// True if the body came from the successor at take_over(), and is unchanged since.
  bool awaits_search(std::uint32_t number) const { return search_of(number) >= Search::starts; }
  /// True if awaits_search(), and the body is behind the sorted slots, which the search does not include.
  bool awaits_search_alone(std::uint32_t number) const { return search_of(number) == Search::starts_alone; }
  /// Ends the state that take_over() began: no body awaits a search any more.
  void end_search();
  /// Frees the slots first <= k < last below started_slots() of bodies for which is_gone(number) is true. For
  /// results of take_over().
  template <class IsGone>
  void take_out_started(std::size_t first, std::size_t last, IsGone is_gone);
  /// Keeps a list of the bodies that enter or leave from now on, or stops that.
  void record_changes(bool on);
  /// Returns the list so far, each body once in ascending order, and begins a new one.
  std::vector<std::uint32_t> take_changes();
  /// The list so far, in which a body may occur several times.
  std::span<const std::uint32_t> changes() const { return changes_; }

  /// Returns a description of what is wrong with the body's registration, or nothing. Precondition:
  /// contains(number).
  std::optional<std::string> check(std::uint32_t number) const;
  /// True if the deserialized state is consistent in a world with `bodies` bodies, and has no starters.
  bool is_valid(std::size_t bodies) const {
    return !has_starters() && !(awaiting_.empty() && search_begin_ > -infinity) &&
           is_valid_successor(bodies, false, false);
  }
  /// True if the deserialized state of a successor is consistent, survey() and choose_cells() having been
  /// called or not.
  bool is_valid_successor(std::size_t bodies, bool is_surveyed, bool has_cells) const;
  /// True if the deserialized result of a take_over() is consistent in a world with `bodies` bodies.
  bool is_valid_copy(std::size_t bodies) const;
  static void serialize(auto& self, auto& archive) {
    auto& [space, registrations, levels, size_classes, base, has_base, next_end, many_changes, filling,
           records, changed, awaiting, search_begin, taken_over] = self;
    archive(registrations, levels, size_classes, base, has_base, next_end, many_changes, filling, records,
            changed, awaiting, search_begin, taken_over);
  }

 private:
  struct Registration {
    double end = 0.0;
    std::uint32_t level = none;
    std::uint32_t slot = 0;
  };
  /// Result of prepare(): the body's size class and, unless `level` is none, the slot that the body has
  /// already and can keep with the new swept sphere.
  struct Entry {
    int size_class = 0;
    std::uint32_t level = none;
    std::uint32_t slot = 0;
    SweptSphere sphere{};
    float looseness = 0.0f;
  };
  /// A grid level in which bodies start, and their swept spheres until finish_start() sorts them.
  struct Opening {
    std::uint32_t level = none;
    UnsortedSweptSpheres unsorted{};
    SweptSphereSpread spread{};          ///< of the swept spheres, since survey()
    std::vector<std::uint32_t> cells{};  ///< of the swept spheres, since choose_cells()
  };
  /// Whether a body awaits a search since take_over(): not; as one that is found; as one that came from the
  /// successor, in a sorted slot or behind these.
  enum class Search : std::uint8_t { none, found, starts, starts_alone };
  /// Number of bodies by size class.
  using Sizes = std::map<int, std::size_t>;
  /// What add_starters() has added since the last finish_start().
  struct Filling {
    std::vector<Opening> openings;
    Sizes sizes;
    bool is_surveyed = false;
    bool has_cells = false;
  };

  Entry prepare(std::uint32_t number, const InflatedBound& bound, double now, const Window& window) const;
  void replace(const Entry& entry, double now, SweptSphereGrid::Growth& growth);
  void take_out(std::uint32_t number);
  void add(std::uint32_t number, std::uint32_t level, const InflatedBound& bound, double now);
  std::uint32_t level_for(const Window& window, int size_class);
  void open(GridLevel& level, double origin);
  void sort(GridLevel& level, PoolLease& lease);
  template <class Visit>
  void for_each_ended(double now, bool all, Visit visit) const;
  std::vector<std::uint32_t> choose_levels(std::span<const Starter> starters);
  Search search_of(std::uint32_t number) const {
    return number < awaiting_.size() ? awaiting_[number] : Search::none;
  }
  void take_out_starters(const BroadPhase& successor);
  void note_changes_of_ended(std::uint64_t changes, std::uint64_t bodies);
  const Opening* opening_of(std::uint32_t level) const;
  bool is_in_its_level(std::uint32_t number) const;
  bool filling_is_valid() const;
  void note_change(std::uint32_t number) {
    if (records_changes_) changes_.push_back(number);
    if (number < awaiting_.size()) awaiting_[number] = Search::none;
  }
  template <class Sort>
  void sort_to_start(GridLevel& level, Sort sort_level);
  void merge_size_classes(const Sizes& sizes);

  Space space_;
  std::vector<Registration> registrations_;  ///< indexed by body number
  std::vector<GridLevel> levels_;
  SizeClasses size_classes_;
  Vec3 base_{};  ///< base of the frames of levels opened from now on
  bool has_base_ = false;
  double next_end_ = infinity;     ///< see next_end()
  bool has_many_changes_ = false;  ///< in the windows that ended last, so that spare slots pay
  Filling filling_;
  bool records_changes_ = false;
  std::vector<std::uint32_t> changes_;  ///< see take_changes(); a body may occur several times
  std::vector<Search> awaiting_;        ///< by number; empty if no body awaits a search
  double search_begin_ = -infinity;
  double taken_over_ = 0.0;  ///< time of the last take_over(); of a successor, that of its own
};

template <class IsGone>
void BroadPhase::take_out_started(std::size_t first, std::size_t last, IsGone is_gone) {
  std::size_t before = 0;
  for (GridLevel& level : levels_) {
    if (!level.fresh) continue;
    const std::size_t behind = before + level.spheres.sorted_slots();
    for (std::size_t k = std::max(first, before); k < std::min(last, behind); ++k) {
      const auto slot = static_cast<std::uint32_t>(k - before);
      const std::uint32_t number = level.spheres.table().number_at(slot);
      if (number != SweptSphereTable::free_slot && is_gone(number)) level.spheres.remove(slot);
    }
    before = behind;
  }
}

template <class BoundOf>
void BroadPhase::enter_all(std::span<const Arrival> arrivals, BoundOf bound_of, PoolLease& lease) {
  constexpr std::size_t bodies_at_once = 256;
  std::vector<std::vector<SweptSphereGrid::Growth>> growth(
      lease.count(), std::vector<SweptSphereGrid::Growth>(levels_.size()));
  std::vector<std::vector<std::size_t>> others(lease.count());
  lease.for_each(arrivals.size(), bodies_at_once, [&](std::size_t k, std::size_t worker) {
    const auto& [number, time, window] = arrivals[k];
    const Entry entry = prepare(number, bound_of(k), time, window);
    if (entry.level == none) {
      others[worker].push_back(k);
    } else {
      replace(entry, time, growth[worker][entry.level]);
    }
  });
  for (const Arrival& arrival : arrivals) note_change(arrival.number);
  for (const std::vector<SweptSphereGrid::Growth>& of_levels : growth)
    for (std::size_t level = 0; level < of_levels.size(); ++level) levels_[level].grow(of_levels[level]);
  // Sorted, so that the order of entering does not depend on which thread prepared which arrival.
  std::vector<std::size_t> rest;
  for (const std::vector<std::size_t>& some : others) rest.insert(rest.end(), some.begin(), some.end());
  std::sort(rest.begin(), rest.end());
  for (const std::size_t k : rest) {
    const auto& [number, time, window] = arrivals[k];
    enter(number, bound_of(k), time, window);
  }
}

template <class BoundOf>
void BroadPhase::add_starters(std::span<const Starter> starters, double now, BoundOf bound_of,
                              PoolLease& lease) {
  const std::size_t opened = filling_.openings.size();
  const std::vector<std::uint32_t> first_bodies = choose_levels(starters);
  for (std::size_t k = 0; k < first_bodies.size(); ++k) {
    base_ = bound_of(first_bodies[k]).moved.centre;
    has_base_ = true;
    open(levels_[filling_.openings[opened + k].level], now);
  }
  std::vector<SweptSphere*> spheres(levels_.size());
  for (Opening& opening : filling_.openings) spheres[opening.level] = opening.unsorted.spheres.data();
  constexpr std::size_t bodies_at_once = 512;
  lease.for_each(starters.size(), bodies_at_once, [&](std::size_t k, std::size_t) {
    const std::uint32_t number = starters[k].number;
    const Registration& here = registrations_[number];
    spheres[here.level][here.slot] = levels_[here.level].swept_sphere(bound_of(number), now);
  });
}

}  // namespace kinesphere
