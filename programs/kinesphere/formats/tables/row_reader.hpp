// Reads the rows of a table as ids, times, positions and numbers, as their columns say.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "formats/tables/row_filter.hpp"
#include "formats/tables/row_splitter.hpp"
#include "formats/tables/table_columns.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// A row shows that an option has to be given; the message says which. The caller adds file and line.
class OpenQuestion : public std::runtime_error {
 public:
  explicit OpenQuestion(const std::string& text, bool is_about_row = true)
      : std::runtime_error(text), is_about_row_(is_about_row) {}
  /// False if the question is about the whole file.
  bool is_about_row() const { return is_about_row_; }

 private:
  bool is_about_row_;
};

/// Returns the id of a file that has one body: a of tracks/a.csv.gz.
std::string id_of_file(const std::string& file);

/// Numbers have the units of the file; the columns say how large these are. All functions throw WrongInput if
/// a field is not what its column has to be, and OpenQuestion.
class RowReader {
 public:
  /// `head` must outlive it. Throws ProgramError naming --where.
  RowReader(const TableHead& head, TableColumns columns);

  const TableHead& head() const { return head_; }
  const TableColumns& columns() const { return columns_; }
  const RowFilter& filter() const { return filter_; }
  /// Sets what earlier rows have shown of the order of day and month.
  void set_dates(DateOrder dates) { columns_.dates = dates; }
  /// True if --where leaves the row out.
  bool leaves_out(const std::vector<std::string_view>& fields) const { return !filter_.takes(fields); }

  /// Sets the row for the functions below. Its fields must live until the next call.
  void set_row(const std::vector<std::string_view>& fields);
  /// The fields of the row.
  const std::vector<std::string_view>& fields() const { return *fields_; }

  /// Number of bodies in a row, and the choice of one, 0 at first, for the functions below.
  std::size_t bodies() const { return std::max<std::size_t>(columns_.bodies.size(), 1); }
  void set_body(std::size_t body);

  /// Returns the file's name without folder and endings, which is the id of a file with one body.
  const std::string& file_id() const { return file_id_; }
  /// Returns the id as spelled, but 3 for 3.0 and 3.000000e+00; valid until the next call.
  std::string_view id();
  /// Returns nothing for a missing time, or if there is no such column.
  std::optional<TimeField> time(Quantity quantity = Quantity::time);
  /// Returns nothing for a missing number, or if there is no such column.
  std::optional<double> number(Quantity quantity);
  /// Returns the angle, in radians counterclockwise from the x axis, to which the quaternion of the row turns
  /// that axis; nothing if it is missing, or if there are no such columns.
  std::optional<double> turned_axis() const;
  /// Returns x, y, z, or degrees east and north and z; z is 0 if it is missing or there is no such column.
  /// Nothing if x or y is missing; so are 181 and 91 as longitude and latitude, with which AIS says that it
  /// knows none.
  std::optional<Vec3> position();
  /// The first missing value of the row: its column and what it would be; nothing if there is none.
  struct Missing {
    std::size_t column;
    std::string_view what;
  };
  const std::optional<Missing>& missing() const { return missing_; }
  /// True if the row has a height.
  bool has_height() const { return has_height_; }
  /// Returns "expected a number as x (column 3), but got nothing".
  std::string wrong_text(std::size_t column, std::string_view expected) const;

 private:
  struct VoidColumn {
    std::size_t place;
    std::string_view values;
  };

  void check_void_columns() const;
  void check_likelihood() const;
  std::string_view field(std::size_t column) const { return (*fields_)[column]; }
  std::string_view name_of(Quantity quantity) const;
  void check_size(const FileTime& time);
  std::string_view with_date(std::string_view clock);
  std::string_view with_nanoseconds(std::string_view seconds);
  void check_decimals(std::size_t column);
  void check_date(std::string_view text, const FileTime& time) const;
  std::optional<double> degrees(Quantity quantity, const std::optional<std::size_t>& hemisphere,
                                std::string_view letters);
  /// The numbers of a coordinate in all rows before.
  struct Span {
    double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
    std::size_t count = 0;
  };
  void check_place(double x, double y, std::optional<double> z);
  void check_coordinate(Quantity quantity, double value, Span& span, bool is_none = false) const;
  std::string where_name(Quantity quantity) const;

  const TableHead& head_;
  TableColumns columns_;
  RowFilter filter_;
  std::vector<VoidColumn> void_columns_;
  std::optional<std::size_t> likelihood_;  ///< column
  const std::vector<std::string_view>* fields_ = nullptr;
  std::optional<Missing> missing_;
  bool has_height_ = false;
  bool has_time_ = false;  ///< a row had a time
  std::size_t body_ = 0;
  std::array<Span, 3> spans_;
  /// Numbers with a point, and with a comma, of tables that may have both as decimal signs: the first that
  /// certainly has decimals, and the first in which thousands may be separated.
  struct Marked {
    std::string decimal, thousands;
  };
  std::array<Marked, 2> marked_;
  std::string file_id_, id_, buffer_, date_and_clock_;
};

}  // namespace kinesphere::program
