#include "errors.hpp"

#include "exchange.hpp"

namespace kinesphere::python {
namespace {

void set_error(std::string_view code, std::string_view argument, BodyId body, const std::string& message) {
  const py::object made = package_attribute("kinesphere.errors", "error_of")(
      std::string(code), std::string(argument), object_of(body), message);
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
}

}  // namespace

void bind_errors(py::module_&) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const BadResult& bad) {
      const Error& error = bad.error();
      set_error(name_of(error.code), error.argument, error.body, error.message);
    }
  });
}

void throw_state_error(std::string_view code, std::string_view argument, const std::string& message) {
  set_error(code, argument, no_body, message);
  throw py::error_already_set();
}

}  // namespace kinesphere::python
