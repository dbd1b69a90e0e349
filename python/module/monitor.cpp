// A monitor: its definition, reports that go in, and events that come out.
#include "monitor.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "definitions.hpp"
#include "errors.hpp"
#include "exchange.hpp"
#include "kinesphere/limits.hpp"
#include "monitor_definition.hpp"
#include "monitor_reports.hpp"

namespace kinesphere::python {
namespace {

/// A Python function that is polled for reports, or none. Must be made and destroyed under the GIL, and is
/// called without it.
class TrackPoll {
 public:
  TrackPoll(const py::object& given, std::string_view call, bool plane)
      : call_(call), plane_(plane), given_(given) {
    require_function(given, {call, "poll"}, "must be a function of (ids, time)");
  }

  Result<std::optional<MonitorEvent>> advance(Monitor& monitor, double until) {
    if (given_.is_none()) return monitor.advance(until);
    return monitor.advance(until, [this](std::span<const TrackId> ids, double time,
                                         std::span<std::optional<TrackReport>> reports) {
      interruptions_.call([&] { ask(ids, time, reports); });
    });
  }
  Interruptions& interruptions() { return interruptions_; }

 private:
  void ask(std::span<const TrackId> ids, double time, std::span<std::optional<TrackReport>> reports) const {
    const py::object asked = array_of_tracks(ids);
    const py::object answer = given_(asked, time);
    if (answer.is_none()) return;
    if (!py::isinstance<py::dict>(answer))
      throw py::type_error(call_ +
                           ": poll must return None or a dict of arguments of report(), but returned " +
                           py::repr(answer).cast<std::string>());
    GivenReports given = GivenReports::of(answer, call_, "poll");
    const bool has_ids = !given.ids.is_none();
    if (!has_ids) given.ids = asked;
    const Reports answered(given, call_, plane_);
    for (std::size_t row = 0; row < answered.size(); ++row) {
      const auto place = std::find(ids.begin(), ids.end(), answered.id(row)) - ids.begin();
      const auto k = static_cast<std::size_t>(place);
      if (k == ids.size() || reports[k])
        refuse({call_, "poll"}, "must report each of the tracks that it is asked for at most once",
               "returned " + std::to_string(answered.id(row)) + " in row " + std::to_string(row));
      reports[k] = answered.at(row);
    }
  }

  std::string call_;
  bool plane_;
  py::object given_;
  Interruptions interruptions_;
};

py::object advance_monitor(MonitorHandle& handle, double until, const py::object& poll) {
  const auto turn = handle.take("advance");
  TrackPoll polled(poll, "advance", handle.is_plane());
  const auto event =
      [&] {
        const py::gil_scoped_release released;
        return polled.advance(handle.monitor, until);
      }()
          .value();
  return event ? py::cast(*event) : py::none();
}

/// Takes all events up to a time, into handle.undelivered. Needs no GIL.
Result<void> take_events(MonitorHandle& handle, double until, TrackPoll& poll) {
  while (true) {
    const Result<std::optional<MonitorEvent>> event = poll.advance(handle.monitor, until);
    if (!event) return event.error();
    if (!*event) return {};
    handle.undelivered.push_back(record_of(**event));
    poll.interruptions().look();
  }
}

py::object deliver(MonitorHandle& handle) {
  const py::object table = table_of(handle.undelivered);
  handle.undelivered = {};
  return table;
}

py::object run_monitor(MonitorHandle& handle, double until, const py::object& poll) {
  const auto turn = handle.take("run");
  TrackPoll polled(poll, "run", handle.is_plane());
  require([&] {
    const py::gil_scoped_release released;
    return take_events(handle, until, polled);
  }());
  return deliver(handle);
}

/// Iterates over the events of a monitor up to a time.
class MonitorEventIterator {
 public:
  MonitorEventIterator(std::shared_ptr<MonitorHandle> handle, double until, py::object poll)
      : handle_(std::move(handle)), until_(until), poll_(std::move(poll)) {}

  double until() const { return until_; }

  py::object next() {
    const py::object event = advance_monitor(*handle_, until_, poll_);
    if (event.is_none()) throw py::stop_iteration();
    return event;
  }

 private:
  std::shared_ptr<MonitorHandle> handle_;
  double until_;
  py::object poll_;
};

void take_reports(MonitorHandle& handle, const GivenReports& given) {
  const auto turn = handle.take("report");
  const Reports reports(given, "report", handle.is_plane());
  const py::gil_scoped_release released;
  reports.check(handle.monitor);
  for (std::size_t row = 0; row < reports.size(); ++row)
    require(handle.monitor.report(reports.id(row), reports.at(row)));
}

/// Returns the times at which reports arrive: their timestamps, if None is given. Throws BadResult unless
/// they are finite and in order.
std::vector<double> arrivals_of(const py::object& given, const Reports& reports) {
  const Argument argument{"feed", "arrivals"};
  std::vector<double> arrivals(reports.size());
  const Column<double> column = given.is_none() ? Column(0.0) : real_column(given, argument, arrivals.size());
  for (std::size_t row = 0; row < arrivals.size(); ++row) {
    const double time = given.is_none() ? reports.timestamp(row) : column[row];
    const auto refuse_row = [&](std::string_view expectation, ErrorCode code) {
      refuse(argument, expectation,
             "is " + py::repr(py::float_(time)).cast<std::string>() + " in row " + std::to_string(row), code);
    };
    if (!std::isfinite(time)) refuse_row("must be finite", ErrorCode::not_finite);
    if (std::abs(time) > limits::largest_time)
      refuse_row("must lie within the limits of times", ErrorCode::out_of_range);
    if (row > 0 && time < arrivals[row - 1])
      refuse_row(given.is_none() ? "must be given where timestamps are not in ascending order"
                                 : "must be in ascending order",
                 ErrorCode::time_backwards);
    arrivals[row] = time;
  }
  return arrivals;
}

py::object feed(MonitorHandle& handle, const GivenReports& given, const py::object& arrivals) {
  const auto turn = handle.take("feed");
  const Reports reports(given, "feed", handle.is_plane());
  const std::vector<double> times = arrivals_of(arrivals, reports);
  TrackPoll nobody(py::none(), "feed", handle.is_plane());
  {
    const py::gil_scoped_release released;
    reports.check(handle.monitor);
    for (std::size_t row = 0; row < reports.size(); ++row) {
      // Reports that arrive together are taken together.
      if (row == 0 || times[row] != times[row - 1]) require(take_events(handle, times[row], nobody));
      require(handle.monitor.report(reports.id(row), reports.at(row)));
      nobody.interruptions().look();
    }
    if (!times.empty()) require(take_events(handle, times.back(), nobody));
  }
  return deliver(handle);
}

/// Removes tracks, all of them or, on an error, none.
void remove_tracks(MonitorHandle& handle, const py::object& given) {
  const auto turn = handle.take("remove");
  const TrackIds tracks = track_ids_of(given, {"remove", "ids"});
  std::vector<TrackId> sorted;
  for (std::size_t row = 0; row < tracks.ids.size(); ++row) {
    const TrackId id = tracks.ids[row];
    if (!handle.monitor.contains(id))
      throw_of_row(
          {ErrorCode::unknown_body, "ids", no_body, "remove: there is no track " + std::to_string(id)},
          "remove", row, tracks.is_single);
    sorted.push_back(id);
  }
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    refuse({"remove", "ids"}, "must all be different", "there are two " + std::to_string(*twice));
  for (const TrackId id : tracks.ids) require(handle.monitor.remove(id));
}

py::bytes save_monitor(MonitorHandle& handle) {
  const auto turn = handle.take("save");
  const std::vector<std::byte> bytes = [&] {
    const py::gil_scoped_release released;
    return handle.monitor.save();
  }();
  return bytes_of(bytes);
}

std::shared_ptr<MonitorHandle> restore_monitor(const py::object& snapshot) {
  return std::make_shared<MonitorHandle>(
      Monitor::restore(bytes_from(snapshot, {"restore", "snapshot"})).value());
}

py::bytes pickle_monitor(MonitorHandle& handle) {
  if (!handle.undelivered.empty())
    throw_state_error(
        "run_in_progress", "monitor",
        "pickle: monitor must have delivered its events, but a call was interrupted; call run() "
        "first");
  return save_monitor(handle);
}

void bind_reporting(MonitorClass& monitor) {
  const auto none = py::none();
  monitor
      .def(
          "report",
          [](MonitorHandle& handle, const py::object& ids, const py::object& timestamps,
             const py::object& positions, const py::object& velocities, const py::object& position_errors,
             const py::object& velocity_errors, const py::object& timestamp_errors,
             const py::object& track_classes, const py::object& plan_accelerations,
             const py::object& plan_acceleration_limits, const py::object& plan_valid_until) {
            take_reports(handle, {ids, timestamps, positions, velocities, position_errors, velocity_errors,
                                  timestamp_errors, track_classes, plan_accelerations,
                                  plan_acceleration_limits, plan_valid_until});
          },
          py::arg("ids"), py::arg("timestamps"), py::arg("positions"), py::arg("velocities") = none,
          py::arg("position_errors") = 0.0, py::arg("velocity_errors") = none, py::kw_only(),
          py::arg("timestamp_errors") = 0.0, py::arg("track_classes") = 0,
          py::arg("plan_accelerations") = none, py::arg("plan_acceleration_limits") = none,
          py::arg("plan_valid_until") = none,
          R"(Accepts reports that arrive now, all of them or, where something is wrong, none.

The first report of an id adds a track; one of another class than before starts the track anew. run(), advance()
or events() tell what follows from them.

ids: shape (n,), whole numbers from 0 to 2^64 - 1; or one id, and then one vector for each of the vectors.
timestamps (time): of the states, on the monitor's clock; late ones and those out of order are fine.
positions (length): shape (n, 3), or (n, 2) in two dimensions.
velocities (length / time): the same shape. None where none were reported, which requires a class with a
largest speed.

What follows is one value for all, or one for each report, shape (n,):
position_errors (length) and velocity_errors (length / time): how far the states may be off, which are bounds
and no standard deviations. Shape (n, 2) has horizontal and vertical limits; ErrorBound.cylinder() is one for
all. A velocity that was not reported has an infinite error.
timestamp_errors (time): how far the timestamps may be off.
track_classes: numbers of Monitor(classes=...).
plan_accelerations (length / time^2): shape (n, 3), of plans that are in force from the timestamp until
plan_valid_until (time, default inf), while accelerations differ from them by at most plan_acceleration_limits
(length / time^2, default 0). Where plan_valid_until is -inf there is no plan.

Raises InvalidValue that names the argument, the row and the track. Cost: about a microsecond for each.)")
      .def(
          "feed",
          [](MonitorHandle& handle, const py::object& ids, const py::object& timestamps,
             const py::object& positions, const py::object& velocities, const py::object& position_errors,
             const py::object& velocity_errors, const py::object& arrivals,
             const py::object& timestamp_errors, const py::object& track_classes,
             const py::object& plan_accelerations, const py::object& plan_acceleration_limits,
             const py::object& plan_valid_until) {
            return feed(
                handle,
                {ids, timestamps, positions, velocities, position_errors, velocity_errors, timestamp_errors,
                 track_classes, plan_accelerations, plan_acceleration_limits, plan_valid_until},
                arrivals);
          },
          py::arg("ids"), py::arg("timestamps"), py::arg("positions"), py::arg("velocities") = none,
          py::arg("position_errors") = 0.0, py::arg("velocity_errors") = none, py::kw_only(),
          py::arg("arrivals") = none, py::arg("timestamp_errors") = 0.0, py::arg("track_classes") = 0,
          py::arg("plan_accelerations") = none, py::arg("plan_acceleration_limits") = none,
          py::arg("plan_valid_until") = none,
          R"(Accepts reports that arrive one after the other, and returns the MonitorEvents of that time.

It is a loop in C++ over run(arrivals[k]) and report() of row k, with run(arrivals[-1]) in the end. arrivals
(time) are in ascending order, not before monitor.time; without them, reports arrive at their timestamps. All
others are as for report(). All reports are taken or, where something is wrong, none. Ctrl-C interrupts it after
some row: those before are taken, and their events come with the next run() or feed().)");
}

void bind_advancing(MonitorClass& monitor) {
  monitor
      .def("advance", advance_monitor, py::arg("until"), py::arg("poll") = py::none(),
           R"(Goes on to the next event, at most to time `until`: the MonitorEvent, or None at `until`.

Events of one time come in the order of their kind, ids and level; an end counts as the kind that it ends, and
what begins and ends for the same tracks keeps its order.
poll: a function f(ids, time) for tracks whose reports can be requested. The monitor calls it when a pair is
about to turn undecided, with ids of shape (n,). It returns a dict of arguments of report(), with a row for each
id; with "ids" only for these; or None if nobody has answered. What it raises comes out of this call, which may
be repeated.)")
      .def(
          "events",
          [](std::shared_ptr<MonitorHandle> handle, double until, py::object poll) {
            return MonitorEventIterator(std::move(handle), until, std::move(poll));
          },
          py::arg("until"), py::arg("poll") = py::none(),
          R"(Goes through all events up to time `until`: for event in monitor.events(60.0).

Each step is an advance(). In the loop reports may be taken and tracks removed.)")
      .def("run", run_monitor, py::arg("until"), py::arg("poll") = py::none(),
           R"(Goes on to time `until` and returns all MonitorEvents, in order; see advance().

The GIL is released meanwhile, and Ctrl-C interrupts it. After an exception the monitor can go on; the events
from before come first in what the next run() returns.)")
      .def("remove", remove_tracks, py::arg("ids"),
           "Removes a track, or all of an array, or on an error none. Their events `dropped` come next.");
}

}  // namespace

void bind_monitor(py::module_& module) {
  bind_monitor_definition(module);
  bind_monitor_events(module);
  py::class_<MonitorEventIterator>(module, "MonitorEventIterator",
                                   "The events of a monitor up to a time, one by one; see Monitor.events().")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &MonitorEventIterator::next)
      .def("__repr__", [](const MonitorEventIterator& events) {
        return py::str("<MonitorEventIterator until {}>").format(events.until());
      });

  MonitorClass monitor(module, "Monitor",
                       R"(Certain statements about the separation of tracks that report irregularly.

A World asks its bodies; a Monitor receives reports, which carry timestamps and errors of their own, and may be
late, out of order or missing. Between reports a track lies where the limits of its class allow. At each time
two tracks are certainly apart, certainly within a separation, or undecided by the reports; each change is an
event. With look-ahead times, closest approaches are also predicted.

    monitor = Monitor(classes=[TrackClass(acceleration_limit=3.0)],
                      separations=[SeparationRule(0, 0, [Separation.sphere(50.0, look_ahead=60.0)])])
    monitor.report(ids, timestamps, positions, velocities, position_errors=3.0)
    events = monitor.run(12.5)

Tracks have the caller's ids: whole numbers from 0 to 2^64 - 1. No certain verdict is ever wrong, as long as
tracks keep the limits of their classes, and of any three successive reports of a track at most one has larger
errors than it states. One thread at a time may use a monitor; another one is refused with StateError.)");
  bind_monitor_arguments(monitor, [](const MonitorDefinition& definition) {
    return std::make_shared<MonitorHandle>(Monitor::create(definition).value());
  });
  monitor
      .def_property_readonly(
          "definition",
          [](MonitorHandle& handle) {
            const auto turn = handle.take("definition");
            return arguments_of(handle.monitor.definition());
          },
          "What the monitor was made from: Monitor(**monitor.definition) makes another one.")
      .def(
          "save", save_monitor,
          R"(The whole monitor as bytes: Monitor.restore() makes one that goes on as this one does, to the bit.

Monitors are also pickled, and copied by copy.copy() and copy.deepcopy(). Cost: O(tracks + near pairs).)")
      .def_static(
          "restore", restore_monitor, py::arg("snapshot"),
          "The monitor that save() wrote. Raises InvalidValue (bad_snapshot) for bytes that are none.")
      .def(py::pickle(&pickle_monitor, [](const py::bytes& state) { return restore_monitor(state); }));
  bind_reporting(monitor);
  bind_advancing(monitor);
  bind_monitor_answers(module, monitor);
}

}  // namespace kinesphere::python
