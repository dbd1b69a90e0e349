// `kinesphere-bench gas` with tiny sizes: every packing has its row.
#include "research/tests/bench/bench_table.hpp"

namespace kinesphere::program::bench_gas_test {
namespace {

class BenchGas : public BenchTest {};

TEST_F(BenchGas, EveryPackingHasItsRow) {
  EXPECT_NE(bench("gas").out.find("largest deviation"), std::string::npos);
  const BenchRows table = BenchTest::table("gas.csv");
  ASSERT_EQ(table.size(), 11u);
  for (std::size_t row = 0; row < 10; ++row) {
    ASSERT_EQ(table[row + 1].size(), table[0].size());
    const auto number = [&](const char* column) { return csv_number(table, row, column); };
    SCOPED_TRACE(number("packing"));
    // With so few spheres and collisions the measurement agrees with theory only roughly.
    EXPECT_NEAR(number("contacts"), 2000.0, 400.0);
    EXPECT_NEAR(number("Z") / number("Z_theory"), 1.0, 0.2);
    EXPECT_NEAR(number("Z_off"), 100.0 * (number("Z") / number("Z_theory") - 1.0), 1e-6);
    EXPECT_NEAR(number("rate_off"), 100.0 * (number("rate") / number("rate_theory") - 1.0), 1e-6);
    EXPECT_GT(number("rate_error"), 0.0);
    EXPECT_LT(number("energy_change"), 1e-11);
    EXPECT_GT(number("contacts_per_cpu_second"), 0.0);
  }
}

}  // namespace
}  // namespace kinesphere::program::bench_gas_test
