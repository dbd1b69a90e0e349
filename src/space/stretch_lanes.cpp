#include "space/stretch_lanes.hpp"

#include <bit>

// Without this macro, Highway 1.0 does not compile for a processor with AVX3_DL vectors and no better ones.
#ifndef HWY_WANT_AVX3_DL
#define HWY_WANT_AVX3_DL
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "space/stretch_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinesphere::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No fused operations, because every processor has to round alike.
std::size_t near_stretches(const float* const* columns, const float* stretch, const StretchRange* ranges,
                           std::size_t count, std::uint32_t* found) {
  const hn::CappedTag<float, stretch_lanes> d;
  using V = hn::Vec<decltype(d)>;
  const auto dot = [](V x, V y, V z, V u, V v, V w)
                       HWY_ATTR { return hn::Add(hn::Add(hn::Mul(x, u), hn::Mul(y, v)), hn::Mul(z, w)); };
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const V one = hn::Set(d, 1.0F), minus_one = hn::Set(d, -1.0F);
  // Keeps divisors from being 0. That moves no stretch by more than 2^-50.
  const V least_square = hn::Set(d, 0x1p-100F);
  const V x = hn::Set(d, stretch[0]), y = hn::Set(d, stretch[1]), z = hn::Set(d, stretch[2]);
  const V u = hn::Set(d, stretch[3]), v = hn::Set(d, stretch[4]), w = hn::Set(d, stretch[5]);
  const V radius = hn::Set(d, stretch[6]);
  const std::uint32_t* const begin = found;
  for (const StretchRange* range = ranges; range != ranges + count; ++range) {
    for (std::uint32_t slot = range->first; slot < range->last; slot += lanes) {
      const V dx = hn::Sub(hn::LoadU(d, columns[0] + slot), x),
              du = hn::Sub(hn::LoadU(d, columns[3] + slot), u);
      const V dy = hn::Sub(hn::LoadU(d, columns[1] + slot), y),
              dv = hn::Sub(hn::LoadU(d, columns[4] + slot), v);
      const V dz = hn::Sub(hn::LoadU(d, columns[2] + slot), z),
              dw = hn::Sub(hn::LoadU(d, columns[5] + slot), w);
      const V both = hn::Add(hn::LoadU(d, columns[6] + slot), radius);
      const V nearest =
          hn::Div(hn::Neg(dot(dx, dy, dz, du, dv, dw)), hn::Add(dot(du, dv, dw, du, dv, dw), least_square));
      const V s = hn::Min(hn::Max(nearest, minus_one), one);
      const V px = hn::Add(dx, hn::Mul(du, s)), py = hn::Add(dy, hn::Mul(dv, s)),
              pz = hn::Add(dz, hn::Mul(dw, s));
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, hn::Le(dot(px, py, pz, px, py, pz), hn::Mul(both, both)), bytes);
      std::uint32_t bits = static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
      if (range->last - slot < lanes) bits &= (std::uint32_t{1} << (range->last - slot)) - 1;
      for (; bits != 0; bits &= bits - 1)
        *found++ = slot + static_cast<std::uint32_t>(std::countr_zero(bits));
    }
  }
  return static_cast<std::size_t>(found - begin);
}

}  // namespace kinesphere::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinesphere {

HWY_EXPORT(near_stretches);

std::size_t near_stretches(const StretchColumns& columns, const std::array<float, 7>& stretch,
                           std::span<const StretchRange> ranges, std::uint32_t* found) {
  return HWY_DYNAMIC_DISPATCH(near_stretches)(columns.data(), stretch.data(), ranges.data(), ranges.size(),
                                              found);
}

}  // namespace kinesphere
#endif
