// Chains of 8 and 16 beads with bonds that they cannot break, which coil up: steps of a potential for each
// kind of pair, told apart by the states of pairs. Their sizes are compared with that of a self-avoiding
// walk: the end to end distance grows with the number of bonds to the power 0.588 (Le Guillou and
// Zinn-Justin, 1977).
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

using namespace kinesphere;

namespace {

constexpr std::int32_t bonded = 1;

struct Coil {
  double square_end_to_end = 0.0, longest_bond = 0.0;
  int samples = 0;
};

double gauss(Random& random) {
  const double size = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return size * std::cos(2.0 * std::numbers::pi * random.uniform());
}

/// Follows one chain, and adds what is found at each sample.
void coil(std::uint32_t beads, std::uint64_t seed, Coil& found) {
  const double size = 4.0 * beads;
  World world = World::create({.box = Box{{0, 0, 0}, {size, size, size}},
                               .periodic = {true, true, true},
                               .contacts = ContactEvents::impacts})
                    .value();
  const double infinity = std::numeric_limits<double>::infinity();
  const StepPotential bond =
      StepPotential::create({.distances = {0.5}, .energies = {0.0}, .outside = infinity}, world.definition())
          .value();
  world.set_sensor(0, bond.sensor()).value();
  // A chain that is bent a little, so that it moves in all directions.
  std::vector<State> start;
  Random random(seed);
  for (std::uint32_t k = 0; k < beads; ++k)
    start.push_back({{1.2 * k + 1.0, 0.5 * size + 0.3 * (k % 2), 0.5 * size + 0.3 * (k / 2 % 2)},
                     random.point_in_ball()});
  Ballistic motion = Ballistic::create({.start = start}).value();
  SingleMotionSource source(motion);
  std::vector<BodyId> chain;
  for (std::uint32_t k = 0; k < beads; ++k) {
    BodyDefinition bead = motion.definition(k, 0.0);
    bead.radius = 0.5;
    chain.push_back(world.add(bead).value());
    if (k > 0) world.set_pair_state(chain[k - 1], chain[k], bonded).value();
  }

  // Pairs without a bond only bounce; those with one are turned back where it is stretched.
  const auto respond = [&](const Event& event) -> Response {
    if (event.kind == EventKind::timer) return {.stop = true};
    if (is_of_sensor(event.kind) && event.pair_state != bonded) return {};
    return bond.respond(event);
  };
  const auto hear = [&](const Event& event) {
    if (event.kind != EventKind::timer) return;
    const BodyId hit = chain[random.bits() % beads];
    Vec3 velocity;
    for (int axis = 0; axis < 3; ++axis) velocity[axis] = gauss(random);
    motion.set_velocity(hit.index, event.time, velocity).value();
    world.set_velocity(hit, velocity).value();
    if (event.time < 300.0) return;  // it forgets how it began
    ++found.samples;
    Vec3 whole;
    for (std::uint32_t k = 1; k < beads; ++k) {
      const Vec3 along = motion.state(k, event.time).position - motion.state(k - 1, event.time).position;
      found.longest_bond = std::max(found.longest_bond, norm(along));
      whole += along;
    }
    found.square_end_to_end += norm_squared(whole);
  };
  world.schedule({.time = 0.5, .period = 0.5}).value();
  world.run(900.0, source, respond, hear).value();
}

}  // namespace

int main() {
  Coil small, large;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    coil(8, seed, small);
    coil(16, seed, large);
  }
  const double ratio = large.square_end_to_end / large.samples / (small.square_end_to_end / small.samples);
  const double exponent = 0.5 * std::log(ratio) / std::log(15.0 / 7.0);
  const double longest = std::max(small.longest_bond, large.longest_bond);
  std::printf("longest bond %.6f, at most 1.5\n", longest);
  std::printf("size grows with the number of bonds to the power %.2f, self-avoiding walks 0.588\n", exponent);
  return longest < 1.5001 && std::abs(exponent - 0.588) < 0.08 ? 0 : 1;
}
