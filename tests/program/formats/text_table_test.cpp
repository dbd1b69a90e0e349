// Tables in text files.
#include "formats/tables/text_table.hpp"

#include <fmt/format.h>

#include "base/number_text.hpp"
#include "program/support.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program::text_table_test {
namespace {

using Fields = std::vector<std::string>;

struct Row {
  std::size_t line;
  Fields fields;
};

struct Table {
  Fields comments, header;
  std::vector<Row> rows;
};

Table parse(const std::string& text) {
  RecordCutter cutter(RecordCutter::Kind::rows);
  TextTable table("t.txt", true);
  Table result;
  const auto read = [&](const Record& record) {
    try {
      if (const auto* const fields = table.read(record))
        result.rows.push_back({record.line, {fields->begin(), fields->end()}});
    } catch (const WrongInput& error) {
      throw ProgramError(fmt::format("t.txt:{}: {}", record.line, error.what()));
    }
  };
  // Rows may come in any pieces.
  for (const char c : text) {
    cutter.feed({&c, 1});
    while (const auto record = cutter.next()) read(*record);
  }
  if (const auto record = cutter.rest()) read(*record);
  result.comments = table.head().comments;
  result.header = table.head().names;
  return result;
}

std::string error_in(const std::string& text) {
  return error_of([&] { parse(text); });
}

TEST(TextTable, FindsTheSeparator) {
  for (const char* text : {"1;2.5;x\n3;4;y\n", "1,2.5,x\n3,4,y\n", "1\t2.5\tx\n3\t4\ty\n",
                           "  1 2.5   x\r\n 3\t4 y", "\n1 ; 2.5 ; x\n\n3;4;y"}) {
    SCOPED_TRACE(text);
    const Table table = parse(text);
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[0].fields, (Fields{"1", "2.5", "x"}));
    EXPECT_EQ(table.rows[1].fields, (Fields{"3", "4", "y"}));
    EXPECT_TRUE(table.header.empty());
  }
}

TEST(TextTable, KeepsEmptyFields) {
  EXPECT_EQ(parse("1;;3;\n").rows[0].fields, (Fields{"1", "", "3", ""}));
  EXPECT_EQ(parse("1\t\t3\t\n").rows[0].fields, (Fields{"1", "", "3", ""}));
}

TEST(TextTable, ReadsQuotedFields) {
  const Table table = parse(
      "\"id\", \"x, m\" ,name\r\n\"1\",\"2\",\"a \"\"b\"\"\"\r\n3,4,\"two\r\nlines, and a #\n# "
      "more\"\r\n5,6,\"\"\r\n");
  EXPECT_EQ(table.header, (Fields{"id", "x, m", "name"}));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0].fields, (Fields{"1", "2", "a \"b\""}));
  EXPECT_EQ(table.rows[1].fields, (Fields{"3", "4", "two\r\nlines, and a #\n# more"}));
  EXPECT_EQ(table.rows[2].fields, (Fields{"5", "6", ""}));
  EXPECT_EQ(table.rows[2].line, 6u);
  // A separator in quotes does not count in the search for the separator, nor does one in the quoted first
  // line.
  EXPECT_EQ(parse("\"a;b\nc\",2\n").rows[0].fields, (Fields{"a;b\nc", "2"}));
}

TEST(TextTable, NamesTheQuoteThatIsWrong) {
  EXPECT_EQ(error_in("a,b\n1,\"2\n3,4\n"), "t.txt:2: expected a quote that ends the quoted field (column 2)");
  EXPECT_EQ(error_in("a,b\n1,2\"3\"\n"), "t.txt:2: expected quotes only around a whole field (column 2)");
  EXPECT_EQ(error_in("a,b\n\"1\"2,3\n"), "t.txt:2: expected a separator after the quoted field (column 1)");
}

TEST(TextTable, FindsTheHeader) {
  const Table plain = parse("\xEF\xBB\xBFid,x\n1,2\n");
  EXPECT_EQ(plain.header, (Fields{"id", "x"}));
  ASSERT_EQ(plain.rows.size(), 1u);
  EXPECT_EQ(plain.rows[0].line, 2u);
  const Table comment = parse("# made by hand\n# id x/m\n1\t2\n");
  EXPECT_EQ(comment.header, (Fields{"id", "x/m"}));
  EXPECT_EQ(comment.comments, (Fields{"made by hand", "id x/m"}));
  EXPECT_EQ(parse("# Ship Id,Base Date\n1,2\n").header, (Fields{"Ship Id", "Base Date"}));
  EXPECT_TRUE(parse("# made by my hand\n1 2\n").header.empty());
}

TEST(TextTable, NamesTheLineOfARowOfOtherLength) {
  EXPECT_EQ(error_in("# c\n1 2 3\n\n1 2\n"), "t.txt:4: expected 3 columns, but got 2");
  EXPECT_EQ(error_in("a;b\n1;2\n1;2;3\n"), "t.txt:3: expected 2 columns, but got 3");
  EXPECT_EQ(error_in("a;b\n1;2;3\n"),
            "t.txt:2: expected 2 columns as in the first line, but got 3 (lines above the header have to be "
            "left out "
            "or begin with #)");
}

std::vector<Fields> rows_of(const std::string& text) {
  std::vector<Fields> rows;
  for (const Row& row : parse(text).rows) rows.push_back(row.fields);
  return rows;
}

TEST(TextTable, ReadsWhatToolsWriteAroundTheRows) {
  const Table comment = parse("% id x\n1 2\n");
  EXPECT_EQ(comment.header, (Fields{"id", "x"}));
  EXPECT_EQ(parse("//id,x\n1,2\n").header, (Fields{"id", "x"}));
  EXPECT_EQ(rows_of("id,x\n1,2\n% pause\n3,4\n"), (std::vector<Fields>{{"1", "2"}, {"3", "4"}}));
  const std::string excel = "sep=;\r\nid;x\r\n1;2\r\n";
  EXPECT_EQ(parse(excel).header, (Fields{"id", "x"}));
  EXPECT_EQ(rows_of(excel), (std::vector<Fields>{{"1", "2"}}));
  EXPECT_EQ(rows_of("id|x\n1|2\n"), (std::vector<Fields>{{"1", "2"}}));
  // An empty field behind the last.
  EXPECT_EQ(rows_of("id,x\n1,2,\n3,4,\n"), (std::vector<Fields>{{"1", "2"}, {"3", "4"}}));
  // R's write.table names rows.
  const std::string named = "\"id\" \"x\"\n\"1\" \"a b\" 2\n\"2\" \"c\" 4\n";
  EXPECT_EQ(parse(named).header, (Fields{"", "id", "x"}));
  EXPECT_EQ(rows_of(named), (std::vector<Fields>{{"1", "a b", "2"}, {"2", "c", "4"}}));
  EXPECT_EQ(parse("id\tx\n\"3\"\t7\t2\n\"4\"\t8\t2\n").header, (Fields{"", "id", "x"}));
  // A column too many, or a decimal comma, is no name of a row.
  EXPECT_NE(error_in("frame x\n1 2 5\n"), "");
  EXPECT_NE(error_in("id,x\n1,2,5\n"), "");
  EXPECT_NE(error_in("time id\n2024-01-01 00:00:00 7\n"), "");
}

TEST(TextTable, WantsARow) {
  const auto error_of_file = [](const std::string& text) {
    return error_of([&] { parse_tracks({{"t.txt", text}}, {}); });
  };
  EXPECT_EQ(error_of_file(""), "t.txt: expected rows of numbers, but found none");
  EXPECT_EQ(error_of_file("# c\nid,x\n"),
            "t.txt: expected rows of numbers, but found none: its first line is 'id x'");
  EXPECT_EQ(error_of_file(std::string("1,2\n\0,3\n", 8)),
            "t.txt: expected a text file, but it has zero bytes: if it is one that was cut off, leave them "
            "out with tr -d '\\0'");
}

TEST(TextTable, NumbersAreWholeFieldsAndFinite) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500.0);
  EXPECT_EQ(parse_number("+2"), 2.0);
  for (const char* wrong : {"", "x", "1x", "1 2", "nan", "inf", "1e999", "--1", "+-1"}) {
    EXPECT_FALSE(parse_number(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace kinesphere::program::text_table_test
