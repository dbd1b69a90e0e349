// Tests that run many cases of each family.
#pragma once

#include <gtest/gtest.h>

#include "support/bound_cases.hpp"
#include "support/test_size.hpp"

namespace kinesphere {

inline const auto cases_per_family = rounds_of<std::uint64_t>(8000);

/// `make(pair, random)` makes a printable case of each random pair.
template <std::uint64_t seed, auto make>
class FamilyTest : public testing::TestWithParam<Family> {
 protected:
  /// Calls check(case, random) for one case after the other, until one fails. Each series has its own cases.
  template <class Check>
  void for_each_case(std::uint64_t series, Check check) {
    for (std::uint64_t k = 0; k < cases_per_family; ++k) {
      Random random = Random::at(seed, k, series);
      const auto drawn = make(GetParam().draw(random), random);
      check(drawn, random);
      if (HasFailure()) FAIL() << "seed " << seed << ", case " << k << "\n" << drawn;
    }
  }
};

}  // namespace kinesphere
