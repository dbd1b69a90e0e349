// SpotChecks selects exact bodies to probe although no certificate needs it.
//
// The bound of an exact body does not grow (Bound::is_exact). So the world probes such a body only where its
// bound comes near others, and would not notice that a body which promised to fly straight on has turned.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bodies/body.hpp"
#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {

class SpotChecks {
 public:
  /// Bodies with names below this, the first bodies, are checked at next() however they move. All others that
  /// move are checked there once, after their arrival, and then at their turn() and as probes_between says,
  /// which keeps gases cheap.
  static constexpr std::uint32_t first_names = 32;
  /// Those that move are also checked twice on each way of their radius, if the world then makes at least so
  /// many other probes for each of these checks.
  static constexpr std::uint64_t probes_between = 100;
  /// The exact bodies among which are those to be checked.
  struct Census {
    bool any = false;
    std::uint64_t moving = 0;
    double least_time = infinity;  ///< in which one of them goes half its radius
  };

  /// Returns true for a body whose state is known for ever if it keeps its promise and its velocity.
  static bool concerns(const Body& body) {
    return body.bound.is_exact() && body.present() && !body.is_static() && !body.is_sleeping();
  }
  /// Returns true if a body that this concerns can be checked at `time`: its report then is not known.
  static bool may_check(const Body& body, double time) {
    return concerns(body) && !body.dirty && body.change_number == Body::none && !body.fresh(time);
  }

  /// Notes that an exact body was added, teleported or enabled. A check that is due soon serves it, too: so
  /// bodies that arrive all the time cost no more than a check in each first interval.
  void note_arrival(double time) {
    if (arrivals_.empty() || arrivals_.back() != time) arrivals_.push_back(time);
    if (arrived_ == -infinity) began_ = time;
    arrived_ = time;
    if (!(rarer_ > time && rarer_ <= time + first_)) rarer_ = time;
  }
  /// Returns when bodies are to be checked next that is_due() chooses among all.
  double next() const { return std::min(rarer_, even_); }
  /// Returns true if note_check() needs a complete census: the world has made enough probes for a check.
  static bool counts(std::uint64_t probes) { return probes >= probes_between; }
  /// Adds an exact body to the census.
  static void count(Census& census, const Body& body) {
    census.any = true;
    const double speed = norm_one(body.bound.velocity) + norm_one(body.bound.planned_acceleration);
    census.moving += speed > 0.0;
    // Division only for those that are quicker than the others.
    if (speed * census.least_time > 0.5 * body.radius) census.least_time = 0.5 * body.radius / speed;
  }
  /// Notes that they were checked at `time`, until which the world has made so many probes. `pace`: a time in
  /// which bodies move noticeably among each other.
  void note_check(double pace, double time, const Census& census, std::uint64_t probes) {
    const int rung = std::clamp(exponent_of(pace), -1000, 0) - 6;
    first_ = std::max(power_of_two(rung), 0x1p-40 * std::abs(time));
    std::erase_if(arrivals_, [&](double arrival) { return is_old(arrival, time); });
    if (time >= rarer_) {
      const double age = time - arrived_;
      rarer_ = !census.any ? infinity : arrived_ + (is_old(arrived_, time) ? 4.0 * age : first_);
    }
    even_ = infinity;
    if (counts(probes) && census.moving > 0) {
      const double price = static_cast<double>(census.moving * probes_between);
      const double affordable = (time - began_) * price / static_cast<double>(probes);
      even_ = time + std::max({census.least_time, affordable, first_});
    }
    checked_ = time;
  }
  /// Returns true if a body of this name is to be checked at `time`. Then it is among those that have just
  /// arrived; or it moves, has had no report since the last check, and the world makes many probes; or it
  /// stands still or is one of the first bodies, has had no report since before the last check, and the time
  /// since that report has doubled since then. Precondition: may_check().
  bool is_due(const Body& body, std::uint32_t name, double time) const {
    if (time == arrived_) return false;
    const double report = body.bound.time;
    if (!arrivals_.empty() && std::binary_search(arrivals_.begin(), arrivals_.end(), report))
      return is_old(report, time);
    if (time >= even_ && report <= checked_) return true;
    if (name >= first_names && !body.stands_still()) return false;
    return checked_ > report && exponent_of(time - report) > exponent_of(checked_ - report);
  }
  /// Returns false if of the bodies that move only first ones can be due at `time`. None is due at the time
  /// of an arrival.
  bool may_choose_any(double time) const { return time != arrived_ && (!arrivals_.empty() || time >= even_); }
  static void serialize(auto& self, auto& archive) {
    archive(self.arrivals_, self.arrived_, self.first_, self.checked_, self.rarer_, self.even_, self.began_);
  }
  /// Validates values read from bytes: none has happened after `time`, so that times of arrivals stay in
  /// ascending order, and no sum of infinities becomes a NaN.
  bool is_valid(double time) const {
    return first_ >= 0.0 && first_ < infinity && arrived_ <= time && checked_ <= time && began_ <= time &&
           !std::isnan(rarer_) && (rarer_ == infinity || arrived_ > -infinity) && !std::isnan(even_) &&
           std::is_sorted(arrivals_.begin(), arrivals_.end()) &&
           std::all_of(arrivals_.begin(), arrivals_.end(), [=](double arrival) { return arrival <= time; });
  }
  std::size_t bytes() const { return arrivals_.capacity() * sizeof(double); }

 private:
  /// Returns true if so much of the first interval has passed that a check says something.
  bool is_old(double arrival, double time) const { return time - arrival >= 0.5 * first_ && time > arrival; }

  std::vector<double> arrivals_{};  ///< ascending; times of arrivals that no check has served yet
  double arrived_ = -infinity;      ///< time of the last arrival
  double first_ = 0.0;              ///< the interval after an arrival until the first check (time)
  double checked_ = -infinity;      ///< time of the last check
  double rarer_ = infinity;         ///< the next check of those that become rarer
  double even_ = infinity;          ///< the next check of all that move
  double began_ = -infinity;        ///< time of the first arrival
};

}  // namespace kinesphere
