// std::bit_cast, with a substitute for standard libraries that lack it (such as emscripten 3.1's).
#pragma once

#include <bit>
#include <type_traits>

namespace kinesphere {

#if defined(__cpp_lib_bit_cast)
using std::bit_cast;
#else
template <class To, class From>
requires(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
         std::is_trivially_copyable_v<From>) constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

}  // namespace kinesphere
