// Errors of the library as exceptions of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <utility>

#include "kinesphere/result.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Registers exceptions: BadResult, which Result::value() throws, becomes an exception of
/// kinesphere.errors.
void bind_errors(py::module_& module);
/// Makes all functions that have been bound so far name the argument that is wrong: a misspelled keyword, a
/// missing one, another type.
void bind_arguments(py::module_& module);

/// Throws an error that exists in this package alone.
[[noreturn]] void throw_state_error(std::string_view code, std::string_view argument,
                                    const std::string& message);

/// Throws BadResult unless the call succeeded.
inline void require(const Result<void>& result) { result.value(); }

}  // namespace kinesphere::python
