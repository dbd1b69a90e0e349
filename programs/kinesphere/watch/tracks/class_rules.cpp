// Classes by the user's word: --class NAME=EXPRESSION and NAME=@FILE.
#include "watch/tracks/class_rules.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/ids/identities.hpp"
#include "formats/tables/row_reader.hpp"

namespace kinesphere::program {
namespace {

using Ids = std::unordered_set<std::string>;

/// Returns the first field of each line, in lower case.
std::shared_ptr<const Ids> ids_in(const std::string& path) {
  const auto ids = std::make_shared<Ids>();
  for (const ListedLine& line : lines_of_list(path, "--class"))
    ids->insert(in_lower_case(first_of_line(line.text)));
  return ids;
}

ClassRule parse_class_rule(const std::string& text, TrackClasses& classes) {
  const std::size_t equal = text.find('=');
  if (equal == std::string::npos || trimmed(std::string_view(text).substr(equal + 1)).empty())
    throw ProgramError(fmt::format("--class: expected CLASS=EXPRESSION or CLASS=@FILE, but got '{}'", text));
  ClassRule rule;
  rule.motion_class =
      classes.add(parse_motion_class(std::string(trimmed(std::string_view(text).substr(0, equal)))));
  rule.expression = trimmed(std::string_view(text).substr(equal + 1));
  if (rule.expression.starts_with('@')) rule.ids = ids_in(std::exchange(rule.expression, {}).substr(1));
  return rule;
}

/// The fields of reports that expressions may name.
TableHead report_head() {
  const std::vector<std::string> names{"id", "category", "type", "status", "speed"};
  return {.file = {}, .comments = {}, .names = names, .units = {}, .first = names, .separator = ','};
}

/// Rules over the columns of a table, or over the fields of reports.
class ClassRules {
 public:
  /// Throws ProgramError naming --class and what was expected.
  ClassRules(const std::vector<ClassRule>& rules, const TableHead& head, const TableColumns& columns) {
    rules_.reserve(rules.size());
    for (const ClassRule& rule : rules)
      rules_.push_back({rule.motion_class, rule.ids,
                        rule.ids ? RowFilter() : RowFilter(rule.expression, head, columns, "--class")});
  }

  /// Returns the class of the first rule that holds; 0: none.
  std::size_t class_of(std::string_view id, const std::vector<std::string_view>& fields) const {
    for (const Rule& rule : rules_)
      if (rule.ids ? rule.ids->contains(in_lower_case(id)) : rule.filter.takes(fields))
        return rule.motion_class;
    return 0;
  }

 private:
  struct Rule {
    std::size_t motion_class = 0;
    std::shared_ptr<const Ids> ids;  ///< null: the expression counts
    RowFilter filter;
  };
  std::vector<Rule> rules_;
};

class RuledFormat final : public ReportFormat, private ReportSink {
 public:
  RuledFormat(std::unique_ptr<ReportFormat> format, std::vector<ClassRule> rules, bool is_table)
      : format_(std::move(format)), rules_(std::move(rules)) {
    if (!is_table) filters_.emplace(rules_, report_head(), TableColumns());
  }

  void read(const Record& record, ReportSink& sink) override {
    sink_ = &sink;
    format_->read(record, *this);
  }
  void finish(ReportSink& sink) override {
    sink_ = &sink;
    format_->finish(*this);
  }
  const RowReader* rows() const override { return format_->rows(); }
  std::string_view title() const override { return format_->title(); }
  void save(ByteWriter& state) const override { format_->save(state); }
  void restore(ByteReader& state) override { format_->restore(state); }

 private:
  void take(const SourceReport& report) override {
    SourceReport ruled = report;
    if (report.row != nullptr) {
      // The columns are known with the first row.
      if (!filters_) filters_.emplace(rules_, report.row->head(), report.row->columns());
      ruled.ruled_class = filters_->class_of(report.id, report.row->fields());
    } else {
      speed_ = report.ground_speed ? fmt::format("{}", *report.ground_speed) : "";
      fields_ = {report.id, report.category, report.craft_type, report.status, speed_};
      ruled.ruled_class = filters_->class_of(report.id, fields_);
    }
    sink_->take(ruled);
  }
  void time_is(const FileTime& arrival, TimeKind kind) override { sink_->time_is(arrival, kind); }
  void pass_over(Passed reason) override { sink_->pass_over(reason); }
  void warn(const std::string& warning) override { sink_->warn(warning); }
  void refuse(std::size_t line, const std::string& reason) override { sink_->refuse(line, reason); }

  std::unique_ptr<ReportFormat> format_;
  std::vector<ClassRule> rules_;
  std::optional<ClassRules> filters_;
  ReportSink* sink_ = nullptr;
  std::string speed_;
  std::vector<std::string_view> fields_;
};

}  // namespace

std::vector<ClassRule> parse_class_rules(const std::vector<std::string>& texts, TrackClasses& classes) {
  std::vector<ClassRule> rules;
  rules.reserve(texts.size());
  for (const std::string& text : texts) rules.push_back(parse_class_rule(text, classes));
  return rules;
}

std::unique_ptr<ReportFormat> make_ruled_format(std::unique_ptr<ReportFormat> format,
                                                const std::vector<ClassRule>& rules, bool is_table) {
  if (rules.empty()) return format;
  return std::make_unique<RuledFormat>(std::move(format), rules, is_table);
}

}  // namespace kinesphere::program
