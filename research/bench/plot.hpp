// Figures drawn by gnuplot from the CSV files of the tables.
#pragma once

#include <string>
#include <vector>

namespace kinesphere::program {

struct Curve {
  std::string column;  ///< of the CSV file
  std::string title;
  bool line = true;  ///< points alone otherwise
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

bool has_gnuplot();
/// Runs NAME.gp in the folder. Throws ProgramError when gnuplot fails.
void run_gnuplot(const std::string& folder, const std::string& name);

}  // namespace kinesphere::program
