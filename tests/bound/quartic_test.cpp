// Eq 10: its coefficients, and its first root by both solvers, against quadruple precision.
#include "bound/quartic.hpp"

#include <gtest/gtest.h>

#include "support/bound_cases.hpp"
#include "support/exact_certificates.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t seed = 10;
constexpr std::uint64_t cases = 20000;
/// (d - r1)(d - r2)(d - r3)(d - r4) times `factor`.
Quartic with_roots(double factor, double r1, double r2, double r3, double r4) {
  Quartic c{factor};
  for (const double root : {r1, r2, r3, r4})
    for (std::size_t k = 5; k-- > 0;) c[k] = (k > 0 ? c[k - 1] : 0.0) - root * c[k];
  return c;
}

struct Solver {
  const char* name;
  double (*first_root)(const Quartic&);
  double (*meeting_time)(const Bound&, const Bound&, double, double, double);
  int wrong_in_1000;  ///< the closed form loses digits where its coefficients differ much in size

  friend std::ostream& operator<<(std::ostream& out, const Solver& solver) { return out << solver.name; }
};

double numeric(const Quartic& quartic) { return first_root_numeric(quartic); }

class FirstRoot : public testing::TestWithParam<Solver> {
 protected:
  static double of(const Quartic& quartic) { return GetParam().first_root(quartic); }
};

TEST_P(FirstRoot, is_the_least_of_four) {
  for (std::uint64_t k = 0; k < cases; ++k) {
    Random random = Random::at(seed, k, 0);
    double roots[4];
    for (double& root : roots) root = random.uniform(0.5, 10.0);
    const double least = *std::min_element(roots, roots + 4);
    EXPECT_NEAR(of(with_roots(1.0, roots[0], roots[1], roots[2], roots[3])), least, 1e-3)
        << "seed " << seed << ", case " << k;
  }
}

TEST_P(FirstRoot, passes_over_negative_ones) {
  EXPECT_NEAR(of(with_roots(-1.0, -1.0, -2.0, -3.0, 4.0)), 4.0, 1e-12);
  EXPECT_NEAR(of(with_roots(1.0, -1.0, -2.0, 7.0, 4.0)), 4.0, 1e-12);
  EXPECT_EQ(of(with_roots(1.0, -1.0, -2.0, -3.0, -4.0)), infinity);
}

TEST_P(FirstRoot, of_lower_degrees) {
  EXPECT_EQ(of({1, 0, 0, 0, 0}), infinity);
  EXPECT_EQ(of({1, 1, 0, 0, 0}), infinity);
  EXPECT_DOUBLE_EQ(of({1, -2, 0, 0, 0}), 0.5);
  EXPECT_NEAR(of({6, -5, 1, 0, 0}), 2.0, 1e-14);
  EXPECT_EQ(of({1, -1, 1, 0, 0}), infinity);
  EXPECT_NEAR(of({6, -11, 6, -1, 0}), 1.0, 1e-14);
  EXPECT_NEAR(of({8, 0, 0, -1, 0}), 2.0, 1e-14);
  EXPECT_NEAR(of({4, 0, -5, 0, 1}), 1.0, 1e-14);
  EXPECT_NEAR(of({16, 0, 0, 0, -1}), 2.0, 1e-14);
}

TEST_P(FirstRoot, is_zero_where_bounds_overlap_already) {
  EXPECT_EQ(of({0, 1, 1, 1, 1}), 0.0);
  EXPECT_EQ(of({-1, 1, 1, 1, 1}), 0.0);
  EXPECT_EQ(of({std::numeric_limits<double>::quiet_NaN(), 1, 1, 1, 1}), 0.0);
}

/// Of bounds with sizes, speeds and ages as in a scene, whose meeting is no near miss.
TEST_P(FirstRoot, is_the_time_of_meeting) {
  int meetings = 0, asked = 0, wrong = 0;
  for (std::uint64_t k = 0; k < cases; ++k) {
    Random random = Random::at(seed, k, 1);
    PairCase c = families::everyday(random);
    c.distance = std::abs(c.distance);
    // A gap that is larger by 1e-6 moves the time hardly, or the pair nearly grazes.
    const auto truth = [&c](double extra) {
      return static_cast<double>(exact::earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance, extra));
    };
    const double sooner = truth(1e-6);
    const double later = truth(-1e-6);
    if (!(later - sooner < 1e-3) && later != sooner) continue;
    const double got = GetParam().meeting_time(c.a, c.b, c.from, c.horizon, c.distance);
    ++asked;
    meetings += later < infinity && later > c.from;
    if (got >= sooner && got <= later) continue;
    ASSERT_LE(++wrong * 1000, GetParam().wrong_in_1000 * static_cast<int>(cases))
        << got << " is not in [" << sooner << ", " << later << "], seed " << seed << ", case " << k << "\n"
        << c;
  }
  EXPECT_GT(asked, 10000);
  EXPECT_GT(meetings, 1000);
}

TEST_P(FirstRoot, keeps_the_horizon) {
  const Bound a{.velocity = {1, 0, 0}, .radius = 1};
  const Bound b{.position = {10, 0, 0}, .radius = 1};
  const auto meeting = GetParam().meeting_time;
  EXPECT_EQ(meeting(a, b, 0, 7.999, 0), infinity);
  EXPECT_NEAR(meeting(a, b, 0, 8.001, 0), 8.0, 1e-12);
  EXPECT_NEAR(meeting(a, b, 0, infinity, 0), 8.0, 1e-12);
  EXPECT_NEAR(meeting(a, b, 0, infinity, 2), 6.0, 1e-12);
  EXPECT_EQ(meeting(a, b, 9, infinity, 0), 9.0);
}

INSTANTIATE_TEST_SUITE_P(Solvers, FirstRoot,
                         testing::Values(Solver{"numeric", numeric, meeting_time_numeric, 0},
                                         Solver{"closed_form", first_root_closed_form,
                                                meeting_time_closed_form, 1}),
                         [](const auto& solver) { return solver.param.name; });

/// The value of the quartic is what its definition says, whatever plans and growths there are.
TEST(MeetingQuartic, is_the_square_of_eq_9) {
  for (std::uint64_t k = 0; k < cases; ++k) {
    Random random = Random::at(seed, k, 2);
    const PairCase c = families::everyday(random);
    const Quartic quartic = meeting_quartic(c.a, c.b, c.from, c.distance);
    const double d = random.uniform(0.0, 5.0);
    const double t = c.from + d;
    const double reach = c.a.radius_at(t) + c.b.radius_at(t) + c.distance;
    const double expected = norm_squared(c.a.centre_at(t) - c.b.centre_at(t)) - reach * reach;
    const double scale = length_scale(c, t);
    ASSERT_NEAR(polynomial::value(quartic, d), expected, 1e-14 * scale * scale)
        << "seed " << seed << ", case " << k << "\n"
        << c;
  }
}

/// The paper's own form: a = A_i + A_j, b = A_i (t0 - t_i) + A_j (t0 - t_j).
TEST(MeetingQuartic, is_eq_10) {
  const Bound one{
      .time = 1, .position = {1, 2, 3}, .velocity = {1, 0, -1}, .radius = 1, .growth_acceleration = 2};
  const Bound two{
      .time = 2, .position = {9, 8, 7}, .velocity = {0, 2, 0}, .radius = 2, .growth_acceleration = 4};
  // At t0 = 3: x_r = (3,2,1) - (9,10,7), v_r = (1,-2,-1), r = 1 + 4 + 2 + 2 = 9, a = 6, b = 2*2 + 4*1 = 8.
  const Quartic expected{136 - 81, 2 * (16 - 72), 6 - 54 - 64, -48, -9};
  EXPECT_EQ(meeting_quartic(one, two, 3.0), expected);
}

}  // namespace
}  // namespace kinesphere
