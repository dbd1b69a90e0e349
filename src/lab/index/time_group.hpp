// A few times side by side: the least of them, and where a time stands.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace kinesphere {

/// Fills a cache line. All times are +infinity at first, and none is ever NaN.
class alignas(64) TimeGroup {
 public:
  static constexpr std::size_t width = 8;

  TimeGroup() { times_.fill(std::numeric_limits<double>::infinity()); }

  double operator[](std::size_t place) const { return times_[place]; }
  double& operator[](std::size_t place) { return times_[place]; }

  /// Without vectors, which could be loaded only some time after one of the times has been stored.
  double least() const {
    const auto& t = times_;
    return lesser(lesser(lesser(lesser(t[0], t[2]), t[4]), t[6]),
                  lesser(lesser(lesser(t[1], t[3]), t[5]), t[7]));
  }

  /// The first place with this time; if there is none, `width`.
  std::size_t find(double time) const {
#if defined(__SSE2__)
    const __m128d wanted = _mm_set1_pd(time);
    const auto found_at = [&](std::size_t place) {
      return _mm_castpd_si128(_mm_cmpeq_pd(_mm_load_pd(times_.data() + place), wanted));
    };
    const __m128i first_half = _mm_packs_epi32(found_at(0), found_at(2));
    const __m128i second_half = _mm_packs_epi32(found_at(4), found_at(6));
    // Two bits for each place.
    const auto found = static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(first_half, second_half)));
    return static_cast<std::size_t>(std::countr_zero(found | 1u << 2 * width)) / 2;
#else
    return find_one_by_one(time);
#endif
  }
  /// The same without vector instructions.
  std::size_t find_one_by_one(double time) const {
    std::size_t place = 0;
    while (place < width && times_[place] != time) ++place;
    return place;
  }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [times] = self;
    archive(times);
  }

 private:
  /// One instruction where std::min takes two.
  static double lesser(double a, double b) { return a < b ? a : b; }

  std::array<double, width> times_;
};

}  // namespace kinesphere
