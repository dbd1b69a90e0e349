// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
// Constructors of worlds and monitors, and the arguments that they were made from.
// clang-format off
#pragma once

#include <limits>
#include <optional>
#include <string>

#include <pybind11/stl.h>

#include "definition_arguments.hpp"

namespace kinesphere::python {

template <class Class, class Create>
void bind_world_arguments(Class& bound, const Create& create) {
  bound.def(
      py::init([create](const py::object& box, const py::object& periodic, const py::object& wall_filter, int dimensions, double contact_tolerance, const py::object& separation_distance, double zeno_interval, double start_time, const std::string& contacts, bool allow_overlap, bool spread_window_starts, bool adopt_observed_limits, double shear_rate) {
        WorldDefinition definition;
        definition.dimensions = dimensions;
        definition.contact_tolerance = contact_tolerance;
        definition.zeno_interval = zeno_interval;
        definition.start_time = start_time;
        definition.allow_overlap = allow_overlap;
        definition.spread_window_starts = spread_window_starts;
        definition.adopt_observed_limits = adopt_observed_limits;
        definition.shear_rate = shear_rate;
        read_argument(box, {"World", "box"}, definition, definition.box);
        read_argument(periodic, {"World", "periodic"}, definition, definition.periodic);
        read_argument(wall_filter, {"World", "wall_filter"}, definition, definition.wall_filter);
        read_argument(separation_distance, {"World", "separation_distance"}, definition, definition.separation_distance);
        read_argument(contacts, {"World", "contacts"}, definition, definition.contacts);
        return create(definition);
      }),
      py::kw_only(),
      py::arg("box") = py::none(),
      py::arg("periodic") = false,
      py::arg("wall_filter") = py::none(),
      py::arg("dimensions") = 3,
      py::arg("contact_tolerance") = 1e-06,
      py::arg("separation_distance") = py::none(),
      py::arg("zeno_interval") = 0.0,
      py::arg("start_time") = 0.0,
      py::arg("contacts") = "all",
      py::arg("allow_overlap") = true,
      py::arg("spread_window_starts") = false,
      py::arg("adopt_observed_limits") = true,
      py::arg("shear_rate") = 0.0,
      R"(box: walls, a Box or a pair of corners; without one the world is unbounded.
periodic: True, or axes such as "xy", on which the box repeats instead of having walls; in two dimensions True
means "xy".
wall_filter: the filter of all walls, a dict with category, mask and group or some of these (set_filter());
they meet a body as another body with this filter would. Without one they meet every body.
dimensions: 2 or 3, default 3. With 2, bodies are discs in the plane z = 0.
contact_tolerance: > 0 (length), default 1e-6: the largest gap of a contact.
separation_distance: (length, > contact_tolerance; default 4 of it): the gap at which a contact ends.
zeno_interval: >= 0 (time): contacts of a body that follow each other sooner are `repeated`.
start_time: The time at which the world begins.
contacts: which contact events the world reports. "all": a begin and an end for each contact, and a begin for
each further approach in between (event.already_touching). "impacts", for what only bounces: a begin for each
approach, and no ends. "begin_and_end", for contacts that are watched: one begin and one end, and the first
approach if the contact began without one or a response has parted the two.
allow_overlap: Default true. If False, bodies that certainly overlap are refused.
spread_window_starts: Has no effect.
adopt_observed_limits: Default true: a report that breaks the promise of its body raises the body's
acceleration limit to what explains the report.
shear_rate: (1 / time): the images of bodies across y slide along x, so that a flow goes on through the
borders. x and y repeat then, and all bodies are balls.
Raises ValueError (InvalidValue) that names the argument.)");
}

inline py::dict arguments_of(const WorldDefinition& definition) {
  py::dict arguments;
  arguments["box"] = argument_of(definition.box);
  arguments["periodic"] = argument_of(definition.periodic);
  arguments["wall_filter"] = argument_of(definition.wall_filter);
  arguments["dimensions"] = argument_of(definition.dimensions);
  arguments["contact_tolerance"] = argument_of(definition.contact_tolerance);
  arguments["separation_distance"] = argument_of(definition.separation_distance);
  arguments["zeno_interval"] = argument_of(definition.zeno_interval);
  arguments["start_time"] = argument_of(definition.start_time);
  arguments["contacts"] = argument_of(definition.contacts);
  arguments["allow_overlap"] = argument_of(definition.allow_overlap);
  arguments["spread_window_starts"] = argument_of(definition.spread_window_starts);
  arguments["adopt_observed_limits"] = argument_of(definition.adopt_observed_limits);
  arguments["shear_rate"] = argument_of(definition.shear_rate);
  return arguments;
}

template <class Class, class Create>
void bind_monitor_arguments(Class& bound, const Create& create) {
  bound.def(
      py::init([create](const py::object& classes, const py::object& separations, int dimensions, std::optional<double> start_time, double tolerance, double time_resolution, double window, double stale_after, double drop_after, double prediction_hold, double prediction_confirmation, double prediction_margin, double prediction_error_part, const Shard& shard) {
        MonitorDefinition definition;
        definition.dimensions = dimensions;
        definition.start_time = start_time;
        definition.tolerance = tolerance;
        definition.time_resolution = time_resolution;
        definition.window = window;
        definition.stale_after = stale_after;
        definition.drop_after = drop_after;
        definition.prediction_hold = prediction_hold;
        definition.prediction_confirmation = prediction_confirmation;
        definition.prediction_margin = prediction_margin;
        definition.prediction_error_part = prediction_error_part;
        definition.shard = shard;
        read_argument(classes, {"Monitor", "classes"}, definition, definition.classes);
        read_argument(separations, {"Monitor", "separations"}, definition, definition.separations);
        return create(definition);
      }),
      py::kw_only(),
      py::arg("classes"),
      py::arg("separations"),
      py::arg("dimensions") = 3,
      py::arg("start_time") = py::none(),
      py::arg("tolerance") = 0.001,
      py::arg("time_resolution") = 0.001,
      py::arg("window") = 1.0,
      py::arg("stale_after") = std::numeric_limits<double>::infinity(),
      py::arg("drop_after") = std::numeric_limits<double>::infinity(),
      py::arg("prediction_hold") = 0.0,
      py::arg("prediction_confirmation") = 0.0,
      py::arg("prediction_margin") = 0.0,
      py::arg("prediction_error_part") = 0.0,
      py::arg("shard") = Shard{},
      R"(classes: a list of TrackClass; report(track_classes=...) has their numbers.
separations: a list of SeparationRule. Pairs of classes that none names are not watched.
dimensions: 2 or 3, default 3. In two dimensions, z is ignored.
start_time: Without it the clock starts at the first report or the first time to advance to.
tolerance: > 0 (length), default 1e-3: how far outside the separation a pair still is `within`.
time_resolution: > 0 (time), default 1e-3: how late a verdict may be that time alone decides.
window: > 0 (time), default 1: about the time between two reports of a track.
stale_after: > 0 (time), default inf: age of the latest report at which a track is stale.
drop_after: > 0 (time), default inf: age of the latest report at which a track is dropped.
prediction_hold: >= 0 (time): a prediction ends once it has not held for this long.
prediction_confirmation: >= 0 (time): a prediction begins once it has held for this long.
prediction_margin: In [0, 1]: a prediction goes on within the separation enlarged by this part of it.
prediction_error_part: In [0, 1]: separations are enlarged for predictions by this part of the position errors
of both tracks.
shard: the pairs that this monitor watches.
Raises ValueError (InvalidValue) that names the argument.)");
}

inline py::dict arguments_of(const MonitorDefinition& definition) {
  py::dict arguments;
  arguments["classes"] = argument_of(definition.classes);
  arguments["separations"] = argument_of(definition.separations);
  arguments["dimensions"] = argument_of(definition.dimensions);
  arguments["start_time"] = argument_of(definition.start_time);
  arguments["tolerance"] = argument_of(definition.tolerance);
  arguments["time_resolution"] = argument_of(definition.time_resolution);
  arguments["window"] = argument_of(definition.window);
  arguments["stale_after"] = argument_of(definition.stale_after);
  arguments["drop_after"] = argument_of(definition.drop_after);
  arguments["prediction_hold"] = argument_of(definition.prediction_hold);
  arguments["prediction_confirmation"] = argument_of(definition.prediction_confirmation);
  arguments["prediction_margin"] = argument_of(definition.prediction_margin);
  arguments["prediction_error_part"] = argument_of(definition.prediction_error_part);
  arguments["shard"] = argument_of(definition.shard);
  return arguments;
}

}  // namespace kinesphere::python
