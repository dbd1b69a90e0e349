// Truth about frames in which all bodies go straight on from one place to another.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Pairs whose contact has begun, in a frame: begun[a][b] and begun[b][a].
using BegunPairs = std::vector<std::vector<bool>>;

/// StraightFrames compares contacts that have begun with the smallest distances of the centres.
class StraightFrames {
 public:
  /// Two bodies touch nearer than `touch`; distances within `margin` of it decide nothing.
  StraightFrames(double touch, double margin) : touch_(touch), margin_(margin) {}

  /// Expects that a contact has begun of each two bodies that are there, apart before the frame and within
  /// `touch` in it, and of no others that were apart.
  void expect(const std::vector<Vec3>& before, const std::vector<Vec3>& after, const BegunPairs& begun,
              const std::function<bool(std::uint32_t body)>& is_there) {
    for (std::uint32_t a = 0; a < after.size(); ++a)
      for (std::uint32_t b = a + 1; b < after.size(); ++b) {
        if (!is_there(a) || !is_there(b)) continue;
        const Vec3 from = before[b] - before[a], way = after[b] - after[a] - from;
        if (norm(from) < touch_ + margin_) continue;  // in touch since an earlier frame, or as it came
        const double square = norm_squared(way);
        const double nearest = square > 0 ? std::clamp(-dot(from, way) / square, 0.0, 1.0) : 0.0;
        const double distance = norm(from + way * nearest);
        met += distance < touch_ - margin_ ? 1 : 0;
        apart += distance > touch_ + margin_ ? 1 : 0;
        if (std::abs(distance - touch_) > margin_) {
          EXPECT_EQ(begun[a][b], distance < touch_) << a << ' ' << b;
        }
      }
  }

  std::uint64_t met = 0, apart = 0;  ///< pairs, summed over frames

 private:
  double touch_, margin_;
};

}  // namespace kinesphere
