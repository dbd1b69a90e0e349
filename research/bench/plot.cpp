// Figures drawn by gnuplot from the CSV files of the tables.
#include "research/bench/plot.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// As one word of a shell command.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

std::string gnuplot_script(const Plot& plot) {
  std::string script = fmt::format(
      "# Run in this folder: gnuplot {0}.gp\n"
      "set terminal svg size 640,440 font 'Helvetica,13' background 'white'\n"
      "set output '{0}.svg'\n"
      "set datafile separator ','\n"
      "set datafile columnheaders\n"
      "set title '{1}'\n"
      "set xlabel '{2}'\n"
      "set ylabel '{3}'\n"
      "set border 3\n"
      "set tics nomirror out\n"
      "set key top left reverse Left\n",
      plot.name, plot.title, plot.x_label, plot.y_label);
  script += plot.logarithmic ? "set logscale xy\nset format xy '10^{%L}'\n"
                             : "set xrange [0:*]\nset yrange [0:*]\n";
  script += "plot ";
  int style = 1;
  for (const Curve& curve : plot.curves) {
    if (style > 1) script += ", \\\n     ";
    script += fmt::format("'{}.csv' using '{}':'{}' with {} lw 1.5 pt {} ps 0.8 lc {} title '{}'", plot.table,
                          plot.x_column, curve.column, curve.line ? "linespoints" : "points", 2 * style + 3,
                          style, curve.title);
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
