// The cheap look at neighbours: most of them can be left alone for some sums and products, a few for a root.
#pragma once

#include "bound/encounter.hpp"
#include "bound/glance.hpp"
#include "bound/rounding.hpp"
#include "world/engine.hpp"

namespace kinesphere {

/// A body from whom one neighbour after the other is looked at.
class World::Engine::Lookout {
 public:
  Lookout(const Engine& engine, std::uint32_t number)
      : engine_(engine),
        number_(number),
        body_(engine.bodies_[number]),
        own_(body_.bound, engine.time_),
        now_(engine.time_),
        bare_(!body_.is_fixed() && engine.book_.partners_of(number).empty() &&
              engine.book_.crossings_of(number).empty()) {
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

  /// Reports that are not fresh tell no more of the two than left_alone_until().
  bool knows_all_of(std::uint32_t partner) const {
    const Body& other = engine_.bodies_[partner];
    if (!bare_ || other.is_fixed()) return false;
    if (!engine_.sensors_.any()) return true;
    const auto sensed =
        engine_.sensors_.largest(body_.definition, other.definition, [](double) { return false; });
    return sensed == engine_.reach_of_pair(body_, other);
  }

  /// Which of these neighbours, four at most, can be left alone for as long as is enough.
  [[gnu::always_inline]] Lanes apart(const Glance<>& glance,
                                     std::span<const Neighbours::Place> places) const {
    if (!bare_) return 0;
    const std::vector<Neighbour>& all = engine_.neighbours_.of(number_);
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
  bool is_apart_from(std::uint32_t partner) const {
    return meets_bare(partner) &&
           encounter(partner).stay_apart(time_for(partner),
                                         sensed_at(partner) + engine_.definition_.contact_tolerance);
  }
  /// One or the other.
  double left_alone_until(std::uint32_t partner) const {
    return is_apart_from(partner) ? enough_for(partner) : meeting_with(partner);
  }
  /// When a look at those that are apart is needed again; +infinity: when a box ends.
  double enough() const { return enough_ < body_.box_end ? enough_ : infinity; }
  /// The same of one partner.
  double enough_for(std::uint32_t partner) const {
    const double boxes_end = std::min(body_.box_end, engine_.sketches_[partner].end);
    return enough_ < boxes_end ? enough_ : infinity;
  }

  /// They cannot meet sooner; +infinity: until their boxes end. Now, if a closer look is needed, or fresh
  /// reports.
  double meeting_with(std::uint32_t partner) const {
    if (!meets_bare(partner)) return now_;
    const Encounter pair = encounter(partner);
    const double sensed = sensed_at(partner);
    if (pair.is_near(sensed + engine_.definition_.contact_tolerance)) return now_;
    const double boxes_end = std::min(body_.box_end, engine_.sketches_[partner].end);
    return rounding::sum_down(now_, pair.meeting(boxes_end - now_, sensed + engine_.rounding_room()));
  }

 private:
  bool meets_bare(std::uint32_t partner) const { return bare_ && !engine_.bodies_[partner].is_fixed(); }
  [[gnu::always_inline]] Encounter encounter(std::uint32_t partner) const {
    MovedBound moved(engine_.bodies_[partner].bound, now_);
    if (engine_.space_.repeats()) moved.centre += engine_.shift_to_meet(number_, partner);
    return {own_, moved};
  }
  double time_for(std::uint32_t partner) const {
    return std::min({body_.box_end, engine_.sketches_[partner].end, enough_}) - now_;
  }
  /// Beyond this gap neither of the two senses the other.
  double sensed_at(std::uint32_t partner) const {
    return engine_.sensors_.any() ? engine_.reach_of_pair(body_, engine_.bodies_[partner]) : 0.0;
  }

  static constexpr double beyond_first = 2.0;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  const Engine& engine_;
  std::uint32_t number_;
  const Body& body_;
  MovedBound own_;
  double now_;
  /// It touches and senses nothing.
  bool bare_;
  double first_ = infinity;
  double enough_ = infinity;
};

}  // namespace kinesphere
