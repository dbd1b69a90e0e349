// --where: which rows an expression takes, and how a wrong one is refused.
#include "formats/tables/row_filter.hpp"

#include "formats/tables/table_columns.hpp"
#include "program/support.hpp"

namespace kinesphere::program::row_filter_test {
namespace {

TableHead head() {
  return {.file = "t.csv",
          .names = {"who", "v class", "speed", "lost"},
          .first = {"u", "car", "1", "0"},
          .separator = ';'};
}

bool takes(const std::string& expression,
           const std::vector<std::string_view>& row = {"u", "Car", "1,5", "0"}) {
  TableColumns columns;
  columns[Quantity::id] = Column{.place = 0};
  return RowFilter(expression, head(), columns).takes(row);
}

TEST(RowFilter, ComparesColumns) {
  for (const char* held :
       {"", "lost = 0", "lost == 0.0", "speed > 1", "speed <= 1.5", "WHO = U", "id != v", "\"v class\" = car",
        "4 = 0", "not lost = 1", "lost=0 and speed=1.5", "who = \"u\"", "lost = 1 or speed = 1.5 and who = u",
        "(lost = 1 or lost = 0) and not (speed > 2 or who = v)", "who != ''", "not not lost = 0"})
    EXPECT_TRUE(takes(held)) << held;
  for (const char* other :
       {"lost = 1", "speed < 1.5", "who = v", "not (lost = 0)", "lost = 1 and lost = 0 or who = v",
        "(lost = 1 or lost = 0) and who = v", "speed > 1.5", "who > 0"})
    EXPECT_FALSE(takes(other)) << other;
  EXPECT_TRUE(takes("speed = none", {"u", "car", "none", "0"}));
  EXPECT_FALSE(takes("speed < 2", {"u", "car", "none", "0"}));
}

TEST(RowFilter, NamesWhatIsWrong) {
  const auto error = [](const std::string& expression) { return error_of([&] { takes(expression); }); };
  EXPECT_EQ(error("colour = red"),
            "--where: expected a column's name or number from 1 to 4 (it has the columns who, v class, "
            "speed, lost) at "
            "'colour = red', but got 'colour = red'");
  EXPECT_EQ(error("lost ~ 0"), "--where: expected one of = != < <= > >= at '~ 0', but got 'lost ~ 0'");
  EXPECT_EQ(error("lost ="), "--where: expected a value at the end, but got 'lost ='");
  EXPECT_EQ(error("lost = 0 who = u"),
            "--where: expected and, or, or the end at 'who = u', but got 'lost = 0 who = u'");
  EXPECT_EQ(error("(lost = 0"), "--where: expected ')' at the end, but got '(lost = 0'");
  EXPECT_EQ(error("speed < fast"),
            "--where: expected a number instead of 'fast' at the end, but got 'speed < fast'");
  EXPECT_TRUE(
      error(std::string(5000, '(')).starts_with("--where: expected at most 100 brackets in each other"));
}

}  // namespace
}  // namespace kinesphere::program::row_filter_test
