// How much memory a process has taken.
#pragma once

#include <sys/resource.h>

#include <cstdint>

namespace kinesphere {

/// Returns the peak memory of this process so far, in bytes.
inline std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace kinesphere
