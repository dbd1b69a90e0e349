#include "objects.hpp"

namespace kinesphere::c {

bool Usage::begin_reading() {
  const std::lock_guard lock(mutex_);
  if (changes_ > 0) {
    if (owner_ != std::this_thread::get_id()) return false;
    ++changes_;
    return true;
  }
  ++readers_;
  return true;
}

bool Usage::begin_changing() {
  const std::lock_guard lock(mutex_);
  if (readers_ > 0 || (changes_ > 0 && owner_ != std::this_thread::get_id())) return false;
  owner_ = std::this_thread::get_id();
  ++changes_;
  return true;
}

void Usage::end_reading() {
  const std::lock_guard lock(mutex_);
  --(changes_ > 0 ? changes_ : readers_);
}

void Usage::end_changing() {
  const std::lock_guard lock(mutex_);
  --changes_;
}

bool Usage::begin_destroying() {
  const std::lock_guard lock(mutex_);
  if (readers_ > 0 || changes_ > 0) return false;
  owner_ = {};
  changes_ = 1;
  return true;
}

const GameWorld& WorldObject::game() const {
  if (!is_game())
    detail::bad_result({ErrorCode::unsupported, "game", no_body,
                        "game: this world is no game: ks_game_create() and ks_game_restore() make games"});
  return std::get<GameWorld>(owner);
}

const Simulation& WorldObject::simulation() const {
  if (is_game())
    detail::bad_result({ErrorCode::unsupported, "world", no_body,
                        "world: a game moves its bodies itself: it takes no motions and no probes, and time "
                        "passes by ks_game_step() or by ks_world_advance() with ks_probe_motions"});
  return std::get<Simulation>(owner);
}

HandleTable<WorldObject>& table_of(ks_world) {
  static auto* const table = new HandleTable<WorldObject>(1);
  return *table;
}

HandleTable<MonitorObject>& table_of(ks_monitor) {
  static auto* const table = new HandleTable<MonitorObject>(2);
  return *table;
}

HandleTable<ReplayObject>& table_of(ks_replay) {
  static auto* const table = new HandleTable<ReplayObject>(3);
  return *table;
}

HandleTable<MeshObject>& table_of(ks_mesh) {
  static auto* const table = new HandleTable<MeshObject>(4);
  return *table;
}

HandleTable<StepPotentialObject>& table_of(ks_step_potential) {
  static auto* const table = new HandleTable<StepPotentialObject>(5);
  return *table;
}

void refuse_handle(std::string_view call, HandleState state) {
  const bool stale = state == HandleState::stale;
  throw Failure{stale ? KS_ERROR_STALE_HANDLE : KS_ERROR_INVALID_HANDLE, "handle",
                std::string(call) + (stale ? ": the object of this handle has been destroyed"
                                           : ": this never was a handle of such an object")};
}

void refuse_use(std::string_view call) {
  throw Failure{KS_ERROR_IN_USE, "handle", std::string(call) + ": the object is in use by another call"};
}

}  // namespace kinesphere::c
