// A few boxes side by side: compared with another one all at once.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// A box in single precision that contains the double one it was made from.
struct FloatBox {
  std::array<float, 3> lower;
  std::array<float, 3> upper;

  FloatBox() = default;
  FloatBox(const std::array<float, 3>& low, const std::array<float, 3>& high) : lower(low), upper(high) {}
  explicit FloatBox(const Box& box);

  bool overlaps(const FloatBox& other) const {
    return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1] &&
           other.lower[1] <= upper[1] && lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
  }
  float extent() const { return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}); }

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [low, high] = self;
    archive(low, high);
  }
  friend bool operator==(const FloatBox&, const FloatBox&) = default;
};

/// Boxes of bodies, coordinate by coordinate. A place that is free overlaps nothing.
class alignas(16) BoxBlock {
 public:
  static constexpr std::size_t width = 4;
  /// A set of places: bit k for place k.
  using Places = unsigned;

  BoxBlock() {
    for (std::size_t place = 0; place < width; ++place) clear(place);
  }

  void put(std::size_t place, const FloatBox& box, std::uint32_t body) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower_[axis][place] = box.lower[axis];
      upper_[axis][place] = box.upper[axis];
    }
    bodies_[place] = body;
  }
  void clear(std::size_t place) {
    // No comparison with it is true.
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    put(place, {{nothing, nothing, nothing}, {nothing, nothing, nothing}}, nobody);
  }
  bool is_free(std::size_t place) const { return std::isnan(lower_[0][place]) && bodies_[place] == nobody; }
  FloatBox box(std::size_t place) const {
    FloatBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[axis] = lower_[axis][place];
      box.upper[axis] = upper_[axis][place];
    }
    return box;
  }
  std::uint32_t body(std::size_t place) const { return bodies_[place]; }

  /// A box that others are compared with.
  class Query {
   public:
    explicit Query(const FloatBox& box) : box_(box) {
#if defined(__SSE2__)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lower_[axis] = _mm_set1_ps(box.lower[axis]);
        upper_[axis] = _mm_set1_ps(box.upper[axis]);
      }
#endif
    }

   private:
    friend class BoxBlock;
    FloatBox box_;
#if defined(__SSE2__)
    __m128 lower_[3], upper_[3];
#endif
  };

  /// Those whose boxes overlap, touching included.
  Places overlapping(const Query& query) const {
#if defined(__SSE2__)
    const auto on_axis = [&](std::size_t axis) {
      return _mm_and_ps(_mm_cmple_ps(_mm_load_ps(lower_[axis].data()), query.upper_[axis]),
                        _mm_cmple_ps(query.lower_[axis], _mm_load_ps(upper_[axis].data())));
    };
    return static_cast<Places>(_mm_movemask_ps(_mm_and_ps(_mm_and_ps(on_axis(0), on_axis(1)), on_axis(2))));
#else
    return overlapping_one_by_one(query);
#endif
  }
  /// The same without vector instructions.
  Places overlapping_one_by_one(const Query& query) const {
    Places places = 0;
    for (std::size_t place = 0; place < width; ++place)
      if (box(place).overlaps(query.box_)) places |= 1u << place;
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

  std::array<std::array<float, width>, 3> lower_;
  std::array<std::array<float, width>, 3> upper_;
  std::array<std::uint32_t, width> bodies_;
};

}  // namespace kinesphere
