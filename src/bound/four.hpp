// Four single-precision numbers, one beside the other: all operations go lane by lane.
//
// FourVector does them at once with SSE2, FourPlain one by one; every lane of both has the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace kinesphere {

/// A set of lanes: bit k for lane k.
using Lanes = unsigned;
inline constexpr std::size_t lane_count = 4;
inline constexpr Lanes all_lanes = 0xfu;

class FourPlain {
 public:
  explicit FourPlain(float all) { lanes_.fill(all); }
  explicit FourPlain(const std::array<float, lane_count>& lanes) : lanes_(lanes) {}
  /// Lane k of value[i] is rows[k][i].
  static std::array<FourPlain, 4> columns(const std::array<const float*, lane_count>& rows) {
    const auto column = [&](std::size_t i) {
      return FourPlain({rows[0][i], rows[1][i], rows[2][i], rows[3][i]});
    };
    return {column(0), column(1), column(2), column(3)};
  }

  friend FourPlain operator+(const FourPlain& a, const FourPlain& b) {
    return each(a, b, [](float x, float y) { return x + y; });
  }
  friend FourPlain operator-(const FourPlain& a, const FourPlain& b) {
    return each(a, b, [](float x, float y) { return x - y; });
  }
  friend FourPlain operator*(const FourPlain& a, const FourPlain& b) {
    return each(a, b, [](float x, float y) { return x * y; });
  }
  friend FourPlain abs(const FourPlain& a) {
    return each(a, a, [](float x, float) { return std::abs(x); });
  }
  /// The value where a > b, 0 elsewhere.
  friend FourPlain if_greater(const FourPlain& a, const FourPlain& b, const FourPlain& value) {
    FourPlain result(0.0f);
    for (std::size_t k = 0; k < lane_count; ++k)
      if (a.lanes_[k] > b.lanes_[k]) result.lanes_[k] = value.lanes_[k];
    return result;
  }
  friend Lanes operator>(const FourPlain& a, const FourPlain& b) {
    Lanes found = 0;
    for (std::size_t k = 0; k < lane_count; ++k)
      if (a.lanes_[k] > b.lanes_[k]) found |= 1u << k;
    return found;
  }

 private:
  template <class Operation>
  static FourPlain each(const FourPlain& a, const FourPlain& b, Operation operation) {
    std::array<float, lane_count> lanes;
    for (std::size_t k = 0; k < lane_count; ++k) lanes[k] = operation(a.lanes_[k], b.lanes_[k]);
    return FourPlain(lanes);
  }

  std::array<float, lane_count> lanes_;
};

#if defined(__SSE2__)
class FourVector {
 public:
  explicit FourVector(float all) : lanes_(_mm_set1_ps(all)) {}
  explicit FourVector(const std::array<float, lane_count>& lanes) : lanes_(_mm_loadu_ps(lanes.data())) {}
  static std::array<FourVector, 4> columns(const std::array<const float*, lane_count>& rows) {
    __m128 a = _mm_loadu_ps(rows[0]);
    __m128 b = _mm_loadu_ps(rows[1]);
    __m128 c = _mm_loadu_ps(rows[2]);
    __m128 d = _mm_loadu_ps(rows[3]);
    _MM_TRANSPOSE4_PS(a, b, c, d);
    return {FourVector(a), FourVector(b), FourVector(c), FourVector(d)};
  }

  friend FourVector operator+(FourVector a, FourVector b) {
    return FourVector(_mm_add_ps(a.lanes_, b.lanes_));
  }
  friend FourVector operator-(FourVector a, FourVector b) {
    return FourVector(_mm_sub_ps(a.lanes_, b.lanes_));
  }
  friend FourVector operator*(FourVector a, FourVector b) {
    return FourVector(_mm_mul_ps(a.lanes_, b.lanes_));
  }
  friend FourVector abs(FourVector a) { return FourVector(_mm_andnot_ps(_mm_set1_ps(-0.0f), a.lanes_)); }
  friend FourVector if_greater(FourVector a, FourVector b, FourVector value) {
    return FourVector(_mm_and_ps(_mm_cmpgt_ps(a.lanes_, b.lanes_), value.lanes_));
  }
  friend Lanes operator>(FourVector a, FourVector b) {
    return static_cast<Lanes>(_mm_movemask_ps(_mm_cmpgt_ps(a.lanes_, b.lanes_)));
  }

 private:
  explicit FourVector(__m128 lanes) : lanes_(lanes) {}

  __m128 lanes_;
};
using Four = FourVector;
#else
using Four = FourPlain;
#endif

}  // namespace kinesphere
