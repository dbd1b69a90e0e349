// A world as Python has it.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "events.hpp"
#include "guard.hpp"
#include "kinesphere/game_world.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"
#include "threads.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// The exception of a Python pair filter, which must not throw into the engine: kept until the end
/// of the call.
struct FilterTrouble {
  std::exception_ptr thrown;
};

/// A world, or a game, which is a world that moves its own bodies.
struct WorldHandle {
  explicit WorldHandle(World made) : owned(std::move(made)), world(std::get<World>(owned)) {}
  explicit WorldHandle(GameWorld made) : owned(std::move(made)), world(std::get<GameWorld>(owned).world()) {}

  std::variant<World, GameWorld> owned;
  World& world;
  InUse in_use{};
  /// Events of a run; of an interrupted one until the next.
  KeptEvents undelivered{};
  /// Set while there is a pair filter.
  std::shared_ptr<FilterTrouble> filter_trouble{};
  bool has_rotation_probe = false;
  /// Those of use_threads().
  std::unique_ptr<Threads> threads{};
  bool warned_of_hops = false;
  bool warned_of_jams = false;
  /// The first broken promise until the caller has been warned of it.
  std::optional<Event> broken{};
  bool warned_of_promises = false;
  /// Calls in a row that could not advance, as `until` was the time of the world, and found no event.
  int idle_calls = 0;

  /// For other threads: a time that the world has reached. The thread that uses the world sets it, and each
  /// thread reads it, under the GIL.
  double reached = world.time();

  bool is_game() const { return std::holds_alternative<GameWorld>(owned); }
  GameWorld& game() { return std::get<GameWorld>(owned); }
  /// Calls change(game) for a game, and change(world) for any other world: for calls that both have.
  template <class Change>
  auto change(const Change& change_it) {
    return is_game() ? change_it(game()) : change_it(world);
  }
  /// Throws BadResult for a game, which moves its bodies itself.
  void require_moved_by_others(std::string_view call) const {
    if (!is_game()) return;
    throw BadResult({ErrorCode::unsupported, "world", no_body,
                     std::string(call) + ": world must be moved by others, but a GameWorld moves its bodies "
                                         "itself: step(), advance() and events() let time pass"});
  }

  bool is_plane() const { return world.definition().dimensions == 2; }
  InUse::Use take(std::string_view call) {
    InUse::Use use = in_use.take(call, "world");
    reached = world.time();
    return use;
  }
  double time() { return in_use.is_taken_elsewhere() ? reached : world.time(); }
};

/// Ends a call that may have used the pair filter: raises the filter's exception.
inline void end_call(WorldHandle& handle) {
  if (!handle.filter_trouble || !handle.filter_trouble->thrown) return;
  std::rethrow_exception(std::exchange(handle.filter_trouble->thrown, nullptr));
}

/// Calls `work` without the GIL; its callbacks acquire the GIL.
template <class Work>
auto without_gil(WorldHandle& handle, const Work& work) {
  auto result = [&] {
    const py::gil_scoped_release released;
    return work();
  }();
  end_call(handle);
  return result;
}

/// A call that only reads the world, which is passed to `read`.
template <class Read>
auto reading(const char* call, Read read) {
  return [call, read](WorldHandle& handle) {
    const auto turn = handle.take(call);
    return read(std::as_const(handle.world));
  };
}

/// A scene with the parameters that it was made from.
struct SceneHandle : Scene {
  SceneHandle(Scene made, SceneParameters given) : Scene(std::move(made)), parameters(std::move(given)) {}
  SceneParameters parameters;
};

using WorldClass = py::class_<WorldHandle, std::shared_ptr<WorldHandle>>;

/// Reads True for all axes, or some of the letters "xyz".
Axes axes_of(const py::object& given, const Argument& argument, bool plane);
/// Restores a world from these bytes.
std::shared_ptr<WorldHandle> restored(const py::object& snapshot, const py::object& pair_filter);

// Each function binds the calls of one subject.
void bind_bodies(WorldClass& world);
void bind_rigid_bodies(py::module_& module, WorldClass& world);
void bind_going_on(py::module_& module, WorldClass& world);
void bind_answers(py::module_& module, WorldClass& world);
void bind_inspection(py::module_& module, WorldClass& world);
void bind_world(py::module_& module);
void bind_game(py::module_& module, WorldClass& world);
void bind_body_map(py::module_& module);
void bind_replay(py::module_& module);
void bind_placement(py::module_& module);
void bind_scenes(py::module_& module);
void bind_tracks(py::module_& module);
void bind_paths(py::module_& module);

/// Returns a snapshot of the world or the game.
py::bytes save(WorldHandle& handle);
/// Returns a Python function for callbacks that the engine keeps: copies of a world share it, and the last of
/// them may be destroyed without the GIL.
std::shared_ptr<py::object> kept_by_engine(const py::object& function);
/// Returns where a pair filter of this function keeps its exception; nothing for None.
std::shared_ptr<FilterTrouble> trouble_of(const py::object& function);
/// Returns a filter that calls a Python function; empty for None.
PairFilter pair_filter_of(const py::object& function, const std::shared_ptr<FilterTrouble>& trouble);

}  // namespace kinesphere::python
