#include "exchange.hpp"

#include <bit>
#include <cstring>
#include <map>
#include <utility>

namespace kinesphere::python {
namespace {

constexpr bool is_little = std::endian::native == std::endian::little;

std::string text_of(py::handle object) { return py::str(object).cast<std::string>(); }

/// Returns true for an array of numpy.ma, some of whose numbers may be missing.
bool may_be_masked(py::handle given) {
  return std::string_view(Py_TYPE(given.ptr())->tp_name) == "MaskedArray";
}

/// Returns an array of real numbers (kinds "fiu") or whole numbers ("iu").
py::object as_array(py::handle given, const Argument& argument, std::string_view kinds, const char* wanted) {
  const auto fail = [&](const std::string& found) {
    throw py::type_error(std::string(argument.call) + ": " + std::string(argument.name) + " must be " +
                         wanted + ", but " + found);
  };
  if (may_be_masked(given) && numpy("ma").attr("is_masked")(given).cast<bool>())
    fail("has masked entries: leave their rows out");
  py::object array;
  try {
    array = numpy("asarray")(given);
  } catch (const py::error_already_set& error) {
    // NumPy's exceptions for rows of different lengths and the like.
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    fail("NumPy says: " + text_of(error.value()));
  }
  const py::object type = array.attr("dtype");
  const auto kind = type.attr("kind").cast<std::string>();
  const bool empty = array.attr("size").cast<std::size_t>() == 0;
  if (!empty && kinds.find(kind) == std::string_view::npos) fail("is an array of " + text_of(type));
  return array;
}

std::string shape_of(const Py_buffer& buffer) {
  std::string text = "(";
  for (int axis = 0; axis < buffer.ndim; ++axis)
    text += (axis > 0 ? ", " : "") + std::to_string(buffer.shape[axis]);
  return text + (buffer.ndim == 1 ? ",)" : ")");
}

/// Returns the letter of a format of one native number, else 0.
char letter_of(const Py_buffer& buffer) {
  const char* format = buffer.format != nullptr ? buffer.format : "B";
  if (*format == '@' || *format == '=' || *format == (is_little ? '<' : '>')) ++format;
  return std::strlen(format) == 1 ? *format : '\0';
}

std::string columns(bool plane) { return plane ? "(n, 3) or (n, 2)" : "(n, 3)"; }

/// Returns the rows of shape (count, 3) or, in the plane, (count, 2); an empty array has no bodies.
std::size_t rows_of(const Numbers& numbers, const Argument& argument, bool plane,
                    std::optional<std::size_t> count) {
  const bool is_table =
      numbers.dimensions() == 2 && (numbers.length(1) == 3 || (plane && numbers.length(1) == 2));
  const bool is_nothing = numbers.dimensions() == 1 && numbers.length(0) == 0;
  const std::size_t rows = is_table ? numbers.length(0) : 0;
  if ((!is_table && !is_nothing) || (count && rows != *count)) {
    const std::string expected = count ? " with n = " + std::to_string(*count) : "";
    refuse(argument, "must have shape " + columns(plane) + expected, "has shape " + numbers.shape());
  }
  return rows;
}

Vec3 row_of(const Numbers& numbers, std::size_t row) {
  return {numbers.at(row, 0), numbers.at(row, 1), numbers.length(1) == 3 ? numbers.at(row, 2) : 0.0};
}

/// Returns numpy.dtype() of that name, made once.
template <int Which>
const py::object& type_named(const char* name) {
  // Never destroyed: statics outlive the interpreter.
  static const auto* const type = new py::object(numpy("dtype")(name));
  return *type;
}
const py::object& double_type() { return type_named<0>("f8"); }
const py::object& whole_type() { return type_named<1>("i8"); }

/// Returns numpy.ndarray(shape, dtype, buffer).
py::object made_array(PyObject* shape, const py::object& dtype, PyObject* memory) {
  static PyObject* const array_class = numpy("ndarray").release().ptr();
  PyObject* const arguments[] = {shape, dtype.ptr(), memory};
  auto array = py::reinterpret_steal<py::object>(PyObject_Vectorcall(array_class, arguments, 3, nullptr));
  if (!array) throw py::error_already_set();
  return array;
}

}  // namespace

void refuse(const Argument& argument, std::string_view expectation, const std::string& found,
            ErrorCode code) {
  throw BadResult({code, std::string(argument.name), no_body,
                   std::string(argument.call) + ": " + std::string(argument.name) + " " +
                       std::string(expectation) + ", but " + found});
}

void refuse_type(const Argument& argument, std::string_view expectation, py::handle given) {
  throw py::type_error(std::string(argument.call) + ": " + std::string(argument.name) + " " +
                       std::string(expectation) + ", but is " + text_of(py::repr(given)));
}

void require_function(const py::object& given, const Argument& argument, std::string_view expectation) {
  if (!given.is_none() && PyCallable_Check(given.ptr()) == 0) refuse_type(argument, expectation, given);
}

std::uint64_t whole_number(py::handle given, const Argument& argument) {
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  if (!index) {
    PyErr_Clear();
    refuse_type(argument, "must be a whole number", given);
  }
  const unsigned long long number = PyLong_AsUnsignedLongLong(index.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  refuse(argument, "must be a whole number from 0 to 2^64 - 1", "is " + text_of(index));
}

std::vector<std::uint64_t> whole_numbers(py::handle given, const Argument& argument, bool* is_signed) {
  const py::object array = as_array(given, argument, "iu", "whole numbers");
  const bool may_be_negative = array.attr("dtype").attr("kind").cast<std::string>() == "i";
  if (is_signed != nullptr) *is_signed = may_be_negative;
  const py::object plain = numpy("ascontiguousarray")(array, may_be_negative ? "i8" : "u8");
  Py_buffer buffer{};
  if (PyObject_GetBuffer(plain.ptr(), &buffer, PyBUF_RECORDS_RO) != 0) throw py::error_already_set();
  const std::string shape = shape_of(buffer);
  const auto count = static_cast<std::size_t>(buffer.len) / sizeof(std::uint64_t);
  std::vector<std::uint64_t> values(count);
  if (count > 0) std::memcpy(values.data(), buffer.buf, count * sizeof(std::uint64_t));
  const bool is_row = array.attr("ndim").cast<int>() == 1;
  PyBuffer_Release(&buffer);
  if (!is_row) refuse(argument, "must have shape (n,)", "has shape " + shape);
  return values;
}

Numbers::Numbers(py::handle given, const Argument& argument) {
  if (take(given)) return;
  const py::object array = as_array(given, argument, "fiu", "real numbers");
  // float64 in this machine's byte order is always a readable buffer.
  if (!take(numpy("asarray")(array, double_type()))) throw py::error_already_set();
}

Numbers::~Numbers() { PyBuffer_Release(&buffer_); }

bool Numbers::take(py::handle given) {
  if (PyObject_CheckBuffer(given.ptr()) == 0 || may_be_masked(given)) return false;
  if (PyObject_GetBuffer(given.ptr(), &buffer_, PyBUF_RECORDS_RO) != 0) {
    PyErr_Clear();
    buffer_ = {};
    return false;
  }
  const char letter = letter_of(buffer_);
  is_single_ = letter == 'f';
  if (letter == 'd' || letter == 'f') return true;
  PyBuffer_Release(&buffer_);
  buffer_ = {};
  return false;
}

std::string Numbers::shape() const { return shape_of(buffer_); }

double Numbers::at_offset(std::ptrdiff_t offset) const {
  const char* const at = static_cast<const char*>(buffer_.buf) + offset;
  if (is_single_) {
    float number;
    std::memcpy(&number, at, sizeof number);
    return static_cast<double>(number);
  }
  double number;
  std::memcpy(&number, at, sizeof number);
  return number;
}

Vec3 vector_of(py::handle given, const Argument& argument, bool plane) {
  // Usual tuples are read without NumPy.
  if (PyTuple_CheckExact(given.ptr()) && PyTuple_GET_SIZE(given.ptr()) == 3) {
    double numbers[3];
    bool are_floats = true;
    for (Py_ssize_t k = 0; k < 3 && are_floats; ++k) {
      PyObject* const item = PyTuple_GET_ITEM(given.ptr(), k);
      are_floats = PyFloat_CheckExact(item);
      if (are_floats) numbers[k] = PyFloat_AS_DOUBLE(item);
    }
    if (are_floats) return {numbers[0], numbers[1], numbers[2]};
  }
  const Numbers numbers(given, argument);
  const bool fits =
      numbers.dimensions() == 1 && (numbers.length(0) == 3 || (plane && numbers.length(0) == 2));
  if (!fits)
    refuse(argument, plane ? "must have shape (3,) or (2,)" : "must have shape (3,)",
           "has shape " + numbers.shape());
  return {numbers.at(0), numbers.at(1), numbers.length(0) == 3 ? numbers.at(2) : 0.0};
}

std::vector<Vec3> vectors_of(py::handle given, const Argument& argument, bool plane,
                             std::optional<std::size_t> count) {
  const Numbers numbers(given, argument);
  const std::size_t rows = rows_of(numbers, argument, plane, count);
  std::vector<Vec3> vectors(rows);
  for (std::size_t row = 0; row < rows; ++row) vectors[row] = row_of(numbers, row);
  return vectors;
}

ContactEvents contact_events_of(const std::string& name, const Argument& argument) {
  if (name == "all") return ContactEvents::all;
  if (name == "begin_and_end") return ContactEvents::begin_and_end;
  if (name == "impacts") return ContactEvents::impacts;
  refuse(argument, "must be \"all\", \"begin_and_end\" or \"impacts\"", "is \"" + name + "\"");
}

std::vector<double> each_of(py::handle given, const Argument& argument, std::size_t count) {
  const Numbers numbers(given, argument);
  if (numbers.dimensions() == 0) return std::vector<double>(count, numbers.scalar());
  if (numbers.dimensions() != 1 || numbers.length(0) != count)
    refuse(argument, "must be one number, or one for each of " + std::to_string(count) + " bodies",
           "has shape " + numbers.shape());
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = numbers.at(k);
  return values;
}

std::vector<std::uint64_t> each_whole_of(py::handle given, const Argument& argument, std::size_t count) {
  if (PyIndex_Check(given.ptr()) != 0 && PyObject_HasAttrString(given.ptr(), "__len__") == 0)
    return std::vector<std::uint64_t>(count, whole_number(given, argument));
  std::vector<std::uint64_t> values = whole_numbers(given, argument);
  if (values.size() != count)
    refuse(argument, "must be one number, or one for each of " + std::to_string(count) + " bodies",
           "has " + std::to_string(values.size()));
  return values;
}

std::int32_t group_of(py::handle given, const Argument& argument) {
  const auto group = given.cast<long long>();
  constexpr long long least = std::numeric_limits<std::int32_t>::min(),
                      most = std::numeric_limits<std::int32_t>::max();
  if (group < least || group > most) refuse(argument, "must have 32 bits", "is " + std::to_string(group));
  return static_cast<std::int32_t>(group);
}

SensorClass sensor_class_of(std::uint64_t given, const Argument& argument) {
  if (given > std::numeric_limits<SensorClass>::max())
    refuse(argument, "must lie in [0, 255]", "is " + std::to_string(given));
  return static_cast<SensorClass>(given);
}

std::vector<State> states_of(py::handle positions, py::handle velocities, std::string_view call, bool plane) {
  const std::vector<Vec3> places = vectors_of(positions, {call, "positions"}, plane);
  std::vector<State> states(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) states[k].position = places[k];
  if (velocities.is_none()) return states;
  const std::vector<Vec3> speeds = vectors_of(velocities, {call, "velocities"}, plane, places.size());
  for (std::size_t k = 0; k < places.size(); ++k) states[k].velocity = speeds[k];
  return states;
}

void read_states(py::handle answer, std::span<State> states, std::string_view call, bool plane) {
  const auto refuse_answer = [&](const std::string& found) {
    refuse({call, "probe"}, "must return (positions, velocities)", found);
  };
  if (PyTuple_Check(answer.ptr()) == 0 && PyList_Check(answer.ptr()) == 0)
    refuse_answer("returned " + text_of(py::type::handle_of(answer).attr("__name__")));
  if (PySequence_Fast_GET_SIZE(answer.ptr()) != 2)
    refuse_answer("returned " + std::to_string(PySequence_Fast_GET_SIZE(answer.ptr())) + " things");
  PyObject** const pair = PySequence_Fast_ITEMS(answer.ptr());
  const Argument argument_of[] = {{call, "positions of the probe"}, {call, "velocities of the probe"}};
  const Numbers positions(pair[0], argument_of[0]), velocities(pair[1], argument_of[1]);
  rows_of(positions, argument_of[0], plane, states.size());
  rows_of(velocities, argument_of[1], plane, states.size());
  for (std::size_t k = 0; k < states.size(); ++k) states[k] = {row_of(positions, k), row_of(velocities, k)};
}

NewArray::NewArray(std::initializer_list<std::size_t> shape, const py::object& dtype, std::size_t item_size) {
  py::tuple lengths(shape.size());
  std::size_t items = 1, axis = 0;
  for (const std::size_t length : shape) {
    items *= length;
    lengths[axis++] = length;
  }
  const auto bytes = py::reinterpret_steal<py::object>(
      PyByteArray_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(items * item_size)));
  if (!bytes) throw py::error_already_set();
  memory_ = PyByteArray_AS_STRING(bytes.ptr());
  array_ = made_array(lengths.ptr(), dtype, bytes.ptr());
}

py::object row_type(std::span<const Field> fields, std::size_t row_size) {
  py::list names, formats, offsets;
  for (const Field& field : fields) {
    names.append(field.name);
    formats.append(field.type);
    offsets.append(field.offset);
  }
  py::dict description;
  description["names"] = names;
  description["formats"] = formats;
  description["offsets"] = offsets;
  description["itemsize"] = row_size;
  return numpy("dtype")(description);
}

NewArray new_doubles(std::initializer_list<std::size_t> shape) {
  return {shape, double_type(), sizeof(double)};
}
NewArray new_whole_numbers(std::size_t count) { return {{count}, whole_type(), sizeof(std::int64_t)}; }

py::object array_of(std::span<const double> numbers) {
  NewArray array = new_doubles({numbers.size()});
  if (!numbers.empty()) std::memcpy(array.data<double>(), numbers.data(), numbers.size_bytes());
  return array.take();
}

py::object array_of(const Vec3& vector) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const py::bytes bytes(reinterpret_cast<const char*>(&vector), sizeof vector);
  static PyObject* const three = PyLong_FromLong(3);
  return made_array(three, double_type(), bytes.ptr());
}

py::object array_of(std::span<const Vec3> vectors) {
  NewArray array = new_doubles({vectors.size(), 3});
  if (!vectors.empty()) std::memcpy(array.data<double>(), vectors.data(), vectors.size_bytes());
  return array.take();
}

py::tuple arrays_of(std::span<const State> states) {
  NewArray positions = new_doubles({states.size(), 3}), velocities = new_doubles({states.size(), 3});
  for (std::size_t k = 0; k < states.size(); ++k) {
    std::memcpy(positions.data<double>() + 3 * k, &states[k].position, sizeof(Vec3));
    std::memcpy(velocities.data<double>() + 3 * k, &states[k].velocity, sizeof(Vec3));
  }
  return py::make_tuple(positions.take(), velocities.take());
}

py::bytes bytes_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<std::byte> bytes_from(py::handle given, const Argument& argument) {
  Py_buffer buffer{};
  if (PyObject_GetBuffer(given.ptr(), &buffer, PyBUF_SIMPLE) != 0) {
    PyErr_Clear();
    throw py::type_error(std::string(argument.call) + ": " + std::string(argument.name) +
                         " must be bytes, but is " + text_of(py::type::handle_of(given).attr("__name__")));
  }
  const auto* const begin = static_cast<const std::byte*>(buffer.buf);
  std::vector<std::byte> bytes(begin, begin + buffer.len);
  PyBuffer_Release(&buffer);
  return bytes;
}

BodyId id_of(py::handle given, const Argument& argument) {
  if (given.is_none()) return no_body;
  BodyId body = no_body;
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  // A list of truth values is a mask, and no ids 0 and 1.
  if (!index || PyBool_Check(given.ptr())) {
    PyErr_Clear();
    refuse_type(argument, "must be the id of a body", given);
  }
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  // Ids are neither negative nor longer than 64 bits.
  if (overflow == 0 && number >= 0) body = BodyId::unpack(static_cast<std::uint64_t>(number));
  static const py::handle id_class = package_attribute("kinesphere.ids", "BodyId").release();
  if (py::isinstance(given, id_class)) body.world = given.attr("world").cast<std::uint32_t>();
  return body;
}

Ids ids_of(py::handle given, const Argument& argument) {
  if (PyLong_Check(given.ptr()) != 0 || given.is_none()) return {{id_of(given, argument)}, true};
  if (PyIndex_Check(given.ptr()) != 0 && PyObject_HasAttrString(given.ptr(), "__len__") == 0)
    return {{id_of(given, argument)}, true};
  Ids result;
  // The ids in a list know their world; NumPy drops that.
  if (PyList_Check(given.ptr()) != 0 || PyTuple_Check(given.ptr()) != 0) {
    for (const py::handle item : py::reinterpret_borrow<py::sequence>(given))
      result.ids.push_back(id_of(item, argument));
    return result;
  }
  for (const std::uint64_t number : whole_numbers(given, argument))
    result.ids.push_back(BodyId::unpack(number));
  return result;
}

py::object object_of(BodyId body) {
  if (body == no_body) return py::none();
  static const py::handle id_class = package_attribute("kinesphere.ids", "BodyId").release();
  return id_class(number_of(body), body.world);
}

py::object array_of(std::span<const BodyId> ids) {
  NewArray array = new_whole_numbers(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) array.data<std::int64_t>()[k] = number_of(ids[k]);
  return array.take();
}

py::object package_attribute(const char* module, const char* name) {
  return py::module_::import(module).attr(name);
}

std::string text_of_parts(const py::object& self, std::span<const char* const> parts) {
  std::string text = text_of(self.get_type().attr("__name__")) + "(";
  for (const char* const part : parts) {
    py::object value = self.attr(part);
    if (py::hasattr(value, "tolist")) value = py::tuple(value.attr("tolist")());
    if (text.back() != '(') text += ", ";
    text += std::string(part) + "=" + text_of(py::repr(value));
  }
  return text + ")";
}

py::object numpy(const char* name) {
  static const py::handle module = py::module_::import("numpy").release();
  return module.attr(name);
}

namespace {
/// Returns a member of one of the package's enumerations.
template <class Kind>
py::object member(const char* enumeration, Kind kind) {
  return package_attribute("kinesphere.kinds", enumeration)(static_cast<int>(kind));
}
}  // namespace

py::object object_of_field(EventKind kind) { return member("EventKind", kind); }
py::object object_of_field(Wall wall) { return wall == Wall::none ? py::none() : member("Wall", wall); }
py::object object_of_field(Senses senses) { return member("Senses", senses); }
py::object object_of_field(MonitorEventKind kind) { return member("MonitorEventKind", kind); }
py::object object_of_field(Verdict verdict) { return member("Verdict", verdict); }

}  // namespace kinesphere::python
