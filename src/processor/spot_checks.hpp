// SpotChecks selects exact bodies to probe although no certificate needs it.
//
// The bound of an exact body does not grow (Bound::is_exact). So the world probes such a body only where its
// bound comes near others, and would not notice that a body which promised to fly straight on has turned.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "bodies/body.hpp"
#include "broadphase/window_policy.hpp"
#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {

class SpotChecks {
 public:
  /// Bodies with names below this, the first bodies, are checked at next(), too.
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

  /// Notes that one of the first bodies was added, teleported or enabled.
  void note_arrival(double time) { arrived_ = next_ = time; }
  /// Returns when the first bodies are to be checked next.
  double next() const { return next_; }
  /// Notes that the first bodies were checked at `time`. `any`: this concerns any of them.
  void note_check(const WindowPolicy& policy, double time, bool any) {
    const int rung = std::min(policy.is_chosen() ? policy.main_rung() : 0, 0) - 6;
    const double first = std::max(power_of_two(rung), 0x1p-40 * std::abs(time));
    next_ = any ? arrived_ + (time > arrived_ ? 4.0 * (time - arrived_) : first) : infinity;
    checked_ = time;
  }
  /// Returns true if one of the first bodies is to be checked at `time`: it stands still or is among the last
  /// that arrived, and the time since its report has doubled since the last check. Precondition: may_check().
  bool is_due(const Body& body, double time) const {
    const double report = body.bound.time;
    if (report != arrived_ && !body.stands_still()) return false;
    return checked_ <= report || exponent_of(time - report) > exponent_of(checked_ - report);
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

  static void serialize(auto& self, auto& archive) { archive(self.arrived_, self.checked_, self.next_); }

 private:
  double arrived_ = -infinity;
  double checked_ = -infinity;
  double next_ = infinity;
};

}  // namespace kinesphere
