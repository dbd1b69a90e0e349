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

Error overlap_error(std::string_view call, BodyId other, const std::string& name_of_other) {
  return {ErrorCode::overlapping, "position", other,
          std::string(call) + ": position must not overlap another body, but the body would overlap " +
              name_of_other};
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
  // A free index has the generation that its next body will have.
  const bool known = body.index < table.size() &&
                     (body.generation < table[body.index].generation ||
                      (body.generation == table[body.index].generation && table[body.index].alive));
  if (!known) {
    return Error{ErrorCode::unknown_body, "body", body,
                 std::string(call) + ": " + text_of(body) + " was never in this world"};
  }
  if (body.generation != table[body.index].generation) {
    return Error{ErrorCode::stale_body, "body", body,
                 std::string(call) + ": " + text_of(body) + " has been removed"};
  }
  return {};
}

Result<void> World::check_new(const BodyDefinition& body, std::string_view call) const {
  auto valid = first_error(check_idle(engine_->probing(), call), check_body(body, definition(), call));
  if (!valid || definition().allow_overlap) return valid;
  if (const auto other = engine_->certain_overlap(body)) return overlap_error(call, *other, text_of(*other));
  return {};
}

Result<BodyId> World::add(const BodyDefinition& body) {
  if (auto valid = check_new(body, "add"); !valid) return valid.error();
  return engine_->add(body);
}

Result<std::vector<BodyId>> World::add_all(std::span<const BodyDefinition> bodies) {
  if (auto idle = check_idle(engine_->probing(), "add_all"); !idle) return idle.error();
  HashGrid earlier;
  for (std::uint32_t number = 0; number < bodies.size(); ++number) {
    const std::string call = "add_all: bodies[" + std::to_string(number) + "]";
    if (auto valid = check_new(bodies[number], call); !valid) return valid.error();
    if (definition().allow_overlap) continue;
    const Box box = engine_->box_of(bodies[number]);
    std::optional<std::uint32_t> other;
    earlier.for_each_overlap(box, [&](std::uint32_t candidate) {
      const bool overlap = engine_->certainly_overlap(bodies[number], bodies[candidate]);
      if (overlap && (!other || candidate < *other)) other = candidate;
    });
    if (other) return overlap_error(call, no_body, "bodies[" + std::to_string(*other) + "]");
    earlier.set(number, box);
  }
  std::vector<BodyId> ids;
  ids.reserve(bodies.size());
  for (const BodyDefinition& body : bodies) ids.push_back(engine_->add(body));
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
