#include "core/near_lanes.hpp"

#include <array>
#include <bit>
#include <type_traits>

#ifndef KINESPHERE_CORE_LANES_OF_MASK
#define KINESPHERE_CORE_LANES_OF_MASK
namespace kinesphere::core {

/// For each mask of eight lanes, the numbers of the lanes that it has, in four bits each, from the lowest on.
constexpr std::array<std::uint32_t, 256> lanes_of_mask = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t mask = 0; mask < 256; ++mask)
    for (std::uint32_t lane = 0, count = 0; lane < 8; ++lane)
      if ((mask >> lane & 1) != 0) table[mask] |= lane << 4 * count++;
  return table;
}();

}  // namespace kinesphere::core
#endif

// Without this macro, Highway 1.0 does not compile for a processor with AVX3_DL vectors and no better ones.
#ifndef HWY_WANT_AVX3_DL
#define HWY_WANT_AVX3_DL
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/near_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinesphere::core::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No fused operations, because every processor has to round alike; and no branch on what is found, which
// would be mispredicted.

/// Below this, products of squares underflow, and the answer is unknown.
constexpr double least = 0x1p-400;

/// The neighbours of one group, by column.
template <class V>
struct Neighbours {
  V x, y, z, time, u, v, w, radius;
};
template <class V>
struct Drifts {
  V x, y, z, growth_speed;
};

#if HWY_MAX_BYTES >= 32
using D = hn::FixedTag<double, 4>;

/// Loads two halves of a cache line of four balls, and exchanges rows and columns.
template <class V>
HWY_INLINE void columns(D d, V& a, V& b, V& c, V& e) {
  const V ab = hn::InterleaveLower(d, a, b), ba = hn::InterleaveUpper(d, a, b);
  const V ce = hn::InterleaveLower(d, c, e), ec = hn::InterleaveUpper(d, c, e);
  a = hn::ConcatLowerLower(d, ce, ab);
  b = hn::ConcatLowerLower(d, ec, ba);
  c = hn::ConcatUpperUpper(d, ce, ab);
  e = hn::ConcatUpperUpper(d, ec, ba);
}

template <class V>
HWY_INLINE Neighbours<V> load(D d, const Ball* balls, const std::uint32_t* n) {
  const Ball &a = balls[n[0]], &b = balls[n[1]], &c = balls[n[2]], &e = balls[n[3]];
  Neighbours<V> all{hn::Load(d, &a.position.x), hn::Load(d, &b.position.x), hn::Load(d, &c.position.x),
                    hn::Load(d, &e.position.x), hn::Load(d, &a.velocity.x), hn::Load(d, &b.velocity.x),
                    hn::Load(d, &c.velocity.x), hn::Load(d, &e.velocity.x)};
  columns(d, all.x, all.y, all.z, all.time);
  columns(d, all.u, all.v, all.w, all.radius);
  return all;
}
template <class V>
HWY_INLINE Drifts<V> load_drifts(D d, const Drift* drifts, const std::uint32_t* n) {
  const auto row = [=](std::uint32_t number)
                       HWY_ATTR { return hn::LoadU(d, &drifts[number].planned_acceleration.x); };
  Drifts<V> all{row(n[0]), row(n[1]), row(n[2]), row(n[3])};
  columns(d, all.x, all.y, all.z, all.growth_speed);
  return all;
}
template <class V>
HWY_INLINE V limits(D d, const Ball* balls, const std::uint32_t* n) {
  alignas(32) const double limit[4] = {balls[n[0]].acceleration_limit, balls[n[1]].acceleration_limit,
                                       balls[n[2]].acceleration_limit, balls[n[3]].acceleration_limit};
  return hn::Load(d, limit);
}
#else
using D = hn::FixedTag<double, 1>;

template <class V>
HWY_INLINE Neighbours<V> load(D d, const Ball* balls, const std::uint32_t* n) {
  const Ball& b = balls[*n];
  return {hn::Set(d, b.position.x), hn::Set(d, b.position.y), hn::Set(d, b.position.z), hn::Set(d, b.time),
          hn::Set(d, b.velocity.x), hn::Set(d, b.velocity.y), hn::Set(d, b.velocity.z), hn::Set(d, b.radius)};
}
template <class V>
HWY_INLINE Drifts<V> load_drifts(D d, const Drift* drifts, const std::uint32_t* n) {
  const Drift& drift = drifts[*n];
  const Vec3& plan = drift.planned_acceleration;
  return {hn::Set(d, plan.x), hn::Set(d, plan.y), hn::Set(d, plan.z), hn::Set(d, drift.growth_speed)};
}
template <class V>
HWY_INLINE V limits(D d, const Ball* balls, const std::uint32_t* n) {
  return hn::Set(d, balls[*n].acceleration_limit);
}
#endif
using V = hn::Vec<D>;

HWY_INLINE V image_count(D d, V way, double inverse) {
  const V rounder = hn::Set(d, 0x1.8p52);
  return hn::Sub(hn::Add(hn::Mul(way, hn::Set(d, inverse)), rounder), rounder);
}
HWY_INLINE V image(D d, V way, double period, double inverse) {
  return hn::Sub(way, hn::Mul(hn::Set(d, period), image_count(d, way, inverse)));
}
HWY_INLINE V dot(V a, V b, V c, V e, V f, V g) {
  return hn::Add(hn::Add(hn::Mul(a, e), hn::Mul(b, f)), hn::Mul(c, g));
}

using M = hn::Mask<D>;

/// Of neighbours: there are none, they repeat with the periods, or these slide as well.
enum class Images { none, repeat, slide };

HWY_INLINE std::uint32_t bits_of(D d, M mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// The balls of a group, or one ball in all lanes, at the present. `radius` includes the margin.
struct Motions {
  V x, y, z, u, v, w, radius, speed, growth;
  Drifts<V> plan;
};

HWY_INLINE Motions motion_of(D d, const NearQuery& q) {
  return {hn::Set(d, q.position.x),
          hn::Set(d, q.position.y),
          hn::Set(d, q.position.z),
          hn::Set(d, q.velocity.x),
          hn::Set(d, q.velocity.y),
          hn::Set(d, q.velocity.z),
          hn::Set(d, q.radius),
          hn::Set(d, q.speed),
          hn::Set(d, q.growth),
          {hn::Set(d, q.plan.x), hn::Set(d, q.plan.y), hn::Set(d, q.plan.z), hn::Zero(d)}};
}

/// Moves balls on to the present, for a time `since` their reports.
template <bool drifts>
HWY_INLINE Drifts<V> move_on(D d, Neighbours<V>& b, V since, const Drift* all, const std::uint32_t* n) {
  b.x = hn::Add(b.x, hn::Mul(b.u, since));
  b.y = hn::Add(b.y, hn::Mul(b.v, since));
  b.z = hn::Add(b.z, hn::Mul(b.w, since));
  if constexpr (drifts) {
    const Drifts<V> drift = load_drifts<V>(d, all, n);
    const V squared = hn::Mul(hn::Mul(hn::Set(d, 0.5), since), since);
    b.x = hn::Add(b.x, hn::Mul(drift.x, squared));
    b.y = hn::Add(b.y, hn::Mul(drift.y, squared));
    b.z = hn::Add(b.z, hn::Mul(drift.z, squared));
    b.u = hn::Add(b.u, hn::Mul(drift.x, since));
    b.v = hn::Add(b.v, hn::Mul(drift.y, since));
    b.w = hn::Add(b.w, hn::Mul(drift.z, since));
    return drift;
  }
  const V zero = hn::Zero(d);
  return {zero, zero, zero, zero};
}

/// Returns the motions of a group of balls, as Core::candidates() gives that of one.
template <bool grows, bool drifts>
HWY_INLINE Motions motions_of(D d, const Ball* balls, const std::uint32_t* n, const PairQuery& q) {
  Neighbours<V> b = load<V>(d, balls, n);
  const V since = hn::Sub(hn::Set(d, q.now), b.time);
  const Drifts<V> drift = move_on<drifts>(d, b, since, q.drifts, n);
  V radius = b.radius, speed = hn::Zero(d), limit = speed;
  if constexpr (grows) {
    limit = limits<V>(d, balls, n);
    speed = hn::Mul(limit, since);
    V growth = hn::Mul(hn::Mul(hn::Mul(hn::Set(d, 0.5), limit), since), since);
    if constexpr (drifts) {
      growth = hn::Add(growth, hn::Mul(drift.growth_speed, since));
      speed = hn::Add(speed, drift.growth_speed);
    }
    radius = hn::Add(radius, growth);
  }
  return {b.x, b.y, b.z, b.u, b.v, b.w, hn::Add(radius, hn::Set(d, q.margin)), speed, limit, drift};
}

/// The motion of a ball relative to those of a group, from the present on: the vector between the centres is
/// X + V t after a time t, and the sum of the radii, with the margin, start + (rate + growth t) t. What
/// different planned accelerations bend the way between the centres by counts as growth.
template <bool grows>
struct RelativeMotions {
  V x, y, z, u, v, w, start, rate, growth;
  V square, approach, speed;  ///< |X|^2, -X V, |V|^2
  V passing;                  ///< |X x V|^2

  template <bool drifts, Images images>
  HWY_INLINE static RelativeMotions of(D d, const Motions& own, const Ball* balls, const std::uint32_t* n,
                                       const PairQuery& q) {
    static_assert(grows || !drifts);
    Neighbours<V> b = load<V>(d, balls, n);
    const V since = hn::Sub(hn::Set(d, q.now), b.time), half = hn::Set(d, 0.5);
    const Drifts<V> drift = move_on<drifts>(d, b, since, q.drifts, n);
    RelativeMotions m;
    m.x = hn::Sub(own.x, b.x);
    m.y = hn::Sub(own.y, b.y);
    m.z = hn::Sub(own.z, b.z);
    [[maybe_unused]] V rows = hn::Zero(d);
    if constexpr (images == Images::slide) {
      rows = image_count(d, m.y, q.periods->inverse.y);
      m.x = hn::Sub(m.x, hn::Mul(hn::Set(d, q.periods->slide), rows));
    }
    if constexpr (images != Images::none) {
      m.x = image(d, m.x, q.periods->length.x, q.periods->inverse.x);
      m.y = image(d, m.y, q.periods->length.y, q.periods->inverse.y);
      m.z = image(d, m.z, q.periods->length.z, q.periods->inverse.z);
    }
    m.u = hn::Sub(own.u, b.u);
    if constexpr (images == Images::slide)
      m.u = hn::Sub(m.u, hn::Mul(hn::Set(d, q.periods->slide_speed), rows));
    m.v = hn::Sub(own.v, b.v);
    m.w = hn::Sub(own.w, b.w);
    m.start = hn::Add(b.radius, own.radius);
    if constexpr (grows) {
      const V limit = limits<V>(d, balls, n);
      m.start = hn::Add(m.start, hn::Mul(half, hn::Mul(hn::Mul(limit, since), since)));
      m.rate = hn::Add(hn::Mul(limit, since), own.speed);
      m.growth = hn::Add(limit, own.growth);
      if constexpr (drifts) {
        m.start = hn::Add(m.start, hn::Mul(drift.growth_speed, since));
        m.rate = hn::Add(m.rate, drift.growth_speed);
        const V bend =
            hn::Add(hn::Add(hn::Abs(hn::Sub(own.plan.x, drift.x)), hn::Abs(hn::Sub(own.plan.y, drift.y))),
                    hn::Abs(hn::Sub(own.plan.z, drift.z)));
        m.growth = hn::Add(m.growth, bend);
      }
      m.growth = hn::Mul(half, m.growth);
    }
    m.square = dot(m.x, m.y, m.z, m.x, m.y, m.z);
    m.approach = hn::Neg(dot(m.x, m.y, m.z, m.u, m.v, m.w));
    m.speed = dot(m.u, m.v, m.w, m.u, m.v, m.w);
    const V cx = hn::Sub(hn::Mul(m.y, m.w), hn::Mul(m.z, m.v));
    const V cy = hn::Sub(hn::Mul(m.z, m.u), hn::Mul(m.x, m.w));
    const V cz = hn::Sub(hn::Mul(m.x, m.v), hn::Mul(m.y, m.u));
    m.passing = dot(cx, cy, cz, cx, cy, cz);
    return m;
  }

  HWY_INLINE V radii(V time) const {
    if constexpr (grows) return hn::Add(start, hn::Mul(hn::Add(rate, hn::Mul(growth, time)), time));
    return start;
  }

  /// Returns which certainly stay apart for this time (QuickReject::stay_apart).
  HWY_INLINE M stay_apart(D d, V time) const {
    const V now = hn::Mul(start, start), reach = radii(time), limit = hn::Mul(reach, reach);
    const V low = hn::Set(d, least), along = hn::Sub(square, hn::Mul(approach, time));
    const M above =
        hn::And(hn::Gt(along, hn::Zero(d)), hn::Gt(hn::Mul(along, along), hn::Mul(limit, square)));
    const V ex = hn::Add(x, hn::Mul(u, time)), ey = hn::Add(y, hn::Mul(v, time)),
            ez = hn::Add(z, hn::Mul(w, time));
    const M ends_before = hn::Ge(approach, hn::Mul(speed, time));
    const M apart_at_end = hn::Gt(dot(ex, ey, ez, ex, ey, ez), limit);
    const M pass_by = hn::And(hn::Gt(passing, hn::Mul(limit, speed)), hn::Gt(speed, low));
    const M clear = hn::Or(hn::And(ends_before, apart_at_end), hn::AndNot(ends_before, pass_by));
    return hn::And(hn::And(hn::Gt(square, now), hn::Gt(square, low)),
                   hn::Or(above, hn::And(hn::Gt(square, limit), clear)));
  }
};

/// When they come within the radii and `more` (length) if the bounds do not grow; anything, where they do
/// not.
template <bool grows>
HWY_INLINE V guess_meeting(D d, const RelativeMotions<grows>& m, V more) {
  const V reach = hn::Add(m.start, more);
  const V left = hn::Sub(m.square, hn::Mul(reach, reach));
  const V root = hn::Sub(hn::Mul(m.approach, m.approach), hn::Mul(m.speed, left));
  return hn::Div(left, hn::Add(m.approach, hn::Sqrt(hn::Max(root, hn::Zero(d)))));
}

/// The same where they grow, as if the gap fell all the time as it does now, but for what bounds grow.
HWY_INLINE V guess_early_meeting(D d, const RelativeMotions<true>& m, V more) {
  const V distance = hn::Sqrt(m.square), gap = hn::Sub(distance, hn::Add(m.start, more));
  const V nearing = hn::Add(hn::Div(m.approach, distance), m.rate);
  const V square = hn::Add(hn::Mul(nearing, nearing), hn::Mul(hn::Mul(hn::Set(d, 4.0), m.growth), gap));
  return hn::Div(hn::Add(gap, gap), hn::Add(nearing, hn::Sqrt(square)));
}

/// The same by two steps of Newton's method.
HWY_INLINE V refine(D d, const RelativeMotions<true>& m, V more, V time) {
  for (int step = 0; step < 2; ++step) {
    const V reach = hn::Add(m.radii(time), more);
    const V way = hn::Sub(hn::Mul(m.speed, time), m.approach);
    const V left = hn::Sub(hn::Add(m.square, hn::Mul(hn::Sub(way, m.approach), time)), hn::Mul(reach, reach));
    const V faster = hn::Add(m.rate, hn::Mul(hn::Add(m.growth, m.growth), time));
    const V slope = hn::Sub(way, hn::Mul(reach, faster));
    time = hn::Sub(time, hn::Div(hn::Mul(hn::Set(d, 0.5), left), slope));
  }
  return time;
}

/// Returns how long those of a group certainly stay apart, 0 where that is unknown: times are guessed, and
/// then tried.
template <bool grows, bool drifts>
HWY_INLINE V stay_apart_for(D d, const RelativeMotions<grows>& pairs, const PairQuery& q) {
  // With as much again as the margin, what rounding makes of a guess does not matter.
  const V zero = hn::Zero(d), more = hn::Set(d, q.margin), near = hn::Add(pairs.start, hn::Set(d, q.near));
  const auto tried = [&](V time) HWY_ATTR {
    return hn::IfThenElseZero(hn::And(hn::Gt(time, zero), pairs.stay_apart(d, time)), time);
  };
  V time;
  if constexpr (grows) {
    const V early = guess_early_meeting(d, pairs, more);
    time = hn::Max(tried(early), tried(refine(d, pairs, more, early)));
    // Most of those that fall alike do not grow.
    if constexpr (drifts) time = hn::Max(time, tried(guess_meeting(d, pairs, more)));
  } else {
    time = tried(guess_meeting(d, pairs, more));
  }
  return hn::IfThenElseZero(hn::Gt(pairs.square, hn::Mul(near, near)), time);
}

template <bool grows, bool drifts, Images images>
HWY_INLINE std::uint32_t group(const Ball* balls, const std::uint32_t* n, const Motions& own,
                               const NearQuery& q, double* apart) {
  const D d;
  const auto pairs = RelativeMotions<grows>::template of<drifts, images>(d, own, balls, n, q.pairs);
  const M meet = hn::Not(pairs.stay_apart(d, hn::Set(d, q.duration)));
  const std::uint32_t found = bits_of(d, meet) & ((1u << hn::Lanes(d)) - 1);
  if (found != 0) hn::StoreU(stay_apart_for<grows, drifts>(d, pairs, q.pairs), d, apart);
  return found;
}

template <bool grows, bool drifts, Images images>
std::uint32_t candidates(const Ball* balls, const std::uint32_t* neighbours, std::size_t count,
                         const NearQuery& query, double* apart) {
  const std::size_t lanes = hn::Lanes(D());
  const Motions own = motion_of(D(), query);
  std::uint32_t found = 0;
  std::size_t k = 0;
  for (; k + lanes <= count; k += lanes)
    found |= group<grows, drifts, images>(balls, neighbours + k, own, query, apart + k) << k;
  if (k < count) {
    std::uint32_t rest[8];
    for (std::size_t lane = 0; lane < lanes; ++lane) rest[lane] = neighbours[k + lane < count ? k + lane : k];
    found |= (group<grows, drifts, images>(balls, rest, own, query, apart + k) & ((1u << (count - k)) - 1))
             << k;
  }
  return found;
}

/// Calls f(grows, drifts, images) with the constants that suit the world.
HWY_INLINE auto as_in_world(const PairQuery& query, auto f) {
  const auto of_space = [&](auto images) HWY_ATTR {
    const std::true_type yes;
    const std::false_type no;
    if (query.drifts != nullptr) return f(yes, yes, images);
    return query.grows ? f(yes, no, images) : f(no, no, images);
  };
  if (!query.periods->any) return of_space(std::integral_constant<Images, Images::none>());
  return query.periods->slides ? of_space(std::integral_constant<Images, Images::slide>())
                               : of_space(std::integral_constant<Images, Images::repeat>());
}

std::uint32_t may_meet(const Ball* balls, const std::uint32_t* neighbours, std::size_t count,
                       const NearQuery& query, double* apart) {
  return as_in_world(query.pairs, [&](auto grows, auto drifts, auto images) HWY_ATTR {
    return candidates<grows, drifts, images>(balls, neighbours, count, query, apart);
  });
}

template <bool grows, bool drifts, Images images>
HWY_INLINE V group_apart(D d, const Ball* balls, const std::uint32_t* first, const std::uint32_t* second,
                         const PairQuery& q) {
  const Motions own = motions_of<grows, drifts>(d, balls, first, q);
  const auto pairs = RelativeMotions<grows>::template of<drifts, images>(d, own, balls, second, q);
  double ends[hn::MaxLanes(d)];
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) ends[lane] = balls[first[lane]].own;
  const M apart = pairs.stay_apart(d, hn::Sub(hn::LoadU(d, ends), hn::Set(d, q.now)));
  const V never = hn::Inf(d);
  if (hn::AllTrue(d, apart)) return never;
  return hn::IfThenElse(apart, never, stay_apart_for<grows, drifts>(d, pairs, q));
}

void pairs_stay_apart(const Ball* balls, const std::uint32_t* first, const std::uint32_t* second,
                      std::size_t count, const PairQuery& query, double* apart) {
  as_in_world(query, [&](auto grows, auto drifts, auto images) HWY_ATTR {
    const D d;
    for (std::size_t k = 0; k < count; k += hn::Lanes(d))
      hn::StoreU(group_apart<grows, drifts, images>(d, balls, first + k, second + k, query), d, apart + k);
  });
}

/// Loads the safe regions of a group: their centres and radii (region units).
struct Regions {
  V x, y, z, radius;
};
#if HWY_MAX_BYTES >= 32
HWY_INLINE Regions load_regions(D d, const Ball* balls, const std::uint32_t* n) {
  const hn::Rebind<float, D> half;
  const auto row = [=](std::uint32_t number)
                       HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(half, balls[number].centre)); };
  Regions all{row(n[0]), row(n[1]), row(n[2]), row(n[3])};
  columns(d, all.x, all.y, all.z, all.radius);
  return all;
}
#else
HWY_INLINE Regions load_regions(D d, const Ball* balls, const std::uint32_t* n) {
  const Ball& b = balls[*n];
  return {hn::Set(d, double{b.centre[0]}), hn::Set(d, double{b.centre[1]}), hn::Set(d, double{b.centre[2]}),
          hn::Set(d, double{b.region})};
}
#endif

/// Core::stays_inside() for balls that go straight on and whose bounds do not grow, with its first guess.
HWY_INLINE V group_stays(D d, const Ball* balls, const std::uint32_t* n, const StayQuery& query) {
  Neighbours<V> b = load<V>(d, balls, n);
  move_on<false>(d, b, hn::Sub(hn::Set(d, query.now), b.time), nullptr, n);
  const Regions region = load_regions(d, balls, n);
  const V unit = hn::Set(d, query.unit), zero = hn::Zero(d);
  const V x = hn::Sub(b.x, hn::Add(hn::Mul(region.x, unit), hn::Set(d, query.origin.x)));
  const V y = hn::Sub(b.y, hn::Add(hn::Mul(region.y, unit), hn::Set(d, query.origin.y)));
  const V z = hn::Sub(b.z, hn::Add(hn::Mul(region.z, unit), hn::Set(d, query.origin.z)));
  const V room = hn::Sub(hn::Mul(region.radius, unit), hn::Set(d, query.margin));
  const V qq = dot(x, y, z, x, y, z), qv = dot(x, y, z, b.u, b.v, b.w),
          vv = dot(b.u, b.v, b.w, b.u, b.v, b.w);
  const V squared_room = hn::Mul(room, room), left = hn::Sub(squared_room, qq);
  const V root = hn::Sqrt(hn::Add(hn::Mul(qv, qv), hn::Mul(vv, left)));
  const M outwards = hn::Gt(qv, zero);
  const V above = hn::IfThenElse(outwards, left, hn::Sub(root, qv));
  const V below = hn::IfThenElse(outwards, hn::Add(root, qv), vv);
  const V guess = hn::Mul(hn::Set(d, 1.0 - 0x1p-30), hn::Div(above, below));
  const V way = hn::Mul(vv, guess);
  const V square = hn::Add(qq, hn::Mul(hn::Add(hn::Add(qv, qv), way), guess));
  const V size = hn::Add(qq, hn::Mul(hn::Add(hn::Add(hn::Abs(qv), hn::Abs(qv)), way), guess));
  const V rounding = hn::Mul(hn::Set(d, 0x1p-48), size);
  const M is_inside = hn::And(hn::Gt(room, zero), hn::Lt(qq, squared_room));
  const M is_certain =
      hn::And(hn::And(hn::Eq(limits<V>(d, balls, n), zero), hn::Ge(vv, hn::Set(d, 0x1p-800))),
              hn::And(is_inside, hn::Lt(hn::Add(square, rounding), squared_room)));
  return hn::IfThenElse(is_certain, guess, hn::Set(d, -1.0));
}

void stays_in_flight(const Ball* balls, const std::uint32_t* numbers, std::size_t count,
                     const StayQuery& query, double* stays) {
  const D d;
  for (std::size_t k = 0; k < count; k += hn::Lanes(d))
    hn::StoreU(group_stays(d, balls, numbers + k, query), d, stays + k);
}

using F = hn::CappedTag<float, RegionBlock::lanes>;

HWY_INLINE hn::Vec<F> image(F d, hn::Vec<F> way, float period, float inverse) {
  const auto rounder = hn::Set(d, 0x1.8p23F);
  const auto whole = hn::Sub(hn::Add(hn::Mul(way, hn::Set(d, inverse)), rounder), rounder);
  return hn::Sub(way, hn::Mul(hn::Set(d, period), whole));
}

template <bool repeats>
std::size_t within_reach(const RegionBlock* blocks, const BallBlock* balls, const std::uint32_t* places,
                         std::size_t count, const RegionQuery& q, const FloatPeriods& p,
                         std::uint32_t* found) {
  const F d;
  const hn::Rebind<std::uint32_t, F> numbers;
  const auto shifts = hn::ShiftLeft<2>(hn::Iota(numbers, 0));
  std::size_t end = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const RegionBlock& block = blocks[places[k]];
    for (std::size_t lane = 0; lane < RegionBlock::lanes; lane += hn::Lanes(d)) {
      auto x = hn::Sub(hn::Load(d, block.x + lane), hn::Set(d, q.x));
      auto y = hn::Sub(hn::Load(d, block.y + lane), hn::Set(d, q.y));
      auto z = hn::Sub(hn::Load(d, block.z + lane), hn::Set(d, q.z));
      if constexpr (repeats) {
        x = image(d, x, p.length[0], p.inverse[0]);
        y = image(d, y, p.length[1], p.inverse[1]);
        z = image(d, z, p.length[2], p.inverse[2]);
      }
      const auto sum = hn::Add(hn::Load(d, block.reach + lane), hn::Set(d, q.reach));
      const auto square = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
      const auto near = hn::RebindMask(numbers, hn::Le(square, hn::Mul(sum, sum)));
      // Highway's own functions for this take a hundred cycles on some processors.
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(numbers, near, bits);
      const auto packed = hn::Shr(hn::Set(numbers, lanes_of_mask[bits[0]]), shifts);
      const auto order = hn::IndicesFromVec(numbers, hn::And(packed, hn::Set(numbers, hn::Lanes(d) - 1)));
      hn::StoreU(hn::TableLookupLanes(hn::Load(numbers, balls[places[k]].balls + lane), order), numbers,
                 found + end);
      end += static_cast<std::size_t>(std::popcount(bits[0]));
    }
  }
  return end;
}

std::size_t regions_within_reach(const RegionBlock* blocks, const BallBlock* balls,
                                 const std::uint32_t* places, std::size_t count, const RegionQuery& query,
                                 const FloatPeriods& periods, std::uint32_t* found) {
  return periods.any ? within_reach<true>(blocks, balls, places, count, query, periods, found)
                     : within_reach<false>(blocks, balls, places, count, query, periods, found);
}

ListMatches compare_lists(const std::uint32_t* list, std::size_t length, const std::uint32_t* present,
                          std::size_t count) {
  const hn::CappedTag<std::uint32_t, most_list_lanes> d;
  const auto first = [](std::size_t bits) {
    return bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
  };
  std::uint64_t of_list = first(length), of_present = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto number = hn::Set(d, present[k]);
    std::uint64_t same = 0;
    for (std::size_t from = 0; from < length; from += hn::Lanes(d)) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, hn::Eq(hn::LoadU(d, list + from), number), bits);
      same |= std::uint64_t{bits[0]} << from;
    }
    of_present |= static_cast<std::uint64_t>((same & first(length)) == 0) << k;
    of_list &= ~same;
  }
  return {of_list, of_present};
}

}  // namespace kinesphere::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinesphere::core {

HWY_EXPORT(may_meet);
HWY_EXPORT(pairs_stay_apart);
HWY_EXPORT(stays_in_flight);
HWY_EXPORT(regions_within_reach);
HWY_EXPORT(compare_lists);

std::uint32_t may_meet(const Ball* balls, const std::uint32_t* neighbours, std::size_t count,
                       const NearQuery& query, double* apart) {
  return HWY_DYNAMIC_DISPATCH(may_meet)(balls, neighbours, count, query, apart);
}

void pairs_stay_apart(const Ball* balls, const std::uint32_t* first, const std::uint32_t* second,
                      std::size_t count, const PairQuery& query, double* apart) {
  HWY_DYNAMIC_DISPATCH(pairs_stay_apart)(balls, first, second, count, query, apart);
}

void stays_in_flight(const Ball* balls, const std::uint32_t* numbers, std::size_t count,
                     const StayQuery& query, double* stays) {
  HWY_DYNAMIC_DISPATCH(stays_in_flight)(balls, numbers, count, query, stays);
}

std::size_t regions_within_reach(const RegionBlock* blocks, const BallBlock* balls,
                                 const std::uint32_t* places, std::size_t count, const RegionQuery& query,
                                 const FloatPeriods& periods, std::uint32_t* found) {
  return HWY_DYNAMIC_DISPATCH(regions_within_reach)(blocks, balls, places, count, query, periods, found);
}

ListMatches compare_lists(const std::uint32_t* list, std::size_t length, const std::uint32_t* present,
                          std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(compare_lists)(list, length, present, count);
}

}  // namespace kinesphere::core
#endif
