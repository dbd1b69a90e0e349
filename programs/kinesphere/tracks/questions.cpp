// What a file does not say: questions, all of which are asked at once.
#include "tracks/questions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t most_questions = 12;

bool asks_for_dates(std::string_view question) { return question.find("--dates day-first") != question.npos; }

/// Returns the word of a shell behind an option at a place in a text; nothing where there is none, or one
/// that the user has to complete.
std::optional<std::string> word_behind(std::string_view text, std::string_view option, std::size_t at) {
  if (at == text.npos) return std::nullopt;
  text.remove_prefix(at + option.size());
  std::string word;
  if (text.starts_with('\'')) {
    text.remove_prefix(1);
    const std::size_t end = text.find('\'');
    if (end == text.npos || text.substr(end).starts_with("'\\'")) return std::nullopt;
    word = text.substr(0, end);
  } else {
    word = text.substr(0, text.find_first_of(" ,;)"));
    // Commas belong to a list of columns.
    if (option == "--columns ") word = text.substr(0, text.find_first_of(" ;)"));
    while (word.ends_with(',')) word.pop_back();
  }
  return word.empty() || word.find("...") != word.npos ? std::nullopt : std::optional(word);
}

/// Calls `read`; returns the question that it throws, or nothing. Other errors are none.
std::optional<std::string> question_of(const std::function<void(const ColumnHints&)>& read,
                                       const ColumnHints& hints) {
  try {
    read(hints);
  } catch (const ProgramError& error) {
    return error.what();
  }
  return std::nullopt;
}

/// Returns the only order of day and month with which no date is asked about, whatever else is; nothing if
/// several fit, or none.
std::optional<DateOrder> only_order(ColumnHints hints, const std::function<void(const ColumnHints&)>& read) {
  std::optional<DateOrder> only;
  for (const DateOrder order : {DateOrder::day_first, DateOrder::month_first, DateOrder::year_first}) {
    ColumnHints assumed = hints;
    assumed.dates = order;
    auto question = question_of(read, assumed);
    for (std::size_t k = 0; k < most_questions && question && !asks_for_dates(*question); ++k) {
      if (!assume_answer(*question, assumed)) break;
      question = question_of(read, assumed);
    }
    if (question && asks_for_dates(*question)) continue;
    if (only) return std::nullopt;
    only = order;
  }
  return only;
}

/// Returns the questions in one line. The name of the file stands before the first alone.
std::string joined(const std::vector<std::string>& questions) {
  const std::string& first = questions.front();
  const std::string file = first.substr(0, std::min(first.find(": "), first.size()) + 2);
  std::string text = fmt::format("{}{} questions", file, questions.size());
  for (std::size_t k = 0; k < questions.size(); ++k) {
    const bool has_name = questions[k].starts_with(file);
    text +=
        fmt::format("{} ({}) {}", k == 0 ? ":" : ";", k + 1, questions[k].substr(has_name ? file.size() : 0));
  }
  return text;
}

}  // namespace

bool assume_answer(const std::string& question, ColumnHints& hints) {
  // The first proposal uses a column, the last one keeps rows.
  const std::size_t say = std::min(question.find("say "), question.size());
  const auto first = [&](std::string_view option) {
    return word_behind(question, option, question.find(option, say));
  };
  if (const auto rows = word_behind(question, "--where ", question.rfind("--where "))) {
    hints.where = hints.where.empty() ? *rows : fmt::format("({}) and ({})", hints.where, *rows);
  } else if (const auto columns = first("--columns "); columns && hints.columns != *columns) {
    hints.columns = *columns;
    hints.format.clear();
  } else if (question.find("say --positions ") != question.npos && hints.positions.empty()) {
    hints.positions = "lonlat";
  } else if (const auto unit = first("--time-unit "); unit && hints.time_unit.empty()) {
    hints.time_unit = *unit;
  } else if (question.find("--frame-rate") != question.npos && !hints.frame_rate) {
    hints.frame_rate = 1.0;
  } else {
    return false;
  }
  return true;
}

void ask_all(ColumnHints hints, const std::function<void(const ColumnHints&)>& read) {
  std::vector<std::string> questions;
  while (questions.size() < most_questions) {
    try {
      read(hints);
    } catch (const ProgramError& error) {
      const std::string question = error.what();
      if (asks_for_dates(question) && hints.dates == DateOrder::unknown) {
        const auto order = only_order(hints, read);
        hints.dates = order.value_or(DateOrder::day_first);
        if (!order) questions.push_back(question);
        continue;
      }
      ColumnHints answered = hints;
      const bool is_known = std::ranges::find(questions, question) != questions.end();
      if (is_known || !assume_answer(question, answered)) {
        // An error with what was assumed may be none with the right answers.
        if (questions.empty()) throw;
        break;
      }
      questions.push_back(question);
      hints = answered;
      continue;
    }
    break;
  }
  if (questions.empty()) return;
  throw ProgramError(questions.size() == 1 ? questions.front() : joined(questions));
}

}  // namespace kinesphere::program
