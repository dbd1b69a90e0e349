// Results of a benchmark: tables, on the terminal and in CSV files, and figures that gnuplot draws from
// these.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/table_file.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

class ResultTable {
 public:
  /// `columns` has the names in the CSV file; on the terminal underscores become blanks.
  explicit ResultTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// Adds a row. Precondition: there is one cell for each column.
  void row(std::vector<Cell> cells);

  /// Returns the table with numbers of four digits on the right and text on the left.
  std::string text() const;
  /// Saves the table as a CSV file. Throws ProgramError.
  void save(const std::string& path) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

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

/// Spheres in a box, seen from the front along y.
struct SpherePlot {
  std::string name;  ///< name of the files: NAME.csv with x, y, z and radius (length), far spheres first;
                     ///< NAME.gp, NAME.svg
  std::string title;
  Box box;
};

bool has_gnuplot();
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
