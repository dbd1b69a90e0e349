// Four numbers, one beside the other: all operations go lane by lane.
//
// FourVector does them at once with SSE2, FourPlain one by one; every lane of both has the same bits. Both
// are in single precision, and have a Precise for double precision beside them.
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
  class Precise;
  using Mask = Lanes;
  explicit FourPlain(float all) { lanes_.fill(all); }
  explicit FourPlain(const Precise& numbers);
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
  friend Mask operator>(const FourPlain& a, const FourPlain& b) {
    return where(a, b, [](float x, float y) { return x > y; });
  }
  friend Mask operator>=(const FourPlain& a, const FourPlain& b) {
    return where(a, b, [](float x, float y) { return x >= y; });
  }

 private:
  template <class Operation>
  static FourPlain each(const FourPlain& a, const FourPlain& b, Operation operation) {
    std::array<float, lane_count> lanes;
    for (std::size_t k = 0; k < lane_count; ++k) lanes[k] = operation(a.lanes_[k], b.lanes_[k]);
    return FourPlain(lanes);
  }
  template <class Comparison>
  static Mask where(const FourPlain& a, const FourPlain& b, Comparison holds) {
    Mask found = 0;
    for (std::size_t k = 0; k < lane_count; ++k)
      if (holds(a.lanes_[k], b.lanes_[k])) found |= 1u << k;
    return found;
  }

  std::array<float, lane_count> lanes_;
};

class FourPlain::Precise {
 public:
  explicit Precise(double all) { lanes_.fill(all); }
  /// Lane k of value[i] is rows[k][i].
  static std::array<Precise, 2> columns(const std::array<const double*, lane_count>& rows) {
    std::array<Precise, 2> columns{Precise(0.0), Precise(0.0)};
    for (std::size_t i = 0; i < columns.size(); ++i)
      for (std::size_t k = 0; k < lane_count; ++k) columns[i].lanes_[k] = rows[k][i];
    return columns;
  }

  friend Precise operator-(Precise a, const Precise& b) {
    for (std::size_t k = 0; k < lane_count; ++k) a.lanes_[k] -= b.lanes_[k];
    return a;
  }
  friend Precise min(Precise a, const Precise& b) {
    for (std::size_t k = 0; k < lane_count; ++k) a.lanes_[k] = std::min(a.lanes_[k], b.lanes_[k]);
    return a;
  }

 private:
  friend class FourPlain;
  std::array<double, lane_count> lanes_;
};

inline FourPlain::FourPlain(const Precise& numbers) {
  for (std::size_t k = 0; k < lane_count; ++k) lanes_[k] = static_cast<float>(numbers.lanes_[k]);
}

#if defined(__SSE2__)
class FourVector {
 public:
  class Precise;
  class Mask;
  explicit FourVector(float all) : lanes_(_mm_set1_ps(all)) {}
  explicit FourVector(const std::array<float, lane_count>& lanes) : lanes_(_mm_loadu_ps(lanes.data())) {}
  explicit FourVector(const Precise& numbers);
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
  friend Mask operator>(FourVector a, FourVector b);
  friend Mask operator>=(FourVector a, FourVector b);

 private:
  explicit FourVector(__m128 lanes) : lanes_(lanes) {}

  __m128 lanes_;
};

/// Lanes that are a set as soon as someone asks for it.
class FourVector::Mask {
 public:
  friend Mask operator&(Mask a, Mask b) { return Mask(_mm_and_ps(a.lanes_, b.lanes_)); }
  friend Mask operator|(Mask a, Mask b) { return Mask(_mm_or_ps(a.lanes_, b.lanes_)); }
  operator Lanes() const { return static_cast<Lanes>(_mm_movemask_ps(lanes_)); }

 private:
  friend Mask operator>(FourVector a, FourVector b);
  friend Mask operator>=(FourVector a, FourVector b);
  explicit Mask(__m128 lanes) : lanes_(lanes) {}

  __m128 lanes_;
};

inline FourVector::Mask operator>(FourVector a, FourVector b) {
  return FourVector::Mask(_mm_cmpgt_ps(a.lanes_, b.lanes_));
}
inline FourVector::Mask operator>=(FourVector a, FourVector b) {
  return FourVector::Mask(_mm_cmpge_ps(a.lanes_, b.lanes_));
}

class FourVector::Precise {
 public:
  explicit Precise(double all) : low_(_mm_set1_pd(all)), high_(low_) {}
  static std::array<Precise, 2> columns(const std::array<const double*, lane_count>& rows) {
    const __m128d a = _mm_loadu_pd(rows[0]);
    const __m128d b = _mm_loadu_pd(rows[1]);
    const __m128d c = _mm_loadu_pd(rows[2]);
    const __m128d d = _mm_loadu_pd(rows[3]);
    return {Precise(_mm_unpacklo_pd(a, b), _mm_unpacklo_pd(c, d)),
            Precise(_mm_unpackhi_pd(a, b), _mm_unpackhi_pd(c, d))};
  }

  friend Precise operator-(Precise a, Precise b) {
    return Precise(_mm_sub_pd(a.low_, b.low_), _mm_sub_pd(a.high_, b.high_));
  }
  friend Precise min(Precise a, Precise b) {
    return Precise(_mm_min_pd(a.low_, b.low_), _mm_min_pd(a.high_, b.high_));
  }

 private:
  friend class FourVector;
  Precise(__m128d low, __m128d high) : low_(low), high_(high) {}

  __m128d low_, high_;
};

inline FourVector::FourVector(const Precise& numbers)
    : lanes_(_mm_movelh_ps(_mm_cvtpd_ps(numbers.low_), _mm_cvtpd_ps(numbers.high_))) {}
using Four = FourVector;
#else
using Four = FourPlain;
#endif

}  // namespace kinesphere
