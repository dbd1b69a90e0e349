// Arguments of definitions: how each is read where Python has another form than the library, and told again.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "exchange.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere::python {

/// Read an argument into a field of `definition`, whose dimensions are known. Throw what is wrong with it.
void read_argument(const py::object& given, const Argument& argument, const WorldDefinition& definition,
                   std::optional<Box>& box);
void read_argument(const py::object& given, const Argument& argument, const WorldDefinition& definition,
                   Axes& axes);
void read_argument(const py::object& given, const Argument& argument, const WorldDefinition& definition,
                   std::optional<Filter>& filter);
void read_argument(const std::string& given, const Argument& argument, const WorldDefinition& definition,
                   ContactEvents& contacts);
/// None stands for the default, as NaN does in the library.
void read_argument(const py::object& given, const Argument& argument, const WorldDefinition& definition,
                   double& number);
void read_argument(const py::object& given, const Argument& argument, const MonitorDefinition& definition,
                   std::vector<TrackClass>& classes);
void read_argument(const py::object& given, const Argument& argument, const MonitorDefinition& definition,
                   std::vector<SeparationRule>& rules);

/// Returns the argument that makes this field.
template <class Field>
py::object argument_of(const Field& field) {
  return py::cast(field);
}
inline py::object argument_of(double number) {
  return std::isnan(number) ? py::none() : py::object(py::float_(number));
}
py::object argument_of(const Axes& axes);
py::object argument_of(ContactEvents contacts);
py::object argument_of(const std::optional<Filter>& filter);

}  // namespace kinesphere::python
