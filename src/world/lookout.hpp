// The cheap looks at neighbours: most of them can be left alone for some sums and products, a few for a root.
#pragma once

#include "bound/encounter.hpp"
#include "bound/glance.hpp"
#include "bound/rounding.hpp"
#include "number/infinity.hpp"
#include "world/engine.hpp"

namespace kinesphere {

/// A body from whom four neighbours at a time are glanced at.
class World::Engine::Glances {
 public:
  Glances(const Engine& engine, std::uint32_t number)
      : engine_(engine),
        glance_(engine.sketches_[number], engine.time_,
                engine.sensors_.largest_reach() + engine.definition_.contact_tolerance) {
    if (engine.space_.repeats()) images_.emplace(engine.homes_[number], engine.space_.period());
  }

  /// Which of the first four can be left alone until this time.
  [[gnu::always_inline]] Lanes apart(const Unwatched* first, double until) const {
    const auto row = [first](const auto& table) {
      return std::array{&table[first[0].partner], &table[first[1].partner], &table[first[2].partner],
                        &table[first[3].partner]};
    };
    return images_ ? glance_.apart(row(engine_.sketches_), until, *images_, row(engine_.homes_))
                   : glance_.apart(row(engine_.sketches_), until);
  }

 private:
  const Engine& engine_;
  Glance<> glance_;
  std::optional<Glance<>::Images> images_;
};

/// A body from whom one neighbour after the other is looked at.
class World::Engine::Lookout {
 public:
  Lookout(const Engine& engine, std::uint32_t number)
      : engine_(engine),
        number_(number),
        body_(engine.bodies_[number]),
        now_(engine.time_),
        bare_(engine.is_bare(number)) {
    expect(std::min(body_.box_end, body_.wall_time));
  }

  /// The body will be looked at at this time. Pairs that come into question only much later can wait for
  /// then.
  void expect(double time) {
    if (time > now_ && time < first_) {
      first_ = time;
      enough_ = now_ + beyond_first * (first_ - now_);
    }
  }

  /// The body touches and senses nothing: else nobody can be left alone for a glance or a closer look.
  bool is_bare() const { return bare_; }
  /// Whether a neighbour can be left alone for as long as is enough, by a closer look.
  struct Look {
    bool apart;
    double until;  ///< if not apart: they cannot meet sooner; now, if fresh reports are needed
  };
  Look look_at(std::uint32_t partner) const {
    const Body& other = engine_.bodies_[partner];
    if (!bare_ || other.is_fixed()) return {false, now_};
    MovedBound moved(other.bound, now_);
    if (engine_.space_.repeats()) moved.centre += engine_.shift_to_meet(number_, partner);
    const Encounter pair(MovedBound(body_.bound, now_), moved);
    const double sensed = engine_.sensors_.any() ? engine_.reach_of_pair(body_, other) : 0.0;
    const double near = sensed + engine_.definition_.contact_tolerance;
    const double boxes_end = std::min(body_.box_end, other.box_end);
    if (pair.stay_apart(std::min(boxes_end, enough_) - now_, near)) return {true, now_};
    if (pair.is_near(near)) return {false, now_};
    const double room = sensed + engine_.rounding_room();
    return {false, rounding::sum_down(now_, pair.meeting(boxes_end - now_, room))};
  }
  /// Nothing can happen between the two until this time; +infinity: until their boxes end. Now, if fresh
  /// reports are needed.
  double left_alone_until(std::uint32_t partner) const {
    const Look look = look_at(partner);
    if (!look.apart) return look.until;
    const double boxes_end = std::min(body_.box_end, engine_.bodies_[partner].box_end);
    return enough_ < boxes_end ? enough_ : infinity;
  }
  /// Nobody has to be left alone for longer.
  double enough() const { return enough_; }
  /// When a look at those that are apart is needed again; +infinity: when a box ends.
  double next_look() const { return enough_ < body_.box_end ? enough_ : infinity; }

 private:
  static constexpr double beyond_first = 2.0;

  const Engine& engine_;
  std::uint32_t number_;
  const Body& body_;
  double now_;
  /// It touches and senses nothing.
  bool bare_;
  double first_ = infinity;
  double enough_ = infinity;
};

}  // namespace kinesphere
