#include "research/bench/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/output_file.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

std::string text_of(const Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return number(*value);
  if (const auto* count = std::get_if<std::uint64_t>(&cell)) return grouped(*count);
  if (const auto* flag = std::get_if<bool>(&cell)) return *flag ? "yes" : "NO";
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return "-";
}

std::string heading_of(std::string column) {
  std::replace(column.begin(), column.end(), '_', ' ');
  return column;
}

/// Quotes a text as one word of a shell command.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string head(const std::string& name, const std::string& title, const std::string& terminal) {
  return fmt::format(
      "# Run in this folder: gnuplot {0}.gp\n"
      "set terminal {2} font 'Helvetica,13' background 'white'\n"
      "set output '{0}.{3}'\n"
      "set datafile separator ','\n"
      "set datafile columnheaders\n"
      "set title '{1}'\n",
      name, title, terminal, terminal.starts_with("svg") ? "svg" : "png");
}

constexpr std::size_t line_width = 110;

std::string wrapped(std::string_view text) {
  std::string lines;
  while (text.size() > line_width) {
    const std::size_t blank = std::min(text.rfind(' ', line_width), text.size());
    lines += std::string(text.substr(0, blank)) + '\n';
    text.remove_prefix(std::min(blank + 1, text.size()));
  }
  return lines += text;
}

/// Returns the gnuplot script, which has to run in the folder of the CSV file.
std::string gnuplot_script(const SpherePlot& plot) {
  const auto& [lower, upper] = plot.box;
  std::string script = head(plot.name, plot.title, "pngcairo size 440,420");
  script += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nset cbrange [{}:{}]\n", lower.x, upper.x,
                        lower.z, upper.z, lower.y, upper.y);
  return script +
         "set size ratio -1\n"
         "set palette defined (0 '#1f5fa8', 1 '#dbe8f6')\n"
         "unset colorbox\n"
         "unset key\n"
         "set tics nomirror out\n" +
         fmt::format("plot '{}.csv' using 'x':'z':'radius':'y' {}\n", plot.name,
                     "with circles lc palette lw 0.3 fs solid border lt -1");
}

std::string gnuplot_script(const Plot& plot) {
  std::string script = head(plot.name, plot.title, "svg size 640,440");
  script += fmt::format(
      "set xlabel '{}'\n"
      "set ylabel '{}'\n"
      "set border 3\n"
      "set tics nomirror out\n"
      "set key top left reverse Left\n",
      plot.x_label, plot.y_label);
  script += plot.logarithmic ? "set logscale xy\nset format xy '10^{%L}'\n"
                             : "set xrange [0:*]\nset yrange [0:*]\n";
  script += "plot ";
  int style = 1;
  for (const Curve& curve : plot.curves) {
    if (style > 1) script += ", \\\n     ";
    const std::string bars =
        curve.error_bars ? fmt::format(":'{0}_low':'{0}_high'", curve.column) : std::string();
    const char* const kind = curve.error_bars ? (curve.line ? "yerrorlines" : "yerrorbars")
                                              : (curve.line ? "linespoints" : "points");
    script +=
        fmt::format("'{}.csv' using '{}':'{}'{} with {} lw 1.5 pt {} ps 0.8 lc {} title '{}'", plot.table,
                    plot.x_column, curve.column, bars, kind, 2 * style + 3, style, curve.title);
    ++style;
  }
  return script + "\n";
}

/// Runs NAME.gp in the folder. Throws ProgramError if gnuplot fails.
void run_gnuplot(const std::string& folder, const std::string& name) {
  const std::string command = fmt::format("cd {} && gnuplot {}.gp", quoted(folder), quoted(name));
  if (std::system(command.c_str()) != 0)
    throw ProgramError(fmt::format("{}/{}.gp: gnuplot failed", folder, name));
}

}  // namespace

void ResultTable::row(std::vector<Cell> cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back(std::move(cells));
}

std::string ResultTable::text() const {
  std::vector<std::string> lines(rows_.size() + 1);
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    const std::string heading = heading_of(columns_[column]);
    std::size_t width = heading.size();
    bool on_the_left = !rows_.empty();
    for (const auto& row : rows_) {
      width = std::max(width, text_of(row[column]).size());
      on_the_left = on_the_left && std::holds_alternative<std::string>(row[column]);
    }
    const auto add = [&](std::string& line, const std::string& text) {
      line += column == 0 ? "" : "  ";
      line += on_the_left ? fmt::format("{:<{}}", text, width) : fmt::format("{:>{}}", text, width);
    };
    add(lines[0], heading);
    for (std::size_t row = 0; row < rows_.size(); ++row) add(lines[row + 1], text_of(rows_[row][column]));
  }
  std::string text;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

void ResultTable::save(const std::string& path) const {
  TableFile file(path, columns_);
  for (const auto& row : rows_) file.write(row);
  file.commit();
}

bool has_gnuplot() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

Report::Report(std::string folder) : folder_(std::move(folder)), draws_(has_gnuplot()) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error || !std::filesystem::is_directory(folder_))
    throw ProgramError(fmt::format("--output: expected a folder that can be made, but got '{}'", folder_));
}

void Report::heading(std::string_view title) const {
  print("{}\n{:=<{}}\n", title, "", title.size());
  finish_output();
}

void Report::note(std::string_view text) const {
  print("{}\n\n", wrapped(text));
  finish_output();
}

void Report::table(const std::string& name, const ResultTable& table) const {
  save(name, table);
  print("{}\n", table.text());
  finish_output();
}

void Report::save(const std::string& name, const ResultTable& table) const {
  table.save(fmt::format("{}/{}.csv", folder_, name));
}

void Report::run_script(const std::string& name, std::string_view script) const {
  file(name + ".gp", script);
  if (draws_) run_gnuplot(folder_, name);
}

void Report::plot(const Plot& plot) const { run_script(plot.name, gnuplot_script(plot)); }

void Report::plot(const SpherePlot& plot, const ResultTable& spheres) const {
  save(plot.name, spheres);
  run_script(plot.name, gnuplot_script(plot));
}

void Report::file(const std::string& name, std::string_view text) const {
  OutputFile file(fmt::format("{}/{}", folder_, name));
  file.write(text);
  file.commit();
}

}  // namespace kinesphere::program
