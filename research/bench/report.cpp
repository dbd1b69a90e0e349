// Output of a section of the benchmark: on the terminal and into the folder of results.
#include "research/bench/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/output_file.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"

namespace kinesphere::program {
namespace {

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

}  // namespace

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
