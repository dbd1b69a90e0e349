// Events as objects of Python, and as rows of a table.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "exchange.hpp"
#include "records.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Returns a kinesphere.Events.
py::object table_of(std::span<const EventRecord> records);

/// The events of a run that have not been returned yet, with those of their columns that the caller asks for.
class KeptEvents {
 public:
  /// `events` is "all", "none" or a sequence of names of columns. Throws BadResult if there is no such
  /// column, and if events are kept from an interrupted run that asked for others.
  void choose(const py::object& events);
  bool empty() const { return rows_.empty(); }
  /// Needs no GIL.
  void add(const EventRecord& record);
  /// Returns a kinesphere.Events, or a structured array of the columns, and keeps nothing.
  py::object take();

 private:
  bool all_ = true;
  std::vector<Field> columns_{};  ///< if not all; with their places in a row of rows_
  std::vector<std::pair<std::size_t, std::size_t>> parts_{{0, sizeof(EventRecord)}};  ///< offsets and sizes
  std::size_t row_size_ = sizeof(EventRecord);
  std::vector<std::byte> rows_{};
};

void bind_events(py::module_& module);

}  // namespace kinesphere::python
