// `kinesphere-bench gas` with tiny sizes: every packing has its row.
#include "program/support.hpp"
#include "research/tests/bench/bench_table.hpp"

namespace kinesphere::program::bench_gas_test {
namespace {

class BenchGasTest : public ProgramTest {
 protected:
  std::vector<std::vector<std::string>> bench(const std::string& options) const {
    const ProgramRun result = run("gas --quick --output '" + path("out") + "-bench' " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("largest deviation"), std::string::npos) << result.out;
    return csv_rows(read_text(path("out-bench/gas.csv")));
  }
};

TEST_F(BenchGasTest, EveryPackingHasItsRow) {
  const auto table = bench("");
  ASSERT_EQ(table.size(), 11u);
  for (std::size_t row = 0; row < 10; ++row) {
    ASSERT_EQ(table[row + 1].size(), table[0].size());
    const auto number = [&](const char* column) { return std::stod(csv_cell(table, row, column)); };
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

TEST_F(BenchGasTest, DoesOnlyWhatIsAskedFor) {
  const auto table = bench("--only 25,49");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(csv_cell(table, 0, "packing"), "25");
  EXPECT_EQ(csv_cell(table, 1, "packing"), "49");
}

TEST_F(BenchGasTest, RefusesWrongOptions) {
  expect_wrong_input("gas --only 7", {"--only", "5, 10", "7"});
  expect_wrong_input("gas --quick --full", {"--full", "--quick"});
}

}  // namespace
}  // namespace kinesphere::program::bench_gas_test
