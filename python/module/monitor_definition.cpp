#include "monitor_definition.hpp"

#include <limits>
#include <string>

#include <pybind11/stl.h>

namespace kinesphere::python {
namespace {

using limits_of_double = std::numeric_limits<double>;

std::string number_text(double number) { return py::repr(py::float_(number)).cast<std::string>(); }
std::string vector_text(const Vec3& vector) {
  return "(" + number_text(vector.x) + ", " + number_text(vector.y) + ", " + number_text(vector.z) + ")";
}

std::string error_bound_text(const ErrorBound& bound) {
  const std::string horizontal = number_text(bound.horizontal()), vertical = number_text(bound.vertical());
  if (bound == ErrorBound(bound.total())) return "ErrorBound(" + number_text(bound.total()) + ")";
  if (bound == ErrorBound::cylinder(bound.horizontal(), bound.vertical()))
    return "ErrorBound.cylinder(" + horizontal + ", " + vertical + ")";
  return "<ErrorBound: " + horizontal + " horizontally, " + vertical + " vertically, " +
         number_text(bound.total()) + " in total>";
}

/// Returns the plain number for a ball, as that is how users write it.
std::string limit_text(const ErrorBound& bound) {
  return bound == ErrorBound(bound.total()) ? number_text(bound.total()) : error_bound_text(bound);
}

const char* shape_name(Separation::Shape shape) {
  switch (shape) {
    case Separation::Shape::ellipsoid:
      return "ellipsoid";
    case Separation::Shape::cylinder:
      return "cylinder";
    case Separation::Shape::well_clear:
      return "well_clear";
  }
  return "unknown";
}

Separation::Shape shape_named(const std::string& name) {
  for (const auto shape :
       {Separation::Shape::ellipsoid, Separation::Shape::cylinder, Separation::Shape::well_clear})
    if (name == shape_name(shape)) return shape;
  refuse({"Separation", "shape"}, "must be \"ellipsoid\", \"cylinder\" or \"well_clear\"",
         "is \"" + name + "\"");
}

std::string separation_text(const Separation& one) {
  const bool is_sphere = one.shape == Separation::Shape::ellipsoid && one.horizontal == one.vertical;
  std::string text = "Separation." + std::string(is_sphere ? "sphere" : shape_name(one.shape)) + "(" +
                     number_text(one.horizontal);
  if (!is_sphere) text += ", " + number_text(one.vertical);
  if (one.shape == Separation::Shape::well_clear) text += ", " + number_text(one.modified_tau);
  if (one.look_ahead != 0.0) text += ", look_ahead=" + number_text(one.look_ahead);
  return text + ")";
}

std::string class_text(const TrackClass& one) {
  std::string text = "TrackClass(acceleration_limit=" + limit_text(one.acceleration_limit);
  if (!(one.planned_acceleration == Vec3{}))
    text += ", planned_acceleration=" + vector_text(one.planned_acceleration);
  return text + ", largest_speed=" + limit_text(one.largest_speed) + ")";
}

std::string rule_text(const SeparationRule& rule) {
  std::string text =
      "SeparationRule(" + std::to_string(rule.first_class) + ", " + std::to_string(rule.second_class) + ", [";
  for (std::size_t k = 0; k < rule.levels.size(); ++k)
    text += (k > 0 ? ", " : "") + separation_text(rule.levels[k]);
  return text + "])";
}

void bind_bounds(py::module_& module) {
  py::class_<ErrorBound>(
      module, "ErrorBound",
      R"(An upper limit of an error: in the horizontal plane, along the vertical, and in total.

Wherever one is taken, a plain number is a ball of that radius.)")
      .def(py::init<double>(), py::arg("radius"))
      .def_static("cylinder", &ErrorBound::cylinder, py::arg("horizontal"), py::arg("vertical"),
                  "The bound for which the horizontal and the vertical limit hold simultaneously.")
      .def_property_readonly("horizontal", &ErrorBound::horizontal)
      .def_property_readonly("vertical", &ErrorBound::vertical)
      .def_property_readonly("total", [](const ErrorBound& bound) { return bound.total(); })
      .def(
          "__eq__", [](const ErrorBound& a, const ErrorBound& b) { return a == b; }, py::is_operator())
      .def("__repr__", error_bound_text)
      .def(py::pickle(
          [](const ErrorBound& bound) {
            py::tuple parts;
            const auto write = [&](double horizontal, double vertical, double total) {
              parts = py::make_tuple(horizontal, vertical, total);
            };
            ErrorBound::serialize(bound, write);
            return parts;
          },
          [](const py::tuple& parts) {
            ErrorBound bound;
            const auto read = [&](double& horizontal, double& vertical, double& total) {
              horizontal = parts[0].cast<double>();
              vertical = parts[1].cast<double>();
              total = parts[2].cast<double>();
            };
            ErrorBound::serialize(bound, read);
            return bound;
          }));
  py::implicitly_convertible<py::float_, ErrorBound>();
  py::implicitly_convertible<py::int_, ErrorBound>();

  py::class_<TrackClass>(
      module, "TrackClass",
      R"(Motion limits that hold for all tracks of a class; one of the two is finite at least.

acceleration_limit (length / time^2): the largest deviation from the planned acceleration.
planned_acceleration (length / time^2): shape (3,) or (2,).
largest_speed (length / time).)")
      .def(
          py::init([](const ErrorBound& limit, const py::object& planned, const ErrorBound& speed) {
            return TrackClass{limit, vector_of(planned, {"TrackClass", "planned_acceleration"}, true), speed};
          }),
          py::arg("acceleration_limit") = limits_of_double::infinity(),
          py::arg("planned_acceleration") = py::make_tuple(0.0, 0.0, 0.0),
          py::arg("largest_speed") = limits_of_double::infinity())
      .def_readonly("acceleration_limit", &TrackClass::acceleration_limit)
      .def_property_readonly("planned_acceleration",
                             [](const TrackClass& one) { return array_of(one.planned_acceleration); })
      .def_readonly("largest_speed", &TrackClass::largest_speed)
      .def("__repr__", class_text)
      .def(py::pickle(
          [](const TrackClass& one) {
            const Vec3& plan = one.planned_acceleration;
            return py::make_tuple(one.acceleration_limit, py::make_tuple(plan.x, plan.y, plan.z),
                                  one.largest_speed);
          },
          [](const py::tuple& parts) {
            return TrackClass{parts[0].cast<ErrorBound>(), vector_of(parts[1], {"pickle", "plan"}, false),
                              parts[2].cast<ErrorBound>()};
          }));
}

void bind_separations(py::module_& module) {
  const auto look_ahead = py::arg("look_ahead") = 0.0;
  py::class_<Separation>(module, "Separation",
                         R"(A region around a track, in which another track is *within* the separation.

Lengths are > 0. look_ahead (time, >= 0) is the time in which closest approaches are predicted, if both tracks
go straight on; with 0 nothing is predicted.)")
      .def(py::init(
               [](const std::string& shape, double horizontal, double vertical, double ahead, double tau) {
                 return Separation{shape_named(shape), horizontal, vertical, ahead, tau};
               }),
           py::arg("shape"), py::arg("horizontal"), py::arg("vertical"), look_ahead,
           py::arg("modified_tau") = 0.0)
      .def_static("sphere", &Separation::sphere, py::arg("distance"), look_ahead,
                  "The distance (length) is at most `distance`, predicted look_ahead (time) ahead.")
      .def_static("ellipsoid", &Separation::ellipsoid, py::arg("horizontal"), py::arg("vertical"), look_ahead,
                  "(horizontal distance / horizontal)^2 + (vertical distance / vertical)^2 <= 1.")
      .def_static("cylinder", &Separation::cylinder, py::arg("horizontal"), py::arg("vertical"), look_ahead,
                  "The horizontal distance is at most horizontal, and the vertical one at most vertical.")
      .def_static("well_clear", &Separation::well_clear, py::arg("horizontal"), py::arg("vertical"),
                  py::arg("modified_tau"), look_ahead,
                  R"(Loss of well clear with the modified tau (time, >= 0) of RTCA DO-365, as
Separation.well_clear(1222.32, 137.16, 35.0, look_ahead=55.0) in metres and seconds. look_ahead is the time in
which its loss is predicted.)")
      .def_property_readonly(
          "shape", [](const Separation& one) { return shape_name(one.shape); },
          "\"ellipsoid\", \"cylinder\" or \"well_clear\".")
      .def_readonly("horizontal", &Separation::horizontal)
      .def_readonly("vertical", &Separation::vertical, "Ignored in two dimensions.")
      .def_readonly("look_ahead", &Separation::look_ahead)
      .def_readonly("modified_tau", &Separation::modified_tau)
      .def(
          "__eq__", [](const Separation& a, const Separation& b) { return a == b; }, py::is_operator())
      .def("__repr__", separation_text)
      .def(py::pickle(
          [](const Separation& one) {
            return py::make_tuple(shape_name(one.shape), one.horizontal, one.vertical, one.look_ahead,
                                  one.modified_tau);
          },
          [](const py::tuple& parts) {
            return Separation{shape_named(parts[0].cast<std::string>()), parts[1].cast<double>(),
                              parts[2].cast<double>(), parts[3].cast<double>(), parts[4].cast<double>()};
          }));

  py::class_<SeparationRule>(module, "SeparationRule",
                             R"(The separations between the tracks of two classes, by their numbers.

levels: Separations, the widest first, for example a caution and an alarm. A level is an index into them; each
has verdicts of its own.)")
      .def(py::init([](std::size_t first, std::size_t second, const py::object& levels) {
             return SeparationRule{first, second,
                                   list_of<Separation>(levels, {"SeparationRule", "levels"}, "a Separation")};
           }),
           py::arg("first_class"), py::arg("second_class"), py::arg("levels"))
      .def_readonly("first_class", &SeparationRule::first_class)
      .def_readonly("second_class", &SeparationRule::second_class)
      .def_readonly("levels", &SeparationRule::levels)
      .def("__repr__", rule_text)
      .def(py::pickle(
          [](const SeparationRule& rule) {
            return py::make_tuple(rule.first_class, rule.second_class, rule.levels);
          },
          [](const py::tuple& parts) {
            return SeparationRule{parts[0].cast<std::size_t>(), parts[1].cast<std::size_t>(),
                                  parts[2].cast<std::vector<Separation>>()};
          }));

  py::class_<Shard>(module, "Shard",
                    R"(The part of all pairs that one monitor watches: shards first to first + count - 1.

A pair belongs to the shard whose number is the lower of its two ids modulo `of`. Monitors that receive the
same reports divide the pairs among themselves in this way; each tells of its pairs what a single monitor
would.)")
      .def(py::init([](std::uint64_t of, std::uint64_t first, std::uint64_t count) {
             return Shard{of, first, count};
           }),
           py::arg("of") = 1, py::arg("first") = 0, py::arg("count") = 1)
      .def_readonly("of", &Shard::of)
      .def_readonly("first", &Shard::first)
      .def_readonly("count", &Shard::count)
      .def(
          "__eq__", [](const Shard& a, const Shard& b) { return a == b; }, py::is_operator())
      .def("__repr__",
           [](const Shard& shard) {
             return "Shard(of=" + std::to_string(shard.of) + ", first=" + std::to_string(shard.first) +
                    ", count=" + std::to_string(shard.count) + ")";
           })
      .def(py::pickle([](const Shard& shard) { return py::make_tuple(shard.of, shard.first, shard.count); },
                      [](const py::tuple& parts) {
                        return Shard{parts[0].cast<std::uint64_t>(), parts[1].cast<std::uint64_t>(),
                                     parts[2].cast<std::uint64_t>()};
                      }));
}

}  // namespace

void read_argument(const py::object& given, const Argument& argument, const MonitorDefinition& /*definition*/,
                   std::vector<TrackClass>& classes) {
  classes = list_of<TrackClass>(given, argument, "a TrackClass");
}
void read_argument(const py::object& given, const Argument& argument, const MonitorDefinition& /*definition*/,
                   std::vector<SeparationRule>& rules) {
  rules = list_of<SeparationRule>(given, argument, "a SeparationRule");
}

void bind_monitor_definition(py::module_& module) {
  bind_bounds(module);
  bind_separations(module);
}

}  // namespace kinesphere::python
