// Snapshots: the whole state of a world as bytes, and back.
//
// Everything is kept as it stands, the places of capsules in their layers included: what a search meets first
// decides who is probed first, so only the same order goes on the same way. Of the agenda only hot pairs that
// hold are kept: it gives them in the order of their times and numbers, however it has divided time. Memory
// that is merely kept for later is not part of it.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "archive/archive.hpp"
#include "archive/envelope.hpp"
#include "archive/fields.hpp"
#include "input/input_check.hpp"
#include "number/infinity.hpp"
#include "world/engine.hpp"
#include "world/fixed.hpp"
#include "world/validation.hpp"

namespace kinesphere {
namespace {

/// Raise the version when the fields change, or when the engine would go on from the same fields in another
/// way.
constexpr Envelope envelope{{'K', 'i', 'n', 'e', 's', 'p', '\r', '\n'},
                            11,
                            "world",
                            "World::restore",
                            "snapshot",
                            ErrorCode::bad_snapshot};

Error refusal(const std::string& what) { return envelope.refusal(what); }

bool is_sound(const Bound& bound, double now, const WorldDefinition& world) {
  BodyDefinition as_body;
  as_body.radius = 0.5 * bound.radius;  // the sum of a radius and an error
  as_body.acceleration_limit = bound.growth_acceleration;
  as_body.planned_acceleration = bound.planned_acceleration;
  as_body.velocity_error = bound.growth_speed;
  as_body.position = bound.position;
  as_body.velocity = bound.velocity;
  return std::isfinite(bound.time) && bound.time <= now && check_body(as_body, world, "restore");
}

/// To the bit.
template <class T>
bool same(const T& a, const T& b) {
  ByteWriter bytes_of_a, bytes_of_b;
  bytes_of_a(a);
  bytes_of_b(b);
  return bytes_of_a.bytes() == bytes_of_b.bytes();
}

}  // namespace

template <class Self, class Archive>
void World::Engine::transfer(Self& self, Archive& archive) {
  // The definition comes first, as an engine is made from it, space and walls too. The tag is left out
  // (BodyId::world). The last ones matter only during advance().
  auto& [definition, tag, space, enclosure, book, time, size, bodies, changes, rests, filters, middles,
         images, free, shapes, free_shapes, windows, tempo, kicks, agenda, dirty, counters, sensors,
         pair_filter, filtering, gathering, probe, probing_call, probing, probe_ids, probe_states, round, hot,
         scratch] = self;
  archive(book, time, size, bodies, changes, rests, filters, middles, images, free, shapes, free_shapes,
          windows, tempo, kicks, dirty, counters, sensors, filtering, gathering);
  // Of the agenda what counts, in an order of its own: not what is void, nor how it has divided time.
  if constexpr (std::is_const_v<Self>) {
    std::vector<HotPair> pairs = self.hot_pairs();
    std::sort(pairs.begin(), pairs.end());
    archive(pairs);
  } else {
    archive(hot);
  }
}

std::vector<std::byte> World::Engine::save() const {
  ByteWriter content;
  content(definition_);
  transfer(*this, content);
  return envelope.seal(content.bytes());
}

Result<std::unique_ptr<World::Engine>> World::Engine::restore(std::span<const std::byte> bytes,
                                                              PairFilter pair_filter) {
  auto content = envelope.open(bytes);
  if (!content) return content.error();
  ByteReader reader(*content);
  WorldDefinition definition;
  reader(definition);
  const bool known_mode =
      definition.contacts == ContactMode::begin_and_end || definition.contacts == ContactMode::impacts;
  if (reader.failed() || !known_mode || !check_world(definition))
    return refusal("must hold a world that can be, but its definition is impossible");
  auto engine = std::make_unique<Engine>(definition);
  transfer(*engine, reader);
  if (reader.failed() || reader.remaining() != 0)
    return refusal("must hold a world, but its content does not have the form of one");
  if (const char* where = engine->contradiction())
    return refusal(std::string("must hold a world that can be, but contradicts itself in its ") + where);
  engine->agenda_.add_all(engine->hot_);
  engine->tag_ = 0;
  if (pair_filter) engine->filtering_ = true;
  engine->pair_filter_ = std::move(pair_filter);
  return engine;
}

/// The part of a state that was read, if any, that cannot have come about. What passes may be another world
/// than the one that was saved, but is one in which every call is safe.
const char* World::Engine::contradiction() const {
  if (!std::isfinite(time_)) return "time";
  if (!shapes_are_sound()) return "shapes";
  if (!changes_are_sound() || !rests_are_sound() || !bodies_are_sound()) return "bodies";
  for (int number = 0; number <= std::numeric_limits<SensorClass>::max(); ++number)
    if (!check_sensor(sensors_.of(static_cast<SensorClass>(number)), definition_)) return "sensors";
  const auto known = [this](BodyId id) { return was_given_out(id); };
  if (!book_.is_sound(bodies_.size(), time_, walls_, known) || !contacts_of_fixed_are_sound())
    return "contacts";
  if (!windows_.is_sound(bodies_.size()) || !tempo_.is_sound()) return "windows";
  if (!agenda_is_sound()) return "agenda";
  for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
    const bool takes_part = bodies_[number].present();
    const bool registered = windows_.contains(number);
    if (takes_part ? !registered && !bodies_[number].dirty : registered) return "windows";
    if (registered && bodies_[number].is_fixed() && windows_.end_of(number) != infinity) return "windows";
    if (!takes_part && (!book_.partners_of(number).empty() || !book_.crossings_of(number).empty() ||
                        book_.walls_of(number) != 0))
      return "contacts";
  }
  return nullptr;
}

/// Hot pairs, which wait to be put into the agenda, are those of bodies which are registered.
bool World::Engine::agenda_is_sound() const {
  const auto takes_part = [this](std::uint32_t number) {
    return number < bodies_.size() && bodies_[number].present() && windows_.contains(number);
  };
  const auto is_sound = [&](const HotPair& pair) {
    if (!(pair.time < infinity) || !takes_part(pair.first)) return false;
    if (pair.second == HotPair::walls) return walls_ && !bodies_[pair.first].is_fixed() && !is_void(pair);
    return pair.first < pair.second && takes_part(pair.second) && !is_void(pair) &&
           !(bodies_[pair.first].is_fixed() && bodies_[pair.second].is_fixed());
  };
  return std::all_of(hot_.begin(), hot_.end(), is_sound);
}

/// Each shape belongs to one body or is free.
bool World::Engine::shapes_are_sound() const {
  std::vector<bool> is_taken(shapes_.size(), false);
  const auto take = [&is_taken](std::uint32_t number) {
    if (number >= is_taken.size() || is_taken[number]) return false;
    is_taken[number] = true;
    return true;
  };
  for (const std::uint32_t number : free_shapes_)
    if (!take(number)) return false;
  for (const Body& body : bodies_)
    if (body.is_fixed() && !(body.alive && filtering_ && take(body.shape_number))) return false;
  return std::find(is_taken.begin(), is_taken.end(), false) == is_taken.end();
}

/// Fixed bodies touch neither each other nor walls, and are not about to.
bool World::Engine::contacts_of_fixed_are_sound() const {
  const auto fixed = [this](std::uint32_t number) { return bodies_[number].is_fixed(); };
  const auto lives_fixed = [&](BodyId id) { return id == id_of(id.index) && fixed(id.index); };
  for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
    if (!fixed(number)) continue;
    const auto partners = book_.partners_of(number);
    const auto crossings = book_.crossings_of(number);
    if (book_.walls_of(number) != 0 || std::any_of(partners.begin(), partners.end(), fixed) ||
        std::any_of(crossings.begin(), crossings.end(), [&](const Crossing& c) { return fixed(c.partner); }))
      return false;
  }
  // One may have got the index of a body that has gone; then it is dirty, and the pair is not looked at.
  const auto settled_fixed = [&](std::uint32_t number) {
    return fixed(number) && bodies_[number].present() && !bodies_[number].dirty;
  };
  return std::none_of(
             book_.changed().begin(), book_.changed().end(),
             [&](const auto& pair) { return settled_fixed(pair.first) && settled_fixed(pair.second); }) &&
         book_.pending().none_of([&](const Event& event) {
           return lives_fixed(event.first) && (event.second == no_body || lives_fixed(event.second));
         });
}

/// It must equal what its shape makes of it.
bool World::Engine::is_sound_fixed(std::uint32_t number) const {
  const Body& body = bodies_[number];
  if (!check_shape(shape(number), definition_, "restore")) return false;
  const BodyDefinition made = body_of(fixed_definition(id_of(number)));
  return same(definition_of(number), made) &&
         same(body.bound, bound_of(made, {made.position, {}}, body.bound.time)) && body.bound.time <= time_ &&
         std::isfinite(body.bound.time) && !body.settled && body.change_number == Body::none &&
         !(body.dirty && !body.enabled);
}

/// Each change is that of one body, which lives.
bool World::Engine::changes_are_sound() const {
  const auto has = [](const Body& body) { return body.change_number != Body::none; };
  for (std::uint32_t change = 0; change < changes_.size(); ++change) {
    const std::uint32_t number = changes_[change].body;
    if (number >= bodies_.size() || bodies_[number].change_number != change || !bodies_[number].alive)
      return false;
  }
  return std::count_if(bodies_.begin(), bodies_.end(), has) == std::ssize(changes_);
}

/// Each rest is that of one body, which can move and takes part, and whose bound stands still unless there is
/// no report yet.
bool World::Engine::rests_are_sound() const {
  for (std::uint32_t rest = 0; rest < rests_.size(); ++rest) {
    const std::uint32_t number = rests_[rest].body;
    if (number >= bodies_.size()) return false;
    const Body& body = bodies_[number];
    if (body.rest_number != rest || !body.present() || body.is_fixed()) return false;
    Bound still = body.bound;
    still.velocity = still.planned_acceleration = {};
    still.growth_speed = still.growth_acceleration = 0.0;
    if (body.is_at_rest() && !same(still, body.bound)) return false;
    if (rests_[rest].limits.position_error != body.position_error) return false;
  }
  return std::count_if(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.is_resting(); }) ==
         std::ssize(rests_);
}

bool World::Engine::bodies_are_sound() const {
  const auto count = bodies_.size();
  const std::size_t where_space_repeats = space_.repeats() ? count : 0;
  if (filters_.size() > count) return false;
  if (middles_.size() != where_space_repeats || images_.size() != where_space_repeats) return false;
  std::vector<bool> is_free(count, false);
  std::vector<bool> is_listed(count, false);
  for (const std::uint32_t number : free_) {
    if (number >= count || is_free[number]) return false;
    is_free[number] = true;
  }
  for (const std::uint32_t number : dirty_) {
    if (number >= count) return false;
    is_listed[number] = true;
  }
  for (std::size_t number = 0; number < count; ++number) {
    const Body& body = bodies_[number];
    if (body.alive == is_free[number] || (body.dirty && !is_listed[number]) ||
        !is_sound(static_cast<std::uint32_t>(number)))
      return false;
  }
  return size_ + free_.size() == count;
}

bool World::Engine::is_sound(std::uint32_t number) const {
  const Body& body = bodies_[number];
  if (body.is_fixed()) return is_sound_fixed(number);
  if (body.settled) return false;
  // An index that is free is as its next body will find it.
  if (!body.alive) return !body.dirty;
  WorldDefinition unbounded = definition_;
  unbounded.box.reset();
  const BodyDefinition definition = definition_of(number);
  if (!check_body(definition, unbounded, "restore") ||
      !check_radius(definition, no_body, definition_, "restore") ||
      !kinesphere::is_sound(body.bound, time_, unbounded) || !image_is_sound(number))
    return false;
  if (!body.enabled) return !body.dirty;
  // Before time moves on there is a report.
  if (body.change_number != Body::none && !body.dirty) return false;
  return true;
}

/// Whole numbers, and none on axes that do not repeat.
bool World::Engine::image_is_sound(std::uint32_t number) const {
  if (!space_.repeats()) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const double images = images_[number][axis];
    if (!(std::abs(images) <= 0x1p62) || std::floor(images) != images) return false;
    if (!space_.repeats(axis) && images != 0.0) return false;
  }
  return true;
}

bool World::Engine::was_given_out(BodyId id) const {
  if (id.index >= bodies_.size()) return false;
  const Body& body = bodies_[id.index];
  return id.generation < body.generation || (id.generation == body.generation && body.alive);
}

}  // namespace kinesphere
