// The text of --help, and words for misspelt ones.
#include "base/help_text.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <utility>

#include "base/ascii_text.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t help_width = 80, description_column = 26;

/// Returns the end of the longest beginning of `text` that has at most `width` characters and ends where a
/// line may: before a blank, or behind | or a comma. Where there is none, the first such place counts.
std::size_t end_of_line(std::string_view text, std::size_t width) {
  if (text.size() <= width) return text.size();
  const std::size_t blank = text.rfind(' ', width);
  if (blank != text.npos && blank > 0) return blank;
  const std::size_t mark = text.find_last_of("|,", width - 1);
  return mark != text.npos ? mark + 1 : std::min(text.find_first_of(" |,", width), text.size());
}

std::string joined(const std::vector<std::string>& lines, std::size_t indent) {
  std::string text;
  for (const std::string& line : lines) text += std::string(line.empty() ? 0 : indent, ' ') + line + '\n';
  return text;
}

/// Returns a name with its description beside it, or below it where the name is long.
std::string help_entry(const std::string& name, const std::string& description) {
  constexpr std::size_t indent = 2;
  std::string text = joined(broken_lines(name, help_width - indent), indent);
  if (description.empty()) return text;
  const auto lines = broken_lines(description, help_width - description_column);
  const bool fits_beside = indent + name.size() + 2 <= description_column;
  if (!fits_beside) return text + joined(lines, description_column);
  text.back() = ' ';
  text.resize(description_column, ' ');
  return text + joined(lines, description_column).substr(description_column);
}

class HelpFormatter final : public CLI::Formatter {
 public:
  /// One blank line separates groups.
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != text.npos;) text.erase(at, 1);
    return text;
  }
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return help_entry(make_option_name(option, is_positional) + make_option_opts(option),
                      make_option_desc(option));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return help_entry(command->get_name(), command->get_description());
  }
  std::string make_description(const CLI::App* app) const override {
    return joined(broken_lines(app->get_description(), help_width), 0);
  }
  std::string make_footer(const CLI::App* app) const override {
    const std::string footer = app->get_footer();
    return footer.empty() ? "" : '\n' + joined(broken_lines(footer, help_width), 0);
  }
};

/// Returns how many letters have to be put in, left out, replaced or swapped with the next to make `b` of
/// `a`.
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, row(b.size() + 1), next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({next[j - 1] + 1, row[j] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before = row;
    row = next;
  }
  return row.back();
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> make_help_formatter() { return std::make_shared<HelpFormatter>(); }

void add_examples(CLI::App& command, std::initializer_list<std::string_view> lines) {
  std::string footer = command.get_footer();
  if (!footer.empty()) footer += "\n\n";
  footer += "Examples:";
  for (const std::string_view line : lines) footer += "\n  " + std::string(line);
  command.footer(footer);
}

std::string_view meant_word(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t letters_per_edit = 3, shortest_beginning = 3;
  std::string_view meant;
  std::size_t fewest = word.size() / letters_per_edit + 1;
  for (const std::string& each : known) {
    const bool begins_so = word.size() >= shortest_beginning && each.starts_with(word);
    const std::size_t edits = begins_so ? 1 : edits_between(word, each);
    if (edits >= fewest) continue;
    fewest = edits;
    meant = each;
  }
  return meant;
}

std::vector<std::string> broken_lines(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    const bool is_fixed = line.starts_with(' ');
    do {
      const std::size_t size = is_fixed ? line.size() : end_of_line(line, width);
      lines.emplace_back(line.substr(0, size));
      line.remove_prefix(size);
      line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    } while (!line.empty());
  }
  return lines;
}

}  // namespace kinesphere::program
