// One kernel for all vector widths, compiled once for each. Its plain twin, in capsule_search_plain.cpp, says
// what it computes.
#include "window/capsule_search.hpp"

#include <array>
#include <bit>

// Without it, Highway 1.0 cannot be compiled for a processor that has these vectors and no better ones.
#ifndef HWY_WANT_AVX3_DL
#define HWY_WANT_AVX3_DL
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "window/capsule_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinesphere::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No fused operations: every processor has to round alike. Wider vectors than those of eight have been tried:
// rows are too short for them.
void near_capsules(const float* const* table, const CapsuleQuery* queries, const Run* runs,
                   std::size_t run_count, std::uint32_t* found, std::uint32_t* ends) {
  const hn::CappedTag<float, capsule_lanes> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto least = hn::Set(d, capsule_search::least_square);
  std::uint32_t* next = found;
  for (std::size_t run = 0; run < run_count; ++run) {
    const auto& [capsule, first_time, last_time] = queries[runs[run].query];
    const auto& [centre, velocity, radius] = capsule;
    const auto x = hn::Set(d, centre[0]), y = hn::Set(d, centre[1]), z = hn::Set(d, centre[2]);
    const auto u = hn::Set(d, velocity[0]), v = hn::Set(d, velocity[1]), w = hn::Set(d, velocity[2]);
    const auto r = hn::Set(d, radius);
    const auto from = hn::Set(d, first_time), to = hn::Set(d, last_time);
    const std::uint32_t end = runs[run].end;
    for (std::uint32_t k = runs[run].begin; k < end; k += static_cast<std::uint32_t>(lanes)) {
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
      hn::StoreMaskBits(d, hn::AndNot(apart, hn::FirstN(d, end - k)), bytes.data());
      for (unsigned bits = bytes[0]; bits != 0; bits &= bits - 1)
        *next++ = k + static_cast<std::uint32_t>(std::countr_zero(bits));
    }
    ends[run] = static_cast<std::uint32_t>(next - found);
  }
}

}  // namespace kinesphere::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinesphere {

HWY_EXPORT(near_capsules);

void near_capsules(const CapsuleColumns& table, std::span<const CapsuleQuery> queries,
                   std::span<const Run> runs, std::uint32_t* found, std::uint32_t* ends) {
  HWY_DYNAMIC_DISPATCH(near_capsules)(table.data(), queries.data(), runs.data(), runs.size(), found, ends);
}

}  // namespace kinesphere
#endif
