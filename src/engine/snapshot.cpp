// Snapshots: conversion of the whole state of a world to bytes and back.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "archive/archive.hpp"
#include "archive/envelope.hpp"
#include "archive/fields.hpp"
#include "bodies/validation.hpp"
#include "engine/engine.hpp"
#include "kinesphere/limits.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Raise the version if the fields change, or if the engine would continue differently from the same fields.
constexpr Envelope world_envelope{{'K', 'i', 'n', 'e', 's', 'p', '\r', '\n'},
                                  35,
                                  "world",
                                  "World::restore",
                                  "snapshot",
                                  ErrorCode::bad_snapshot};

Error refusal(const std::string& what) { return world_envelope.refusal(what); }

}  // namespace

template <class Self, class Archive>
void World::Engine::serialize(Self& self, Archive& archive) {
  // The definition comes first, since an engine is constructed from it. The tag is omitted (BodyId::world).
  archive(self.state_.bodies, self.state_.contacts, self.state_.spot_checks, self.state_.timers, self.main_,
          self.state_.core);
}

std::vector<std::byte> World::Engine::save() const {
  ByteWriter content;
  content(definition(), bodies().filters.has_pair_filter());
  serialize(*this, content);
  return world_envelope.seal(content.bytes());
}

Result<std::unique_ptr<World::Engine>> World::Engine::restore(std::span<const std::byte> bytes,
                                                              PairFilter pair_filter) {
  auto content = world_envelope.open(bytes);
  if (!content) return content.error();
  ByteReader reader(*content);
  WorldDefinition definition;
  bool needs_filter = false;
  reader(definition, needs_filter);
  if (reader.failed() || !check_world(definition))
    return refusal("must hold a world that can be, but its definition is impossible");
  if (needs_filter && !pair_filter) {
    return Error{ErrorCode::bad_snapshot, "pair_filter", no_body,
                 "World::restore: pair_filter must be given, as the saved world had one, but is empty"};
  }
  auto engine = std::make_unique<Engine>(definition);
  serialize(*engine, reader);
  if (reader.failed() || reader.remaining() != 0)
    return refusal("must hold a world, but its content does not have the form of one");
  if (const char* where = engine->first_invalid_part())
    return refusal(std::string("must hold a world that can be, but contradicts itself in its ") + where);
  if (pair_filter) engine->state_.bodies.filters.keep_pair_filter(std::move(pair_filter));
  if (!engine->main_.rebuild_core())
    return refusal("must hold a world that can be, but contradicts itself in its safe regions");
  return engine;
}

/// Returns the name of the part of a state that no sequence of calls could have produced, or nullptr. A state
/// that passes may differ from the saved one, but every call is safe on it.
const char* World::Engine::first_invalid_part() const {
  if (!(std::abs(time()) <= limits::largest_time)) return "time";
  if (const char* where = bodies().first_invalid_part(time(), main_.dirty().numbers())) return where;
  const auto known = [this](BodyId id) { return bodies().table().was_given_out(id); };
  if (!contacts().is_valid(bodies().numbers(), bodies().walls()) ||
      !main_.events().is_valid(bodies().numbers(), time(), bodies().walls(), known) ||
      !shape_contacts_are_valid())
    return "contacts";
  if (!state_.spot_checks.is_valid(time())) return "spot checks";
  if (!state_.timers.is_valid(time())) return "timers";
  if (!main_.knows_valid_times()) return "certificates";
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number) {
    const Body& body = bodies()[number];
    const bool takes_part = body.present();
    const bool registered = is_registered(number);
    if (!body.alive && !contacts().pairs().of(number).empty()) return "contacts";
    if (body.alive && !contacts().has_form_of(number, body.has_shape(), body.is_static())) return "contacts";
    if (takes_part ? !registered && !bodies()[number].dirty : registered) return "safe regions";
    if (takes_part && !core().can_hold(body.bound, time()) && !core().reports_now(number, time()))
      return "safe regions";
    if (registered && body.is_static() && box_end(number) != infinity) return "safe regions";
    if (!takes_part && (!contacts().partners_of(number).empty() || !contacts().overlaps_of(number).empty() ||
                        contacts().pairs().has_turned(number)))
      return "contacts";
    if (!(takes_part && bodies().meets_walls(number)) && contacts().walls_of(number) != 0) return "contacts";
  }
  return nullptr;
}

/// Bodies with shapes must not touch walls, nor static bodies each other, nor have such events pending.
bool World::Engine::shape_contacts_are_valid() const {
  const auto is_static = [this](std::uint32_t number) { return bodies()[number].is_static(); };
  const auto is_living = [this](BodyId id) { return id == bodies().id_of(id.index); };
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number) {
    if (bodies()[number].has_shape() && contacts().walls_of(number) != 0) return false;
    if (!is_static(number)) continue;
    const auto partners = contacts().partners_of(number);
    const auto overlaps = contacts().overlaps_of(number);
    if (std::any_of(partners.begin(), partners.end(),
                    [&](const ContactRecord& contact) { return is_static(contact.partner); }) ||
        std::any_of(overlaps.begin(), overlaps.end(),
                    [&](const OverlapRecord& c) { return is_static(c.partner); }))
      return false;
  }
  // A static body may have reused the number of a removed body; then it is dirty, and the pair is not
  // rechecked.
  const auto is_certified_static = [&](std::uint32_t number) {
    return is_static(number) && bodies()[number].present() && !bodies()[number].dirty;
  };
  const auto cannot_happen = [&](const Event& event) {
    if (!is_living(event.first)) return false;
    if (event.second != no_body)
      return is_static(event.first.index) && is_living(event.second) && is_static(event.second.index);
    return event.wall == Wall::none ? is_static(event.first.index) : bodies()[event.first.index].has_shape();
  };
  return std::none_of(main_.events().changed().begin(), main_.events().changed().end(),
                      [&](const auto& pair) {
                        return is_certified_static(pair.first) && is_certified_static(pair.second);
                      }) &&
         main_.events().pending().none_of(cannot_happen);
}

}  // namespace kinesphere
