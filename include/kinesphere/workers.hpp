// Who does the work of World::run: threads of the library's own, or the task system of a program that has
// one.
#pragma once

#include <cstddef>
#include <memory>

#include "kinesphere/result.hpp"

namespace kinesphere {

class ThreadPool;

/// A program's own task system. A task is a function that is to be called for ranges which together cover the
/// items from 0 to item_count exactly once; the ranges may be called one after the other or at the same time,
/// in any order and in any threads.
struct TaskSystem {
  using Task = void (*)(std::size_t begin, std::size_t end, void* task_context);

  /// How many threads work on tasks, the one that calls World::run included: from 1 to 256.
  int threads = 1;
  /// Takes a task, and may return before it is done. No range that it is cut into needs to have more than
  /// least_range items. What it returns is handed to finish() and may be null. It must not throw.
  void* (*enqueue)(Task task, std::size_t item_count, std::size_t least_range, void* task_context,
                   void* user_context) = nullptr;
  /// Called once for each task that was taken, in the thread that enqueued it: returns when it is done. It
  /// must not throw.
  void (*finish)(void* handle, void* user_context) = nullptr;
  void* user_context = nullptr;
};

/// Works for one run at a time, of any world; another one that is begun meanwhile fails with workers_busy.
/// Idle threads look out for more to do for a moment (they yield a hundred times), then they sleep.
class Workers {
 public:
  static constexpr int most_threads = 256;

  /// `threads` in all, the one that calls World::run included: from 1, which starts none, to most_threads.
  /// Errors: out_of_range; no_threads where the system does not give as many.
  [[nodiscard]] static Result<Workers> create(int threads);
  /// Errors: out_of_range (threads); null_callback.
  [[nodiscard]] static Result<Workers> create(const TaskSystem& task_system);

  /// Not while they work.
  Workers(Workers&&) noexcept;
  Workers& operator=(Workers&&) noexcept;
  ~Workers();

  /// How many threads work at most. 0 for Workers that have been moved from: the calling thread works alone
  /// then.
  int count() const;

 private:
  friend class ThreadPool;
  explicit Workers(std::unique_ptr<ThreadPool> pool);

  std::unique_ptr<ThreadPool> pool_;
};

}  // namespace kinesphere
