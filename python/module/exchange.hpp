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
#include "kinesphere/result.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Which argument of which call is read: for messages.
struct Argument {
  std::string_view call;
  std::string_view name;
};

/// Throws BadResult: "call: name <expectation>, but <found>".
[[noreturn]] void refuse(const Argument& argument, std::string_view expectation, const std::string& found,
                         ErrorCode code = ErrorCode::out_of_range);

// Arrays that come in.

/// A view of real numbers of which Python has the memory: float64 and float32 as they lie there, in any
/// strides; whatever else NumPy makes real numbers of, as a copy. Throws TypeError for all that is none.
class Numbers {
 public:
  Numbers(py::handle given, const Argument& argument);
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;
  ~Numbers();

  std::size_t dimensions() const { return static_cast<std::size_t>(buffer_.ndim); }
  std::size_t length(std::size_t axis) const { return static_cast<std::size_t>(buffer_.shape[axis]); }
  /// "(5, 3)"
  std::string shape() const;
  /// For an array of one dimension, or of two. A scalar is an array of none.
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

/// A vector: three numbers or, in the plane, two.
Vec3 vector_of(py::handle given, const Argument& argument, bool plane);
/// Vectors, one in a row: shape (n, 3) or, in the plane, (n, 2) too. With `count`, n must be that.
std::vector<Vec3> vectors_of(py::handle given, const Argument& argument, bool plane,
                             std::optional<std::size_t> count = {});
/// One number for each of `count` bodies: shape (n,), or one number for all.
std::vector<double> each_of(py::handle given, const Argument& argument, std::size_t count);
/// Whole numbers, as each_of().
std::vector<std::uint64_t> each_whole_of(py::handle given, const Argument& argument, std::size_t count);
/// Positions with velocities, which are zero where there are none (None).
std::vector<State> states_of(py::handle positions, py::handle velocities, std::string_view call, bool plane);
/// Writes to `states` what a probe returned: two arrays of shape (n, 3) or, in the plane, (n, 2).
void read_states(py::handle answer, std::span<State> states, std::string_view call, bool plane);

// Arrays that go out.

/// A new NumPy array, whose numbers are to be written. Its memory belongs to the array alone.
class NewArray {
 public:
  /// dtype is as numpy.dtype() takes it: "f8", or fields.
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

/// A field of a row: its name, its type as numpy.dtype() takes it, and where it lies in the row.
struct Field {
  const char* name;
  const char* type;
  std::size_t offset;
};
/// The numpy.dtype of rows of this size with these fields.
py::object row_type(std::span<const Field> fields, std::size_t row_size);

NewArray new_doubles(std::initializer_list<std::size_t> shape);
NewArray new_whole_numbers(std::size_t count);
/// An array of three numbers that cannot be changed.
py::object array_of(const Vec3& vector);
py::object array_of(std::span<const double> numbers);
/// Two arrays of shape (n, 3): positions and velocities.
py::tuple arrays_of(std::span<const State> states);
py::bytes bytes_of(std::span<const std::byte> bytes);
/// Any object with a buffer of bytes.
std::vector<std::byte> bytes_from(py::handle given, const Argument& argument);

// Ids: index and generation in one number (BodyId::pack), which is the index as long as no body was removed.

/// A whole number; a kinesphere.BodyId says its world too.
BodyId id_of(py::handle given, const Argument& argument);
/// One id, or an array of them of shape (n,).
struct Ids {
  std::vector<BodyId> ids;
  bool is_single = false;
};
Ids ids_of(py::handle given, const Argument& argument);
/// A kinesphere.BodyId; None for no_body.
py::object object_of(BodyId body);
/// An array of int64.
py::object array_of(std::span<const BodyId> ids);
inline std::int64_t number_of(BodyId body) { return static_cast<std::int64_t>(body.pack()); }
/// Of a module of the package in Python: the class or function of that name. It is looked up once.
py::object package_attribute(const char* module, const char* name);

/// NumPy's function of that name.
py::object numpy(const char* name);

}  // namespace kinesphere::python
