// Output of a section of the benchmark: on the terminal and into the folder of results.
#pragma once

#include <string>
#include <string_view>

#include "research/bench/plot.hpp"
#include "research/bench/result_table.hpp"

namespace kinesphere::program {

class Report {
 public:
  /// Makes the folder if it does not exist. Throws ProgramError, like all other functions of this class.
  explicit Report(std::string folder);

  bool draws() const { return draws_; }

  void heading(std::string_view title) const;
  /// Prints a paragraph, broken into lines.
  void note(std::string_view text) const;
  /// Prints the table and saves it as NAME.csv.
  void table(const std::string& name, const ResultTable& table) const;
  /// Saves the table without printing it.
  void save(const std::string& name, const ResultTable& table) const;
  /// Saves the plot as a script, and its table if one is given; draws it if gnuplot is installed.
  void plot(const Plot& plot) const;
  void plot(const SpherePlot& plot, const ResultTable& spheres) const;
  void file(const std::string& name, std::string_view text) const;

 private:
  /// Saves NAME.gp, and draws it where gnuplot is installed.
  void run_script(const std::string& name, std::string_view script) const;

  std::string folder_;
  bool draws_;
};

}  // namespace kinesphere::program
