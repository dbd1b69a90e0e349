// Who is near whom: for each body the others whose boxes overlap its own, and until when each pair is
// settled.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "memory/prefetch.hpp"

namespace kinesphere {

class HeapCounter;

/// One side of a pair.
struct Neighbour {
  static constexpr double nobody = std::numeric_limits<double>::infinity();
  static constexpr double partner_does = std::numeric_limits<double>::max();

  /// The watch: what holds between the two now cannot change before this time; or one of the two above, which
  /// are later than all times.
  double watch = nobody;
  std::uint32_t partner = 0;
  std::uint32_t mirror = 0;  ///< the place of the pair in the partner's list

  /// This side does.
  bool watches() const { return watch < partner_does; }
  /// One of the two does, and not only until now.
  bool is_watched(double now) const { return now < watch && watch < nobody; }

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [time, whom, there] = self;
    archive(time, whom, there);
  }
};

/// Every pair stands in the lists of both its bodies, and at most one side watches it.
class Neighbours {
 public:
  using Place = std::uint32_t;

  void reserve(std::size_t bodies) { lists_.reserve(bodies); }
  /// Bodies 0 to count - 1 have lists.
  void make_room(std::size_t count) { lists_.resize(count); }
  /// Of a body that will soon be asked for.
  [[gnu::always_inline]] void fetch(std::uint32_t body) const { prefetch(lists_[body]); }
  /// The list itself.
  [[gnu::always_inline]] void fetch_sides(std::uint32_t body) const {
    for (const Neighbour& one : of(body)) prefetch(one);
  }
  /// Good until neighbours come or go.
  std::span<const Neighbour> of(std::uint32_t body) const {
    return std::span(sides_).subspan(lists_[body].first, lists_[body].size);
  }
  /// The first of those whom the body's side watches, Neighbour::partner_does or Neighbour::nobody.
  double earliest_watch(std::uint32_t body) const {
    double earliest = Neighbour::nobody;
    for (const Neighbour& one : of(body)) earliest = one.watch < earliest ? one.watch : earliest;
    return earliest;
  }
  /// Where that of this time stands.
  Place place_of_watch(std::uint32_t body, double time) const {
    Place place = 0;
    while (of(body)[place].watch != time) ++place;
    return place;
  }
  /// Where `partner` stands in the list of the body. Cost: O(length of the list).
  std::optional<Place> find(std::uint32_t body, std::uint32_t partner) const;

  /// The body's neighbours become `found`, others, of which some may stand several times; pairs that stay
  /// keep their watches. Cost: O(old + new).
  void replace(std::uint32_t body, std::span<const std::uint32_t> found);
  void remove_all(std::uint32_t body);
  /// Bodies whose lists have come to 96, 128, 160, ... neighbours since the last call, some several times.
  std::vector<std::uint32_t> take_crowded() { return std::exchange(crowded_, {}); }

  /// The pair is watched from the body's side, until `time`, which may be Neighbour::nobody, and not from the
  /// other. The other list is touched only if it has to change.
  void watch(std::uint32_t body, Place place, double time) {
    Neighbour& here = side(body, place);
    const double before = here.watch;
    here.watch = time;
    if (!here.watches()) {
      if (before != Neighbour::nobody) mirror_of(here).watch = Neighbour::nobody;
    } else if (!(before < Neighbour::partner_does)) {
      mirror_of(here).watch = Neighbour::partner_does;
    }
  }
  void unwatch(std::uint32_t body, Place place) { watch(body, place, Neighbour::nobody); }
  void unwatch_all(std::uint32_t body) {
    for (Place place = 0; place < lists_[body].size; ++place) unwatch(body, place);
  }
  /// The time until which one of the sides watches the pair, or +infinity.
  double watched_until(std::uint32_t body, Place place) const {
    const Neighbour& here = of(body)[place];
    return here.watch == Neighbour::partner_does ? of(here.partner)[here.mirror].watch : here.watch;
  }

  /// Bytes hold the lists, not where they stand; stamps serve within a call only.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    if constexpr (std::same_as<Archive, HeapCounter>) {
      archive(self.lists_, self.sides_);
    } else {
      std::vector<std::vector<Neighbour>> lists(self.lists_.size());
      for (std::uint32_t body = 0; body < lists.size(); ++body)
        lists[body].assign(self.of(body).begin(), self.of(body).end());
      archive(lists);
      if constexpr (!std::is_const_v<Self>) self.build(lists);
    }
  }
  /// For those that were read: true when both sides of each pair know of each other, no pair is there twice,
  /// and no more than one side watches it.
  bool is_sound(std::size_t bodies) const;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  using Holes = std::array<std::uint32_t, 168>;
  static constexpr Holes no_holes() {
    Holes holes;
    holes.fill(none);
    return holes;
  }

  /// A piece of the table of sides: those that are there, and room for more up to its capacity.
  struct List {
    std::uint32_t first = 0;
    std::uint32_t size = 0;
    std::uint32_t capacity = 0;
    std::uint32_t stamp = 0;  ///< stamp_ if the body is found and not yet in the list that is replaced
  };

  Neighbour& side(std::uint32_t body, Place place) { return sides_[lists_[body].first + place]; }
  Neighbour& mirror_of(const Neighbour& one) { return side(one.partner, one.mirror); }
  void add(std::uint32_t body, const Neighbour& neighbour);
  void move(std::uint32_t body, std::uint32_t capacity);
  void pack(std::uint32_t room);
  void build(const std::vector<std::vector<Neighbour>>& lists);
  void link(std::uint32_t a, std::uint32_t b);
  void unlink(std::uint32_t body, Place place);
  void take_out(std::uint32_t body, Place place);

  std::vector<List> lists_;
  std::vector<Neighbour> sides_;
  /// By capacity (hole_kind), what lists that have moved leave behind, until all are packed: the first one's
  /// place, where `partner` is that of the next.
  Holes holes_ = no_holes();
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> crowded_;
};

}  // namespace kinesphere
