// Workers: each item is processed once, by any thread, and despite any failure.
#include "kinesphere/workers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/world.hpp"
#include "parallel/thread_pool.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::workers_test {
namespace {

/// A task system that runs each task when it is waited for, in ranges and threads of its choice.
struct LateTasks {
  struct Taken {
    TaskSystem::Task task;
    std::size_t items;
    void* context;
  };
  int taken = 0;
  int finished = 0;
  bool in_threads = false;

  static void* enqueue(TaskSystem::Task task, std::size_t items, std::size_t, void* context, void* self) {
    ++static_cast<LateTasks*>(self)->taken;
    return new Taken{task, items, context};
  }
  static void finish(void* handle, void* self) {
    const std::unique_ptr<Taken> taken(static_cast<Taken*>(handle));
    auto& tasks = *static_cast<LateTasks*>(self);
    ++tasks.finished;
    if (!tasks.in_threads) {
      if (taken->items > 1) taken->task(1, taken->items, taken->context);
      taken->task(0, 1, taken->context);
      return;
    }
    std::vector<std::thread> threads;
    for (std::size_t item = 0; item < taken->items; ++item)
      threads.emplace_back([&, item] { taken->task(item, item + 1, taken->context); });
    for (std::thread& thread : threads) thread.join();
  }
  TaskSystem system(int threads) { return {threads, enqueue, finish, this}; }
};

void expect_each_item_once(Workers* workers) {
  PoolLease shift(workers);
  ASSERT_TRUE(shift);
  for (const std::size_t items : {0u, 1u, 2u, 7u, 1000u, 100003u}) {
    for (const std::size_t range : {0u, 1u, 16u, 5000u}) {
      if (items / std::max<std::size_t>(range, 1) > 10000) continue;
      std::vector<std::atomic<int>> done(items);
      std::vector<std::atomic<int>> in_use(shift.count());
      shift.parallel_for(items, range, [&](std::size_t begin, std::size_t end, std::size_t worker) {
        ASSERT_LT(worker, shift.count());
        EXPECT_EQ(in_use[worker]++, 0) << "two threads with one number";
        EXPECT_LT(begin, end);
        EXPECT_TRUE(end == items || end - begin >= range);
        for (std::size_t item = begin; item < end; ++item) ++done[item];
        --in_use[worker];
      });
      EXPECT_TRUE(std::all_of(done.begin(), done.end(), [](const auto& times) { return times == 1; }))
          << items << " items by " << range;
    }
  }
}

TEST(Workers, DoEachItemOnce) {
  expect_each_item_once(nullptr);
  for (const int threads : {1, 2, 3, 4, 8}) {
    SCOPED_TRACE(threads);
    Workers workers = Workers::create(threads).value();
    EXPECT_EQ(workers.count(), threads);
    expect_each_item_once(&workers);
    LateTasks tasks;
    Workers by_tasks = Workers::create(tasks.system(threads)).value();
    EXPECT_EQ(by_tasks.count(), threads);
    for (const bool in_threads : {false, true}) {
      tasks.in_threads = in_threads;
      expect_each_item_once(&by_tasks);
    }
    EXPECT_EQ(tasks.taken, tasks.finished);
    EXPECT_EQ(tasks.taken > 0, threads > 1);
  }
}

TEST(Workers, WorkAtTheSameTime) {
  Workers workers = Workers::create(3).value();
  PoolLease shift(&workers);
  std::promise<void> all_here;
  const std::shared_future<void> opened = all_here.get_future().share();
  std::atomic<int> here = 0;
  std::vector<std::thread::id> threads(3);
  shift.parallel_for(3, 1, [&](std::size_t item, std::size_t, std::size_t) {
    threads[item] = std::this_thread::get_id();
    if (++here == 3) all_here.set_value();
    ASSERT_EQ(opened.wait_for(std::chrono::seconds(60)), std::future_status::ready);
  });
  EXPECT_EQ(std::set(threads.begin(), threads.end()).size(), 3u);
  EXPECT_TRUE(std::count(threads.begin(), threads.end(), std::this_thread::get_id()));
}

TEST(Workers, LeaveTheRestToOthersWhileOneIsSlow) {
  Workers workers = Workers::create(2).value();
  PoolLease shift(&workers);
  std::promise<void> rest_done;
  const std::shared_future<void> done = rest_done.get_future().share();
  std::atomic<int> left = 99;
  shift.parallel_for(100, 1, [&](std::size_t item, std::size_t, std::size_t) {
    if (item == 0) {
      EXPECT_EQ(done.wait_for(std::chrono::seconds(60)), std::future_status::ready);
    } else if (--left == 0) {
      rest_done.set_value();
    }
  });
  EXPECT_EQ(left, 0);
}

/// After the first 32 sets of items it is judged whether the others save time.
TEST(Workers, RestIfTheCallerOnlyWaitsForThem) {
  const auto shared_sets = [](auto work) {
    Workers workers = Workers::create(2).value();
    PoolLease lease(&workers);
    std::vector<int> sets;
    for (int set = 0; set < 64; ++set) {
      std::atomic<int> by_others = 0;
      lease.parallel_for(6, 1, [&](std::size_t, std::size_t, std::size_t worker) {
        work(worker);
        by_others += static_cast<int>(worker > 0);
      });
      if (by_others > 0) sets.push_back(set);
    }
    return sets;
  };
  using namespace std::chrono_literals;
  const auto slow_others = shared_sets([](std::size_t worker) {
    if (worker > 0) std::this_thread::sleep_for(2ms);
  });
  for (const int set : slow_others) EXPECT_LT(set, 32);
  const auto equal = shared_sets([](std::size_t) { std::this_thread::sleep_for(1ms); });
  ASSERT_FALSE(equal.empty());
  EXPECT_GE(equal.back(), 32);
}

TEST(Workers, PassOnWhatTheFirstItemThrew) {
  LateTasks tasks;
  Workers own = Workers::create(4).value(), by_tasks = Workers::create(tasks.system(4)).value();
  for (Workers* const workers : {static_cast<Workers*>(nullptr), &own, &by_tasks}) {
    PoolLease shift(workers);
    for (int round = 0; round < 200; ++round) {
      std::atomic<int> working = 0;
      std::string thrown;
      try {
        shift.parallel_for(50, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
          ++working;
          for (std::size_t item = begin; item < end; ++item) {
            if (item % 7 != 5) continue;
            --working;
            throw std::runtime_error(std::to_string(item));
          }
          --working;
        });
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(working, 0) << "all have stopped";
        thrown = error.what();
      }
      ASSERT_EQ(thrown, "5");
    }
    int items = 0;
    shift.parallel_for(1, 1, [&](std::size_t, std::size_t, std::size_t) { ++items; });
    EXPECT_EQ(items, 1) << "and go on";
  }
}

TEST(Workers, PassOnWhatTheFirstItemThrewAlsoWhenALaterOneWasFaster) {
  Workers workers = Workers::create(2).value();
  PoolLease shift(&workers);
  std::promise<void> later_throws;
  const std::shared_future<void> thrown = later_throws.get_future().share();
  const auto fail = [&](std::size_t item, std::size_t, std::size_t) {
    if (item == 1) later_throws.set_value();
    if (item == 0) {
      EXPECT_EQ(thrown.wait_for(std::chrono::seconds(60)), std::future_status::ready);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    throw std::runtime_error(std::to_string(item));
  };
  try {
    shift.parallel_for(10, 1, fail);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "0");
  }
}

TEST(Workers, ComeAndGo) {
  for (int round = 0; round < 50; ++round) {
    Workers workers = Workers::create(1 + round % 5).value();
    if (round % 2 == 0) continue;
    Workers moved = std::move(workers);
    std::atomic<std::size_t> sum = 0;
    PoolLease(&moved).parallel_for(
        100, 3, [&](std::size_t begin, std::size_t end, std::size_t) { sum += end - begin; });
    EXPECT_EQ(sum, 100u);
  }
}

TEST(Workers, AreOfferedInNumbersThatMakeSense) {
  LateTasks tasks;
  for (const int threads : {0, -1, 257}) {
    expect_error(Workers::create(threads), ErrorCode::out_of_range, "threads", "Workers::create:");
    expect_error(Workers::create(tasks.system(threads)), ErrorCode::out_of_range, "threads",
                 "Workers::create:");
  }
  EXPECT_TRUE(Workers::create(Workers::most_threads));
  TaskSystem system = tasks.system(2);
  system.finish = nullptr;
  expect_error(Workers::create(system), ErrorCode::null_callback, "finish", "Workers::create:");
  system.enqueue = nullptr;
  expect_error(Workers::create(system), ErrorCode::null_callback, "enqueue", "Workers::create:");
}

TEST(Workers, WorkForOneRunAtATime) {
  Ballistic motion = Ballistic::create({.start = {{{0, 0, 0}, {1, 0, 0}}, {{5, 0, 0}, {}}}}).value();
  const auto world_of = [&] {
    World world = World::create({}).value();
    for (std::uint32_t k = 0; k < 2; ++k) {
      BodyDefinition body = motion.definition(k, 0.0);
      body.radius = 1.0;
      world.add(body).value();
    }
    return world;
  };
  World world = world_of(), inner = world_of();
  Workers workers = Workers::create(2).value(), others = Workers::create(1).value();
  int reported = 0;
  const auto silent = [](const Event&) {};
  const auto sink = [&](const Event&) {
    ++reported;
    expect_error(inner.run(20.0, motion.probe(), silent, &workers), ErrorCode::workers_busy, "workers",
                 "run:");
    EXPECT_TRUE(inner.run(inner.time() + 1.0, motion.probe(), silent, &others));
  };
  world.run(20.0, motion.probe(), sink, &workers).value();
  EXPECT_EQ(reported, 2);
  inner
      .run(
          20.0, motion.probe(), [&](const Event&) { ++reported; }, &workers)
      .value();
  EXPECT_EQ(reported, 4);

  const Workers taken = std::move(workers);
  EXPECT_EQ(workers.count(), 0);  // NOLINT(bugprone-use-after-move): that is what is tested.
  EXPECT_TRUE(world.run(21.0, motion.probe(), sink, &workers)) << "the calling thread is left";
}

}  // namespace
}  // namespace kinesphere::workers_test
