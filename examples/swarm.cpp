// Some four hundred drones wander about. Each knows how long it is certain to touch no other, and queries the
// world again only when that time runs out; it turns away from a drone that it may meet too soon.
#include <kinesphere/certificates.hpp>
#include <kinesphere/motion/steered_motion.hpp>
#include <kinesphere/random.hpp>
#include <kinesphere/world.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  const double tick = 0.1, seconds = 4.0, reaction = 0.7, agility = 4.0;
  const Vec3 middle{70, 70, 70};

  std::vector<State> start;
  Random random(3);
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 6; ++z)
        start.push_back({{20.0 * x, 20.0 * y, 20.0 * z}, 3 * random.point_in_ball()});
  SteeredMotion drones =
      SteeredMotion::create({.start = start, .acceleration_limits = std::vector(start.size(), agility)})
          .value();
  World world = World::create({.contact_tolerance = 1e-3}).value();
  std::vector<BodyId> ids;
  for (std::uint32_t k = 0; k < drones.size(); ++k) {
    BodyDefinition drone = drones.definition(k, 0.0);
    drone.radius = 0.3;
    ids.push_back(world.add(drone).value());
  }

  std::vector<double> certain_until(ids.size(), 0.0);
  std::uint64_t looks = 0, questions = 0, turns = 0;
  while (world.time() < seconds) {
    const double now = world.time();
    for (const BodyId id : ids) {
      const State self = drones.state(id.index, now);
      ++looks;
      // Moves with the crowd: about the middle, not too fast.
      Vec3 wish = 0.05 * (middle - self.position) - 0.5 * self.velocity;
      if (certain_until[id.index] < now + reaction) {
        ++questions;
        const EarliestContact contact = world.certificates(drones.probe()).earliest_contact(id).value();
        certain_until[id.index] = contact.time;
        if (contact.time < now + reaction) {
          ++turns;
          wish = 1e3 * (self.position - drones.state(contact.partner.index, now).position);
        }
      }
      drones.steer(id.index, now, wish * std::min(1.0, agility / norm(wish))).value();
    }
    for (const Event& event : world.events(now + tick, drones.probe()))
      std::printf("%s at %.3f\n", name_of(event.kind).data(), event.time);
  }

  const Counters& counters = world.counters();
  const auto contacts = static_cast<unsigned long long>(counters.count(EventKind::contact_begin));
  const double probes = static_cast<double>(counters.probes) / (seconds * static_cast<double>(ids.size()));
  const auto share = [&](std::uint64_t part) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(looks);
  };
  std::printf("%.1f %% of the time a drone had to ask, %.1f %% of the time to turn away\n", share(questions),
              share(turns));
  std::printf("%llu contacts; %.2f probes per drone and second\n", contacts, probes);
  return contacts == 0 && probes < 20.0 ? 0 : 1;
}
