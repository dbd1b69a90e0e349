// Worlds that some ranks of a program share, as the parts of coupled programs do.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "distributed/one_world.hpp"
#include "simulation/scene/make_scene.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::distributed_communicators_test {
namespace {

/// Owns a communicator of MPI.
class Group {
 public:
  explicit Group(MPI_Comm comm) : comm_(comm) {}
  /// The ranks of the same colour, in this order.
  Group(int colour, int order) { MPI_Comm_split(MPI_COMM_WORLD, colour, order, &comm_); }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;
  ~Group() { MPI_Comm_free(&comm_); }

  MPI_Comm comm() const { return comm_; }
  int handle() const { return MPI_Comm_c2f(comm_); }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

Scene scene(std::uint64_t seed) {
  SceneParameters parameters;
  parameters.bodies = 150;
  parameters.seconds = 1.0;
  parameters.seed = seed;
  parameters.box.upper = {100, 100, 100};
  return make_scene(parameters).value();
}

/// Every other rank shares one world, and the rest another one, at the same time; the last rank comes first.
TEST(DistributedCommunicators, ShareWorldsOfTheirOwn) {
  const Communicator all;
  const int colour = all.rank() % 2;
  const Group group(colour, -all.rank());
  const Setting setting{.scene = scene(colour == 0 ? 1 : 2), .communicator = group.handle()};
  const RunOutcome one = alone(setting);
  EXPECT_GE(one.events.size(), 50u);
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);
  int rank = -1, ranks = 0;
  MPI_Comm_rank(group.comm(), &rank);
  MPI_Comm_size(group.comm(), &ranks);
  EXPECT_EQ(world.rank(), rank);
  EXPECT_EQ(world.ranks(), ranks);
  // Messages of the caller over the same communicator are its own.
  std::vector<int> of_ranks(static_cast<std::size_t>(ranks), -1);
  MPI_Request sent = MPI_REQUEST_NULL;
  MPI_Isend(&rank, 1, MPI_INT, (rank + 1) % ranks, 0, group.comm(), &sent);
  expect_same(one, finish(setting, world));
  int heard = -1;
  MPI_Recv(&heard, 1, MPI_INT, MPI_ANY_SOURCE, MPI_ANY_TAG, group.comm(), MPI_STATUS_IGNORE);
  MPI_Wait(&sent, MPI_STATUS_IGNORE);
  EXPECT_EQ(heard, (rank + ranks - 1) % ranks);
}

TEST(DistributedCommunicators, RestoreOnTheRanksOfAnother) {
  Communicator all;
  Setting setting{.scene = scene(3)};
  const RunOutcome one = alone(setting);
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);
  std::vector<OrderedEvent> reported;
  const ResponseFn respond = [&](const Event& event) { return setting.answer(event); };
  world.run(0.5, respond, [&](const OrderedEvent& event) { reported.push_back(event); }).value();
  const std::vector<Event> before = merged(reported);
  const std::vector<std::vector<std::byte>> parts = all.gather(world.save().value());
  // Each rank goes on with the whole world, by itself.
  setting.communicator = MPI_Comm_c2f(MPI_COMM_SELF);
  const std::unique_ptr<Motion> rest = setting.scene.motion->clone();
  for (std::uint32_t body = 0; body < setting.scene.bodies.size(); ++body) rest->remove(body).value();
  DistributedWorld restored = DistributedWorld::restore(parts, *rest, setting.communicator).value();
  EXPECT_EQ(restored.ranks(), 1);
  RunOutcome later = finish(setting, restored);
  later.events.insert(later.events.begin(), before.begin(), before.end());
  expect_same_course(one, later);
}

TEST(DistributedCommunicators, HaveToBeOneGroupWithThisRank) {
  const Communicator all;
  const std::unique_ptr<Motion> motion = scene(4).motion->clone();
  const int none = MPI_Comm_c2f(MPI_COMM_NULL);
  expect_error(DistributedWorld::create({}, *motion, none), ErrorCode::unsupported, "communicator",
               "create: communicator is MPI_COMM_NULL");
  expect_error(DistributedWorld::restore({}, *motion, none), ErrorCode::unsupported, "communicator",
               "restore: communicator is MPI_COMM_NULL");
  if (all.ranks() == 1) return;
  const int colour = all.rank() == 0 ? 0 : 1;
  const Group group(colour, 0);
  MPI_Comm between = MPI_COMM_NULL;
  MPI_Intercomm_create(group.comm(), 0, MPI_COMM_WORLD, 1 - colour, 7, &between);
  const Group bridge(between);
  expect_error(DistributedWorld::create({}, *motion, bridge.handle()), ErrorCode::unsupported, "communicator",
               "create: communicator is an intercommunicator");
}

}  // namespace
}  // namespace kinesphere::distributed_communicators_test
