// Errors of calls whose arguments fit no function: pybind11 answers them with a list of signatures. The
// package says instead which argument is wrong (kinesphere.arguments).
#include <pybind11/pybind11.h>

#include <string>

#include "errors.hpp"
#include "exchange.hpp"

namespace kinesphere::python {
namespace {

using Record = py::detail::function_record;

/// The function of pybind11 through which all its functions are called.
PyCFunctionWithKeywords pybind_dispatcher = nullptr;

/// Returns what pybind11 knows about the arguments of a function and its overloads: for each overload the
/// signature, the number of arguments that need no name, and (name, has default) of each.
py::list overloads_of(const Record* record) {
  py::list overloads;
  for (; record != nullptr; record = record->next) {
    py::list arguments;
    for (const auto& argument : record->args)
      arguments.append(py::make_tuple(argument.name == nullptr ? "" : argument.name, bool(argument.value)));
    overloads.append(py::make_tuple(record->signature, record->nargs_pos, arguments));
  }
  return overloads;
}

/// Replaces the TypeError of a call that fits no overload if the package can say what is wrong.
void explain_wrong_call(const Record& record, PyObject* args, PyObject* kwargs) {
  py::error_already_set raised;
  constexpr std::string_view mark = " arguments. The following argument types are supported:";
  if (std::string(py::str(raised.value())).find(mark) == std::string::npos) return raised.restore();
  const bool makes = record.is_constructor;
  const py::object name = makes ? record.scope.attr("__name__") : py::object(py::str(record.name));
  const py::object named =
      kwargs == nullptr ? py::object(py::dict()) : py::reinterpret_borrow<py::object>(kwargs);
  const py::object message = package_attribute("kinesphere.arguments", "wrong_call")(
      name, overloads_of(&record), py::handle(args), named);
  if (message.is_none()) return raised.restore();
  PyErr_SetObject(PyExc_TypeError, message.ptr());
}

PyObject* call_and_explain(PyObject* self, PyObject* args, PyObject* kwargs) {
  PyObject* const result = pybind_dispatcher(self, args, kwargs);
  if (result != nullptr || PyErr_ExceptionMatches(PyExc_TypeError) == 0) return result;
  try {
    // py::capsule would take the error that is set for one of its own.
    explain_wrong_call(*static_cast<const Record*>(PyCapsule_GetPointer(self, PyCapsule_GetName(self))), args,
                       kwargs);
  } catch (py::error_already_set& failed) {
    failed.restore();
  }
  return nullptr;
}

/// Makes a function of pybind11 explain its errors. Anything else stays as it is.
void explain_errors_of(py::handle member) {
  if (Py_IS_TYPE(member.ptr(), &PyStaticMethod_Type)) member = member.attr("__func__");
  const py::handle function = py::detail::get_function(member);
  if (!function || PyCFunction_Check(function.ptr()) == 0) return;
  const py::handle self = PyCFunction_GET_SELF(function.ptr());
  if (!self || !py::isinstance<py::capsule>(self)) return;
  PyMethodDef& definition = *reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
  const auto method =
      reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(definition.ml_meth));
  if (method == call_and_explain) return;
  pybind_dispatcher = method;
  definition.ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(call_and_explain));
}

}  // namespace

void bind_arguments(py::module_& module) {
  for (const auto& [name, member] : py::reinterpret_borrow<py::dict>(module.attr("__dict__"))) {
    explain_errors_of(member);
    if (!py::isinstance<py::type>(member)) continue;
    for (const py::handle inner : py::list(member.attr("__dict__").attr("values")()))
      explain_errors_of(inner);
  }
}

}  // namespace kinesphere::python
