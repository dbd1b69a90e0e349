// Kinesphere's world as a way to find the first contact of two bodies.
#include <memory>
#include <utility>

#include "base/program_error.hpp"
#include "kinesphere/world.hpp"
#include "research/bench/shapes/pair_methods.hpp"

namespace kinesphere::program {
namespace {

/// A world that reports no ends, so that bodies which are removed leave nothing to report.
World pair_world(double tolerance) {
  return require(World::create({.contact_tolerance = tolerance, .contacts = ContactEvents::impacts}));
}

BodyId add(World& world, const TurningBody& body) {
  return require(
      world.add_rigid_body({.body = {.position = body.start.position, .velocity = body.start.velocity},
                            .parts = body.parts,
                            .rotation = body.rotation}));
}

/// Finds the first contact of a pair whose bodies start at the time of the world, and removes them.
std::optional<double> first_contact_in(World& world, const TurningPair& pair) {
  const double begin = world.time();
  const BodyId first = add(world, pair.first);
  const BodyId second = add(world, pair.second);
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const State& start = (ids[k] == first ? pair.first : pair.second).start;
      states[k] = {start.position + start.velocity * (time - begin), start.velocity};
    }
  };
  const auto event = require(world.advance(begin + 1.0, probe));
  for (const BodyId id : {first, second}) require(world.remove(id));
  if (!event) return std::nullopt;
  if (event->kind != EventKind::contact_begin)
    throw ProgramError("shapes: expected a contact, but the world reports " +
                       std::string(name_of(event->kind)));
  return event->time - begin;
}

PairMethod kept_world(std::string name, double tolerance) {
  return {std::move(name), [world = std::make_shared<World>(pair_world(tolerance))](const TurningPair& pair) {
            return first_contact_in(*world, pair);
          }};
}

}  // namespace

std::vector<PairMethod> world_methods() {
  return {{"Kinesphere (new worlds)",
           [](const TurningPair& pair) {
             World world = pair_world(1e-9);
             return first_contact_in(world, pair);
           }},
          kept_world("Kinesphere", 1e-9),
          kept_world("Kinesphere (tolerance 1e-4)", 1e-4)};
}

}  // namespace kinesphere::program
