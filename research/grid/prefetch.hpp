// Prefetching of cache lines that will soon be used.
#pragma once

#include <cstddef>

namespace kinesphere {

/// Prefetches the cache lines of an object. A function that only calls this one must be always_inline too: to
/// GCC it has no effect, and a call of it is left out.
template <class T>
[[gnu::always_inline]] inline void prefetch(const T& object) {
  constexpr std::size_t cache_line = 64;
  const auto* const bytes = reinterpret_cast<const char*>(&object);
  for (std::size_t at = 0; at < sizeof(T); at += cache_line) __builtin_prefetch(bytes + at);
}

}  // namespace kinesphere
