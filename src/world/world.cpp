// The public face of the engine: every call is checked here before anything changes.
#include "kinesphere/world.hpp"

#include <utility>

#include "input/input_check.hpp"
#include "world/engine.hpp"
#include "world/validation.hpp"

namespace kinesphere {
namespace {

Result<void> check_idle(bool probing, std::string_view call) {
  if (!probing) return {};
  return Error{ErrorCode::probe_in_progress, "probe", no_body,
               std::string(call) + ": a probe may not call the world that asked it"};
}

/// A first answer that is an error ends a chain of checks.
template <class... Checks>
Result<void> first_error(const Checks&... checks) {
  Result<void> result;
  (void)((static_cast<bool>(checks) || (result = checks, false)) && ...);
  return result;
}

}  // namespace

World::World(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Result<World> World::create(const WorldDefinition& definition) {
  if (auto valid = check_world(definition); !valid) return valid.error();
  return World(std::make_unique<Engine>(definition));
}

Result<void> World::check_alive(BodyId body, std::string_view call) const {
  const auto& table = engine_->table();
  const bool known = body.index < table.size() && body.generation <= table[body.index].generation;
  if (!known) {
    return Error{ErrorCode::unknown_body, "body", body,
                 std::string(call) + ": " + text_of(body) + " was never in this world"};
  }
  if (body.generation != table[body.index].generation || !table[body.index].alive) {
    return Error{ErrorCode::stale_body, "body", body,
                 std::string(call) + ": " + text_of(body) + " has been removed"};
  }
  return {};
}

Result<BodyId> World::add_as(const BodyDefinition& body, std::string_view call) {
  const auto valid = first_error(check_idle(engine_->probing(), call), check_body(body, definition(), call));
  if (!valid) return valid.error();
  if (!definition().allow_overlap) {
    if (const auto other = engine_->certain_overlap(body)) {
      return Error{ErrorCode::overlapping, "position", *other,
                   std::string(call) +
                       ": position must not overlap another body, but the body would overlap " +
                       text_of(*other)};
    }
  }
  return engine_->add(body);
}

Result<BodyId> World::add(const BodyDefinition& body) { return add_as(body, "add"); }

Result<std::vector<BodyId>> World::add(std::span<const BodyDefinition> bodies) {
  std::vector<BodyId> ids;
  ids.reserve(bodies.size());
  for (const BodyDefinition& body : bodies) {
    auto id = add_as(body, "add: bodies[" + std::to_string(ids.size()) + "]");
    if (!id) {
      while (!ids.empty()) {
        engine_->withdraw(ids.back());
        ids.pop_back();
      }
      return id.error();
    }
    ids.push_back(*id);
  }
  return ids;
}

Result<void> World::remove(BodyId body) {
  auto valid = first_error(check_idle(engine_->probing(), "remove"), check_alive(body, "remove"));
  if (valid) engine_->remove(body);
  return valid;
}

Result<void> World::kick(BodyId body, const Vec3& velocity) {
  auto valid = first_error(check_idle(engine_->probing(), "kick"), check_alive(body, "kick"),
                           check_velocity(velocity, body, "kick"));
  if (valid) engine_->kick(body, velocity);
  return valid;
}

Result<std::optional<Event>> World::advance(double until, Probe probe) {
  const auto valid = first_error(check_idle(engine_->probing(), "advance"), check_time(until, time()));
  if (!valid) return valid.error();
  return engine_->advance(until, probe);
}

double World::time() const { return engine_->time(); }
std::size_t World::size() const { return engine_->size(); }
const WorldDefinition& World::definition() const { return engine_->definition(); }
bool World::contains(BodyId body) const { return static_cast<bool>(check_alive(body, "contains")); }
const Counters& World::counters() const { return engine_->counters(); }
std::optional<AuditFinding> World::audit() const { return engine_->audit(); }

Result<BodyView> World::body(BodyId id) const {
  if (auto valid = check_alive(id, "body"); !valid) return valid.error();
  const Body& body = engine_->table()[id.index];
  return BodyView{body.definition, body.bound, body.box, body.box_end};
}

std::vector<BodyId> World::bodies() const {
  std::vector<BodyId> ids;
  for (std::uint32_t number = 0; number < engine_->table().size(); ++number)
    if (engine_->table()[number].alive) ids.push_back(engine_->id_of(number));
  return ids;
}

}  // namespace kinesphere
