// A program with threads of its own lends them to the world: its task system behind two functions, here that
// of oneTBB.
#include <kinesphere/kinesphere.hpp>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <cstdio>
#include <utility>

using namespace kinesphere;

void* enqueue(TaskSystem::Task task, std::size_t item_count, std::size_t least_range, void* task_context,
              void*) {
  auto* const group = new tbb::task_group;
  group->run([=] {
    const tbb::blocked_range<std::size_t> items(0, item_count, least_range);
    tbb::parallel_for(items, [=](const auto& range) { task(range.begin(), range.end(), task_context); });
  });
  return group;
}

void finish(void* handle, void*) {
  auto* const group = static_cast<tbb::task_group*>(handle);
  group->wait();
  delete group;
}

int main() {
  const TaskSystem tbb_tasks{
      .threads = tbb::this_task_arena::max_concurrency(), .enqueue = enqueue, .finish = finish};
  Workers workers = Workers::create(tbb_tasks).value();

  BallisticDefinition flight;
  for (int k = 0; k < 1000; ++k)
    flight.start.push_back(
        {{2.0 * (k % 10), 2.0 * (k / 10 % 10), 2.0 * (k / 100 % 10)}, {1.0 - k % 3, 0, 0}});
  Ballistic motion = Ballistic::create(flight).value();
  World world = World::create({.contacts = ContactMode::impacts}).value();
  for (std::uint32_t k = 0; k < motion.size(); ++k) {
    BodyDefinition ball = motion.definition(k, 0.0);
    ball.radius = 0.5;
    world.add(ball).value();
  }
  SingleMotionSource mover(motion);
  std::size_t impacts = 0;
  const auto respond = [](const Event& event) -> Response { return response_of(event, bounce(event, 1.0)); };
  world
      .run(
          10.0, mover, respond, [&](const Event&) { ++impacts; }, &workers)
      .value();
  std::printf("%zu impacts, by up to %d threads of oneTBB\n", impacts, workers.count());
}
