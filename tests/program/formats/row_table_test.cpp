// Rows of recordings: their fields, their lines, and heights that not all have.
#include "formats/tables/row_table.hpp"

#include <gtest/gtest.h>

namespace kinesphere::program::row_table_test {
namespace {

std::vector<std::string> fields_of(const RowTable& table, std::size_t row) {
  std::vector<std::string_view> fields;
  table.read(row, fields);
  return {fields.begin(), fields.end()};
}

TEST(RowTable, HasAFieldForEachNameInEachRow) {
  RowTable table("title", {"id", "time"});
  table.add_row(7, "a, \"b\"\nc", 0.1);
  table.begin_row(9);
  table.set(table.column_of("x"), "1.50");
  table.set(table.column_of("time"), "first");
  table.set(table.column_of("time"), "last");
  EXPECT_EQ(table.names(), (std::vector<std::string>{"id", "time", "x"}));
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(fields_of(table, 0), (std::vector<std::string>{"a, \"b\" c", "0.1", ""})) << "on one line";
  EXPECT_EQ(fields_of(table, 1), (std::vector<std::string>{"", "last", "1.50"})) << "the last text counts";
  EXPECT_EQ(table.line(0), 7u);
  EXPECT_EQ(table.line(1), 9u);
  table.forget(1);
  EXPECT_EQ(table.size(), 0u);
  EXPECT_EQ(table.column_of("time"), 1u) << "as if it were new";
}

TEST(RowTable, UsesHeightsThatAllRowsHave) {
  const auto with_heights = [](const char* first, const char* second) {
    RowTable table("title", {"id", "alt"});
    table.add_row(1, "a", first);
    table.add_row(2, "b", second);
    table.use_heights_of_all("f");
    return table;
  };
  EXPECT_EQ(with_heights("1", "2").names().size(), 2u);
  EXPECT_EQ(with_heights("", "").names().size(), 1u);
  EXPECT_TRUE(with_heights("", "").warnings.empty());
  const RowTable some = with_heights("1", "");
  EXPECT_EQ(fields_of(some, 0), std::vector<std::string>{"a"});
  EXPECT_EQ(some.warnings,
            std::vector<std::string>{"f: some points have no height (alt), so that none is used"});
}

}  // namespace
}  // namespace kinesphere::program::row_table_test
