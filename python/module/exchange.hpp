// Numbers between Python and the library. Arrays are read through the buffer protocol (PEP 3118) and made by
// NumPy itself, so that one build serves NumPy 1 and NumPy 2: nothing here is compiled against NumPy.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/monitor/monitor_event.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// The call and the argument, for messages.
struct Argument {
  std::string_view call;
  std::string_view name;
};

/// Throws BadResult: "call: name <expectation>, but <found>".
[[noreturn]] void refuse(const Argument& argument, std::string_view expectation, const std::string& found,
                         ErrorCode code = ErrorCode::out_of_range);

/// Throws TypeError: "call: name <expectation>, but is <given>".
[[noreturn]] void refuse_type(const Argument& argument, std::string_view expectation, py::handle given);
/// Throws that unless `given` is a function, which `expectation` describes, or None.
void require_function(const py::object& given, const Argument& argument, std::string_view expectation);

// Input arrays.

/// A view of real numbers in Python's memory: float64 and float32 in place, with any strides;
/// everything else that NumPy converts to real numbers as a copy. Throws TypeError for other
/// objects.
class Numbers {
 public:
  Numbers(py::handle given, const Argument& argument);
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;
  ~Numbers();

  std::size_t dimensions() const { return static_cast<std::size_t>(buffer_.ndim); }
  std::size_t length(std::size_t axis) const { return static_cast<std::size_t>(buffer_.shape[axis]); }
  /// Returns text such as "(5, 3)".
  std::string shape() const;
  /// Returns an element of an array of one dimension, or of two. A scalar has no dimension.
  double at(std::size_t row) const { return at_offset(offset(0, row)); }
  double at(std::size_t row, std::size_t column) const {
    return at_offset(offset(0, row) + offset(1, column));
  }
  double scalar() const { return at_offset(0); }

 private:
  bool take(py::handle given);
  std::ptrdiff_t offset(std::size_t axis, std::size_t index) const {
    return buffer_.strides[axis] * static_cast<std::ptrdiff_t>(index);
  }
  double at_offset(std::ptrdiff_t offset) const;

  Py_buffer buffer_{};
  bool is_single_ = false;  ///< float32
};

/// Reads a vector: three numbers or, in the plane, two.
Vec3 vector_of(py::handle given, const Argument& argument, bool plane);
/// Reads vectors, one in a row: shape (n, 3) or, in the plane, also (n, 2). With `count`, n must
/// equal it.
std::vector<Vec3> vectors_of(py::handle given, const Argument& argument, bool plane,
                             std::optional<std::size_t> count = {});
/// Reads one number for each of `count` bodies: shape (n,), or one number for all.
std::vector<double> each_of(py::handle given, const Argument& argument, std::size_t count);
/// Reads "all", "begin_and_end" or "impacts".
ContactEvents contact_events_of(const std::string& name, const Argument& argument);
/// Reads whole numbers like each_of().
std::vector<std::uint64_t> each_whole_of(py::handle given, const Argument& argument, std::size_t count);
/// Reads one whole number from 0 to 2^64 - 1.
std::uint64_t whole_number(py::handle given, const Argument& argument);
/// Reads whole numbers of shape (n,). Negative ones come as their bits, with `is_signed` set if there may be
/// some.
std::vector<std::uint64_t> whole_numbers(py::handle given, const Argument& argument,
                                         bool* is_signed = nullptr);
/// Reads a filter group of 32 bits.
std::int32_t group_of(py::handle given, const Argument& argument);
/// Reads a sensor class from 0 to 255.
SensorClass sensor_class_of(std::uint64_t given, const Argument& argument);
/// Reads positions and velocities; None for the latter means zero.
std::vector<State> states_of(py::handle positions, py::handle velocities, std::string_view call, bool plane);
/// Writes the result of a probe to `states`: two arrays of shape (n, 3) or, in the plane, (n, 2).
void read_states(py::handle answer, std::span<State> states, std::string_view call, bool plane);

// Output arrays.

/// A new NumPy array to be filled. The array owns its memory.
class NewArray {
 public:
  /// `dtype` is an argument for numpy.dtype(): "f8", or fields.
  NewArray(std::initializer_list<std::size_t> shape, const py::object& dtype, std::size_t item_size);
  template <class Number>
  Number* data() const {
    return static_cast<Number*>(memory_);
  }
  py::object take() { return std::move(array_); }

 private:
  void* memory_;
  py::object array_;
};

/// A field of a row: its name, its type for numpy.dtype(), and its offset.
struct Field {
  const char* name;
  const char* type;
  std::size_t offset;
};
/// Returns the numpy.dtype of rows of this size with these fields.
py::object row_type(std::span<const Field> fields, std::size_t row_size);

/// Returns a structured array of the rows record(0) to record(count - 1).
template <class Record, class RecordOf>
py::object table_of_records(std::span<const Field> fields, std::size_t count, const RecordOf& record) {
  NewArray table({count}, row_type(fields, sizeof(Record)), sizeof(Record));
  for (std::size_t k = 0; k < count; ++k) table.data<Record>()[k] = record(k);
  return table.take();
}

NewArray new_doubles(std::initializer_list<std::size_t> shape);
NewArray new_whole_numbers(std::size_t count);
/// Returns a read-only array of three numbers.
py::object array_of(const Vec3& vector);
py::object array_of(std::span<const double> numbers);
/// Returns an array of shape (n, 3).
py::object array_of(std::span<const Vec3> vectors);
/// Returns two arrays of shape (n, 3): positions and velocities.
py::tuple arrays_of(std::span<const State> states);
py::bytes bytes_of(std::span<const std::byte> bytes);
/// Reads any object with a buffer of bytes.
std::vector<std::byte> bytes_from(py::handle given, const Argument& argument);

// Ids: index and generation in one number (BodyId::pack), which equals the index until a body is
// removed.

/// Reads a whole number; a kinesphere.BodyId also has its world.
BodyId id_of(py::handle given, const Argument& argument);
/// Reads one id, or an array of them of shape (n,).
struct Ids {
  std::vector<BodyId> ids;
  bool is_single = false;
};
Ids ids_of(py::handle given, const Argument& argument);
/// Returns a kinesphere.BodyId; None for no_body.
py::object object_of(BodyId body);
/// Returns an array of int64.
py::object array_of(std::span<const BodyId> ids);
inline std::int64_t number_of(BodyId body) { return static_cast<std::int64_t>(body.pack()); }
/// Returns the class or function of that name in a module of the Python package. It is looked up
/// once.
py::object package_attribute(const char* module, const char* name);

/// Returns "Name(part=..., part=...)", with attributes of these names.
std::string text_of_parts(const py::object& self, std::span<const char* const> parts);
// Fields of events and answers as objects of Python.
inline py::object object_of_field(BodyId body) { return object_of(body); }
inline py::object object_of_field(const Vec3& vector) { return array_of(vector); }
py::object object_of_field(EventKind kind);
/// None for Wall::none.
py::object object_of_field(Wall wall);
py::object object_of_field(Senses senses);
py::object object_of_field(MonitorEventKind kind);
py::object object_of_field(Verdict verdict);

/// Returns text_of_parts() as a function for __repr__.
template <class... Names>
auto repr_of_parts(Names... names) {
  return [=](const py::object& self) {
    const char* const parts[] = {names...};
    return text_of_parts(self, parts);
  };
}

/// Returns a function for __reduce__: the class makes the object again, of attributes of these names.
template <class... Names>
auto made_of_parts(Names... names) {
  return [=](const py::object& self) {
    return py::make_tuple(self.get_type(), py::make_tuple(self.attr(names)...));
  };
}

/// Returns NumPy's function of that name.
py::object numpy(const char* name);

}  // namespace kinesphere::python
