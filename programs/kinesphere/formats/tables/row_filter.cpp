// The rows that count: --where 'EXPRESSION'.
#include "formats/tables/row_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

struct RowFilter::Node {
  enum class Kind { all_of, any_of, none_of, compare } kind = Kind::all_of;
  std::vector<Node> parts;
  std::size_t column = 0;
  std::string comparison;
  std::string value;
  std::optional<double> number;
  bool decimal_comma = false;

  bool holds(const std::vector<std::string_view>& fields) const {
    const auto part_holds = [&](const Node& part) { return part.holds(fields); };
    switch (kind) {
      case Kind::all_of:
        return std::all_of(parts.begin(), parts.end(), part_holds);
      case Kind::any_of:
        return std::any_of(parts.begin(), parts.end(), part_holds);
      case Kind::none_of:
        return std::none_of(parts.begin(), parts.end(), part_holds);
      case Kind::compare:
        break;
    }
    if (column >= fields.size()) return false;
    const std::string_view field = fields[column];
    const auto own = number ? number_field(field, decimal_comma) : std::nullopt;
    const bool equal = own ? *own == *number : same_name(field, value);
    if (comparison == "=") return equal;
    if (comparison == "!=") return !equal;
    if (!own) return false;
    if (comparison == "<") return *own < *number;
    if (comparison == "<=") return *own <= *number;
    return comparison == ">" ? *own > *number : *own >= *number;
  }
};

/// Reads an expression from left to right; `or` binds least.
class RowFilter::Parser {
 public:
  Parser(RowFilter& filter, const TableHead& head, const TableColumns& columns, std::string_view option)
      : filter_(filter), head_(head), columns_(columns), option_(option), rest_(filter.text_) {}

  Node whole() {
    Node node = any();
    if (!ahead().empty()) fail("and, or, or the end");
    return node;
  }

 private:
  struct Word {
    std::string text;
    bool is_quoted = false;
  };

  [[noreturn]] void fail(std::string_view expected) {
    throw ProgramError(fmt::format("{}: expected {} {}, but got '{}'", option_, expected,
                                   rest_.empty() ? "at the end" : fmt::format("at '{}'", rest_.substr(0, 30)),
                                   filter_.text_));
  }

  std::string_view ahead() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    return rest_;
  }
  bool take(std::string_view word) {
    if (!same_name(ahead().substr(0, word.size()), word)) return false;
    const bool is_word = lower_case(word[0]) >= 'a' && lower_case(word[0]) <= 'z';
    if (is_word && rest_.size() > word.size() && rest_[word.size()] != ' ' && rest_[word.size()] != '(')
      return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  Word word(std::string_view expected) {
    if (ahead().empty()) fail(expected);
    if (const char quote = rest_[0]; quote == '"' || quote == '\'') {
      const std::size_t end = rest_.find(quote, 1);
      if (end == std::string_view::npos) fail("a quote that ends the text");
      Word quoted{std::string(rest_.substr(1, end - 1)), true};
      rest_.remove_prefix(end + 1);
      return quoted;
    }
    const std::string_view plain = rest_.substr(0, rest_.find_first_of(" \t\r=!<>()\"'"));
    if (plain.empty()) fail(expected);
    rest_.remove_prefix(plain.size());
    return {std::string(plain), false};
  }

  Node any() {
    Node node{.kind = Node::Kind::any_of};
    do node.parts.push_back(all());
    while (take("or"));
    return node;
  }
  Node all() {
    Node node{.kind = Node::Kind::all_of};
    do node.parts.push_back(one());
    while (take("and"));
    return node;
  }
  Node one() {
    // Deeper nesting is no likely wish, and would exhaust the stack.
    constexpr int most = 100;
    if (depth_ == most) fail("at most 100 brackets in each other");
    ++depth_;
    Node node;
    if (take("not")) {
      node = {.kind = Node::Kind::none_of};
      node.parts.push_back(one());
    } else if (take("(")) {
      node = any();
      if (!take(")")) fail("')'");
    } else {
      node = comparison();
    }
    --depth_;
    return node;
  }
  Node comparison() {
    Node node{.kind = Node::Kind::compare};
    const std::string_view at = ahead();
    node.column = column(word("a column"), at);
    for (std::string_view sign : {"==", "!=", "<=", ">=", "=", "<", ">"}) {
      if (!take(sign)) continue;
      node.comparison = sign == "==" ? "=" : sign;
      break;
    }
    if (node.comparison.empty()) fail("one of = != < <= > >=");
    const Word value = word("a value");
    node.value = value.text;
    node.number = parse_number(value.text);
    node.decimal_comma = has_decimal_commas(head_.separator);
    const bool is_order = node.comparison != "=" && node.comparison != "!=";
    if (is_order && !node.number) fail(fmt::format("a number instead of '{}'", value.text));
    filter_.mentioned_.push_back(node.column);
    return node;
  }
  std::size_t column(const Word& name, std::string_view at) {
    for (std::size_t place = 0; place < head_.names.size(); ++place)
      if (same_name(head_.names[place], name.text)) return place;
    // Presets know a name with other signs between its words.
    for (std::size_t place = 0; place < head_.names.size(); ++place)
      if (!name.text.empty() && plain_name(head_.names[place]) == plain_name(name.text)) return place;
    if (const auto quantity = quantity_of_key(name.text); quantity && columns_[*quantity])
      return columns_[*quantity]->place;
    const double number = name.is_quoted ? 0.0 : parse_number(name.text).value_or(0.0);
    for (std::size_t place = 0; place < head_.columns(); ++place)
      if (number == static_cast<double>(place + 1)) return place;
    rest_ = at;
    fail(fmt::format("a column's name or number from 1 to {} (it has {})", head_.columns(), head_.text()));
  }

  RowFilter& filter_;
  const TableHead& head_;
  const TableColumns& columns_;
  std::string_view option_;
  std::string_view rest_;
  int depth_ = 0;
};

RowFilter::RowFilter(const std::string& text, const TableHead& head, const TableColumns& columns,
                     std::string_view option)
    : text_(text) {
  if (!text.empty()) root_ = std::make_shared<Node>(Parser(*this, head, columns, option).whole());
}

bool RowFilter::takes(const std::vector<std::string_view>& fields) const {
  return root_ == nullptr || root_->holds(fields);
}

bool RowFilter::mentions(std::size_t column) const {
  return std::find(mentioned_.begin(), mentioned_.end(), column) != mentioned_.end();
}

std::string name_in_filter(const std::string& text) {
  if (!text.empty() && has_only(text, "_-.:/")) return text;
  return '"' + between_single_quotes(text) + '"';
}

}  // namespace kinesphere::program
