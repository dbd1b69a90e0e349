// Figures drawn by gnuplot from the CSV files of the tables.
#pragma once

#include <string>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

struct Curve {
  std::string column;  ///< of the CSV file
  std::string title;
  bool line = true;         ///< points alone otherwise
  bool error_bars = false;  ///< from the column with the suffix _low to that with the suffix _high
};

struct Plot {
  std::string name;   ///< of its files: NAME.gp and NAME.svg
  std::string table;  ///< NAME.csv holds the numbers
  std::string title;
  std::string x_column = "n";
  std::string x_label = "number of spheres";
  std::string y_label;
  bool logarithmic = false;
  std::vector<Curve> curves;
};

/// The gnuplot script, to be run in the folder of the CSV file.
std::string gnuplot_script(const Plot& plot);

/// Spheres in a box, seen from the front along y.
struct SpherePlot {
  std::string name;  ///< of its files: NAME.csv with x, y, z and radius (length), far spheres first; NAME.gp,
                     ///< NAME.svg
  std::string title;
  Box box;
};
std::string gnuplot_script(const SpherePlot& plot);

bool has_gnuplot();
/// Runs NAME.gp in the folder. Throws ProgramError when gnuplot fails.
void run_gnuplot(const std::string& folder, const std::string& name);

}  // namespace kinesphere::program
