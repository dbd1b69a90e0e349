// Snapshots: conversion of the whole state of a world to bytes and back.
//
// All state is saved as it is, including the slots of swept spheres in their grid levels: the order in which
// a search finds bodies decides the order of probes, so only an identical order continues identically. The
// queue is saved as its valid certificates only, in the order of times and numbers, which does not depend on
// its buckets. Spare memory is not saved.
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
                                  29,
                                  "world",
                                  "World::restore",
                                  "snapshot",
                                  ErrorCode::bad_snapshot};

/// Returns true for infinity and for ends of windows that begin within the time limits.
bool is_time_of_window_end(double end) { return end == infinity || std::abs(end) <= Window::latest_end; }

Error refusal(const std::string& what) { return world_envelope.refusal(what); }

}  // namespace

template <class Self, class Archive>
void World::Engine::serialize(Self& self, Archive& archive) {
  // The definition comes first, since an engine is constructed from it. The tag is omitted (BodyId::world).
  archive(self.state_.bodies, self.state_.contacts, self.state_.broad_phase, self.state_.window_policy,
          self.state_.spot_checks, self.main_);
  if constexpr (std::is_const_v<Self>) {
    archive(self.prepared_.has_value());
  } else {
    bool is_prepared = false;
    archive(is_prepared);
    if (is_prepared) self.prepared_.emplace(self.bodies().space(), self.state_.window_policy);
  }
  if (self.prepared_) archive(*self.prepared_);
  if (self.state_.core) archive(*self.state_.core);
  // The queue is saved as its valid certificates in sorted order, without stale ones and without its buckets.
  if constexpr (std::is_const_v<Self>) {
    std::vector<PairCertificate> pairs = self.certificates();
    std::sort(pairs.begin(), pairs.end());
    archive(pairs);
  } else {
    archive(self.read_pairs_);
  }
}

std::vector<std::byte> World::Engine::save() const {
  ByteWriter content;
  content(definition(), bodies().filters.has_pair_filter(), state_.core.has_value());
  serialize(*this, content);
  return world_envelope.seal(content.bytes());
}

Result<std::unique_ptr<World::Engine>> World::Engine::restore(std::span<const std::byte> bytes,
                                                              PairFilter pair_filter) {
  auto content = world_envelope.open(bytes);
  if (!content) return content.error();
  ByteReader reader(*content);
  WorldDefinition definition;
  bool needs_filter = false, uses_core = false;
  reader(definition, needs_filter, uses_core);
  if (reader.failed() || !check_world(definition))
    return refusal("must hold a world that can be, but its definition is impossible");
  if (needs_filter && !pair_filter) {
    return Error{ErrorCode::bad_snapshot, "pair_filter", no_body,
                 "World::restore: pair_filter must be given, as the saved world had one, but is empty"};
  }
  auto engine = std::make_unique<Engine>(definition, uses_core);
  serialize(*engine, reader);
  if (reader.failed() || reader.remaining() != 0)
    return refusal("must hold a world, but its content does not have the form of one");
  if (const char* where = engine->first_invalid_part())
    return refusal(std::string("must hold a world that can be, but contradicts itself in its ") + where);
  if (pair_filter) engine->state_.bodies.filters.keep_pair_filter(std::move(pair_filter));
  if (auto& core = engine->state_.core; core && !engine->main_.rebuild_core())
    return refusal("must hold a world that can be, but contradicts itself in its safe regions");
  engine->main_.queue().add_all(engine->read_pairs_);
  if (engine->prepared_) engine->main_.set_next_slice(engine->prepared_->next_slice());
  return engine;
}

/// Returns the name of the part of a state that no sequence of calls could have produced, or nullptr. A state
/// that passes may differ from the saved one, but every call is safe on it.
const char* World::Engine::first_invalid_part() const {
  if (!(std::abs(time()) <= limits::largest_time) || !is_time_of_window_end(main_.epoch_end())) return "time";
  // Shared windows have lengths that the window policy chose.
  if (!state_.window_policy.is_chosen() && main_.epoch_end() < infinity) return "windows";
  if (const char* where = bodies().first_invalid_part(time(), main_.dirty().numbers())) return where;
  const auto known = [this](BodyId id) { return bodies().table().was_given_out(id); };
  if (!contacts().is_valid(bodies().numbers(), bodies().walls()) ||
      !main_.events().is_valid(bodies().numbers(), time(), bodies().walls(), known) ||
      !shape_contacts_are_valid())
    return "contacts";
  if (!broad_phase().is_valid(bodies().numbers()) || !state_.window_policy.is_valid()) return "windows";
  if (!state_.spot_checks.is_valid(time())) return "spot checks";
  if (state_.core && !main_.knows_valid_times()) return "certificates";
  if (!prepared_ && broad_phase().search_begin() != -infinity) return "windows";
  if (prepared_ &&
      (!may_prepare_starts() || !state_.window_policy.is_chosen() || !prepared_->is_valid(state_)))
    return "prepared start";
  if (!queue_is_valid() || !window_ends_are_valid()) return "certificates";
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number) {
    const Body& body = bodies()[number];
    const bool takes_part = body.present();
    const bool registered = is_registered(number);
    if (body.alive && !contacts().has_form_of(number, body.has_shape(), body.is_static())) return "contacts";
    if (takes_part ? !registered && !bodies()[number].dirty : registered) return "windows";
    if (takes_part && state_.core && !state_.core->can_hold(body.bound, time())) return "safe regions";
    if (registered && body.is_static() && box_end(number) != infinity) return "windows";
    if (!takes_part && (!contacts().partners_of(number).empty() || !contacts().overlaps_of(number).empty()))
      return "contacts";
    if (!(takes_part && bodies().meets_walls(number)) && contacts().walls_of(number) != 0) return "contacts";
  }
  return nullptr;
}

/// Certificates that were read must belong to registered bodies.
bool World::Engine::queue_is_valid() const {
  const auto takes_part = [this](std::uint32_t number) {
    return number < bodies().numbers() && bodies()[number].present() && broad_phase().contains(number);
  };
  const auto is_valid = [&](const PairCertificate& pair) {
    if (!(pair.failure_time >= -limits::largest_time && pair.failure_time < infinity) ||
        !takes_part(pair.first))
      return false;
    if (pair.kind() == PairCertificate::Kind::window_end)
      return !bodies()[pair.first].is_static() && !main_.certifier().is_stale(pair);
    if (pair.kind() == PairCertificate::Kind::with_walls)
      return bodies().meets_walls(pair.first) && !main_.certifier().is_stale(pair);
    return pair.first < pair.second && takes_part(pair.second) && !main_.certifier().is_stale(pair) &&
           !(bodies()[pair.first].is_static() && bodies()[pair.second].is_static());
  };
  return std::all_of(read_pairs_.begin(), read_pairs_.end(), is_valid);
}

/// Each body whose window ends within the epoch must have a window_end certificate by then.
bool World::Engine::window_ends_are_valid() const {
  std::vector<bool> is_renewed(bodies().numbers(), false);
  for (const PairCertificate& pair : read_pairs_)
    if (pair.kind() == PairCertificate::Kind::window_end &&
        pair.failure_time <= broad_phase().end_of(pair.first))
      is_renewed[pair.first] = true;
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number)
    if (broad_phase().contains(number) && !bodies()[number].dirty && !is_renewed[number] &&
        broad_phase().end_of(number) < main_.epoch_end())
      return false;
  return true;
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
