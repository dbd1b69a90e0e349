// Approaches of bodies on known paths: kinesphere.PolynomialPaths, which prepares the arrays in Python.
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "exchange.hpp"
#include "guard.hpp"
#include "kinesphere/approaches.hpp"
#include "threads.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

struct PathApproachRecord {
  std::int64_t first;
  std::int64_t second;
  double begin;
  double end;
  std::int64_t closest;
  bool begins_with_path;
  bool ends_with_path;
  bool is_certain;
  std::array<std::uint8_t, 5> unused;
};

constexpr Field path_approach_fields[] = {
    {"first", "i8", offsetof(PathApproachRecord, first)},
    {"second", "i8", offsetof(PathApproachRecord, second)},
    {"begin", "f8", offsetof(PathApproachRecord, begin)},
    {"end", "f8", offsetof(PathApproachRecord, end)},
    {"closest", "i8", offsetof(PathApproachRecord, closest)},
    {"begins_with_path", "?", offsetof(PathApproachRecord, begins_with_path)},
    {"ends_with_path", "?", offsetof(PathApproachRecord, ends_with_path)},
    {"is_certain", "?", offsetof(PathApproachRecord, is_certain)},
};

struct PathMinimumRecord {
  std::int64_t approach;
  std::int64_t first;
  std::int64_t second;
  double time;
  double distance;
  double relative_speed;
  State first_state;
  State second_state;
  Vec3 position_rtn;
  Vec3 velocity_rtn;
  bool is_cut_off;
  std::array<std::uint8_t, 7> unused;
};

constexpr Field path_minimum_fields[] = {
    {"approach", "i8", offsetof(PathMinimumRecord, approach)},
    {"first", "i8", offsetof(PathMinimumRecord, first)},
    {"second", "i8", offsetof(PathMinimumRecord, second)},
    {"time", "f8", offsetof(PathMinimumRecord, time)},
    {"distance", "f8", offsetof(PathMinimumRecord, distance)},
    {"relative_speed", "f8", offsetof(PathMinimumRecord, relative_speed)},
    {"first_position", "3f8", offsetof(PathMinimumRecord, first_state.position)},
    {"first_velocity", "3f8", offsetof(PathMinimumRecord, first_state.velocity)},
    {"second_position", "3f8", offsetof(PathMinimumRecord, second_state.position)},
    {"second_velocity", "3f8", offsetof(PathMinimumRecord, second_state.velocity)},
    {"relative_position_rtn", "3f8", offsetof(PathMinimumRecord, position_rtn)},
    {"relative_velocity_rtn", "3f8", offsetof(PathMinimumRecord, velocity_rtn)},
    {"is_cut_off", "?", offsetof(PathMinimumRecord, is_cut_off)},
};

PathApproachRecord record_of(const Approaches::Approach& one) {
  return {one.first,
          one.second,
          one.begin,
          one.end,
          static_cast<std::int64_t>(one.closest),
          one.begins_with_path,
          one.ends_with_path,
          one.is_certain,
          {}};
}

PathMinimumRecord record_of(const Approaches& found, const Approaches::Minimum& minimum) {
  const Approaches::Approach& approach = found.approaches[minimum.approach];
  return {static_cast<std::int64_t>(minimum.approach),
          approach.first,
          approach.second,
          minimum.time,
          minimum.distance,
          norm(minimum.relative_velocity()),
          minimum.first,
          minimum.second,
          in_orbital_frame(minimum.first, minimum.relative_position()),
          in_orbital_frame(minimum.first, minimum.relative_velocity()),
          minimum.is_cut_off,
          {}};
}

/// Returns an array's own memory. Precondition: it is contiguous and has this type.
template <class Number>
std::span<const Number> span_of(const py::buffer_info& array) {
  return {static_cast<const Number*>(array.ptr), static_cast<std::size_t>(array.size)};
}

/// Returns the approaches, the minima and the step. The arrays must be contiguous: bodies of uint32, the
/// others of float64.
py::tuple path_approaches(const py::buffer& bodies, const py::buffer& begins, const py::buffer& ends,
                          const py::buffer& coefficients, std::size_t terms, const py::buffer& errors,
                          bool is_chebyshev, double distance, std::optional<std::uint32_t> body,
                          std::optional<double> begin, std::optional<double> end, const py::object& threads,
                          const py::object& progress) {
  const std::array arrays{bodies.request(), begins.request(), ends.request(), coefficients.request(),
                          errors.request()};
  const PolynomialPaths paths{
      .basis = is_chebyshev ? PolynomialPaths::Basis::chebyshev : PolynomialPaths::Basis::monomial,
      .terms = terms,
      .bodies = span_of<std::uint32_t>(arrays[0]),
      .begins = span_of<double>(arrays[1]),
      .ends = span_of<double>(arrays[2]),
      .coefficients = span_of<double>(arrays[3]),
      .errors = span_of<double>(arrays[4])};
  Threads shared(threads);
  Interruptions interruptions;
  const auto report = [&](double done) {
    interruptions.look(1);
    if (!progress.is_none()) interruptions.call([&] { progress(done); });
  };
  const Approaches found = [&] {
    const py::gil_scoped_release released;
    return Approaches::of(paths, distance,
                          {.body = body,
                           .begin = begin,
                           .end = end,
                           .workers = shared.workers(),
                           .progress = ProgressFn(report)})
        .value();
  }();
  return py::make_tuple(
      table_of_records<PathApproachRecord>(path_approach_fields, found.approaches.size(),
                                           [&](std::size_t k) { return record_of(found.approaches[k]); }),
      table_of_records<PathMinimumRecord>(path_minimum_fields, found.minima.size(),
                                          [&](std::size_t k) { return record_of(found, found.minima[k]); }),
      found.step);
}

}  // namespace

void bind_paths(py::module_& module) {
  module.def("_path_approaches", path_approaches, py::arg("bodies"), py::arg("begins"), py::arg("ends"),
             py::arg("coefficients"), py::arg("terms"), py::arg("errors"), py::arg("is_chebyshev"),
             py::arg("distance"), py::arg("body"), py::arg("begin"), py::arg("end"), py::arg("threads"),
             py::arg("progress"));
}

}  // namespace kinesphere::python
