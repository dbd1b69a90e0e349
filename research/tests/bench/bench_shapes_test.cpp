// `kinesphere-bench shapes` with few pairs: the world finds every contact at its time, and the brute force
// that says so agrees with closed forms.
#include <cmath>
#include <string>

#include "research/bench/shapes/turning_pair.hpp"
#include "research/tests/bench/bench_table.hpp"

namespace kinesphere::program::bench_shapes_test {
namespace {

class BenchShapes : public BenchTest {};

TEST_F(BenchShapes, TheWorldFindsEveryContactAtItsTime) {
  const ProgramRun result = bench("shapes");
  const BenchRows table = BenchTest::table("shapes.csv");
  const bool has_fcl = result.out.find("FCL is left out") == std::string::npos;
  ASSERT_EQ(table.size(), 1u + 6u * (has_fcl ? 5u : 3u)) << result.out;
  for (std::size_t row = 0; row + 1 < table.size(); ++row) {
    const auto number = [&](const char* column) { return csv_number(table, row, column); };
    SCOPED_TRACE(csv_cell(table, row, "kind") + ", " + table[row + 1][1]);
    EXPECT_EQ(number("pairs"), 24.0);
    EXPECT_GT(number("touching"), 6.0);
    EXPECT_LT(number("touching"), 24.0);
    EXPECT_GT(number("microseconds"), 0.0);
    const std::string method = csv_cell(table, row, "method");
    if (!method.starts_with("Kinesphere")) continue;
    EXPECT_EQ(number("missed"), 0.0);
    EXPECT_LT(number("too_late"), 1e-12);
    if (method == "Kinesphere (tolerance 1e-4)") continue;
    EXPECT_EQ(number("invented"), 0.0);
    // Where a contact grazes, the time within its tolerance of 1e-9 is longest.
    EXPECT_LT(number("too_early"), 1e-6);
  }
}

TEST(TrueContact, OfADumbbellThatTurnsOnTheSpotHasAClosedForm) {
  // Its balls are 0.2 wide, 1 from the middle, and turn twice. They meet the other ball when they are so near
  // to it that cos(angle) = (1 + 1.1^2 - 0.5^2) / 2.2.
  TurningPair pair{{.parts = {{{-1, 0, 0}, {-1, 0, 0}, 0.1}, {{1, 0, 0}, {1, 0, 0}, 0.1}},
                    .rotation = {.angular_velocity = {0, 0, 12.566370614359172}}},
                   {.parts = {{.radius = 0.4}}, .start = {{0, 1.1, 0}}}};
  const auto contact = true_contact(pair);
  ASSERT_TRUE(contact && contact->exists);
  const double time = 0.125 - std::acos((1.0 + 1.1 * 1.1 - 0.25) / 2.2) / 12.566370614359172;
  EXPECT_LT(contact->from, time + 1e-13);
  EXPECT_GT(contact->to, time - 1e-13);
  EXPECT_LT(contact->to - contact->from, 1e-11);
  pair.second.start.position.y = 1.6;
  const auto none = true_contact(pair);
  EXPECT_TRUE(none && !none->exists);
}

TEST(TrueContact, OfTwoCapsulesThatCrossIsAtTheSumOfTheirRadii) {
  const RigidPart part{{0, 0, -1}, {0, 0, 1}, 0.25};
  TurningPair pair{{.parts = {part}},
                   {.parts = {part},
                    .start = {{-2, 0, 0.9}, {4, 0, 0}},
                    .rotation = {.orientation = rotation_by({1.5707963267948966, 0, 0})}}};
  const auto contact = true_contact(pair);
  ASSERT_TRUE(contact && contact->exists);
  EXPECT_NEAR(contact->from, 0.375, 1e-12);
  EXPECT_NEAR(contact->to, 0.375, 1e-12);
  // Beyond the end of the first one, by a little more than both radii.
  pair.second.start.position.z = 1.5 + 1e-6;
  const auto none = true_contact(pair);
  EXPECT_TRUE(none && !none->exists);
}

}  // namespace
}  // namespace kinesphere::program::bench_shapes_test
