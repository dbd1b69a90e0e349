// The cheap look at neighbours: most of them can be left alone for some sums and products, a few for a root.
#pragma once

#include "bound/encounter.hpp"
#include "bound/glance.hpp"
#include "bound/rounding.hpp"
#include "number/infinity.hpp"
#include "world/engine.hpp"

namespace kinesphere {

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

  /// Which of these neighbours, four at most, can be left alone for as long as is enough.
  [[gnu::always_inline]] Lanes apart(const Glance<>& glance,
                                     std::span<const Neighbours::Place> places) const {
    if (!bare_) return 0;
    const std::span<const Neighbour> all = engine_.neighbours_.of(number_);
    Glance<>::Row others;
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      others[lane] = &engine_.sketches_[all[places[std::min(lane, places.size() - 1)]].partner];
    const double room = engine_.sensors_.largest_reach() + engine_.definition_.contact_tolerance;
    if (!engine_.space_.repeats()) return glance.apart(others, enough_, room, nullptr);
    Glance<>::Homes homes{engine_.space_.period(), &engine_.homes_[number_], {}};
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      homes.others[lane] = &engine_.homes_[all[places[std::min(lane, places.size() - 1)]].partner];
    return glance.apart(others, enough_, room, &homes);
  }
  /// The same of one neighbour, by a closer look.
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
  /// When a look at those that are apart is needed again; +infinity: when a box ends.
  double enough() const { return enough_ < body_.box_end ? enough_ : infinity; }

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
