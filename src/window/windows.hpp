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

#include "number/infinity.hpp"
#include "space/space.hpp"
#include "window/window_layer.hpp"

namespace kinesphere {

class Windows {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

 public:
  explicit Windows(const Space& space) : space_(space) {}

  void reserve(std::size_t bodies) { registrations_.reserve(bodies); }
  const Space& space() const { return space_; }
  /// In no order; some may be empty.
  std::span<const WindowLayer> layers() const { return layers_; }
  bool contains(std::uint32_t number) const {
    return number < registrations_.size() && registrations_[number].layer != none;
  }
  /// Of one that is registered: it stays in its capsule until then.
  double end_of(std::uint32_t number) const { return registrations_[number].end; }
  Window window_of(std::uint32_t number) const { return layers_[registrations_[number].layer].window; }
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
  void enter(std::uint32_t number, const RoomyBound& bound, double now, const Window& window);
  /// A body that enters a window at a time.
  struct Arrival {
    std::uint32_t number;
    double time;
    Window window;
  };
  /// The same for many bodies, each of them once. bound_of(k) gives that of the k-th at its time; it is asked
  /// by several threads.
  template <class BoundOf>
  void enter_all(std::span<const Arrival> arrivals, BoundOf bound_of, Shift& shift);
  void leave(std::uint32_t number);
  /// Makes searches fast again, if many have entered or left one by one.
  void tidy(Shift& shift);
  void tidy() {
    Shift alone;
    tidy(alone);
  }

  // New windows for many bodies at once: end_windows(), then start().

  /// The bodies whose windows have ended by `now` or, if `all`, whose windows end ever, in the order of
  /// their numbers. What starts in this order makes the same layers, whatever has happened before.
  std::vector<std::uint32_t> ended(double now, bool all) const;
  /// Those bodies are registered nowhere any more, and wait for start().
  void end_windows(double now, bool all);
  /// The tiers of windows that hold bodies whose windows have not been ended.
  std::vector<int> held_tiers() const;
  /// A body that starts, in which window, and of what size its capsule is (SizeLevels::level_of).
  struct Starter {
    std::uint32_t number;
    int level;
    Window window;
  };
  /// They start, in windows that are free, in the order in which they are given; bound_of(number) is asked by
  /// several threads. Ends what end_windows() has begun.
  template <class BoundOf>
  void start(std::span<const Starter> starters, double now, BoundOf bound_of, Shift& shift);
  /// How many have started since windows ended.
  std::size_t started() const;

  /// For one that is registered: what is wrong with its place, if anything is.
  std::optional<std::string> check(std::uint32_t number) const;
  /// For one that was read, in a world of this many bodies.
  bool is_sound(std::size_t bodies) const;
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [space, registrations, layers, levels, base, has_base, next_end] = self;
    archive(registrations, layers, levels, base, has_base, next_end);
  }

 private:
  struct Registration {
    double end = 0.0;
    std::uint32_t layer = none;
    std::uint32_t place = 0;

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [until, its_layer, its_place] = self;
      archive(until, its_layer, its_place);
    }
  };
  /// How a body may enter: of what level its capsule is and, unless the layer is none, that it may have the
  /// place that it has.
  struct Entry {
    int level = 0;
    std::uint32_t layer = none;
    std::uint32_t place = 0;
    Capsule capsule{};
    float overhang = 0.0f;
  };
  /// A layer that so many start in; the first one of them.
  struct Opening {
    std::uint32_t layer;
    std::uint32_t first;
    std::size_t bodies;
  };
  /// How many bodies are of each level.
  using Sizes = std::map<int, std::size_t>;

  Entry prepare(std::uint32_t number, const RoomyBound& bound, double now, const Window& window) const;
  void replace(const Entry& entry, double now, Layer::Growth& growth);
  void take_out(std::uint32_t number);
  void add(std::uint32_t number, std::uint32_t layer, const RoomyBound& bound, double now);
  std::uint32_t layer_for(const Window& window, int level);
  void open(WindowLayer& layer, double origin);
  void sort(WindowLayer& layer, Shift& shift);
  template <class Visit>
  void for_each_ended(double now, bool all, Visit visit) const;
  std::vector<Opening> choose_layers(std::span<const Starter> starters, Sizes& sizes);
  void finish_start(const std::vector<UnsortedCapsules>& unsorted, Shift& shift);
  template <class Sort>
  void sort_to_start(WindowLayer& layer, Sort sort_layer);
  void merge_levels(const Sizes& sizes);

  Space space_;
  std::vector<Registration> registrations_;  ///< by body
  std::vector<WindowLayer> layers_;
  SizeLevels levels_;
  Vec3 base_{};  ///< of layers that bodies open by entering
  bool has_base_ = false;
  double next_end_ = infinity;  ///< of the windows that hold a body, or held one
};

template <class BoundOf>
void Windows::enter_all(std::span<const Arrival> arrivals, BoundOf bound_of, Shift& shift) {
  constexpr std::size_t bodies_at_once = 256;
  std::vector<std::vector<Layer::Growth>> growth(shift.count(), std::vector<Layer::Growth>(layers_.size()));
  std::vector<std::vector<std::size_t>> others(shift.count());
  shift.for_each(arrivals.size(), bodies_at_once,
                 [&](std::size_t begin, std::size_t end, std::size_t worker) {
                   for (std::size_t k = begin; k < end; ++k) {
                     const auto& [number, time, window] = arrivals[k];
                     const Entry entry = prepare(number, bound_of(k), time, window);
                     if (entry.layer == none) {
                       others[worker].push_back(k);
                     } else {
                       replace(entry, time, growth[worker][entry.layer]);
                     }
                   }
                 });
  for (const std::vector<Layer::Growth>& of_layers : growth)
    for (std::size_t layer = 0; layer < of_layers.size(); ++layer) layers_[layer].grow(of_layers[layer]);
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
void Windows::start(std::span<const Starter> starters, double now, BoundOf bound_of, Shift& shift) {
  std::vector<UnsortedCapsules> unsorted(layers_.size());
  Sizes sizes;
  for (const Opening& opening : choose_layers(starters, sizes)) {
    base_ = bound_of(opening.first).moved.centre;
    has_base_ = true;
    open(layers_[opening.layer], now);
    unsorted.resize(layers_.size());
    unsorted[opening.layer] = UnsortedCapsules(opening.bodies);
  }
  constexpr std::size_t bodies_at_once = 512;
  shift.for_each(starters.size(), bodies_at_once, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t number = starters[k].number;
      const Registration& here = registrations_[number];
      UnsortedCapsules& all = unsorted[here.layer];
      all.numbers[here.place] = number;
      all.capsules[here.place] = layers_[here.layer].capsule(bound_of(number), now);
    }
  });
  finish_start(unsorted, shift);
  merge_levels(sizes);
}

}  // namespace kinesphere
