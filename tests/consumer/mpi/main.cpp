// Two spheres that meet head-on at t = 4, in a distributed world of the installed library.
#include <cmath>
#include <cstdio>
#include <kinesphere/distributed/distributed_world.hpp>
#include <kinesphere/distributed/mpi_session.hpp>
#include <kinesphere/motion/ballistic.hpp>

int main(int argc, char** argv) {
  using namespace kinesphere;

  const MpiSession mpi(argc, argv);
  Ballistic motion = Ballistic::create({.start = {{{0, 0, 0}, {1, 0, 0}}, {{10, 0, 0}, {-1, 0, 0}}}}).value();
  DistributedWorld world = DistributedWorld::create({}, motion).value();
  for (std::uint32_t k = 0; k < 2; ++k) {
    BodyDefinition body = motion.definition(k, 0.0);
    body.radius = 1.0;
    world.add(k, body, k).value();
  }
  double first = -1.0;
  const auto sink = [&](const OrderedEvent& reported) {
    if (first < 0.0) first = reported.event.time;
  };
  world.run(5.0, sink).value();
  if (std::abs(first - 4.0) > 1e-5) {
    std::fputs("the contact at t = 4 was not found\n", stderr);
    return 1;
  }
  std::printf("rank %d of %d: contact at t = %.6f\n", mpi.rank(), mpi.ranks(), first);
  return 0;
}
