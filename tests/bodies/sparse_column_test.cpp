// A column of values that are mostly the usual one, against a map.
#include "bodies/sparse_column.hpp"

#include <gtest/gtest.h>

#include <map>

#include "archive/fields.hpp"
#include "kinesphere/random.hpp"
#include "support/read_back.hpp"

namespace kinesphere::sparse_column_test {
namespace {

constexpr std::uint64_t seed = 5104;
constexpr double usual = 1.5;

TEST(SparseColumn, HasTheValuesOfAMap) {
  SCOPED_TRACE(seed);
  Random random(seed);
  SparseColumn<double> column(usual);
  std::map<std::uint32_t, double> expected;
  for (int step = 0; step < 2000; ++step) {
    const auto number = static_cast<std::uint32_t>(random.bits() % 50);
    const double value = random.uniform() < 0.4 ? usual : random.uniform();
    column.keep(number, value);
    expected[number] = value;
    for (std::uint32_t k = 0; k < 60; ++k)
      ASSERT_EQ(column.of(k), expected.contains(k) ? expected[k] : usual) << step << ' ' << k;
  }
  SparseColumn<double> back(usual);
  ASSERT_TRUE(read_back(column, back));
  for (std::uint32_t k = 0; k < 60; ++k) EXPECT_EQ(back.of(k), column.of(k));
}

TEST(SparseColumn, TakesNoMemoryForTheUsual) {
  SparseColumn<double> column(usual);
  column.keep(1000, usual);
  EXPECT_TRUE(column.empty());
  EXPECT_TRUE(column.is_valid(0));
  column.keep(7, 2.5);
  EXPECT_FALSE(column.empty());
  EXPECT_TRUE(column.is_valid(8));
  EXPECT_FALSE(column.is_valid(7)) << "a value of a body that is not there";
}

}  // namespace
}  // namespace kinesphere::sparse_column_test
