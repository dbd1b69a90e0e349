// ChangingRadii stores how the radii of bodies change with time.
//
// The rate is a part of the growth speed of the body's bound, whatever its sign: then each certificate holds
// for a radius that grows, and for one that shrinks it is early. A report gives the bound the radius that the
// body has by then.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "bodies/sparse_column.hpp"

namespace kinesphere {

struct ChangingRadius {
  double rate = 0.0;    ///< BodyDefinition::radius_rate
  double radius = 0.0;  ///< at `time` (length)
  double time = 0.0;
  double velocity_error = 0.0;  ///< the rest of the bound's growth speed
  bool is_kept = false;         ///< true for a body whose radius changes, or has changed

  double at(double now) const { return is_point(now) ? 0.0 : std::max(radius + rate * (now - time), 0.0); }
  double rate_at(double now) const { return is_point(now) ? 0.0 : rate; }
  /// A ball that has shrunk to a point stays one.
  bool is_point(double now) const { return rate < 0.0 && now >= end(); }
  /// Returns when the radius is 0. Precondition: the rate is negative.
  double end() const { return time - radius / rate; }

  friend bool operator==(const ChangingRadius&, const ChangingRadius&) = default;
};

class ChangingRadii : public SparseColumn<ChangingRadius> {
 public:
  /// Returns false as long as no radius has changed with time.
  bool any() const { return !empty(); }
  /// Returns nullptr for a body whose radius has never changed with time.
  const ChangingRadius* find(std::uint32_t number) const {
    const ChangingRadius& record = of(number);
    return record.is_kept ? &record : nullptr;
  }
  ChangingRadius* find(std::uint32_t number) {
    return const_cast<ChangingRadius*>(std::as_const(*this).find(number));
  }
};

}  // namespace kinesphere
