// Records do not depend on the pieces of the text, and a truncated one does not swallow the next.
#include "formats/tables/record_cutter.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kinesphere::program::record_cutter_test {
namespace {

struct Cut {
  std::string text;
  std::size_t line;
  bool is_whole;
  friend bool operator==(const Cut&, const Cut&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Cut& cut) {
    return out << cut.line << (cut.is_whole ? ": " : " (not whole): ") << cut.text.substr(0, 100);
  }
};

std::vector<Cut> records_in(RecordCutter::Kind kind, std::string_view text, std::size_t at_once) {
  RecordCutter cutter(kind);
  std::vector<Cut> cuts;
  const auto add = [&](const Record& record) {
    cuts.push_back({std::string(record.text), record.line, record.is_whole});
  };
  for (std::size_t at = 0; at < text.size(); at += at_once) {
    cutter.feed(text.substr(at, at_once));
    while (const auto record = cutter.next()) add(*record);
  }
  if (const auto record = cutter.rest()) add(*record);
  return cuts;
}

void expect_records(RecordCutter::Kind kind, std::string_view text, const std::vector<Cut>& expected) {
  for (const std::size_t at_once : {1u, 2u, 3u, 7u, 64u, 100000u})
    EXPECT_EQ(records_in(kind, text, at_once), expected) << "in pieces of " << at_once;
}

TEST(RecordCutter, CutsLines) {
  const auto lines = RecordCutter::Kind::lines;
  expect_records(lines, "a,b\r\n\nc\n", {{"a,b", 1, true}, {"", 2, true}, {"c", 3, true}});
  expect_records(lines, "a\nlast", {{"a", 1, true}, {"last", 2, true}});
  expect_records(lines, "", {});
}

TEST(RecordCutter, PassesOverLinesThatAreTooLong) {
  const std::string text = "a\n" + std::string(RecordCutter::longest_line + 1000, 'x') + "\nb\n";
  for (const std::size_t at_once : {std::size_t{1000}, text.size()}) {
    const auto records = records_in(RecordCutter::Kind::lines, text, at_once);
    ASSERT_EQ(records.size(), 3u);
    EXPECT_FALSE(records[1].is_whole);
    EXPECT_EQ(records[1].line, 2u);
    EXPECT_EQ(records[2], (Cut{"b", 3, true}));
  }
}

TEST(RecordCutter, CutsDocuments) {
  const auto documents = RecordCutter::Kind::documents;
  expect_records(documents, R"({"now": 1}{"now": {"a": [1, "}"]}})",
                 {{R"({"now": 1})", 1, true}, {R"({"now": {"a": [1, "}"]}})", 1, true}});
  expect_records(
      documents, "{ \"now\" : 1,\n\"aircraft\": [\n{\"hex\": \"a\\\"b\"}\n]\n}\n\n{\"now\": 2}\n",
      {{"{ \"now\" : 1,\n\"aircraft\": [\n{\"hex\": \"a\\\"b\"}\n]\n}", 1, true}, {"{\"now\": 2}", 7, true}});
  expect_records(documents, " \n\t\r\n", {});
}

TEST(RecordCutter, GoesOnBehindDocumentsThatAreCutOff) {
  const auto documents = RecordCutter::Kind::documents;
  expect_records(documents, "{\"now\": 1, \"aircraft\": [{\"hex\"\n{ \"now\": 2}\n",
                 {{"{\"now\": 1, \"aircraft\": [{\"hex\"", 1, false}, {"{ \"now\": 2}", 2, true}});
  expect_records(documents, "{\"now\": 1, \"aircraft\": [{\"he\n{\"time\": 2}\n",
                 {{"{\"now\": 1, \"aircraft\": [{\"he", 1, false}, {"{\"time\": 2}", 2, true}});
  expect_records(documents, "noise\n{\"now\": 2}\n{\"now\"",
                 {{"noise", 1, true}, {"{\"now\": 2}", 2, true}, {"{\"now\"", 3, false}});
}

}  // namespace
}  // namespace kinesphere::program::record_cutter_test
