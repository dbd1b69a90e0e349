// The workers inside: items of work that are done by several threads at the same time.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <type_traits>

#include "kinesphere/workers.hpp"

namespace kinesphere {

/// A function of (begin, end, worker) that outlives its use here.
class RangeFunction {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_const_t<F>, RangeFunction>) explicit RangeFunction(F& function)
      : object_(const_cast<void*>(static_cast<const void*>(&function))),
        call_([](void* object, std::size_t begin, std::size_t end, std::size_t worker) {
          (*static_cast<F*>(object))(begin, end, worker);
        }) {}
  void operator()(std::size_t begin, std::size_t end, std::size_t worker) const {
    call_(object_, begin, end, worker);
  }

 private:
  void* object_;
  void (*call_)(void*, std::size_t, std::size_t, std::size_t);
};

/// The items of one for_each(): whoever is free takes the next range of them, so that unequal items balance.
class SharedRange {
 public:
  SharedRange(std::size_t items, std::size_t range, RangeFunction work)
      : items_(items), range_(range), work_(work) {}

  /// Takes ranges until none is left, or one has failed.
  void work(std::size_t worker);
  /// Throws what the first range threw that did. All must have stopped.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::size_t items_;
  std::size_t range_;
  RangeFunction work_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;  ///< of what follows
  std::exception_ptr failure_;
  std::size_t failed_at_ = 0;
};

class ThreadPool {
 public:
  virtual ~ThreadPool() = default;
  ThreadPool() = default;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  virtual int count() const = 0;
  /// Has the items worked on by the calling thread, as worker 0, and by others, each with a number less than
  /// count() of its own. Returns when all have stopped.
  virtual void run(SharedRange& items) = 0;

  /// Of Workers that have not been moved from.
  static ThreadPool& of(Workers& workers) { return *workers.pool_; }
  static Workers made(std::unique_ptr<ThreadPool> pool) { return Workers(std::move(pool)); }

 private:
  friend class PoolLease;
  std::atomic<bool> busy_ = false;
};

/// The crew is taken for as long as this lives, unless it was already. Without workers, the calling thread
/// works alone.
class PoolLease {
 public:
  explicit PoolLease(Workers* workers = nullptr);
  PoolLease(const PoolLease&) = delete;
  PoolLease& operator=(const PoolLease&) = delete;
  ~PoolLease() {
    if (pool_) pool_->busy_ = false;
  }

  /// It was free. Nothing else may be asked otherwise.
  explicit operator bool() const { return free_; }
  /// How many may work at the same time.
  std::size_t count() const { return pool_ ? static_cast<std::size_t>(pool_->count()) : 1; }

  /// Calls f(begin, end, worker) for ranges that together cover all items once, on up to count() threads at
  /// the same time; each thread has a number `worker` less than count() of its own. Ranges have at least
  /// `least_range` items (but for the last), and are begun in their order. Returns when all are done. When
  /// one throws, no more are begun, and that of the first range that threw passes through: always the same
  /// one, as those before it have been begun earlier. Must not be called inside f.
  template <class F>
  void parallel_for(std::size_t items, std::size_t least_range, F&& f) {
    const std::size_t range = least_range > 0 ? least_range : 1;
    if (!pool_ || items <= range || pool_->count() == 1) {
      if (items > 0) f(std::size_t{0}, items, std::size_t{0});
      return;
    }
    SharedRange shared(items, range, RangeFunction(f));
    pool_->run(shared);
    shared.rethrow();
  }

 private:
  ThreadPool* pool_ = nullptr;
  bool free_ = true;
};

}  // namespace kinesphere
