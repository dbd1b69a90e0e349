// Internal interface of Workers: parallel loops over ranges of items.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>

#include "kinesphere/workers.hpp"

namespace kinesphere {

/// A reference to a function of (begin, end, worker). The function must outlive the reference.
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

/// The items of one parallel_for(). Each free worker takes the next range, which balances unequal items.
class SharedRange {
 public:
  SharedRange(std::size_t items, std::size_t range, RangeFunction work)
      : items_(items), range_(range), work_(work) {}

  /// Processes ranges until none is left or one has failed. Returns how many. Thread-safe.
  std::size_t work(std::size_t worker);
  /// Returns the number of all ranges.
  std::size_t ranges() const { return (items_ + range_ - 1) / range_; }
  /// Throws the exception of the first range that failed, if any. Precondition: all workers have stopped.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::size_t items_;
  std::size_t range_;
  RangeFunction work_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;  ///< protects the members below
  std::exception_ptr failure_;
  std::size_t failed_at_ = 0;
};

class Workers::Pool {
 public:
  virtual ~Pool() = default;
  Pool() = default;
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  virtual int count() const = 0;
  /// Processes all items on the calling thread, as worker 0, and on others, each with its own number less
  /// than count(). Returns when all have stopped.
  virtual void run(SharedRange& items) = 0;
  /// Returns the pool of `workers`. Precondition: they have not been moved from.
  static Pool& of(Workers& workers) { return *workers.pool_; }
  static Workers made(std::unique_ptr<Pool> pool) { return Workers(std::move(pool)); }

 private:
  friend class PoolLease;
  std::atomic<bool> busy_ = false;
};

using ThreadPool = Workers::Pool;

/// Acquires the pool for the lifetime of the lease, if it is free. Without workers, the calling thread works
/// alone.
class PoolLease {
 public:
  explicit PoolLease(Workers* workers = nullptr);
  PoolLease(const PoolLease&) = delete;
  PoolLease& operator=(const PoolLease&) = delete;
  ~PoolLease() {
    if (pool_) pool_->busy_ = false;
  }

  /// True if the pool was acquired, or if there are no workers; all other members require it.
  explicit operator bool() const { return free_; }
  /// Returns the maximum number of concurrent workers.
  std::size_t count() const { return pool_ ? static_cast<std::size_t>(pool_->count()) : 1; }

  /// Calls f(begin, end, worker) for disjoint ranges that cover all items, on up to count() threads
  /// concurrently; each thread has its own number `worker` less than count(). Ranges have at least
  /// `least_range` items, except for the last one, and begin in order. Returns when all are done. If f
  /// throws, no further ranges begin, and the exception of the first range that threw is rethrown. It is
  /// always the same one, since earlier ranges began before it. Must not be called inside f.
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
  /// Calls f(k, worker) for each item k, as parallel_for() does.
  template <class F>
  void for_each(std::size_t items, std::size_t least_range, F f) {
    parallel_for(items, least_range, [&](std::size_t begin, std::size_t end, std::size_t worker) {
      for (std::size_t k = begin; k < end; ++k) f(k, worker);
    });
  }

 private:
  ThreadPool* pool_ = nullptr;
  bool free_ = true;
};

}  // namespace kinesphere
