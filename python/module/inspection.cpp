// Inspection of a world, and its recordings.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>

#include "errors.hpp"
#include "exchange.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/recording.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

/// Returns the named bodies, or all of them.
std::vector<BodyId> named_or_all(const WorldHandle& handle, const py::object& bodies, std::string_view call) {
  return bodies.is_none() ? handle.world.bodies() : ids_of(bodies, {call, "bodies"}).ids;
}

py::tuple bounds(WorldHandle& handle, const py::object& bodies) {
  const auto turn = handle.take("bounds");
  const std::vector<BodyId> ids = named_or_all(handle, bodies, "bounds");
  NewArray centres = new_doubles({ids.size(), 3}), radii = new_doubles({ids.size()});
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const BodyView view = handle.world.body(ids[k]).value();
    const Vec3 centre = view.is_static ? view.definition.position : view.bound.centre_at(handle.world.time());
    for (int axis = 0; axis < 3; ++axis)
      centres.data<double>()[3 * k + static_cast<std::size_t>(axis)] = centre[axis];
    radii.data<double>()[k] =
        view.is_static ? view.definition.radius : view.bound.radius_at(handle.world.time());
  }
  return py::make_tuple(centres.take(), radii.take());
}

py::object images(WorldHandle& handle, const py::object& bodies) {
  const auto turn = handle.take("images");
  const std::vector<BodyId> ids = named_or_all(handle, bodies, "images");
  NewArray array({ids.size(), 3}, numpy("dtype")("i8"), sizeof(std::int64_t));
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const auto image = handle.world.body(ids[k]).value().image;
    std::copy(image.begin(), image.end(), array.data<std::int64_t>() + 3 * k);
  }
  return array.take();
}

/// Returns the image of `position` on the path of the body since the caller placed it: the one nearest to
/// where the last report has it now. Reports are less than half a period off (WorldDefinition::periodic).
Vec3 unwrapped_one(const World& world, const BodyView& view, Vec3 position) {
  const WorldDefinition& definition = world.definition();
  const Vec3 moved =
      view.is_static ? Vec3{} : view.bound.centre_at(world.time()) - view.bound.centre_at(view.bound.time);
  for (int axis = 0; axis < 3; ++axis) {
    if (!definition.periodic[axis]) continue;
    const double period = definition.box->upper[axis] - definition.box->lower[axis];
    const double expected = view.definition.position[axis] + moved[axis] +
                            static_cast<double>(view.image[static_cast<std::size_t>(axis)]) * period;
    position[axis] += period * std::round((expected - position[axis]) / period);
  }
  return position;
}

py::object unwrapped(WorldHandle& handle, const py::object& positions, const py::object& bodies) {
  const auto turn = handle.take("unwrapped");
  const std::vector<BodyId> ids = named_or_all(handle, bodies, "unwrapped");
  const std::vector<Vec3> given =
      vectors_of(positions, {"unwrapped", "positions"}, handle.is_plane(), ids.size());
  std::vector<Vec3> places(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k)
    places[k] = unwrapped_one(handle.world, handle.world.body(ids[k]).value(), given[k]);
  return array_of(places);
}

py::object touching(WorldHandle& handle, const py::object& body) {
  const auto turn = handle.take("touching");
  return array_of(handle.world.touching(id_of(body, {"touching", "body"})).value());
}

py::list sensed(WorldHandle& handle, const py::object& body) {
  const auto turn = handle.take("sensor_overlaps");
  py::list found;
  for (const SensorOverlap& one :
       handle.world.sensor_overlaps(id_of(body, {"sensor_overlaps", "body"})).value())
    found.append(py::make_tuple(object_of(one.body), one.distance));
  return found;
}

py::tuple sensor(const WorldHandle& handle, std::uint64_t sensor_class) {
  if (sensor_class > 255)
    refuse({"sensor", "sensor_class"}, "must lie in [0, 255]", "is " + std::to_string(sensor_class));
  const Sensor& found = handle.world.sensor(static_cast<SensorClass>(sensor_class));
  return py::make_tuple(array_of(found.distances), found.mask);
}

py::list certificates(WorldHandle& handle) {
  const auto turn = handle.take("certificates");
  py::list list;
  for (const Certificate& known : handle.world.inspection().certificates())
    list.append(py::make_tuple(object_of(known.first), object_of(known.second), known.until));
  return list;
}

py::list cells(WorldHandle& handle) {
  const auto turn = handle.take("cells");
  py::list list;
  for (const CellView& cell : handle.world.inspection().cells())
    list.append(py::make_tuple(cell.box, cell.bodies));
  return list;
}

/// Returns None, or the place and the defect.
py::object audit(WorldHandle& handle) {
  const auto turn = handle.take("audit");
  const auto finding = without_gil(handle, [&] { return handle.world.inspection().audit(); });
  if (!finding) return py::none();
  return py::make_tuple(finding->where, finding->what);
}

py::list busiest(WorldHandle& handle, std::size_t count) {
  const auto turn = handle.take("busiest");
  py::list list;
  for (const BusyBody& busy : handle.world.inspection().busiest(count).value()) list.append(busy);
  return list;
}

py::bytes stop_recording(WorldHandle& handle) {
  const auto turn = handle.take("stop_recording");
  return bytes_of(handle.world.stop_recording().value());
}

/// The counters beside those of the kinds of events.
struct Counter {
  const char* name;
  std::uint64_t Counters::*member;
  const char* documentation = "";
};
constexpr Counter all_counters[] = {
    {"probes", &Counters::probes, "States asked for, one per body and call."},
    {"window_ends", &Counters::window_ends},
    {"starts", &Counters::starts},
    {"restarts", &Counters::restarts},
    {"pair_checks", &Counters::pair_checks},
    {"wall_checks", &Counters::wall_checks},
    {"searches", &Counters::searches},
    {"candidates", &Counters::candidates},
    {"hot_pairs", &Counters::hot_pairs},
    {"certificates", &Counters::certificates},
    {"zeno_steps", &Counters::zeno_steps},
    {"repeated_contacts", &Counters::repeated_contacts},
    {"jammed_contacts", &Counters::jammed_contacts},
};

py::tuple numbers_of(const Counters& counters) {
  py::list events;
  for (const std::uint64_t count : counters.events) events.append(count);
  py::list numbers;
  numbers.append(events);
  for (const Counter& one : all_counters) numbers.append(counters.*one.member);
  return py::tuple(numbers);
}

Counters counters_of(const py::tuple& numbers) {
  Counters counters;
  const py::list events = numbers[0];
  if (numbers.size() != 1 + std::size(all_counters) || events.size() != counters.events.size())
    throw py::value_error("pickle: Counters must be of this version");
  for (std::size_t k = 0; k < events.size(); ++k) counters.events[k] = events[k].cast<std::uint64_t>();
  for (std::size_t k = 0; k < std::size(all_counters); ++k)
    counters.*all_counters[k].member = numbers[1 + k].cast<std::uint64_t>();
  return counters;
}

void bind_views(py::module_& module) {
  py::class_<BodyView>(module, "BodyView", "What the world knows of a body; a copy.")
      .def_property_readonly("radius", [](const BodyView& view) { return view.definition.radius; })
      .def_property_readonly("acceleration_limit",
                             [](const BodyView& view) { return view.definition.acceleration_limit; })
      .def_property_readonly(
          "planned_acceleration",
          [](const BodyView& view) { return array_of(view.definition.planned_acceleration); })
      .def_property_readonly("position_error",
                             [](const BodyView& view) { return view.definition.position_error; })
      .def_property_readonly("velocity_error",
                             [](const BodyView& view) { return view.definition.velocity_error; })
      .def_property_readonly(
          "position", [](const BodyView& view) { return array_of(view.definition.position); },
          "At the last report, shape (3,).")
      .def_property_readonly("velocity",
                             [](const BodyView& view) { return array_of(view.definition.velocity); })
      .def_property_readonly(
          "report_time", [](const BodyView& view) { return view.bound.time; }, "When that was.")
      .def_property_readonly("category", [](const BodyView& view) { return view.definition.filter.category; })
      .def_property_readonly("mask", [](const BodyView& view) { return view.definition.filter.mask; })
      .def_property_readonly("group", [](const BodyView& view) { return view.definition.filter.group; })
      .def_property_readonly("solid", [](const BodyView& view) { return view.definition.solid; })
      .def_property_readonly("sensor_class",
                             [](const BodyView& view) { return view.definition.sensor_class; })
      .def_property_readonly("user_data", [](const BodyView& view) { return view.definition.user_data; })
      .def_readonly("box", &BodyView::box, "Contains the body, and all that it senses, until box_end.")
      .def_readonly("box_end", &BodyView::box_end)
      .def_property_readonly(
          "image",
          [](const BodyView& view) { return py::make_tuple(view.image[0], view.image[1], view.image[2]); },
          "Where space repeats: how many boxes the body has gone beyond the first one.")
      .def_readonly("enabled", &BodyView::enabled)
      .def_readonly("is_static", &BodyView::is_static)
      .def_readonly("sleeping", &BodyView::sleeping)
      .def("__repr__", repr_of_parts("position", "velocity", "radius", "acceleration_limit", "report_time"));

  py::class_<Counters> counted(module, "Counters", "What a world has done so far; a copy.");
  for (const Counter& one : all_counters) counted.def_readonly(one.name, one.member, one.documentation);
  counted.def_property_readonly("steps", &Counters::steps)
      .def(
          "count",
          [](const Counters& counters, int kind) {
            if (kind < 0 || kind >= event_kind_count)
              refuse({"count", "kind"}, "must be an EventKind", "is " + std::to_string(kind));
            return counters.count(static_cast<EventKind>(kind));
          },
          py::arg("kind"), "Events of an EventKind that have been told.")
      .def("__eq__",
           [](const Counters& a, const py::object& b) {
             return py::isinstance<Counters>(b) && numbers_of(a).equal(numbers_of(b.cast<const Counters&>()));
           })
      .def("__repr__", repr_of_parts("steps", "probes", "window_ends", "starts", "restarts", "pair_checks",
                                     "wall_checks", "searches", "candidates", "hot_pairs", "certificates"))
      .def(py::pickle(&numbers_of, &counters_of));

  py::class_<BusyBody>(module, "BusyBody", "A body that was probed while profiling was on, and why; a copy.")
      .def_property_readonly("body", [](const BusyBody& busy) { return object_of(busy.body); })
      .def_property_readonly(
          "reason", [](const BusyBody& busy) { return name_of(busy.reason); },
          "One of touching, narrow_misses, loose_limit, contacts, travel, changes, queries.")
      .def_property_readonly(
          "advice", [](const BusyBody& busy) { return advice_on(busy.reason); },
          "What the reason means, and what makes such a body cheaper.")
      .def_readonly("probes", &BusyBody::probes, "Probed states of the body; the sum of the next five.")
      .def_readonly("touching", &BusyBody::touching, "For a body or wall that it touches.")
      .def_readonly("near", &BusyBody::near,
                    "For a body, wall or sensor distance that it may reach or leave.")
      .def_readonly("windows", &BusyBody::windows, "When it may leave its safe region, and spot checks.")
      .def_readonly("changes", &BusyBody::changes, "After changes and violated bounds.")
      .def_readonly("queries", &BusyBody::queries, "For queries and predictions with a probe.")
      .def_readonly("contacts", &BusyBody::contacts, "Events contact_begin and wall_begin of the body.")
      .def_readonly("acceleration_limit", &BusyBody::acceleration_limit, "Now (length / time^2).")
      .def_readonly("largest_acceleration", &BusyBody::largest_acceleration,
                    "Largest deviation from the planned acceleration that reported velocities prove.")
      .def("__repr__", [](const BusyBody& busy) {
        return "BusyBody(body=" + to_string(busy.body) + ", reason='" + std::string(name_of(busy.reason)) +
               "', probes=" + std::to_string(busy.probes) + ")";
      });
}

/// A replay; WorldView reads its world.
struct ReplayHandle {
  std::shared_ptr<FilterTrouble> trouble;
  Replay replay;
};

std::shared_ptr<ReplayHandle> open_replay(const py::object& recording, const py::object& pair_filter) {
  const std::vector<std::byte> bytes = bytes_from(recording, {"Replay", "recording"});
  auto trouble = std::make_shared<FilterTrouble>();
  auto replay = Replay::open(bytes, pair_filter_of(pair_filter, trouble)).value();
  return std::make_shared<ReplayHandle>(ReplayHandle{trouble, std::move(replay)});
}

py::object advance_replay(ReplayHandle& handle) {
  const std::optional<Event> event = handle.replay.advance().value();
  if (handle.trouble->thrown) std::rethrow_exception(std::exchange(handle.trouble->thrown, nullptr));
  return event ? py::cast(*event) : py::none();
}

/// Replays a recording, and returns all that happened.
py::tuple read_all(const py::object& recording, const py::object& pair_filter) {
  const std::vector<std::byte> bytes = bytes_from(recording, {"read_recording", "recording"});
  const auto trouble = std::make_shared<FilterTrouble>();
  const auto read = read_recording(bytes, pair_filter_of(pair_filter, trouble));
  if (trouble->thrown) std::rethrow_exception(std::exchange(trouble->thrown, nullptr));
  const RecordedRun& run = read.value();
  std::vector<EventRecord> events;
  for (const Event& event : run.events) events.push_back(record_of(event));
  std::vector<double> times;
  std::vector<BodyId> bodies;
  std::vector<State> states;
  for (const ProbedState& state : run.probed_states) {
    times.push_back(state.time);
    bodies.push_back(state.body);
    states.push_back(state.state);
  }
  const py::tuple arrays = arrays_of(states);
  return py::make_tuple(run.start_time, run.end_time, table_of(events), array_of(times), array_of(bodies),
                        arrays[0], arrays[1]);
}

}  // namespace

void bind_replay(py::module_& module) {
  py::class_<ReplayHandle, std::shared_ptr<ReplayHandle>>(
      module, "Replay", R"(A recorded run again, without what moved its bodies.

The first step that goes another way than its recording raises StateError (diverged) that names it.)")
      .def(py::init(&open_replay), py::arg("recording"), py::arg("pair_filter") = py::none())
      .def("advance", advance_replay, "The outcome of the next recorded advance: an Event, or None.")
      .def_property_readonly("finished", [](const ReplayHandle& handle) { return handle.replay.finished(); })
      .def_property_readonly("step", [](const ReplayHandle& handle) { return handle.replay.step(); })
      .def_property_readonly("step_count",
                             [](const ReplayHandle& handle) { return handle.replay.step_count(); })
      .def_property_readonly("hash", [](const ReplayHandle& handle) { return handle.replay.hash(); })
      .def(
          "world",
          [](const ReplayHandle& handle) {
            return std::make_shared<WorldHandle>(handle.replay.world().clone().value());
          },
          "A clone of the world as it is after the last step. Cost: O(n).")
      .def("__repr__", [](const ReplayHandle& handle) {
        return "<Replay at step " + std::to_string(handle.replay.step()) + " of " +
               std::to_string(handle.replay.step_count()) + ">";
      });
  module.def("_read_recording", read_all, py::arg("recording"), py::arg("pair_filter"));
}

void bind_inspection(py::module_& module, WorldClass& world) {
  bind_views(module);
  world
      .def("bodies", reading("bodies", [](const World& now) { return array_of(now.bodies()); }),
           "The ids of all bodies, fixed and disabled ones too: int64, shape (n,).")
      .def(
          "body",
          [](WorldHandle& handle, const py::object& body) {
            const auto turn = handle.take("body");
            return handle.world.body(id_of(body, {"body", "body"})).value();
          },
          py::arg("body"), "What the world knows of a body: a BodyView.")
      .def("bounds", bounds, py::arg("bodies") = py::none(),
           R"(The spheres that certainly contain these bodies now, or all bodies: centres, shape (n, 3), and
radii, shape (n,).)")
      .def(
          "images", images, py::arg("bodies") = py::none(),
          R"(Where space repeats: how many boxes these bodies, or all, had gone beyond the first one at their last
report. Shape (n, 3).)")
      .def(
          "unwrapped", unwrapped, py::arg("positions"), py::arg("bodies") = py::none(),
          R"(Where these bodies, or all, would be now if space did not repeat: shape (n, 3), for displacements.

positions (length): where they are at world.time, in any image, such as motion.states(world.time)[0]; shape (n,
3), or (n, 2) in a world of two dimensions. Paths start where bodies were last placed (add, teleport, enable). On
axes without repetition positions come back as they are.)")
      .def(
          "shape_of",
          [](WorldHandle& handle, const py::object& body) {
            const auto turn = handle.take("shape_of");
            return object_of(handle.world.body(id_of(body, {"shape_of", "body"})).value().shape);
          },
          py::arg("body"), "Of a static body; of any other a Ball at its last report.")
      .def(
          "user_data",
          [](WorldHandle& handle, const py::object& body) {
            const auto turn = handle.take("user_data");
            return handle.world.user_data(id_of(body, {"user_data", "body"})).value();
          },
          py::arg("body"), "The number that set_user_data() or add() stored for the body.")
      .def("touching", touching, py::arg("body"),
           "Whom the body touches, in the order in which the contacts began.")
      .def("sensor_overlaps", sensed, py::arg("body"),
           "Pairs of partner and sensor distance that the body is within.")
      .def("sensor", sensor, py::arg("sensor_class"), "The distances and the mask of a class.")
      .def_property_readonly("counters", reading("counters", [](const World& now) { return now.counters(); }))
      .def("memory",
           reading("memory",
                   [](const World& now) {
                     const Memory memory = now.inspection().memory();
                     py::dict parts;
                     parts["bodies"] = memory.bodies;
                     parts["windows"] = memory.windows;
                     parts["pairs"] = memory.pairs;
                     parts["contacts"] = memory.contacts;
                     parts["recording"] = memory.recording;
                     parts["other"] = memory.other;
                     return parts;
                   }),
           "Bytes by part. Cost: O(n).")
      .def("cells", cells, "Pairs of a Box and how many bodies lie in it.")
      .def("certificates", certificates,
           "Triples of two ids and until when it is certain that nothing changes between them.")
      .def(
          "set_profiling",
          [](WorldHandle& handle, bool on) {
            const auto turn = handle.take("set_profiling");
            require(handle.world.set_profiling(on));
          },
          py::arg("on"),
          R"(Switched on it begins from zero: timings() and busiest() tell what has cost since. Then run() processes
events one at a time.)")
      .def("timings",
           reading("timings",
                   [](const World& now) {
                     const Timings timings = now.inspection().timings();
                     py::dict parts;
                     parts["advances"] = timings.advances;
                     parts["advance"] = timings.advance;
                     parts["probes"] = timings.probes;
                     return parts;
                   }),
           "Real time (seconds) in advances, and in probes, while timing was on.")
      .def(
          "busiest", busiest, py::arg("count") = 10,
          R"(The bodies that were probed most often while profiling was on: a list of BusyBody, the most probed
first. Raises StateError (not_profiling) if profiling was never on. Cost: O(n).)")
      .def("audit", audit,
           "Checks all facts anew: None, or where and what is wrong. For tests; cost: O(n^2).")
      .def(
          "start_recording",
          [](WorldHandle& handle) {
            const auto turn = handle.take("start_recording");
            require(handle.world.start_recording());
          },
          "From now on all that goes into the world and comes out of it is recorded, in memory.")
      .def("stop_recording", stop_recording,
           "The recording as bytes, for Replay, read_recording() and `kinesphere replay`.")
      .def_property_readonly("recording", reading("recording", [](const World& now) {
                               return now.inspection().is_recording();
                             }));
}

}  // namespace kinesphere::python
