// A world as Python has it.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <memory>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "events.hpp"
#include "guard.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// What a function of Python's raised as the pair filter, which must not throw: kept until the call that
/// asked it is over.
struct FilterTrouble {
  std::exception_ptr thrown;
};

struct WorldHandle {
  explicit WorldHandle(World made) : world(std::move(made)) {}

  World world;
  InUse in_use{};
  /// Fixed bodies that have been added, also those that were removed since.
  std::unordered_set<std::uint64_t> fixed{};
  /// Events that a run has told before it was interrupted.
  std::vector<EventRecord> told{};
  /// There is a pair filter as long as this is.
  std::shared_ptr<FilterTrouble> filter_trouble{};

  bool is_plane() const { return world.definition().dimensions == 2; }
  InUse::Turn take(std::string_view call) { return in_use.take(call, "world"); }
};

/// The end of a call that may have asked the pair filter: raises what that raised.
inline void end_call(WorldHandle& handle) {
  if (!handle.filter_trouble || !handle.filter_trouble->thrown) return;
  std::rethrow_exception(std::exchange(handle.filter_trouble->thrown, nullptr));
}

/// Calls `work`, which may ask whoever it likes, without the GIL.
template <class Work>
auto without_gil(WorldHandle& handle, const Work& work) {
  auto result = [&] {
    const py::gil_scoped_release released;
    return work();
  }();
  end_call(handle);
  return result;
}

/// A call that only reads the world: `read` is handed that.
template <class Read>
auto reading(const char* call, Read read) {
  return [call, read](WorldHandle& handle) {
    const auto turn = handle.take(call);
    return read(std::as_const(handle.world));
  };
}

using WorldClass = py::class_<WorldHandle, std::shared_ptr<WorldHandle>>;

/// What World is made from, and by which it tells what it was made from.
py::dict arguments_of(const WorldDefinition& definition);
/// A World.restore() of these bytes.
std::shared_ptr<WorldHandle> restored(const py::object& snapshot, const py::object& pair_filter);

// By subject: each adds calls to the class.
void bind_bodies(WorldClass& world);
void bind_going_on(py::module_& module, WorldClass& world);
void bind_answers(py::module_& module, WorldClass& world);
void bind_inspection(py::module_& module, WorldClass& world);
void bind_world(py::module_& module);
void bind_body_map(py::module_& module);
void bind_replay(py::module_& module);
void bind_scenes(py::module_& module);
void bind_tracks(py::module_& module);

/// Of Python's that says which pairs may touch; empty for None.
PairFilter pair_filter_of(const py::object& function, const std::shared_ptr<FilterTrouble>& trouble);

}  // namespace kinesphere::python
