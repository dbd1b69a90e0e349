// What callers can ask of a monitor.
#include <pybind11/stl.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "errors.hpp"
#include "exchange.hpp"
#include "monitor.hpp"
#include "monitor_reports.hpp"
#include "records.hpp"

namespace kinesphere::python {
namespace {

/// Returns a structured array with a row for each item.
template <class Record, class Item>
py::object rows_as_table(std::span<const Field> fields, const std::vector<Item>& items) {
  return table_of_records<Record>(fields, items.size(), [&](std::size_t k) { return record_of(items[k]); });
}

py::object answer_pairs(const MonitorHandle& handle, const TrackIds& first, const TrackIds& second,
                        std::uint32_t level) {
  if (second.ids.size() != first.ids.size())
    refuse({"answer", "second"}, "must have one id for each of first, " + std::to_string(first.ids.size()),
           "has " + std::to_string(second.ids.size()));
  std::vector<PairAnswerRecord> records;
  {
    const py::gil_scoped_release released;
    for (std::size_t row = 0; row < first.ids.size(); ++row) {
      const auto found = handle.monitor.answer(first.ids[row], second.ids[row], level);
      if (!found) throw_of_row(found.error(), "answer", row, false);
      PairAnswerRecord& record = records.emplace_back(record_of(*found));
      record.first = first.ids[row];
      record.second = second.ids[row];
    }
  }
  return table_of_records<PairAnswerRecord>(pair_answer_fields, records.size(),
                                            [&](std::size_t k) { return records[k]; });
}

py::object answer_of_monitor(MonitorHandle& handle, const py::object& first, const py::object& second,
                             std::uint32_t level) {
  const auto turn = handle.take("answer");
  const TrackIds a = track_ids_of(first, {"answer", "first"}), b = track_ids_of(second, {"answer", "second"});
  if (!a.is_single || !b.is_single) return answer_pairs(handle, a, b, level);
  return py::cast(handle.monitor.answer(a.ids.front(), b.ids.front(), level).value());
}

py::object needed_reports(MonitorHandle& handle, double until) {
  const auto turn = handle.take("needed");
  if (std::isnan(until)) refuse({"needed", "until"}, "must be a number", "is nan", ErrorCode::not_finite);
  return rows_as_table<ReportRequestRecord>(report_request_fields, handle.monitor.needed(until));
}

std::string short_text(double number) { return py::str("{:.6g}").format(number).cast<std::string>(); }

std::string answer_text(const PairAnswer& answer) {
  return "<PairAnswer " + std::string(name_of(answer.verdict)) + " until " + short_text(answer.until) +
         ": distance " + short_text(answer.lower) + " to " + short_text(answer.upper) +
         ", closest approach " + short_text(answer.closest_distance) + " at " +
         short_text(answer.closest_time) + (answer.predicted ? ", predicted>" : ">");
}

void bind_pair_answer(py::module_& module) {
  module.attr("pair_answer_dtype") = row_type(pair_answer_fields, sizeof(PairAnswerRecord));
  py::class_<PairAnswer> bound(module, "PairAnswer",
                               "The verdict about two tracks and a separation now, and a forecast; a copy.");
  each_pair_answer_property(
      [&](const char* name, auto get, const char* doc) { bound.def_property_readonly(name, get, doc); });
  bound.def("__repr__", answer_text);
}

void bind_views_of_monitor(py::module_& module) {
  using Place = TrackView::Place;
  py::class_<Place>(module, "TrackPlace", "A place where a track may be: within radius of centre.")
      .def_property_readonly("centre", [](const Place& place) { return array_of(place.centre); })
      .def_property_readonly("velocity", [](const Place& place) { return array_of(place.velocity); })
      .def_readonly("radius", &Place::radius, "An ErrorBound.")
      .def("__repr__", [](const Place& place) {
        return py::str("<TrackPlace {!r} within {!r}>")
            .format(array_of(place.centre), py::cast(place.radius));
      });
  py::class_<TrackView>(module, "TrackView", "What a monitor knows about a track now; a copy.")
      .def_readonly("id", &TrackView::id)
      .def_readonly("track_class", &TrackView::track_class)
      .def_readonly("timestamp", &TrackView::timestamp, "Of the latest report.")
      .def_readonly("stale", &TrackView::stale)
      .def_readonly("places", &TrackView::places,
                    "The track certainly is in one of these. There are several only while reports contradict "
                    "each other.")
      .def("__repr__", [](const TrackView& view) {
        return "<TrackView " + std::to_string(view.id) + ", reported for " + short_text(view.timestamp) +
               (view.stale ? ", stale>" : ">");
      });

  py::class_<MonitorCounters> counters(module, "MonitorCounters", "What a monitor has done so far; a copy.");
  const std::pair<const char*, std::uint64_t MonitorCounters::*> members[] = {
      {"reports", &MonitorCounters::reports},       {"late", &MonitorCounters::late},
      {"repeated", &MonitorCounters::repeated},     {"contradictions", &MonitorCounters::contradictions},
      {"polls", &MonitorCounters::polls},           {"searches", &MonitorCounters::searches},
      {"near_pairs", &MonitorCounters::near_pairs}, {"rechecks", &MonitorCounters::rechecks},
  };
  for (const auto& [name, member] : members) counters.def_readonly(name, member);
  counters.def(
      "__repr__", [members = std::vector(std::begin(members), std::end(members))](const MonitorCounters& of) {
        std::string text = "<MonitorCounters:";
        for (const auto& [name, member] : members)
          text += std::string(text.back() == ':' ? " " : ", ") + std::to_string(of.*member) + " " + name;
        return text + ">";
      });
}

/// A call that only reads the monitor, which is passed to `read`.
template <class Read>
auto reading_monitor(const char* call, Read read) {
  return [call, read](MonitorHandle& handle) {
    const auto turn = handle.take(call);
    return read(std::as_const(handle.monitor));
  };
}

}  // namespace

void bind_monitor_answers(py::module_& module, MonitorClass& monitor) {
  bind_pair_answer(module);
  bind_views_of_monitor(module);
  monitor
      .def_property_readonly("time", reading_monitor("time", [](const Monitor& now) { return now.time(); }))
      .def_property_readonly("counters",
                             reading_monitor("counters", [](const Monitor& now) { return now.counters(); }))
      .def("__len__", reading_monitor("len", [](const Monitor& now) { return now.size(); }))
      .def("__contains__",
           [](MonitorHandle& handle, const py::object& id) {
             const auto turn = handle.take("contains");
             return handle.monitor.contains(track_id_of(id, {"contains", "id"}));
           })
      .def("__repr__",
           reading_monitor("repr",
                           [](const Monitor& now) {
                             return py::str("<Monitor of {} tracks at {}>").format(now.size(), now.time());
                           }))
      .def("tracks",
           reading_monitor("tracks", [](const Monitor& now) { return array_of_tracks(now.tracks()); }),
           "The ids of all tracks, in ascending order: an array of uint64.")
      .def(
          "track",
          [](MonitorHandle& handle, const py::object& id) {
            const auto turn = handle.take("track");
            return handle.monitor.track(track_id_of(id, {"track", "id"})).value();
          },
          py::arg("id"), "What is known about a track now.")
      .def("answer", answer_of_monitor, py::arg("first"), py::arg("second"), py::arg("level") = 0,
           R"(The verdict about two tracks at a level, with its forecast: a PairAnswer.

For arrays of ids, shape (n,), a structured array of pair_answer_dtype, with a row for each pair. Cost: that of
a recheck of each pair; O(near pairs) where the latest reports alone leave open what was certified before.)")
      .def("open_pairs",
           reading_monitor("open_pairs",
                           [](const Monitor& now) {
                             return rows_as_table<OpenPairRecord>(open_pair_fields, now.open_pairs());
                           }),
           "The pairs that are not certainly apart: a structured array with first, second, level, verdict "
           "(a number of Verdict) and since, in the order of ids and levels.")
      .def("predicted_pairs",
           reading_monitor("predicted_pairs",
                           [](const Monitor& now) {
                             return rows_as_table<PredictedPairRecord>(predicted_pair_fields,
                                                                       now.predicted_pairs());
                           }),
           "The pairs that are predicted to come within a separation: a structured array with first, second, "
           "level, since, likely_time, closest_time and closest_distance, in the order of ids and levels.")
      .def_property_readonly(
          "open_pair_count",
          reading_monitor("open_pair_count", [](const Monitor& now) { return now.open_pair_count(); }),
          "Pairs that are not certainly apart or were not at some time in the current window; about 150 "
          "bytes each.")
      .def(
          "crowd",
          [](MonitorHandle& handle, std::size_t pairs) {
            const auto turn = handle.take("crowd");
            return array_of_tracks(handle.monitor.crowd(pairs));
          },
          py::arg("pairs"),
          "Tracks whose removal reduces open_pair_count to at most `pairs`, those with most open pairs "
          "first.")
      .def("needed", needed_reports, py::arg("until"),
           R"(The reports that are needed by `until` so that no verdict turns undecided before.

A structured array with track, by (time) and other, in the order of times, each track once. Pairs are known only
up to the end of the current window.)");
}

}  // namespace kinesphere::python
