// Random paths: approaches and minima against plain sampling in quadruple precision, and against themselves
// on several threads and for one body.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinesphere/random.hpp"
#include "paths/path_set.hpp"

namespace kinesphere::random_paths_test {
namespace {

using Basis = PolynomialPaths::Basis;

Vec3 vector_up_to(Random& random, double most) {
  return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
}

/// Paths through [0, 10] that begin and end anywhere, with gaps and jumps, around a place far off.
PathSet random_paths(Random& random, Basis basis, std::size_t terms, std::uint32_t bodies) {
  PathSet paths{.basis = basis, .arcs = {}};
  const Vec3 far = vector_up_to(random, random.uniform() < 0.5 ? 1.0 : 1e4);
  for (std::uint32_t body = 0; body < bodies; ++body) {
    double t = random.uniform() < 0.5 ? 0.0 : random.uniform(0.0, 5.0);
    while (t < 10.0) {
      TestArc arc{body, t, std::min(10.0, t + random.uniform(0.1, 6.0)), {}};
      const double unit = basis == Basis::chebyshev ? 1.0 : arc.end - arc.begin;
      for (std::size_t k = 0; k < terms; ++k)
        arc.coefficients.push_back((k == 0 ? far : Vec3{}) +
                                   vector_up_to(random, 3.0) /
                                       ((1.0 + static_cast<double>(k * k)) * std::pow(unit, k)));
      t = arc.end;
      if (random.uniform() < 0.3) t += random.uniform(0.0, 2.0);
      paths.arcs.push_back(arc);
    }
    paths.errors.push_back(random.uniform() < 0.5 ? 0.0 : random.uniform(0.0, 0.1));
  }
  return paths;
}

/// What is known of one pair, checked at many times.
void check_pair(const PathSet& paths, const Approaches& found, std::uint32_t a, std::uint32_t b,
                double distance) {
  constexpr int samples = 400;
  constexpr double rounding = 1e-8;
  const double limit = distance + paths.errors[a] + paths.errors[b];
  const double depth = 2.0 * (paths.errors[a] + paths.errors[b]);
  std::vector<const Approaches::Approach*> of_pair;
  for (const auto& approach : found.approaches)
    if (approach.first == a && approach.second == b) of_pair.push_back(&approach);
  const auto within = [&](double t) {
    return std::find_if(of_pair.begin(), of_pair.end(),
                        [&](auto* one) { return one->begin <= t && t <= one->end; });
  };
  std::vector<double> times, distances;
  const auto check_course = [&] {
    // A dip of the samples is a minimum of the course between its neighbours.
    for (std::size_t k = 1; k + 1 < times.size(); ++k) {
      if (!(distances[k] < distances[k - 1] && distances[k] < distances[k + 1] && distances[k] < limit) ||
          depth > 0.0)
        continue;
      RC_ASSERT(
          std::any_of(found.minima.begin(), found.minima.end(), [&](const Approaches::Minimum& minimum) {
            const auto& approach = found.approaches[minimum.approach];
            return approach.first == a && approach.second == b && minimum.time >= times[k - 1] &&
                   minimum.time <= times[k + 1] && minimum.distance <= distances[k] + rounding;
          }));
    }
    times.clear(), distances.clear();
  };
  for (int k = 0; k <= samples; ++k) {
    const double t = 10.0 * k / samples;
    const auto d = paths.distance(a, b, t);
    if (!d) {
      check_course();
      RC_ASSERT(within(t) == of_pair.end());
      continue;
    }
    if (*d <= limit - rounding) RC_ASSERT(within(t) != of_pair.end());
    if (*d >= limit + rounding && within(t) != of_pair.end())
      RC_ASSERT(t == (*within(t))->begin || t == (*within(t))->end);
    times.push_back(t), distances.push_back(*d);
  }
  check_course();
}

void check_approaches(const PathSet& paths, const Approaches& found, double distance) {
  for (std::size_t k = 0; k < found.approaches.size(); ++k) {
    const auto& one = found.approaches[k];
    RC_ASSERT(one.first < one.second && one.begin <= one.end && found.minima[one.closest].approach == k);
    const double errors = paths.errors[one.first] + paths.errors[one.second];
    RC_ASSERT(one.is_certain == (found.minima[one.closest].distance + errors <= distance) ||
              std::abs(found.minima[one.closest].distance + errors - distance) < 1e-8);
  }
  double before = -1.0;
  std::size_t approach = 0;
  for (const auto& minimum : found.minima) {
    if (minimum.approach != approach) before = -1.0;
    RC_ASSERT(minimum.approach >= approach && minimum.time > before);
    approach = minimum.approach;
    before = minimum.time;
    const auto& one = found.approaches[approach];
    RC_ASSERT(one.begin <= minimum.time && minimum.time <= one.end);
    RC_ASSERT(found.minima[one.closest].distance <= minimum.distance);
    RC_ASSERT(std::abs(norm(minimum.relative_position()) - minimum.distance) < 1e-8);
  }
}

RC_GTEST_PROP(RandomPaths, NothingIsMissedOrInvented, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const auto basis = random.uniform() < 0.5 ? Basis::chebyshev : Basis::monomial;
  const auto terms = static_cast<std::size_t>(1 + random.uniform() * 12);
  const double distance = random.uniform(0.05, 2.0);
  PathSet paths = random_paths(random, basis, terms, 4);
  const Approaches found = Approaches::of(paths.view(), distance).value();
  check_approaches(paths, found, distance);
  for (std::uint32_t b = 0; b < 4; ++b)
    for (std::uint32_t a = 0; a < b; ++a) check_pair(paths, found, a, b, distance);
}

TEST(ManyPaths, ThreadsAndOneBodyChangeNothing) {
  Random random(2005);
  PathSet paths = random_paths(random, Basis::chebyshev, 6, 300);
  // Far wider than all others, so that it is not in the grid.
  for (Vec3& c : paths.arcs.front().coefficients) c *= 1000.0;
  const PolynomialPaths view = paths.view();
  const Approaches alone = Approaches::of(view, 0.1).value();
  EXPECT_GT(alone.approaches.size(), 200u);
  Workers workers = Workers::create(3).value();
  std::vector<double> progress;
  const Approaches together =
      Approaches::of(view, 0.1,
                     {.workers = &workers, .progress = [&](double done) { progress.push_back(done); }})
          .value();
  ASSERT_EQ(alone.approaches.size(), together.approaches.size());
  ASSERT_EQ(alone.minima.size(), together.minima.size());
  for (std::size_t k = 0; k < alone.approaches.size(); ++k)
    EXPECT_TRUE(alone.approaches[k] == together.approaches[k]) << k;
  for (std::size_t k = 0; k < alone.minima.size(); ++k)
    EXPECT_EQ(alone.minima[k].time, together.minima[k].time) << k;
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  ASSERT_FALSE(progress.empty());
  EXPECT_EQ(progress.back(), 1.0);

  for (const std::uint32_t body : {0u, 7u, 299u}) {
    const Approaches of_one = Approaches::of(view, 0.1, {.body = body}).value();
    std::vector<Approaches::Approach> expected;
    for (const auto& one : alone.approaches)
      if (one.first == body || one.second == body) expected.push_back(one);
    ASSERT_EQ(of_one.approaches.size(), expected.size()) << body;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(of_one.approaches[k].second, expected[k].second);
      EXPECT_NEAR(of_one.approaches[k].begin, expected[k].begin, 1e-7);
      EXPECT_NEAR(of_one.approaches[k].end, expected[k].end, 1e-7);
    }
  }
}

}  // namespace
}  // namespace kinesphere::random_paths_test
