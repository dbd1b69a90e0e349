// The box of a way contains what a bound contains, with its margin.
#include "broadphase/inflated_bound.hpp"

#include <gtest/gtest.h>

#include "support/family_test.hpp"

namespace kinesphere::inflated_bound_test {
namespace {

class Ways : public testing::TestWithParam<Family> {};

TEST_P(Ways, lie_in_their_box) {
  constexpr std::uint64_t seed = 4522;
  for (std::uint64_t k = 0; k < 500 && !HasFailure(); ++k) {
    Random random = Random::at(seed, k, 0);
    const PairCase c = GetParam().draw(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k << "\n" << c);
    const double margin = std::abs(c.distance);
    const InflatedBound bound{BoundAt(c.a, c.from), margin};
    const double duration = c.horizon - c.from;
    const Box box = bound.box_of_way(duration);
    const double errors = 0x1p-46 * (length_scale(c.a, c.horizon) + margin);
    for (const double part : {0.0, 0.25, 0.7, 1.0}) {
      const double time = c.from + duration * part;
      for (int axis = 0; axis < 3; ++axis) {
        const double reach = c.a.radius_at(time) + margin - errors;
        EXPECT_LE(box.lower[axis], c.a.centre_at(time)[axis] - reach);
        EXPECT_GE(box.upper[axis], c.a.centre_at(time)[axis] + reach);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Ways, testing::ValuesIn(all_families), family_name);

TEST(InflatedBound, OfAStraightWayIsTight) {
  const InflatedBound bound{BoundAt(Bound{.velocity = {2, -1, 0}, .radius = 0.5}, 0.0), 0.25};
  EXPECT_EQ(bound.box_of_way(4.0), (Box{{-0.75, -4.75, -0.75}, {8.75, 0.75, 0.75}}));
}

}  // namespace
}  // namespace kinesphere::inflated_bound_test
