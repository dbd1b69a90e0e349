// The kernel of near_swept_spheres(), written once and compiled for each vector width.
// near_swept_spheres_plain() in swept_sphere_search_plain.cpp defines what it computes.
#include "broadphase/swept_sphere_search.hpp"

// Without this macro, Highway 1.0 does not compile for a processor with AVX3_DL vectors and no better ones.
#ifndef HWY_WANT_AVX3_DL
#define HWY_WANT_AVX3_DL
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/swept_sphere_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinesphere::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The kernel uses no fused operations, because every processor has to round alike. It does not branch on what
// it finds: whether a swept sphere is near is unpredictable, and each misprediction would wait for the whole
// chain of operations.
void near_swept_spheres(const float* const* table, const SweptSphereQuery* queries, const SlotRange* ranges,
                        std::size_t run_count, std::uint64_t* words) {
  const hn::CappedTag<float, search_lanes> d;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const auto least = hn::Set(d, swept_sphere_search::least_square);
  for (std::size_t range = 0; range < run_count; ++range) {
    const auto& [sphere, first_time, last_time] = queries[ranges[range].query];
    const auto& [centre, velocity, radius] = sphere;
    const auto x = hn::Set(d, centre[0]), y = hn::Set(d, centre[1]), z = hn::Set(d, centre[2]);
    const auto u = hn::Set(d, velocity[0]), v = hn::Set(d, velocity[1]), w = hn::Set(d, velocity[2]);
    const auto r = hn::Set(d, radius);
    const auto from = hn::Set(d, first_time), to = hn::Set(d, last_time);
    const std::uint32_t end = ranges[range].end;
    for (std::uint32_t first = ranges[range].begin; first < end; first += slots_in_a_word) {
      const std::uint32_t count = HWY_MIN(end - first, slots_in_a_word);
      std::uint64_t apart_bits = 0;
      for (std::uint32_t at = 0; at < count; at += lanes) {
        const std::uint32_t k = first + at;
        const auto dx = hn::Sub(hn::LoadU(d, table[0] + k), x);
        const auto dy = hn::Sub(hn::LoadU(d, table[1] + k), y);
        const auto dz = hn::Sub(hn::LoadU(d, table[2] + k), z);
        const auto du = hn::Sub(hn::LoadU(d, table[3] + k), u);
        const auto dv = hn::Sub(hn::LoadU(d, table[4] + k), v);
        const auto dw = hn::Sub(hn::LoadU(d, table[5] + k), w);
        const auto radii = hn::Add(hn::LoadU(d, table[6] + k), r);
        const auto xv = hn::Add(hn::Add(hn::Mul(dx, du), hn::Mul(dy, dv)), hn::Mul(dz, dw));
        const auto vv = hn::Add(hn::Add(hn::Mul(du, du), hn::Mul(dv, dv)), hn::Mul(dw, dw));
        const auto s = hn::Min(hn::Max(hn::Div(hn::Neg(xv), hn::Add(vv, least)), from), to);
        const auto px = hn::Add(dx, hn::Mul(du, s));
        const auto py = hn::Add(dy, hn::Mul(dv, s));
        const auto pz = hn::Add(dz, hn::Mul(dw, s));
        const auto square = hn::Add(hn::Add(hn::Mul(px, px), hn::Mul(py, py)), hn::Mul(pz, pz));
        const auto apart = hn::Gt(square, hn::Add(hn::Mul(radii, radii), least));
        std::array<std::uint8_t, 8> bytes{};
        hn::StoreMaskBits(d, apart, bytes.data());
        apart_bits |= std::uint64_t{static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8)} << at;
      }
      *words++ = ~apart_bits & (~std::uint64_t{0} >> (slots_in_a_word - count));
    }
  }
}

}  // namespace kinesphere::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinesphere {

HWY_EXPORT(near_swept_spheres);

void near_swept_spheres(const SweptSphereColumns& table, std::span<const SweptSphereQuery> queries,
                        std::span<const SlotRange> ranges, std::uint64_t* words) {
  HWY_DYNAMIC_DISPATCH(near_swept_spheres)(table.data(), queries.data(), ranges.data(), ranges.size(), words);
}

}  // namespace kinesphere
#endif
