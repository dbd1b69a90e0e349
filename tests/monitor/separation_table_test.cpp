// Separations are found by their classes in either order; margins cover all of a class.
#include "monitor/separation_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinesphere/random.hpp"

namespace kinesphere::separation_table_test {
namespace {

constexpr std::uint64_t seed = 5224;
constexpr std::size_t classes = 4;

Separation any_separation(Random& random) {
  const double horizontal = random.uniform(1.0, 9.0), vertical = random.uniform(1.0, 9.0);
  if (random.uniform() < 0.3) return Separation::ellipsoid(horizontal, vertical, 5.0 * random.uniform());
  if (random.uniform() < 0.5) return Separation::cylinder(horizontal, vertical);
  return Separation::well_clear(horizontal, vertical, 3.0 * random.uniform(), 10.0 * random.uniform());
}

TEST(SeparationTable, HoldsTheRulesOfEachPair) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 200; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    MonitorDefinition definition{.classes = std::vector<TrackClass>(classes)};
    for (std::size_t a = 0; a < classes; ++a)
      for (std::size_t b = a; b < classes; ++b) {
        if (random.uniform() < 0.5) continue;
        SeparationRule rule{a, b, {any_separation(random), any_separation(random)}};
        if (random.uniform() < 0.5) std::swap(rule.first_class, rule.second_class);
        definition.separations.push_back(rule);
      }
    const SeparationTable table(definition);
    std::size_t levels = 0;
    for (std::size_t a = 0; a < classes; ++a)
      for (std::size_t b = 0; b < classes; ++b) {
        EXPECT_EQ(table.between(a, b).data(), table.between(b, a).data());
        if (a <= b) levels += table.between(a, b).size();
      }
    EXPECT_EQ(levels, 2 * definition.separations.size());
    for (const auto& [a, b, rules] : definition.separations)
      for (std::size_t level = 0; level < rules.size(); ++level) {
        const Separation& rule = rules[level];
        const Components& found = table.between(a, b)[level];
        EXPECT_EQ(found.begin()->limit, rule.horizontal);
        EXPECT_EQ(found.look_ahead, rule.look_ahead);
        // The farthest offset within the separation.
        const bool is_round = rule.shape == Separation::Shape::ellipsoid;
        const double reach =
            is_round ? std::max(rule.horizontal, rule.vertical) : std::hypot(rule.horizontal, rule.vertical);
        EXPECT_GE(table.margin(a) + table.margin(b), reach);
        for (const std::size_t of : {a, b}) {
          EXPECT_GE(table.modified_tau(of), rule.modified_tau);
          EXPECT_GE(table.stretch(of), is_round ? rule.horizontal / rule.vertical : 1.0);
          if (rule.look_ahead > 0.0) {
            EXPECT_GE(table.look_ahead(of), rule.look_ahead + rule.modified_tau);
          }
        }
      }
  }
}

TEST(SeparationTable, WatchesNobodyWithoutARule) {
  const SeparationTable table({.classes = std::vector<TrackClass>(2)});
  EXPECT_TRUE(table.between(0, 1).empty());
  EXPECT_EQ(table.margin(0), 0.0);
  EXPECT_EQ(table.look_ahead(0), 0.0);
  EXPECT_EQ(table.stretch(0), 1.0);
}

}  // namespace
}  // namespace kinesphere::separation_table_test
