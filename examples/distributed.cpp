// A gas in several processes, each of which brings a part of the bodies:
//   mpirun -n 4 example_distributed
// With any number of processes, one included, it prints the same.
#include <kinesphere/distributed/distributed_world.hpp>
#include <kinesphere/distributed/mpi_session.hpp>
#include <kinesphere/motion/ballistic.hpp>
#include <kinesphere/response.hpp>

#include <cstdint>
#include <cstdio>
#include <vector>

using namespace kinesphere;

int main(int argc, char** argv) {
  const MpiSession mpi(argc, argv);  // MPI_Init, and MPI_Finalize at the end

  // 8000 bodies on a lattice; this process owns those from `first` to before `last`.
  constexpr std::uint32_t side = 20, all = side * side * side;
  const auto begin_of = [&](int rank) {
    return static_cast<std::uint32_t>(all * std::uint64_t(rank) / mpi.ranks());
  };
  const std::uint32_t first = begin_of(mpi.rank()), last = begin_of(mpi.rank() + 1);
  std::vector<State> states;
  for (std::uint32_t k = first; k < last; ++k) {
    const auto x = k % side, y = k / side % side, z = k / side / side;
    const double speed = 1.0 + 0.1 * (k % 7);
    states.push_back({{x + 0.5, y + 0.5, z + 0.5}, {k % 2 == 0 ? speed : -speed, k % 3 - 1.0, k % 5 - 2.0}});
  }
  Ballistic motion = Ballistic::create({.start = states}).value();

  const WorldDefinition definition{.box = Box{{0, 0, 0}, {side, side, side}},
                                   .contacts = ContactMode::impacts};
  DistributedWorld world = DistributedWorld::create(definition, motion).value();
  for (std::uint32_t k = first; k < last; ++k) {
    BodyDefinition body = motion.definition(k - first, 0.0);
    body.radius = 0.2;
    world.add(k, body, k - first).value();
  }

  // Equal on all processes, since it depends on the event alone.
  const auto respond = [](const Event& event) { return response_of(event, bounce(event, 1.0)); };
  // Receives the events with a first body of this process.
  const auto sink = [](const OrderedEvent&) {};
  if (const auto done = world.run(2.0, respond, sink); !done) {
    if (mpi.rank() == 0) std::fprintf(stderr, "%s\n", done.error().message.c_str());
    return 1;
  }

  const Counters counters = world.counters();  // collective: sums over all processes
  const EventHash hash = world.hash();
  if (mpi.rank() == 0) {
    std::printf("%llu contacts, %llu with walls, hash %016llx\n",
                static_cast<unsigned long long>(counters.count(EventKind::contact_begin)),
                static_cast<unsigned long long>(counters.count(EventKind::wall_begin)),
                static_cast<unsigned long long>(hash.value()));
  }
  return 0;
}
