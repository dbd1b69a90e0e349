// Whether what was read of spot checks can be.
#include "processor/spot_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "number/infinity.hpp"

namespace kinesphere::spot_checks_test {
namespace {

/// What a snapshot holds of spot checks.
struct Fields {
  std::vector<double> arrivals;
  double arrived, first, checked, rarer, even, began;
};

bool is_valid(const Fields& fields, double time) {
  SpotChecks checks;
  const auto read = [&](std::vector<double>& arrivals, double& arrived, double& first, double& checked,
                        double& rarer, double& even, double& began) {
    arrivals = fields.arrivals;
    arrived = fields.arrived, first = fields.first, checked = fields.checked;
    rarer = fields.rarer, even = fields.even, began = fields.began;
  };
  SpotChecks::serialize(checks, read);
  return checks.is_valid(time);
}

TEST(SpotChecks, AreRefusedIfTheyContradictThemselves) {
  EXPECT_TRUE(SpotChecks().is_valid(0.0));
  const Fields good{{1.0, 2.0}, 2.0, 0.25, 1.5, 2.5, infinity, 0.5};
  EXPECT_TRUE(is_valid(good, 2.0));
  EXPECT_TRUE(is_valid({{}, 2.0, 0.25, 1.5, infinity, 3.0, 0.5}, 2.0));
  EXPECT_FALSE(is_valid({{1.0, 2.5}, 2.0, 0.25, 1.5, 2.5, infinity, 0.5}, 2.0))
      << "an arrival of the future: the next one would come before it";
  const auto with = [&](double Fields::*field, double value) {
    Fields fields = good;
    fields.*field = value;
    return is_valid(fields, 2.0);
  };
  for (const auto field :
       {&Fields::arrived, &Fields::first, &Fields::checked, &Fields::rarer, &Fields::even, &Fields::began})
    EXPECT_FALSE(with(field, std::nan("")));
  for (const auto field : {&Fields::arrived, &Fields::checked, &Fields::began})
    EXPECT_FALSE(with(field, 2.5)) << "it has not happened yet";
  EXPECT_FALSE(with(&Fields::first, infinity));
  EXPECT_FALSE(with(&Fields::first, -1.0));
  EXPECT_FALSE(with(&Fields::arrived, -infinity)) << "a check without an arrival is never due";
  EXPECT_FALSE(is_valid({{2.0, 1.0}, 2.0, 0.25, 1.5, 2.5, infinity, 0.5}, 2.0));
  EXPECT_FALSE(is_valid({{1.0, std::nan("")}, 2.0, 0.25, 1.5, 2.5, infinity, 0.5}, 2.0));
}

}  // namespace
}  // namespace kinesphere::spot_checks_test
