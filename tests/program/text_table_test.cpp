// Tables in text files.
#include "text_table.hpp"

#include "support.hpp"

namespace kinesphere::program {
namespace {

using Fields = std::vector<std::string_view>;

TEST(TextTable, FindsTheSeparator) {
  for (const char* text : {"1;2.5;x\n3;4;y\n", "1,2.5,x\n3,4,y\n", "1\t2.5\tx\n3\t4\ty\n",
                           "  1 2.5   x\r\n 3\t4 y", "\n1 ; 2.5 ; x\n\n3;4;y"}) {
    SCOPED_TRACE(text);
    const TextTable table = parse_table(text, "t");
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[0].fields, (Fields{"1", "2.5", "x"}));
    EXPECT_EQ(table.rows[1].fields, (Fields{"3", "4", "y"}));
    EXPECT_TRUE(table.header.empty());
  }
}

TEST(TextTable, KeepsEmptyFields) {
  EXPECT_EQ(parse_table("1;;3;\n", "t").rows[0].fields, (Fields{"1", "", "3", ""}));
}

TEST(TextTable, FindsTheHeader) {
  const TextTable plain = parse_table("\xEF\xBB\xBFid,x\n1,2\n", "t");
  EXPECT_EQ(plain.header, (Fields{"id", "x"}));
  EXPECT_EQ(plain.rows.size(), 1u);
  EXPECT_EQ(plain.rows[0].line, 2);
  const TextTable comment = parse_table("# made by hand\n# id x/m\n1\t2\n", "t");
  EXPECT_EQ(comment.header, (Fields{"id", "x/m"}));
  EXPECT_EQ(comment.comments, (Fields{"made by hand", "id x/m"}));
  EXPECT_TRUE(parse_table("# made by my hand\n1 2\n", "t").header.empty());
}

TEST(TextTable, NamesTheLineOfARowOfOtherLength) {
  EXPECT_EQ(error_of([] { parse_table("# c\n1 2 3\n\n1 2\n", "t.txt"); }),
            "t.txt:4: expected 3 columns, but got 2");
  EXPECT_EQ(error_of([] { parse_table("a;b\n1;2;3\n", "t.txt"); }), "t.txt:2: expected 2 columns, but got 3");
}

TEST(TextTable, WantsARow) {
  EXPECT_EQ(error_of([] { parse_table("", "t.txt"); }), "t.txt: expected rows of numbers, but found none");
  EXPECT_EQ(error_of([] { parse_table("# c\nid,x\n", "t.txt"); }),
            "t.txt: expected rows of numbers, but found none");
}

TEST(TextTable, NumbersAreWholeFieldsAndFinite) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500.0);
  EXPECT_EQ(parse_number("+2"), 2.0);
  for (const char* wrong : {"", "x", "1x", "1 2", "nan", "inf", "1e999", "--1", "+-1"}) {
    EXPECT_FALSE(parse_number(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace kinesphere::program
