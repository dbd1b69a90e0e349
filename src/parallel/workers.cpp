#include "kinesphere/workers.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "input/input_check.hpp"
#include "number/scope_guard.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {
namespace {

/// Judges by the clock whether other threads save time. On a busy machine they come late, or are interrupted
/// amid a range for which the caller has to wait. Then they rest, at first for a few sets of items.
class Profit {
 public:
  using Clock = std::chrono::steady_clock;

  /// Returns true if the caller should do the next set of items alone.
  bool rests() {
    if (resting_ == 0) return false;
    --resting_;
    return true;
  }
  /// A set of items was shared: the caller has woken the others from `begin` on, worked on `own` of so many
  /// ranges from `woken` on, and waited for the others from `waiting` on.
  void note(std::size_t own, std::size_t ranges, Clock::time_point begin, Clock::time_point woken,
            Clock::time_point waiting) {
    const std::chrono::duration<double> waking = woken - begin, work = waiting - woken,
                                        waited = Clock::now() - waiting;
    const double by_others = static_cast<double>(ranges - own) / static_cast<double>(own > 0 ? own : 1);
    work_ += work.count();
    saved_ += by_others * work.count() - waking.count() - waited.count();
    if (++sets_ < judged_at_once) return;
    rest_ =
        saved_ < least_profit * work_ ? std::min(rest_ > 0 ? 2 * rest_ : judged_at_once, longest_rest) : 0;
    resting_ = rest_;
    sets_ = 0;
    work_ = saved_ = 0.0;
  }

 private:
  static constexpr int judged_at_once = 32, longest_rest = 4096;
  static constexpr double least_profit = 0.05;

  int sets_ = 0, rest_ = 0, resting_ = 0;
  double work_ = 0.0, saved_ = 0.0;  ///< of the caller (seconds)
};

/// Threads that sleep until there are items, and again after a short wait without items.
class Threads final : public ThreadPool {
 public:
  explicit Threads(int count) {
    threads_.reserve(static_cast<std::size_t>(count) - 1);
    try {
      for (std::size_t worker = 1; worker < static_cast<std::size_t>(count); ++worker)
        threads_.emplace_back([this, worker] { live(worker); });
    } catch (...) {
      dismiss();
      throw;
    }
  }
  ~Threads() override { dismiss(); }

  int count() const override { return static_cast<int>(threads_.size()) + 1; }

  void run(SharedRange& items) override {
    if (profit_.rests()) {
      items.work(0);
      return;
    }
    const Profit::Clock::time_point begin = Profit::Clock::now();
    bool any_asleep = false;
    {
      const std::lock_guard lock(mutex_);
      assert(items_ == nullptr);
      items_ = &items;
      ++round_;
      any_asleep = asleep_ > 0;
    }
    if (any_asleep) wake_.notify_all();
    const Profit::Clock::time_point woken = Profit::Clock::now();
    const std::size_t own = items.work(0);
    const Profit::Clock::time_point waiting = Profit::Clock::now();
    {
      // A worker that has not started by now has no items left, and is not waited for.
      const std::lock_guard lock(mutex_);
      items_ = nullptr;
    }
    const auto all_have_stopped = [this] { return working_ == 0; };
    spin_until(all_have_stopped);
    {
      std::unique_lock lock(mutex_);
      done_.wait(lock, all_have_stopped);
    }
    profit_.note(own, items.ranges(), begin, woken, waiting);
  }

 private:
  void live(std::size_t worker) {
    std::uint64_t last_round = 0;
    for (;;) {
      spin_until([&] { return leaving_ || round_ != last_round; });
      std::unique_lock lock(mutex_);
      ++asleep_;
      wake_.wait(lock, [&] { return leaving_ || (items_ != nullptr && round_ != last_round); });
      --asleep_;
      if (leaving_) return;
      last_round = round_;
      SharedRange& items = *items_;
      ++working_;
      lock.unlock();
      items.work(worker);
      lock.lock();
      if (--working_ == 0) done_.notify_one();
    }
  }

  /// Returns when the condition is true, or after a short time. Polling notices the condition sooner than a
  /// sleeping thread would.
  template <class Comes>
  static void spin_until(Comes comes) {
    constexpr int most_tries = 100;
    for (int tries = 0; tries < most_tries && !comes(); ++tries) std::this_thread::yield();
  }

  void dismiss() {
    {
      const std::lock_guard lock(mutex_);
      leaving_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  Profit profit_;
  /// Protects all members below except threads_; atomic members are also read without it.
  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  SharedRange* items_ = nullptr;          ///< nullptr if no items are left to start with
  std::atomic<std::uint64_t> round_ = 0;  ///< number of the current set of items
  std::atomic<int> working_ = 0;
  int asleep_ = 0;
  std::atomic<bool> leaving_ = false;
  std::vector<std::thread> threads_;
};

/// Runs one task per worker on a task system. Each task takes ranges as long as there are any, so the threads
/// and the number of concurrent tasks do not matter.
class Tasks final : public ThreadPool {
 public:
  explicit Tasks(const TaskSystem& system) : system_(system) {}

  int count() const override { return system_.threads; }

  void run(SharedRange& items) override {
    void* const handle = system_.enqueue(
        [](std::size_t begin, std::size_t end, void* context) {
          for (std::size_t worker = begin; worker < end; ++worker)
            static_cast<SharedRange*>(context)->work(worker + 1);
        },
        static_cast<std::size_t>(count()) - 1, 1, &items, system_.user_context);
    items.work(0);
    system_.finish(handle, system_.user_context);
  }

 private:
  TaskSystem system_;
};

Result<void> check_threads(int threads) {
  return InputCheck("Workers::create")
      .require(threads >= 1 && threads <= Workers::most_threads, ErrorCode::out_of_range, {"threads"},
               "must be from 1 to 256", static_cast<double>(threads))
      .result();
}

}  // namespace

std::size_t SharedRange::work(std::size_t worker) {
  std::size_t done = 0;
  for (; !failed_.load(std::memory_order_relaxed); ++done) {
    const std::size_t begin = next_.fetch_add(range_, std::memory_order_relaxed);
    if (begin >= items_) return done;
    try {
      work_(begin, items_ - begin < range_ ? items_ : begin + range_, worker);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_ || begin < failed_at_) {
        failure_ = std::current_exception();
        failed_at_ = begin;
      }
      failed_ = true;
    }
  }
  return done;
}

PoolLease::PoolLease(Workers* workers) {
  if (workers == nullptr || workers->count() == 0) return;
  ThreadPool& pool = ThreadPool::of(*workers);
  free_ = !pool.busy_.exchange(true);
  if (free_) pool_ = &pool;
}

Result<Workers> Workers::create(int threads) {
  if (auto valid = check_threads(threads); !valid) return valid.error();
  try {
    return Workers(std::make_unique<Threads>(threads));
  } catch (const std::system_error& error) {
    return Error{ErrorCode::no_threads, "threads", no_body,
                 "Workers::create: threads: the system does not give " + text_of(std::size_t(threads)) +
                     " threads: " + error.what()};
  }
}

Result<Workers> Workers::create(const TaskSystem& task_system) {
  if (auto valid = check_threads(task_system.threads); !valid) return valid.error();
  for (const auto& [given, name] : {std::pair{task_system.enqueue != nullptr, "enqueue"},
                                    std::pair{task_system.finish != nullptr, "finish"}}) {
    if (given) continue;
    return Error{ErrorCode::null_callback, name, no_body,
                 std::string("Workers::create: ") + name + " must be a function, but is null"};
  }
  return Workers(std::make_unique<Tasks>(task_system));
}

Workers::Workers(std::unique_ptr<ThreadPool> pool) : pool_(std::move(pool)) {}
Workers::Workers(Workers&&) noexcept = default;
Workers& Workers::operator=(Workers&&) noexcept = default;
Workers::~Workers() = default;

int Workers::count() const { return pool_ ? pool_->count() : 0; }

}  // namespace kinesphere
