// The objects behind handles, and how calls reach them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "boundary.hpp"
#include "handle_table.hpp"
#include "kinesphere/game_world.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/recording.hpp"
#include "kinesphere/simulation.hpp"
#include "kinesphere/step_potential.hpp"
#include "kinesphere/workers.hpp"
#include "number/scope_guard.hpp"

namespace kinesphere::c {

/// A world with the motions that the library has of its bodies, or a game.
struct WorldObject {
  explicit WorldObject(Simulation of) : owner(std::move(of)) {}
  explicit WorldObject(GameWorld of) : owner(std::move(of)) {}

  std::variant<Simulation, GameWorld> owner;
  std::optional<Workers> workers{};                   ///< of the last run with several threads
  std::unique_ptr<Workers> in_use{};                  ///< of ks_world_use_threads()
  std::optional<std::vector<std::byte>> recording{};  ///< the last one that has been stopped
  std::vector<ks_event> events{};                     ///< of the last step of a game
  Usage usage{};

  bool is_game() const { return std::holds_alternative<GameWorld>(owner); }
  /// Throw BadResult with unsupported for the calls that the other kind has.
  GameWorld& game() { return const_cast<GameWorld&>(std::as_const(*this).game()); }
  const GameWorld& game() const;
  Simulation& simulation() { return const_cast<Simulation&>(std::as_const(*this).simulation()); }
  const Simulation& simulation() const;

  World& world() { return const_cast<World&>(std::as_const(*this).world()); }
  const World& world() const {
    return std::visit([](const auto& of) -> const World& { return of.world(); }, owner);
  }
  /// Calls change(game) for a game, and change(world) for any other world: for calls that both have.
  template <class Change>
  auto change(const Change& change) {
    return is_game() ? change(game()) : change(world());
  }
};

struct MonitorObject {
  explicit MonitorObject(Monitor of) : monitor(std::move(of)) {}

  Monitor monitor;
  Usage usage{};
};

struct ReplayObject {
  explicit ReplayObject(Replay of) : replay(std::move(of)) {}

  Replay replay;
  Usage usage{};
};

struct MeshObject {
  explicit MeshObject(Mesh of) : mesh(std::move(of)) {}

  Mesh mesh;
  Usage usage{};
};

struct StepPotentialObject {
  explicit StepPotentialObject(StepPotential of) : potential(std::move(of)) {}

  StepPotential potential;
  Usage usage{};
};

/// Throws BadResult inside callbacks of the world: for changes that do not begin with a call of the world.
inline void require_idle(World& world) { world.reserve(0).value(); }

/// The tables live as long as the program: handles are checked even while it ends.
HandleTable<WorldObject>& table_of(ks_world);
HandleTable<MonitorObject>& table_of(ks_monitor);
HandleTable<ReplayObject>& table_of(ks_replay);
HandleTable<MeshObject>& table_of(ks_mesh);
HandleTable<StepPotentialObject>& table_of(ks_step_potential);

[[noreturn]] void refuse_handle(std::string_view call, HandleState state);
[[noreturn]] void refuse_use(std::string_view call);

template <class Handle>
auto find(std::string_view call, Handle handle) {
  auto found = table_of(handle).find(handle.value);
  if (found.state != HandleState::valid) refuse_handle(call, found.state);
  return std::move(found.object);
}

/// Calls body(object) with the object of a handle, which no other thread uses meanwhile.
template <class Handle, class Body>
ks_status changing(std::string_view call, Handle handle, const Body& body) noexcept {
  return guarded([&] {
    const auto object = find(call, handle);
    if (!object->usage.begin_changing()) refuse_use(call);
    const ScopeGuard end([&] { object->usage.end_changing(); });
    body(*object);
  });
}

/// Calls body(object) with the constant object of a handle, which no other thread changes meanwhile.
template <class Handle, class Body>
ks_status reading(std::string_view call, Handle handle, const Body& body) noexcept {
  return guarded([&] {
    const auto object = find(call, handle);
    if (!object->usage.begin_reading()) refuse_use(call);
    const ScopeGuard end([&] { object->usage.end_reading(); });
    body(std::as_const(*object));
  });
}

/// Writes the handle of a new object, made of `parts`.
template <class Object, class Handle, class... Parts>
void create(std::string_view call, Handle* handle, Parts&&... parts) {
  require_pointer(call, handle, "handle");
  handle->value = table_of(*handle).insert(std::make_shared<Object>(std::forward<Parts>(parts)...));
}

template <class Handle>
ks_status destroy(std::string_view call, Handle handle) noexcept {
  return guarded([&] {
    const auto object = find(call, handle);
    if (!object->usage.begin_destroying()) refuse_use(call);
    table_of(handle).erase(handle.value);
  });
}

}  // namespace kinesphere::c
