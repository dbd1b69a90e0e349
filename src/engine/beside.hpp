// What an island knows that runs beside others: which bodies are its own, and what it does to them.
//
// Inside a part of a phase (islands.hpp) an island meets nobody else, unless one of its bodies is kicked:
// that body's new capsule may touch others. While islands run, the capsules in the windows stay as they are,
// for all; those of kicked bodies are kept here. A body of nobody's or of another island that a kicked one
// may meet in time is claimed: then the island stops, and runs again with it from where the part began. One
// that it may meet later is counted on to be as it was when the part began, up to the time of the kick.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/sea.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "window/agenda.hpp"
#include "window/tempo.hpp"
#include "window/windows.hpp"

namespace kinesphere {

/// A capsule that a body has from `time` on, in its new window.
struct BodyKick {
  std::uint32_t number;
  std::uint32_t stamp;
  double time;
  Window window;
  Bound bound;
  Vec3 middle;  ///< where space repeats
  Since since{};
};

/// An event, and in which round of its instant it came.
struct Told {
  std::uint32_t round;
  Event event;
};

/// A body of another island, or of nobody's, and until when it has to be as it was when the part began.
struct CountedOn {
  std::uint32_t number;
  double time;
};

/// A body that was turned, and from where it had set out before.
using Turn = std::pair<BodyId, Departure>;

/// What an island has done that is only counted.
struct Work {
  Counters counters{};
  Kicks settled{};  ///< bodies that were settled one by one
};

/// Where something stands in a list.
struct Stretch {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  std::uint32_t size() const { return end - begin; }
  template <class T>
  std::span<const T> of(const std::vector<T>& list) const {
    return std::span(list).subspan(begin, size());
  }
};

/// The lists of several islands, one behind the other: the last one is that of the island that runs now.
/// Those of islands that have been taken back are still there.
template <class T>
class Listing {
 public:
  void clear() {
    all_.clear();
    begin_ = 0;
  }
  /// The next list begins.
  void start() { begin_ = static_cast<std::uint32_t>(all_.size()); }
  void add(const T& one) { all_.push_back(one); }
  /// The same list here: where it stands.
  Stretch add(const Listing& other, const Stretch& stretch) {
    start();
    const std::span<const T> list = stretch.of(other.all_);
    all_.insert(all_.end(), list.begin(), list.end());
    return this->stretch();
  }

  bool empty() const { return begin_ == all_.size(); }
  std::size_t size() const { return all_.size() - begin_; }
  Stretch stretch() const { return {begin_, static_cast<std::uint32_t>(all_.size())}; }
  const std::vector<T>& all() const { return all_; }
  std::vector<T>& all() { return all_; }

 private:
  std::vector<T> all_;
  std::uint32_t begin_ = 0;
};

/// What came of an island: where it stands in the lists of the thread that ran it.
struct Outcome {
  std::uint32_t worker = 0;
  std::uint32_t work = 0;
  Stretch told{};
  Stretch kicks{};
  Stretch left{};
  Stretch claims{};
  Stretch counted_on{};
  Stretch turned{};
};

/// What one island knows, and what it has done that others have to see; with the lists of those that the same
/// thread has run before it in this part.
struct Beside {
  Sea* sea = nullptr;
  std::uint32_t own = Sea::nobody;
  Listing<Told> told;
  Listing<BodyKick> kicks;        ///< in the order of their times
  Listing<HotPair> left;          ///< that are due later
  Listing<std::uint32_t> claims;  ///< whom else it needs
  Listing<CountedOn> counted_on;  ///< with whom it has pairs that are due later
  Listing<Turn> turned;
  std::vector<Work> works;
  /// Of the first of these islands that has failed.
  std::optional<Error> failure;

  /// A part begins.
  void clear() {
    told.clear();
    kicks.clear();
    left.clear();
    claims.clear();
    counted_on.clear();
    turned.clear();
    works.clear();
    failure.reset();
  }
  void begin(Sea& all, std::uint32_t place) {
    sea = &all;
    own = place;
    told.start();
    kicks.start();
    left.start();
    claims.start();
    counted_on.start();
    turned.start();
  }
  Outcome end(std::uint32_t worker, const Work& work) {
    works.push_back(work);
    return {worker,
            static_cast<std::uint32_t>(works.size() - 1),
            told.stretch(),
            kicks.stretch(),
            left.stretch(),
            claims.stretch(),
            counted_on.stretch(),
            turned.stretch()};
  }
  /// All has to be answered one by one then.
  bool is_full() const { return kicks.size() > sea->most_kicks; }
  bool is_own(std::uint32_t number) const { return sea->places[number].island == own; }
  void add(const BodyKick& kick) {
    note_change(kick.number, kick.time);
    if (kick.stamp != last_stamp(kick.number)) since(kick.number).kick = kick.time;
    sea->places[kick.number].kick = kicks.stretch().end;
    kicks.add(kick);
  }
  /// One of its own is reported, or gets another capsule.
  void note_change(std::uint32_t number, double time) {
    double& first = since(number).change;
    first = std::min(first, time);
  }
  /// A body of another island, which may be changing it now, as it was when the part began; null for all
  /// others.
  const Kept* as_it_began(std::uint32_t number) const {
    const std::uint32_t island = sea->places[number].island;
    return island == own || island == Sea::nobody ? nullptr : sea->kept_of(number);
  }
  /// Calls visit(number) for each body that has been kicked.
  template <class Visit>
  void for_each_kicked(Visit visit) const {
    const auto [first, last] = kicks.stretch();
    for (std::uint32_t k = first; k < last; ++k) {
      const std::uint32_t number = kicks.all()[k].number;
      if (sea->places[number].kick == k) visit(number);
    }
  }
  const BodyKick* last_kick(std::uint32_t number) const {
    const Sea::Place& place = sea->places[number];
    return place.island == own && place.kick != Sea::none ? &kicks.all()[place.kick] : nullptr;
  }

 private:
  std::uint32_t last_stamp(std::uint32_t number) const {
    const Sea::Place& place = sea->places[number];
    return place.kick != Sea::none ? kicks.all()[place.kick].stamp : sea->kept[place.kept].body.body.stamp;
  }
  /// Of one of its own: since its last kick or, if there was none, since the part began.
  Since& since(std::uint32_t number) {
    assert(is_own(number));
    const Sea::Place& place = sea->places[number];
    return place.kick != Sea::none ? kicks.all()[place.kick].since : sea->kept[place.kept].since;
  }
};

}  // namespace kinesphere
