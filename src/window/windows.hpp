// The windows: until when each body's capsule holds, and whose capsules may touch it until then.
//
// Time is divided into windows of the lengths 2^k, for all whole k, which begin and end at the multiples of
// their length: so where one ends, all shorter ones end. Each body is registered, with a capsule, in one
// window, which suits its speed, until that window ends. Bodies that share a window and are of about one size
// share a layer. Bodies that stand still have a window that never ends.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "bound/encounter.hpp"
#include "number/infinity.hpp"
#include "space/space.hpp"
#include "window/layer.hpp"
#include "window/tempo.hpp"

namespace kinesphere {

/// A body's bound, and how much is to be kept free around it, as a search needs them.
struct RoomyBound {
  MovedBound moved;  ///< moved on to the present
  double room;       ///< length

  /// Around its way straight on for this long, in its largest size.
  Box box_of_way(double duration) const;
};

/// One of the windows of length 2^tier.
struct Window {
  int tier = 0;
  double end = 0.0;
};

class Windows {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  /// A search for the k-th of some bodies, where it is or in another image.
  struct ImageSearch {
    std::uint32_t k;
    bool shifted;
  };

 public:
  /// Two bodies.
  struct Pair {
    std::uint32_t first;
    std::uint32_t second;
  };
  /// What searches need on the way: one for each thread.
  struct Scratch {
    Layer::Searches layer;
    std::vector<std::uint32_t> numbers;
    std::vector<Pair> pairs;
    std::vector<RoomyBound> bounds;
    std::vector<ImageSearch> images;
  };

  explicit Windows(const Space& space) : space_(space) {}

  void reserve(std::size_t bodies);
  bool contains(std::uint32_t number) const {
    return number < registrations_.size() && registrations_[number].layer != none;
  }
  std::size_t size() const;
  /// Of one that is registered: it stays in its capsule until then.
  double end_of(std::uint32_t number) const { return registrations_[number].end; }
  Window window_of(std::uint32_t number) const {
    return {layers_[registrations_[number].layer].tier, registrations_[number].end};
  }
  /// Bodies in windows that end.
  std::size_t moving() const;
  /// When the next window ends that holds a body.
  double next_end() const { return next_end_; }

  /// The window of length 2^tier at a time, or a longer one where numbers cannot tell its end from now.
  static Window window_at(double now, int tier);
  /// Of the shortest window.
  static constexpr int shortest = std::numeric_limits<int>::min();
  static constexpr Window endless() { return {never_ends, infinity}; }
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
  void enter_all(std::span<const Arrival> arrivals, BoundOf bound_of, Shift& shift) {
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
      for (std::size_t layer = 0; layer < of_layers.size(); ++layer) grow(layers_[layer], of_layers[layer]);
    // In the same order whoever has done what.
    std::vector<std::size_t> rest;
    for (const std::vector<std::size_t>& some : others) rest.insert(rest.end(), some.begin(), some.end());
    std::sort(rest.begin(), rest.end());
    for (const std::size_t k : rest) {
      const auto& [number, time, window] = arrivals[k];
      enter(number, bound_of(k), time, window);
    }
  }
  void leave(std::uint32_t number);
  /// The bodies other than `number` whose registered capsule may touch that which it would have from now
  /// until `end`, before their windows end. Good until the next search with this scratch.
  std::span<const std::uint32_t> near(std::uint32_t number, const RoomyBound& bound, double now, double end,
                                      Scratch& scratch) const;

  // New windows for many bodies at once.

  /// The bodies whose windows have ended by `now` or, if `all`, whose windows end ever, in the order of
  /// their numbers. What starts in this order makes the same layers, whatever has happened before.
  std::vector<std::uint32_t> ended(double now, bool all) const;
  /// Those bodies are registered nowhere any more, and wait for start().
  void end_windows(double now, bool all);
  /// The tiers of windows that hold bodies whose windows have not been ended.
  std::vector<int> held_tiers() const;
  /// The longest window, no longer than 2^tier, whose tier is none of these: a layer in which others are
  /// already would have to be sorted anew. Windows that are 8, 64, ... times shorter are tried. Where there
  /// is none, it ends now.
  static Window free_window(double now, int tier, std::span<const int> held);
  /// A body that starts, in which window, and of what size its capsule is.
  struct Starter {
    std::uint32_t number;
    int level;
    Window window;
  };
  static int level_of(const RoomyBound& bound, const Window& window);
  /// They start, in windows that are free, in the order in which they are given; bound_of(number) is asked by
  /// several threads. Ends what end_windows() has begun.
  template <class BoundOf>
  void start(std::span<const Starter> starters, double now, BoundOf bound_of, Shift& shift) {
    std::vector<Layer::Unsorted> unsorted(layers_.size());
    Sizes sizes;
    for (const Opening& opening : choose_layers(starters, sizes)) {
      base_ = bound_of(opening.first).moved.centre;
      has_base_ = true;
      open(layers_[opening.layer], base_, now);
      unsorted.resize(layers_.size());
      unsorted[opening.layer] = Layer::Unsorted(opening.bodies);
    }
    constexpr std::size_t bodies_at_once = 512;
    shift.for_each(starters.size(), bodies_at_once, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t number = starters[k].number;
        const Registration& here = registrations_[number];
        Layer::Unsorted& all = unsorted[here.layer];
        all.numbers[here.place] = number;
        all.capsules[here.place] = layers_[here.layer].capsule(bound_of(number), now);
      }
    });
    finish_start(unsorted, shift);
    merge_levels(sizes);
  }
  /// Makes searches fast again, if many have entered or left one by one.
  void tidy() {
    Shift alone;
    tidy(alone);
  }
  void tidy(Shift& shift);
  /// How many have started since windows ended.
  std::size_t started() const;
  /// Pairs of one that has started, from the k-th of those to before the last, and one that near() finds for
  /// it: going through all of them finds each pair of two of them once. bound_of(number) is asked where there
  /// are several layers, or space repeats. Good until the next search with this scratch.
  template <class BoundOf>
  std::span<const Pair> near_started(std::size_t k, std::size_t last, double now, BoundOf bound_of,
                                     Scratch& scratch) const {
    constexpr std::size_t bodies_at_once = 16;
    scratch.pairs.clear();
    while (k < last) {
      const Started some = started_at(k, std::min(last - k, bodies_at_once));
      search_behind(some, scratch);
      if (needs_bounds_) {
        scratch.bounds.clear();
        for (std::uint32_t place = some.place; place < some.place + some.count; ++place)
          scratch.bounds.push_back(bound_of(layers_[some.layer].layer.number_at(place)));
        search_other_layers(some, now, scratch);
      }
      k += some.count;
    }
    return scratch.pairs;
  }

  /// The bodies whose capsules may reach into a box now, and perhaps some near it; where space repeats
  /// perhaps several times. Good until the next search with this scratch.
  std::span<const std::uint32_t> in_box(const Box& box, double now, Scratch& scratch) const;
  /// Of the smallest capsules, about; +infinity where there are none.
  double least_width() const;
  /// Contains the body from `now` on until its window ends.
  Box box_of(std::uint32_t number, double now) const;
  /// Calls visit(box, number of bodies) for each cell of each layer in which bodies are registered.
  template <class Visit>
  void for_each_cell(Visit visit) const {
    for (const Member& member : layers_) {
      const CapsuleFrame& frame = member.layer.frame();
      member.layer.for_each_cell([&](const Vec3& lower, const Vec3& upper, std::size_t bodies) {
        visit(Box{frame.base + lower / frame.per_length, frame.base + upper / frame.per_length}, bodies);
      });
    }
  }
  std::size_t bytes() const;
  /// For one that is registered: what is wrong with its place, if anything is.
  std::optional<std::string> check(std::uint32_t number) const;

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [space, registrations, layers, merged, next_merged, coarse, base, has_base, next_end,
           needs_bounds] = self;
    archive(registrations, layers, merged, next_merged, coarse, base, has_base, next_end, needs_bounds);
  }
  /// For one that was read, in a world of this many bodies.
  bool is_sound(std::size_t bodies) const;

 private:
  static constexpr int never_ends = std::numeric_limits<int>::max();

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
  /// The capsules of the bodies of about one size in the window of length 2^tier. It stays until windows
  /// end, even if all of them leave.
  struct Member {
    int tier = 0;
    int level = 0;
    double end = -infinity;  ///< -infinity if it is nobody's
    bool has_frame = false;  ///< without one it is empty
    bool fresh = false;      ///< all in it have started since windows ended
    Layer layer{};
    std::uint64_t changes = 0;  ///< since it was last sorted as windows started

    bool is_before(const Member& other) const {
      return std::tie(tier, level, end) < std::tie(other.tier, other.level, other.end);
    }
    Capsule capsule(const RoomyBound& bound, double now) const;
    float time(double now) const;

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [power, size, until, is_framed, is_fresh, capsules, entered] = self;
      archive(power, size, until, is_framed, is_fresh, capsules, entered);
    }
  };
  /// How coarse the cells of such a layer have turned out to have to be, where that is not 1.
  struct Coarseness {
    int tier;
    int level;
    float coarseness;

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [power, size, edge] = self;
      archive(power, size, edge);
    }
  };

  struct Merged {
    int level;
    int into;

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [from, to] = self;
      archive(from, to);
    }
  };
  /// Some that have started, at successive places.
  struct Started {
    std::uint32_t layer;
    std::uint32_t place;
    std::uint32_t count;
  };
  /// How many bodies are of each level.
  using Sizes = std::map<int, std::size_t>;
  /// A layer that so many start in; the first one of them.
  struct Opening {
    std::uint32_t layer;
    std::uint32_t first;
    std::size_t bodies;
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
  Entry prepare(std::uint32_t number, const RoomyBound& bound, double now, const Window& window) const;
  void replace(const Entry& entry, double now, Layer::Growth& growth);
  static void grow(Member& member, const Layer::Growth& growth);
  template <class Visit>
  void for_each_ended(double now, bool all, Visit visit) const;
  void merge_levels(const Sizes& sizes);
  int level_to_start(int level) const;
  int level_to_enter(int level) const;
  std::uint32_t layer_for(const Window& window, int level);
  void open(Member& member, const Vec3& base, double origin);
  float coarseness_of(const Member& member) const;
  std::vector<Opening> choose_layers(std::span<const Starter> starters, Sizes& sizes);
  void finish_start(const std::vector<Layer::Unsorted>& unsorted, Shift& shift);
  template <class Sort>
  void sort_to_start(std::uint32_t layer, Sort sort_layer);
  void take_out(std::uint32_t number);
  void add(std::uint32_t number, std::uint32_t layer, const RoomyBound& bound, double now);
  void sort(std::uint32_t layer, Shift& shift);
  Started started_at(std::size_t k, std::size_t most) const;
  void search_behind(const Started& some, Scratch& scratch) const;
  void search_other_layers(const Started& some, double now, Scratch& scratch) const;
  static CapsuleQuery query_for(const Member& member, const RoomyBound& bound, double now, double end);
  bool add_searches(const Member& member, std::uint32_t k, const RoomyBound& bound, double now, double end,
                    Scratch& scratch) const;

  Space space_;
  std::vector<Registration> registrations_;
  std::vector<Member> layers_;
  std::vector<Merged> merged_;       ///< levels that few bodies have, into larger ones; by level
  std::vector<Merged> next_merged_;  ///< the same from the next start on
  std::vector<Coarseness> coarse_;
  Vec3 base_{};  ///< of layers that bodies open by entering
  bool has_base_ = false;
  double next_end_ = infinity;  ///< of the windows that hold a body, or held one
  bool needs_bounds_ = false;   ///< to search for those that have started: not all are in one layer
};

}  // namespace kinesphere
