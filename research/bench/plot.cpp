// Figures drawn by gnuplot from the CSV files of the tables.
#include "research/bench/plot.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

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

}  // namespace

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

bool has_gnuplot() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

void run_gnuplot(const std::string& folder, const std::string& name) {
  const std::string command = fmt::format("cd {} && gnuplot {}.gp", quoted(folder), quoted(name));
  if (std::system(command.c_str()) != 0)
    throw ProgramError(fmt::format("{}/{}.gp: gnuplot failed", folder, name));
}

}  // namespace kinesphere::program
