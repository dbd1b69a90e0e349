// Workers that never stand back, so that tests execute clusters side by side on every machine.
#pragma once

#include "kinesphere/workers.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// Returns Workers::create(threads), or an error of it. Their threads work however little they gain.
inline Result<Workers> eager_workers(int threads) {
  auto workers = Workers::create(threads);
  if (workers) ThreadPool::of(*workers).be_eager();
  return workers;
}

}  // namespace kinesphere
