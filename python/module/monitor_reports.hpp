// Reports of tracks in columns, as arrays of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exchange.hpp"
#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// One value for all rows, or one for each.
template <class Value>
class Column {
 public:
  Column() = default;
  explicit Column(Value common) : values_{std::move(common)}, is_common_(true) {}
  explicit Column(std::vector<Value> each) : values_(std::move(each)) {}

  const Value& operator[](std::size_t row) const { return values_[is_common_ ? 0 : row]; }

 private:
  std::vector<Value> values_;
  bool is_common_ = false;
};

/// Reads a real number for all rows, or one for each.
Column<double> real_column(py::handle given, const Argument& argument, std::size_t rows);

/// Ids of tracks: whole numbers of 64 bits.
struct TrackIds {
  std::vector<TrackId> ids;
  bool is_single = false;  ///< One number and not a sequence.
};
/// Reads one id, or a sequence of them. Errors name the row.
TrackIds track_ids_of(py::handle given, const Argument& argument);
TrackId track_id_of(py::handle given, const Argument& argument);
/// Returns an array of uint64.
py::object array_of_tracks(std::span<const TrackId> ids);

/// The arguments of Monitor.report(); None for those that were not given.
struct GivenReports {
  py::object ids, timestamps, positions, velocities, position_errors, velocity_errors, timestamp_errors,
      track_classes, plan_accelerations, plan_acceleration_limits, plan_valid_until;

  /// Reads a dict of arguments that `source`, a function of the caller, returned.
  static GivenReports of(const py::dict& arguments, std::string_view call, const char* source);
};

/// Reports that were read from arrays. It holds copies, and needs no GIL.
class Reports {
 public:
  /// Throws BadResult or TypeError, with the argument and the row.
  Reports(const GivenReports& given, std::string_view call, bool plane);

  std::size_t size() const { return ids_.ids.size(); }
  TrackId id(std::size_t row) const { return ids_.ids[row]; }
  double timestamp(std::size_t row) const { return timestamps_[row]; }
  TrackReport at(std::size_t row) const;
  /// Throws BadResult with the row and the track unless this monitor takes all reports.
  void check(const Monitor& monitor) const;

 private:
  void read_plans(const GivenReports& given, bool plane);

  std::string call_;
  TrackIds ids_;
  Column<double> timestamps_;
  std::vector<Vec3> positions_;
  std::vector<Vec3> velocities_;  ///< Empty if none were reported.
  Column<ErrorBound> position_errors_;
  Column<ErrorBound> velocity_errors_;
  Column<double> timestamp_errors_;
  Column<std::size_t> track_classes_;
  std::vector<Vec3> plan_accelerations_;  ///< Empty if there are no plans.
  Column<ErrorBound> plan_acceleration_limits_;
  Column<double> plan_valid_until_;
};

/// Rethrows an error of a row: "call: row 5, ..." for a call that takes several rows.
[[noreturn]] void throw_of_row(const Error& error, std::string_view call, std::size_t row, bool is_single);

}  // namespace kinesphere::python
