// What a section of the benchmark writes: on the terminal and into the folder of results.
#pragma once

#include <string>
#include <string_view>

#include "research/bench/plot.hpp"
#include "research/bench/result_table.hpp"

namespace kinesphere::program {

class Report {
 public:
  /// Makes the folder if need be. Throws ProgramError, as do all others here.
  explicit Report(std::string folder);

  bool draws() const { return draws_; }

  void heading(std::string_view title) const;
  /// A paragraph for the reader, broken into lines.
  void note(std::string_view text) const;
  /// Printed, and saved as NAME.csv.
  void table(const std::string& name, const ResultTable& table) const;
  /// Saved alone.
  void save(const std::string& name, const ResultTable& table) const;
  /// Saved as a script, and with its table if one is given; drawn where gnuplot is installed.
  void plot(const Plot& plot) const;
  void plot(const SpherePlot& plot, const ResultTable& spheres) const;
  void file(const std::string& name, std::string_view text) const;

 private:
  std::string folder_;
  bool draws_;
};

}  // namespace kinesphere::program
