// Eight boxes side by side, in whole steps, compared with another box all at once.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace kinesphere {

/// StepBox is a box in whole steps, ends included, with the last 16 bits of each coordinate. That is enough
/// to compare it with boxes that lie within `farthest` steps of it. All coordinates are rounded down, which
/// keeps overlaps: boxes with a point in common have a step in common.
struct StepBox {
  using Step = std::uint16_t;
  static constexpr int farthest = 0x7fff;

  std::array<Step, 3> lower;
  std::array<Step, 3> upper;

  bool overlaps(const StepBox& other) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (is_after(lower[axis], other.upper[axis]) || is_after(other.lower[axis], upper[axis])) return false;
    return true;
  }
  friend bool operator==(const StepBox&, const StepBox&) = default;

 private:
  static bool is_after(Step a, Step b) { return static_cast<Step>(b - a) > farthest; }
};

/// BoxBlock holds the boxes of up to eight bodies, coordinate by coordinate, in two cache lines. The owner of
/// the block keeps the number of places in use.
class alignas(64) BoxBlock {
 public:
  static constexpr std::size_t width = 8;
  /// A set of places: bit k stands for place k.
  using Places = unsigned;

  /// Returns the first `count` places.
  static constexpr Places first(std::size_t count) { return (1u << count) - 1u; }

  void put(std::size_t place, const StepBox& box, std::uint32_t body) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower_[axis][place] = box.lower[axis];
      upper_[axis][place] = box.upper[axis];
    }
    bodies_[place] = body;
  }
  StepBox box(std::size_t place) const {
    return {{lower_[0][place], lower_[1][place], lower_[2][place]},
            {upper_[0][place], upper_[1][place], upper_[2][place]}};
  }
  std::uint32_t body(std::size_t place) const { return bodies_[place]; }
  /// Returns the place of a body, or `width` if it is in none of the first `count` places.
  std::size_t find(std::uint32_t body, std::size_t count = width) const {
    Places found = 0;
#if defined(__SSE2__)
    const __m128i wanted = _mm_set1_epi32(static_cast<int>(body));
    const auto equal = [&](std::size_t first) {
      return _mm_cmpeq_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(&bodies_[first])), wanted);
    };
    const __m128i any = _mm_packs_epi32(equal(0), equal(width / 2));
    found = static_cast<Places>(_mm_movemask_epi8(_mm_packs_epi16(any, any)));
#else
    for (std::size_t place = 0; place < width; ++place)
      found |= static_cast<Places>(bodies_[place] == body) << place;
#endif
    return static_cast<std::size_t>(std::countr_zero((found & first(count)) | 1u << width));
  }

  /// A box prepared for comparisons with blocks.
  class Query {
   public:
    explicit Query(const StepBox& box) {
#if defined(__SSE2__)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lower_[axis] = _mm_set1_epi16(static_cast<short>(box.lower[axis]));
        upper_[axis] = _mm_set1_epi16(static_cast<short>(box.upper[axis]));
      }
#else
      box_ = box;
#endif
    }

   private:
    friend class BoxBlock;
#if defined(__SSE2__)
    __m128i lower_[3], upper_[3];
#else
    StepBox box_;
#endif
  };

  /// Returns the places with boxes that overlap the query, places not in use included.
  [[gnu::always_inline]] Places overlapping(const Query& query) const {
#if defined(__SSE2__)
    // The sign bit of a lane is set if one box ends before the other begins.
    const auto apart = [&](std::size_t axis) {
      const auto load = [](const std::array<StepBox::Step, width>& steps) {
        return _mm_load_si128(reinterpret_cast<const __m128i*>(steps.data()));
      };
      return _mm_or_si128(_mm_sub_epi16(query.upper_[axis], load(lower_[axis])),
                          _mm_sub_epi16(load(upper_[axis]), query.lower_[axis]));
    };
    const __m128i any = _mm_or_si128(_mm_or_si128(apart(0), apart(1)), apart(2));
    return ~static_cast<Places>(_mm_movemask_epi8(_mm_packs_epi16(any, any))) & first(width);
#else
    return overlapping_one_by_one(query.box_);
#endif
  }
  /// Returns what overlapping() does, without vector instructions.
  Places overlapping_one_by_one(const StepBox& query) const {
    Places found = 0;
    for (std::size_t place = 0; place < width; ++place)
      if (box(place).overlaps(query)) found |= 1u << place;
    return found;
  }

  friend bool operator==(const BoxBlock&, const BoxBlock&) = default;

 private:
  std::array<std::array<StepBox::Step, width>, 3> lower_{};
  std::array<std::array<StepBox::Step, width>, 3> upper_{};
  std::array<std::uint32_t, width> bodies_{};
};

}  // namespace kinesphere
