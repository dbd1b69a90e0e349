// Eight boxes side by side, in whole steps: compared with another one all at once.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace kinesphere {

/// A box in steps from some corner, ends included. Rounding all coordinates down keeps overlaps: boxes with a
/// point in common have a step in common.
struct StepBox {
  using Step = std::int16_t;
  std::array<Step, 3> lower;
  std::array<Step, 3> upper;

  /// Those that are farther away than steps can tell become the least or the largest. One number beyond each
  /// of these is left, for a box that overlaps nothing.
  static constexpr Step least = std::numeric_limits<Step>::min() + 1;
  static constexpr Step largest = std::numeric_limits<Step>::max() - 1;
  static Step clamped(std::int64_t steps) {
    return static_cast<Step>(std::clamp<std::int64_t>(steps, least, largest));
  }
  static constexpr StepBox nothing() {
    constexpr Step above = largest + 1;
    constexpr Step below = least - 1;
    return {{above, above, above}, {below, below, below}};
  }

  bool overlaps(const StepBox& other) const {
    return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1] &&
           other.lower[1] <= upper[1] && lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
  }
  /// On its longest axis.
  int extent() const { return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}); }
  friend bool operator==(const StepBox&, const StepBox&) = default;
};

/// Boxes of bodies, coordinate by coordinate. A place that is free overlaps nothing.
class alignas(16) BoxBlock {
 public:
  static constexpr std::size_t width = 8;
  /// A set of places: bit k for place k.
  using Places = unsigned;

  BoxBlock() {
    for (std::size_t place = 0; place < width; ++place) clear(place);
  }

  void put(std::size_t place, const StepBox& box, std::uint32_t body) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower_[axis][place] = box.lower[axis];
      upper_[axis][place] = box.upper[axis];
    }
    bodies_[place] = body;
  }
  void clear(std::size_t place) { put(place, StepBox::nothing(), nobody); }
  bool is_free(std::size_t place) const {
    return bodies_[place] == nobody && box(place) == StepBox::nothing();
  }
  StepBox box(std::size_t place) const {
    return {{lower_[0][place], lower_[1][place], lower_[2][place]},
            {upper_[0][place], upper_[1][place], upper_[2][place]}};
  }
  std::uint32_t body(std::size_t place) const { return bodies_[place]; }

  /// A box that others are compared with.
  class Query {
   public:
    Query() = default;
    explicit Query(const StepBox& box) {
      for (std::size_t axis = 0; axis < 3; ++axis) set(axis, box.lower[axis], box.upper[axis]);
    }
    void set(std::size_t axis, StepBox::Step lower, StepBox::Step upper) {
#if defined(__SSE2__)
      lower_[axis] = _mm_set1_epi16(lower);
      upper_[axis] = _mm_set1_epi16(upper);
#else
      box_.lower[axis] = lower;
      box_.upper[axis] = upper;
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

  /// Those whose boxes overlap it.
  [[gnu::always_inline]] Places overlapping(const Query& query) const {
#if defined(__SSE2__)
    const auto apart = [&](std::size_t axis) {
      const auto load = [](const std::array<StepBox::Step, width>& steps) {
        return _mm_load_si128(reinterpret_cast<const __m128i*>(steps.data()));
      };
      return _mm_or_si128(_mm_cmpgt_epi16(load(lower_[axis]), query.upper_[axis]),
                          _mm_cmpgt_epi16(query.lower_[axis], load(upper_[axis])));
    };
    const __m128i any = _mm_or_si128(_mm_or_si128(apart(0), apart(1)), apart(2));
    return static_cast<Places>(_mm_movemask_epi8(_mm_packs_epi16(any, any)) & 0xff) ^ 0xffu;
#else
    return overlapping_one_by_one(query.box_);
#endif
  }
  /// The same without vector instructions.
  Places overlapping_one_by_one(const StepBox& query) const {
    Places places = 0;
    for (std::size_t place = 0; place < width; ++place)
      if (box(place).overlaps(query)) places |= 1u << place;
    return places;
  }

  /// Calls visit(place) for each of them.
  template <class Visit>
  static void for_each(Places places, Visit visit) {
    for (; places != 0; places &= places - 1) visit(static_cast<std::size_t>(std::countr_zero(places)));
  }

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [lower, upper, bodies] = self;
    archive(lower, upper, bodies);
  }

 private:
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

  std::array<std::array<StepBox::Step, width>, 3> lower_;
  std::array<std::array<StepBox::Step, width>, 3> upper_;
  std::array<std::uint32_t, width> bodies_;
};

}  // namespace kinesphere
