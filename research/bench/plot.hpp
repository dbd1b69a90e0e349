// Figures drawn by gnuplot from the CSV files of the tables.
#pragma once

#include <string>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

struct Curve {
  std::string column;  ///< column of the CSV file
  std::string title;
  bool line = true;         ///< false: points alone
  bool error_bars = false;  ///< from the column with the suffix _low to the column with the suffix _high
};

struct Plot {
  std::string name;   ///< name of the files NAME.gp and NAME.svg
  std::string table;  ///< name of the table: NAME.csv holds the numbers
  std::string title;
  std::string x_column = "n";
  std::string x_label = "number of spheres";
  std::string y_label;
  bool logarithmic = false;
  std::vector<Curve> curves;
};

/// Returns the gnuplot script, which has to run in the folder of the CSV file.
std::string gnuplot_script(const Plot& plot);

/// Spheres in a box, seen from the front along y.
struct SpherePlot {
  std::string name;  ///< name of the files: NAME.csv with x, y, z and radius (length), far spheres first;
                     ///< NAME.gp, NAME.svg
  std::string title;
  Box box;
};
std::string gnuplot_script(const SpherePlot& plot);

bool has_gnuplot();
/// Runs NAME.gp in the folder. Throws ProgramError if gnuplot fails.
void run_gnuplot(const std::string& folder, const std::string& name);

}  // namespace kinesphere::program
