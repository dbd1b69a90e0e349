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
#include "broadphase/window_policy.hpp"
#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {

class SpotChecks {
 public:
  /// Bodies with names below this, the first bodies, are checked at next() however they move. All others that
  /// move are checked there once, after their arrival, and then wait for turn(), which keeps gases cheap.
  static constexpr std::uint32_t first_names = 32;
  /// Each body that moves is checked at the start of one of so many main windows.
  static constexpr std::uint32_t windows_between = 32;

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
    arrived_ = time;
    if (!(next_ > time && next_ <= time + first_)) next_ = time;
  }
  /// Returns when bodies are to be checked next that is_due() chooses among all.
  double next() const { return next_; }
  /// Notes that they were checked at `time`. `any`: this concerns any body.
  void note_check(const WindowPolicy& policy, double time, bool any) {
    const int rung = std::min(policy.is_chosen() ? policy.main_rung() : 0, 0) - 6;
    first_ = std::max(power_of_two(rung), 0x1p-40 * std::abs(time));
    std::erase_if(arrivals_, [&](double arrival) { return is_old(arrival, time); });
    const double age = time - arrived_;
    next_ = !any ? infinity : arrived_ + (is_old(arrived_, time) ? 4.0 * age : first_);
    checked_ = time;
  }
  /// Returns true if a body of this name is to be checked at `time`: it is among those that have just
  /// arrived, or it stands still or is one of the first bodies, has had no report since before the last
  /// check, and the time since that report has doubled since then. Precondition: may_check().
  bool is_due(const Body& body, std::uint32_t name, double time) const {
    const double report = body.bound.time;
    if (!arrivals_.empty() && std::binary_search(arrivals_.begin(), arrivals_.end(), report))
      return is_old(report, time);
    if (name >= first_names && !body.stands_still()) return false;
    return checked_ > report && exponent_of(time - report) > exponent_of(checked_ - report);
  }
  /// Returns true if next() came only for bodies that arrive at `time`: none of them is due yet.
  bool only_plans(double time) const { return time == arrived_; }
  /// Returns false for most bodies for which is_due() is false, at less cost.
  bool may_be_due(const Body& body, std::uint32_t name) const {
    return !arrivals_.empty() || body.bound.velocity == Vec3{} || name < first_names;
  }
  /// Returns the number, modulo windows_between, to which the names of the moving bodies add up that are to
  /// be checked if windows start at `time`; nullopt unless main windows start then.
  static std::optional<std::uint32_t> turn(const WindowPolicy& policy, double time) {
    if (!policy.is_chosen()) return std::nullopt;
    const double index = time * power_of_two(-policy.main_rung());
    if (index != std::floor(index)) return std::nullopt;
    const double turn = std::fmod(index, double{windows_between});
    return static_cast<std::uint32_t>(turn < 0.0 ? turn + windows_between : turn);
  }

  static void serialize(auto& self, auto& archive) {
    archive(self.arrivals_, self.arrived_, self.first_, self.checked_, self.next_);
  }
  /// Validates values read from bytes.
  bool is_valid() const {
    return first_ >= 0.0 && !std::isnan(arrived_) && !std::isnan(checked_) && !std::isnan(next_) &&
           std::is_sorted(arrivals_.begin(), arrivals_.end()) &&
           std::none_of(arrivals_.begin(), arrivals_.end(), [](double time) { return std::isnan(time); });
  }
  std::size_t bytes() const { return arrivals_.capacity() * sizeof(double); }

 private:
  /// Returns true if so much of the first interval has passed that a check says something.
  bool is_old(double arrival, double time) const { return time - arrival >= 0.5 * first_ && time > arrival; }

  std::vector<double> arrivals_{};  ///< ascending; times of arrivals that no check has served yet
  double arrived_ = -infinity;      ///< time of the last arrival
  double first_ = 0.0;              ///< the interval after an arrival until the first check (time)
  double checked_ = -infinity;
  double next_ = infinity;
};

}  // namespace kinesphere
