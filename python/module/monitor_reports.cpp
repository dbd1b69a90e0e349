#include "monitor_reports.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace kinesphere::python {
namespace {

std::string row_name(std::string_view name, std::size_t row) {
  return std::string(name) + "[" + std::to_string(row) + "]";
}

bool is_one_number(py::handle given) {
  return PyIndex_Check(given.ptr()) != 0 && PyObject_HasAttrString(given.ptr(), "__len__") == 0;
}

/// Returns a Python float or int, which is read without NumPy; nothing for other objects.
std::optional<double> plain_number(py::handle given) {
  if (PyFloat_Check(given.ptr())) return PyFloat_AS_DOUBLE(given.ptr());
  if (!PyLong_CheckExact(given.ptr())) return std::nullopt;
  const double number = PyLong_AsDouble(given.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  return std::nullopt;
}

/// Reads whole numbers >= 0: one, or one for each row.
Column<std::size_t> whole_column(py::handle given, const Argument& argument, std::size_t rows) {
  if (is_one_number(given)) return Column<std::size_t>(track_id_of(given, argument));
  TrackIds numbers = track_ids_of(given, argument);
  if (numbers.ids.size() != rows)
    refuse(argument, "must be one number, or one for each of " + std::to_string(rows) + " reports",
           "has " + std::to_string(numbers.ids.size()));
  return Column<std::size_t>(std::move(numbers.ids));
}

/// Reads a number or ErrorBound for all rows, or an array of radii, or of horizontal and vertical limits.
Column<ErrorBound> bound_column(py::handle given, const Argument& argument, std::size_t rows) {
  if (py::isinstance<ErrorBound>(given)) return Column<ErrorBound>(given.cast<ErrorBound>());
  if (const auto number = plain_number(given)) return Column<ErrorBound>(ErrorBound(*number));
  const Numbers numbers(given, argument);
  if (numbers.dimensions() == 0) return Column<ErrorBound>(ErrorBound(numbers.scalar()));
  const bool are_pairs = numbers.dimensions() == 2 && numbers.length(1) == 2;
  if ((numbers.dimensions() != 1 && !are_pairs) || numbers.length(0) != rows)
    refuse(argument,
           "must be a number, an ErrorBound, or of shape (n,) or (n, 2) with n = " + std::to_string(rows),
           "has shape " + numbers.shape());
  std::vector<ErrorBound> values(rows);
  for (std::size_t row = 0; row < rows; ++row)
    values[row] = are_pairs ? ErrorBound::cylinder(numbers.at(row, 0), numbers.at(row, 1))
                            : ErrorBound(numbers.at(row));
  return Column<ErrorBound>(std::move(values));
}

/// Reads one vector for a single report, else shape (n, 3) or (n, 2).
std::vector<Vec3> vector_column(py::handle given, const Argument& argument, bool plane, const TrackIds& ids) {
  if (ids.is_single) return {vector_of(given, argument, plane)};
  return vectors_of(given, argument, plane, ids.ids.size());
}

}  // namespace

Column<double> real_column(py::handle given, const Argument& argument, std::size_t rows) {
  if (const auto number = plain_number(given)) return Column<double>(*number);
  const Numbers numbers(given, argument);
  if (numbers.dimensions() == 0) return Column<double>(numbers.scalar());
  if (numbers.dimensions() != 1 || numbers.length(0) != rows)
    refuse(argument, "must be one number, or one for each of " + std::to_string(rows) + " reports",
           "has shape " + numbers.shape());
  std::vector<double> values(rows);
  for (std::size_t row = 0; row < rows; ++row) values[row] = numbers.at(row);
  return Column<double>(std::move(values));
}

TrackId track_id_of(py::handle given, const Argument& argument) { return whole_number(given, argument); }

TrackIds track_ids_of(py::handle given, const Argument& argument) {
  if (is_one_number(given)) return {{track_id_of(given, argument)}, true};
  TrackIds result;
  // NumPy makes doubles of lists with numbers of 64 bits.
  if (PyList_Check(given.ptr()) != 0 || PyTuple_Check(given.ptr()) != 0) {
    for (const py::handle item : py::reinterpret_borrow<py::sequence>(given)) {
      const std::string name = row_name(argument.name, result.ids.size());
      result.ids.push_back(track_id_of(item, {argument.call, name}));
    }
    return result;
  }
  bool is_signed = false;
  result.ids = whole_numbers(given, argument, &is_signed);
  for (std::size_t row = 0; is_signed && row < result.ids.size(); ++row) {
    const auto number = static_cast<std::int64_t>(result.ids[row]);
    if (number < 0)
      refuse({argument.call, row_name(argument.name, row)}, "must be a whole number from 0 to 2^64 - 1",
             "is " + std::to_string(number));
  }
  return result;
}

py::object array_of_tracks(std::span<const TrackId> ids) {
  static const py::handle type = numpy("dtype")("u8").release();
  NewArray array({ids.size()}, py::reinterpret_borrow<py::object>(type), sizeof(TrackId));
  for (std::size_t k = 0; k < ids.size(); ++k) array.data<TrackId>()[k] = ids[k];
  return array.take();
}

GivenReports GivenReports::of(const py::dict& arguments, std::string_view call, const char* source) {
  GivenReports given;
  const std::pair<const char*, py::object*> places[] = {
      {"ids", &given.ids},
      {"timestamps", &given.timestamps},
      {"positions", &given.positions},
      {"velocities", &given.velocities},
      {"position_errors", &given.position_errors},
      {"velocity_errors", &given.velocity_errors},
      {"timestamp_errors", &given.timestamp_errors},
      {"track_classes", &given.track_classes},
      {"plan_accelerations", &given.plan_accelerations},
      {"plan_acceleration_limits", &given.plan_acceleration_limits},
      {"plan_valid_until", &given.plan_valid_until},
  };
  for (const auto& [name, place] : places) {
    const bool is_there = arguments.contains(name);
    *place = is_there ? py::object(arguments[name]) : py::none();
  }
  for (const auto& [key, value] : arguments) {
    bool is_known = false;
    for (const auto& [name, place] : places) is_known = is_known || key.equal(py::str(name));
    if (!is_known)
      throw py::type_error(std::string(call) + ": " + source +
                           " must return arguments of report(), but returned " +
                           py::repr(key).cast<std::string>());
  }
  return given;
}

Reports::Reports(const GivenReports& given, std::string_view call, bool plane)
    : call_(call), ids_(track_ids_of(given.ids, {call, "ids"})) {
  const std::size_t rows = size();
  timestamps_ = real_column(given.timestamps, {call, "timestamps"}, rows);
  positions_ = vector_column(given.positions, {call, "positions"}, plane, ids_);
  position_errors_ = given.position_errors.is_none()
                         ? Column(ErrorBound())
                         : bound_column(given.position_errors, {call, "position_errors"}, rows);
  if (!given.velocities.is_none())
    velocities_ = vector_column(given.velocities, {call, "velocities"}, plane, ids_);
  else if (!given.velocity_errors.is_none())
    refuse({call, "velocity_errors"}, "must come with velocities", "there are none");
  if (!given.velocity_errors.is_none())
    velocity_errors_ = bound_column(given.velocity_errors, {call, "velocity_errors"}, rows);
  else if (given.velocities.is_none())
    velocity_errors_ = Column(ErrorBound(std::numeric_limits<double>::infinity()));
  else
    velocity_errors_ = Column(ErrorBound());
  timestamp_errors_ = given.timestamp_errors.is_none()
                          ? Column(0.0)
                          : real_column(given.timestamp_errors, {call, "timestamp_errors"}, rows);
  track_classes_ = given.track_classes.is_none()
                       ? Column(std::size_t{0})
                       : whole_column(given.track_classes, {call, "track_classes"}, rows);
  read_plans(given, plane);
}

void Reports::read_plans(const GivenReports& given, bool plane) {
  const Argument limits{call_, "plan_acceleration_limits"}, until{call_, "plan_valid_until"};
  if (given.plan_accelerations.is_none()) {
    for (const auto& [value, argument] :
         {std::pair(&given.plan_acceleration_limits, limits), std::pair(&given.plan_valid_until, until)})
      if (!value->is_none()) refuse(argument, "must come with plan_accelerations", "there are none");
    return;
  }
  plan_accelerations_ = vector_column(given.plan_accelerations, {call_, "plan_accelerations"}, plane, ids_);
  plan_acceleration_limits_ = given.plan_acceleration_limits.is_none()
                                  ? Column(ErrorBound())
                                  : bound_column(given.plan_acceleration_limits, limits, size());
  plan_valid_until_ = given.plan_valid_until.is_none() ? Column(std::numeric_limits<double>::infinity())
                                                       : real_column(given.plan_valid_until, until, size());
}

TrackReport Reports::at(std::size_t row) const {
  TrackReport report;
  report.timestamp = timestamps_[row];
  report.state.position = positions_[row];
  if (!velocities_.empty()) report.state.velocity = velocities_[row];
  report.position_error = position_errors_[row];
  report.velocity_error = velocity_errors_[row];
  report.timestamp_error = timestamp_errors_[row];
  report.track_class = track_classes_[row];
  // A plan that was valid until -infinity is none.
  if (!plan_accelerations_.empty() && plan_valid_until_[row] != -std::numeric_limits<double>::infinity())
    report.plan =
        TrackReport::Plan{plan_accelerations_[row], plan_acceleration_limits_[row], plan_valid_until_[row]};
  return report;
}

void Reports::check(const Monitor& monitor) const {
  for (std::size_t row = 0; row < size(); ++row)
    if (const Result<void> checked = monitor.check_report(id(row), at(row)); !checked)
      throw_of_row(checked.error(), call_, row, ids_.is_single);
}

void throw_of_row(const Error& error, std::string_view call, std::size_t row, bool is_single) {
  const std::string rest = error.message.substr(std::min(error.message.find(": ") + 2, error.message.size()));
  Error named = error;
  named.message = std::string(call) + ": " + (is_single ? "" : "row " + std::to_string(row) + ", ") + rest;
  throw BadResult(named);
}

}  // namespace kinesphere::python
