#include "mover.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "errors.hpp"
#include "exchange.hpp"

namespace kinesphere::python {
namespace {

/// The origin of a body that has none yet.
constexpr MotionOrigin unknown_departure{.time = std::numeric_limits<double>::quiet_NaN()};

/// Worlds of two dimensions and of three may have these bodies.
constexpr bool plane_or_space = true;

std::shared_ptr<MoverHandle> create_mover(const py::object& function, const py::object& positions,
                                          const py::object& velocities, double start_time) {
  if (PyCallable_Check(function.ptr()) == 0)
    refuse_type({"MotionSource", "function"}, "must be a function of (ids, t, since, positions, velocities)",
                function);
  auto handle = std::make_shared<MoverHandle>(MoverHandle{function, {}});
  for (const State& state : states_of(positions, velocities, "MotionSource", plane_or_space))
    handle->departures.push_back({start_time, state});
  return handle;
}

void set_origin(MoverHandle& handle, const py::object& bodies, double t, const py::object& positions,
                const py::object& velocities) {
  const auto turn = handle.in_use.take_alone("set_origin", "mover");
  const Ids named = ids_of(bodies, {"set_origin", "bodies"});
  std::vector<State> states;
  if (named.is_single) {
    states = {{vector_of(positions, {"set_origin", "positions"}, plane_or_space),
               vector_of(velocities, {"set_origin", "velocities"}, plane_or_space)}};
  } else {
    states = states_of(positions, velocities, "set_origin", plane_or_space);
  }
  if (states.size() != named.ids.size())
    refuse({"set_origin", "positions"}, "must have n = " + std::to_string(named.ids.size()) + " as bodies",
           "has " + std::to_string(states.size()));
  constexpr std::uint32_t most = 1u << 28;
  for (const BodyId body : named.ids)
    if (body.index >= most)
      refuse({"set_origin", "bodies"}, "must be ids of a world", "one is " + to_string(body));
  for (std::size_t k = 0; k < states.size(); ++k) {
    const std::uint32_t index = named.ids[k].index;
    if (index >= handle.departures.size())
      handle.departures.resize(index + std::size_t{1}, unknown_departure);
    handle.departures[index] = {t, states[k]};
  }
}

py::tuple states_now(MoverHandle& handle, const py::object& ids, double t) {
  const auto turn = handle.in_use.take_alone("mover", "mover");
  const Ids named = ids_of(ids, {"mover", "ids"});
  std::vector<State> states(named.ids.size());
  ask(handle, named.ids, t, states, "mover", plane_or_space);
  return arrays_of(states);
}

}  // namespace

const MotionOrigin& MoverHandle::origin(BodyId body) const {
  if (body.index < departures.size() && !std::isnan(departures[body.index].time))
    return departures[body.index];
  throw BadResult({ErrorCode::unknown_body, "motion", body,
                   "run: motion must know where all bodies set out, but does not of body " + to_string(body) +
                       " (MotionSource.set_origin)"});
}

void ask(const MoverHandle& handle, std::span<const BodyId> ids, double time, std::span<State> states,
         std::string_view call, bool plane) {
  NewArray since = new_doubles({ids.size(), 1}), positions = new_doubles({ids.size(), 3}),
           velocities = new_doubles({ids.size(), 3});
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const MotionOrigin& from = handle.origin(ids[k]);
    since.data<double>()[k] = from.time;
    std::memcpy(positions.data<double>() + 3 * k, &from.state.position, sizeof(Vec3));
    std::memcpy(velocities.data<double>() + 3 * k, &from.state.velocity, sizeof(Vec3));
  }
  const py::object arguments[] = {array_of(ids), py::float_(time), since.take(), positions.take(),
                                  velocities.take()};
  PyObject* const raw[] = {arguments[0].ptr(), arguments[1].ptr(), arguments[2].ptr(), arguments[3].ptr(),
                           arguments[4].ptr()};
  const auto answer = py::reinterpret_steal<py::object>(
      PyObject_Vectorcall(handle.function.ptr(), raw, std::size(raw), nullptr));
  if (!answer) throw py::error_already_set();
  read_states(answer, states, call, plane);
}

void FunctionMover::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  constexpr std::size_t few = 2;
  const auto is_known = [&](BodyId id) {
    return id.index < answers_.size() && answers_[id.index].time == time;
  };
  if (ids.size() <= few && std::all_of(ids.begin(), ids.end(), is_known)) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = answers_[ids[k].index].state;
    return;
  }
  interruptions_.look(1);
  interruptions_.call([&] { ask(handle_, ids, time, states, call_, plane_); });
  if (ids.size() > few) return;
  for (std::size_t k = 0; k < ids.size(); ++k) answers_.at(ids[k].index) = {time, states[k]};
}

void bind_mover(py::module_& module) {
  py::class_<MoverHandle, std::shared_ptr<MoverHandle>>(
      module, "MotionSource",
      R"(A motion of your own, whose bodies World.run() can give velocities.

function(ids, t, since, positions, velocities) -> (positions, velocities) says where bodies are at time t
that set out at `since` from these positions with these velocities: since has shape (n, 1), the others (n,
3), so that

    MotionSource(lambda ids, t, since, places, speeds: (places + speeds * (t - since), speeds), positions)

moves them straight on. It must depend on nothing else but the bodies, and is asked for times in any order.
From start_time on they set out from positions and velocities (shape (n, 3) or (n, 2)), those of the ids 0
to n - 1; what a run answers is kept here. mover(ids, t) tells states.)")
      .def(py::init(&create_mover), py::arg("function"), py::arg("positions"),
           py::arg("velocities") = py::none(), py::kw_only(), py::arg("start_time") = 0.0)
      .def("set_origin", set_origin, py::arg("bodies"), py::arg("t"), py::arg("positions"),
           py::arg("velocities"),
           R"(Bodies set out anew at time t, as the world has been told (add, set_velocity, teleport).

One id and vectors of shape (3,), or n ids and shape (n, 3).)")
      .def("__call__", states_now, py::arg("ids"), py::arg("t"))
      .def("__len__", [](const MoverHandle& handle) { return handle.departures.size(); })
      .def("__repr__",
           [](const MoverHandle& handle) {
             return "<MotionSource of " + std::to_string(handle.departures.size()) + " bodies>";
           })
      .def(py::pickle(
          [](const MoverHandle& handle) {
            return py::make_tuple(handle.function, bytes_of(std::as_bytes(std::span(handle.departures))));
          },
          [](const py::tuple& state) {
            static_assert(std::is_trivially_copyable_v<MotionOrigin>);
            const std::vector<std::byte> bytes = bytes_from(state[1], {"pickle", "departures"});
            std::vector<MotionOrigin> departures(bytes.size() / sizeof(MotionOrigin));
            if (!departures.empty())
              std::memcpy(departures.data(), bytes.data(), departures.size() * sizeof(MotionOrigin));
            return std::make_shared<MoverHandle>(MoverHandle{state[0], std::move(departures)});
          }))
      .def("__copy__",
           [](const MoverHandle& handle) {
             return std::make_shared<MoverHandle>(MoverHandle{handle.function, handle.departures});
           })
      .def("__deepcopy__", [](const MoverHandle& handle, const py::dict& memo) {
        const py::object function = py::module_::import("copy").attr("deepcopy")(handle.function, memo);
        return std::make_shared<MoverHandle>(MoverHandle{function, handle.departures});
      });
}

}  // namespace kinesphere::python
