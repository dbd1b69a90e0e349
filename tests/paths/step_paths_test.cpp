// What the search for near pairs rests on: each path stays within its proven deviation, and no pair that
// comes within the distance in a step is left out.
#include "paths/step_paths.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "kinesphere/random.hpp"
#include "paths/near_pairs.hpp"
#include "paths/path_set.hpp"

namespace kinesphere::step_paths_test {
namespace {

using Basis = PolynomialPaths::Basis;

constexpr double whole = 10.0;

/// Paths of this many terms: each a single arc, or cut into two arcs that jump at the seam.
PathSet random_arcs(Random& random, Basis basis, std::size_t terms, std::uint32_t bodies) {
  PathSet paths{.basis = basis, .arcs = {}};
  const bool are_cut = random.uniform() < 0.5;
  for (std::uint32_t body = 0; body < bodies; ++body) {
    const double seam = are_cut ? random.uniform(1.0, 9.0) : whole;
    for (double begin = 0.0; begin < whole; begin = begin < seam ? seam : whole) {
      TestArc arc{body, begin, begin < seam ? seam : whole, {}};
      const double unit = basis == Basis::chebyshev ? 1.0 : arc.end - arc.begin;
      for (std::size_t k = 0; k < terms; ++k) {
        const double most = 5.0 / std::pow(unit, static_cast<double>(k));
        arc.coefficients.push_back(
            {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)});
      }
      paths.arcs.push_back(arc);
    }
  }
  return paths;
}

/// Returns the place of a body at a time by plain arithmetic, on each arc that has this time.
std::vector<Vec3> places_at(const PathSet& paths, std::uint32_t body, double t) {
  std::vector<Vec3> places;
  for (const TestArc& arc : paths.arcs) {
    if (arc.body != body || t < arc.begin || t > arc.end) continue;
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = static_cast<double>(paths.coordinate(arc, axis, t));
    places.push_back(place);
  }
  return places;
}

RC_GTEST_PROP(StepPathsOf, RandomArcsStayWithinTheirDeviation, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const auto basis = random.uniform() < 0.5 ? Basis::chebyshev : Basis::monomial;
  PathSet paths = random_arcs(random, basis, static_cast<std::size_t>(1 + random.uniform() * 8), 3);
  PoolLease alone;
  const ArcTable arcs(paths.view(), alone);
  const Steps steps = Steps::of(0.0, whole, whole / std::floor(random.uniform(1.0, 8.0)));
  StepPaths computed(arcs);
  computed.compute(steps, 0, steps.count);
  for (std::size_t step = 0; step < steps.count; ++step) {
    for (std::uint32_t body = 0; body < 3; ++body) {
      const StepPath& path = computed.at(step)[body];
      RC_ASSERT(path.exists());
      for (int k = 0; k <= 40; ++k) {
        const double x = k / 40.0;
        const double t = steps.time(step) + x * (steps.time(step + 1) - steps.time(step));
        const Vec3 on_parabola = path.begin + (path.end - path.begin) * x + path.bend * (4.0 * x * (1.0 - x));
        for (const Vec3& place : places_at(paths, body, t))
          RC_ASSERT(norm(place - on_parabola) <= path.radius + 1e-12);
      }
    }
  }
}

RC_GTEST_PROP(NearPairsOf, NoPairThatComesNearInAStepIsLeftOut, ()) {
  constexpr std::uint32_t bodies = 40;  // more than searches without a grid compare
  constexpr int samples = 100;
  const double distance = 0.5;
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  PathSet paths = random_arcs(random, Basis::chebyshev, 3, bodies);
  PoolLease alone;
  const ArcTable arcs(paths.view(), alone);
  StepPaths computed(arcs);
  computed.compute(Steps::of(0.0, whole, whole), 0, 1);
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  NearPairs(distance, {}).find(computed.at(0), [&](auto a, auto b) { found.insert({a, b}); });
  for (int k = 0; k <= samples; ++k) {
    std::vector<Vec3> places;
    for (std::uint32_t body = 0; body < bodies; ++body)
      places.push_back(places_at(paths, body, whole * k / samples).back());
    for (std::uint32_t b = 0; b < bodies; ++b)
      for (std::uint32_t a = 0; a < b; ++a)
        if (norm(places[a] - places[b]) < distance) RC_ASSERT(found.contains({a, b}));
  }
}

}  // namespace
}  // namespace kinesphere::step_paths_test
