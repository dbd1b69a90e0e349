// Threads as Python passes them to a call.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "kinesphere/workers.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Threads: a number, or an existing Workers object.
class Threads {
 public:
  explicit Threads(const py::object& given) : given_(given) {
    if (py::isinstance<Workers>(given)) {
      workers_ = &given.cast<Workers&>();
    } else if (given.cast<int>() != 1) {
      own_.emplace(Workers::create(given.cast<int>()).value());
      workers_ = &*own_;
    }
  }
  Workers* workers() { return workers_; }

 private:
  py::object given_;
  std::optional<Workers> own_;
  Workers* workers_ = nullptr;
};

}  // namespace kinesphere::python
