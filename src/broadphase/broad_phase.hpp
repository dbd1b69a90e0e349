// Who may be where until when. Each body is registered, with a capsule, in one window, which suits its speed,
// until that window ends. Bodies that share a window and are of about one size share a layer. Bodies that
// stand still have a window that never ends.
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
  /// In no order; some may be empty.
  std::span<const GridLevel> levels() const { return levels_; }
  bool contains(std::uint32_t number) const {
    return number < registrations_.size() && registrations_[number].level != none;
  }
  /// Of one that is registered: it stays in its capsule until then.
  double end_of(std::uint32_t number) const { return registrations_[number].end; }
  Window window_of(std::uint32_t number) const { return levels_[registrations_[number].level].window; }
  /// Contains the body from `now` on until its window ends.
  Box box_of(std::uint32_t number, double now) const;
  /// Bodies that are registered.
  std::size_t size() const;
  /// Those of them in windows that end.
  std::size_t moving() const;
  /// When the next window ends that holds a body.
  double next_end() const { return next_end_; }
  /// Of the smallest capsules, about; +infinity where there are none.
  double least_width() const;

  /// Registers a body in a window from `now` on, perhaps anew.
  void enter(std::uint32_t number, const InflatedBound& bound, double now, const Window& window);
  /// A body that enters a window at a time.
  struct Arrival {
    std::uint32_t number;
    double time;
    Window window;
  };
  /// The same for many bodies, each of them once. bound_of(k) gives that of the k-th at its time; it is asked
  /// by several threads.
  template <class BoundOf>
  void enter_all(std::span<const Arrival> arrivals, BoundOf bound_of, PoolLease& shift);
  void leave(std::uint32_t number);
  /// Makes searches fast again, if many have entered or left one by one.
  void tidy(PoolLease& shift);
  void tidy() {
    PoolLease alone;
    tidy(alone);
  }

  // New windows for many bodies at once: end_windows(), then start().

  /// The bodies whose windows have ended by `now` or, if `all`, whose windows end ever, in the order of
  /// their numbers. What starts in this order makes the same layers, whatever has happened before.
  std::vector<std::uint32_t> ended(double now, bool all) const;
  /// Those bodies are registered nowhere any more, and wait for start().
  void end_windows(double now, bool all);
  /// The tiers of windows that hold bodies whose windows have not been ended.
  std::vector<int> held_rungs() const;
  /// A body that starts, in which window, and of what size its capsule is (SizeClasses::size_class_of).
  struct Starter {
    std::uint32_t number;
    int size_class;
    Window window;
  };
  /// They start, in windows that are free, in the order in which they are given; bound_of(number) is asked by
  /// several threads. Ends what end_windows() has begun.
  template <class BoundOf>
  void start(std::span<const Starter> starters, double now, BoundOf bound_of, PoolLease& shift);
  /// How many have started since windows ended.
  std::size_t started() const;

  /// For one that is registered: what is wrong with its place, if anything is.
  std::optional<std::string> check(std::uint32_t number) const;
  /// For one that was read, in a world of this many bodies.
  bool is_valid(std::size_t bodies) const;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [space, registrations, layers, levels, base, has_base, next_end] = self;
    archive(registrations, layers, levels, base, has_base, next_end);
  }

 private:
  struct Registration {
    double end = 0.0;
    std::uint32_t level = none;
    std::uint32_t slot = 0;

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [until, its_layer, its_place] = self;
      archive(until, its_layer, its_place);
    }
  };
  /// How a body may enter: of what level its capsule is and, unless the layer is none, that it may have the
  /// place that it has.
  struct Entry {
    int size_class = 0;
    std::uint32_t level = none;
    std::uint32_t slot = 0;
    SweptSphere sphere{};
    float looseness = 0.0f;
  };
  /// A layer that so many start in; the first one of them.
  struct Opening {
    std::uint32_t level;
    std::uint32_t first;
    std::size_t bodies;
  };
  /// How many bodies are of each level.
  using Sizes = std::map<int, std::size_t>;

  Entry prepare(std::uint32_t number, const InflatedBound& bound, double now, const Window& window) const;
  void replace(const Entry& entry, double now, SweptSphereGrid::Growth& growth);
  void take_out(std::uint32_t number);
  void add(std::uint32_t number, std::uint32_t layer, const InflatedBound& bound, double now);
  std::uint32_t level_for(const Window& window, int level);
  void open(GridLevel& layer, double origin);
  void sort(GridLevel& layer, PoolLease& shift);
  template <class Visit>
  void for_each_ended(double now, bool all, Visit visit) const;
  std::vector<Opening> choose_levels(std::span<const Starter> starters, Sizes& sizes);
  void finish_start(const std::vector<UnsortedSweptSpheres>& unsorted, PoolLease& shift);
  template <class Sort>
  void sort_to_start(GridLevel& layer, Sort sort_layer);
  void merge_size_classes(const Sizes& sizes);

  Space space_;
  std::vector<Registration> registrations_;  ///< by body
  std::vector<GridLevel> levels_;
  SizeClasses size_classes_;
  Vec3 base_{};  ///< of layers that bodies open by entering
  bool has_base_ = false;
  double next_end_ = infinity;  ///< of the windows that hold a body, or held one
};

template <class BoundOf>
void BroadPhase::enter_all(std::span<const Arrival> arrivals, BoundOf bound_of, PoolLease& shift) {
  constexpr std::size_t bodies_at_once = 256;
  std::vector<std::vector<SweptSphereGrid::Growth>> growth(
      shift.count(), std::vector<SweptSphereGrid::Growth>(levels_.size()));
  std::vector<std::vector<std::size_t>> others(shift.count());
  shift.parallel_for(arrivals.size(), bodies_at_once,
                     [&](std::size_t begin, std::size_t end, std::size_t worker) {
                       for (std::size_t k = begin; k < end; ++k) {
                         const auto& [number, time, window] = arrivals[k];
                         const Entry entry = prepare(number, bound_of(k), time, window);
                         if (entry.level == none) {
                           others[worker].push_back(k);
                         } else {
                           replace(entry, time, growth[worker][entry.level]);
                         }
                       }
                     });
  for (const std::vector<SweptSphereGrid::Growth>& of_layers : growth)
    for (std::size_t layer = 0; layer < of_layers.size(); ++layer) levels_[layer].grow(of_layers[layer]);
  // In the same order whoever has done what.
  std::vector<std::size_t> rest;
  for (const std::vector<std::size_t>& some : others) rest.insert(rest.end(), some.begin(), some.end());
  std::sort(rest.begin(), rest.end());
  for (const std::size_t k : rest) {
    const auto& [number, time, window] = arrivals[k];
    enter(number, bound_of(k), time, window);
  }
}

template <class BoundOf>
void BroadPhase::start(std::span<const Starter> starters, double now, BoundOf bound_of, PoolLease& shift) {
  std::vector<UnsortedSweptSpheres> unsorted(levels_.size());
  Sizes sizes;
  for (const Opening& opening : choose_levels(starters, sizes)) {
    base_ = bound_of(opening.first).moved.centre;
    has_base_ = true;
    open(levels_[opening.level], now);
    unsorted.resize(levels_.size());
    unsorted[opening.level] = UnsortedSweptSpheres(opening.bodies);
  }
  constexpr std::size_t bodies_at_once = 512;
  shift.parallel_for(starters.size(), bodies_at_once, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t number = starters[k].number;
      const Registration& here = registrations_[number];
      UnsortedSweptSpheres& all = unsorted[here.level];
      all.numbers[here.slot] = number;
      all.spheres[here.slot] = levels_[here.level].swept_sphere(bound_of(number), now);
    }
  });
  finish_start(unsorted, shift);
  merge_size_classes(sizes);
}

}  // namespace kinesphere
