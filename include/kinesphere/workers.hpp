// Workers of a world, of runs and of queries: threads of the library, or the task system of a program that
// has one.
#pragma once

#include <cstddef>
#include <memory>

#include "kinesphere/result.hpp"

namespace kinesphere {

/// A program's own task system. A task is a function to be called for ranges that together cover the items
/// from 0 to item_count exactly once. The ranges may be called sequentially or concurrently, in any order
/// and in any threads.
struct TaskSystem {
  /// What a task system calls: works on the items from the first to before the last.
  using Task = void (*)(std::size_t begin, std::size_t end, void* task_context);

  /// Number of threads that work on tasks, including the one that calls World::run(): from 1 to 256.
  int threads = 1;
  /// Accepts a task, and may return before it is done. No range needs more than least_range items. Its
  /// return value is passed to finish() and may be null. It must not throw.
  void* (*enqueue)(Task task, std::size_t item_count, std::size_t least_range, void* task_context,
                   void* user_context) = nullptr;
  /// Waits until a task is done. It is called once for each accepted task, in the thread that enqueued it,
  /// and must not throw.
  void (*finish)(void* handle, void* user_context) = nullptr;
  void* user_context = nullptr;
};

/// Serves one run() at a time, of any world; another run() that starts meanwhile fails with workers_busy, and
/// calls of a world that uses them (World::use_workers()) do without them. Idle threads yield a hundred times
/// while they look for work, and then sleep. Those that save no time, as on a busy machine, rest for a while.
class Workers {
 public:
  class Pool;  ///< of the library

  /// Largest number of threads.
  static constexpr int most_threads = 256;

  /// Creates workers with `threads` threads in total, including the one that calls World::run(): from 1,
  /// which starts no thread, to most_threads. Errors: out_of_range; no_threads if the system cannot start
  /// as many.
  [[nodiscard]] static Result<Workers> create(int threads);
  /// Creates workers that use a task system. Errors: out_of_range (threads); null_callback.
  [[nodiscard]] static Result<Workers> create(const TaskSystem& task_system);

  /// Workers must not be moved, assigned to or destroyed during a run().
  Workers(Workers&&) noexcept;
  Workers& operator=(Workers&&) noexcept;
  ~Workers();

  /// Returns the largest number of threads that work. 0 for moved-from Workers: the calling thread then
  /// works alone.
  int count() const;

 private:
  explicit Workers(std::unique_ptr<Pool> pool);

  std::unique_ptr<Pool> pool_;
};

}  // namespace kinesphere
