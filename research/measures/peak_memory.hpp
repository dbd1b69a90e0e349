// How much memory a process has taken.
#pragma once

#include <cstdint>

namespace kinesphere {

/// Returns the peak memory of this process so far, in bytes.
std::uint64_t peak_memory();

}  // namespace kinesphere
