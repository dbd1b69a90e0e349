// RapidCheck searches for bounds that break a certificate, and shrinks them.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "support/bound_checks.hpp"

namespace kinesphere::certificates_test {
namespace {

/// Shrinks towards whole numbers, one and zero.
rc::Gen<double> number(int exponents) {
  return rc::gen::map(
      rc::gen::pair(rc::gen::inRange<std::int64_t>(-9000000, 9000001), rc::gen::inRange(0, exponents)),
      [](const std::pair<std::int64_t, int>& drawn) {
        return std::ldexp(static_cast<double>(drawn.first), -drawn.second);
      });
}

rc::Gen<double> size(int exponents) {
  return rc::gen::map(number(exponents), [](double x) { return std::abs(x); });
}

rc::Gen<Vec3> vector(int exponents) {
  return rc::gen::construct<Vec3>(number(exponents), number(exponents), number(exponents));
}

rc::Gen<Bound> any_bound() {
  return rc::gen::construct<Bound>(rc::gen::map(size(60), [](double age) { return -age; }), vector(40),
                                   vector(50), vector(60), size(40), size(50), size(60));
}

rc::Gen<PairCase> any_case() {
  const auto question =
      rc::gen::construct<PairCase>(any_bound(), any_bound(), size(60), size(60), number(40));
  return rc::gen::map(question, [](const PairCase& drawn) {
    PairCase c = drawn;
    c.horizon += c.from;
    return c;
  });
}

}  // namespace
}  // namespace kinesphere::certificates_test

namespace rc {
template <>
struct Arbitrary<kinesphere::PairCase> {
  static Gen<kinesphere::PairCase> arbitrary() { return kinesphere::certificates_test::any_case(); }
};
}  // namespace rc

namespace kinesphere::certificates_test {
namespace {

RC_GTEST_PROP(CertificateProperty, meeting_is_never_late, (const PairCase& c)) {
  const double got = earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance);
  RC_ASSERT(exact::Wide(got) <= exact::earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance));
}

RC_GTEST_PROP(CertificateProperty, separation_is_never_late, (const PairCase& c)) {
  const double got = earliest_separation(c.a, c.b, c.from, c.horizon, c.distance);
  RC_ASSERT(exact::Wide(got) <= exact::earliest_separation(c.a, c.b, c.from, c.horizon, c.distance));
}

RC_GTEST_PROP(CertificateProperty, swept_box_contains_the_bound, (const PairCase& c)) {
  const Box box = swept_box(c.a, c.from, c.horizon);
  for (int axis = 0; axis < 3; ++axis) {
    RC_ASSERT(box.upper[axis] >= exact::farthest(c.a, axis, 1, c.from, c.horizon));
    RC_ASSERT(box.lower[axis] <= exact::farthest(c.a, axis, -1, c.from, c.horizon));
  }
}

RC_GTEST_PROP(CertificateProperty, gap_limits_enclose_the_gap, (const PairCase& c)) {
  const GapLimits got = gap_limits(c.a, c.b, c.from);
  const exact::Gaps truth = exact::gap_limits(c.a, c.b, c.from);
  RC_ASSERT(got.lower <= truth.lower);
  RC_ASSERT(got.upper >= truth.upper);
}

}  // namespace
}  // namespace kinesphere::certificates_test
