// What the caller's functions throw: other ranks have to hear of it, so it becomes an error.
#pragma once

#include <exception>
#include <type_traits>

#include "kinesphere/result.hpp"

namespace kinesphere {

/// The result of f(), if it has one, or what it throws.
template <class F>
Result<void> guarded(F f) {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<F>>) {
      f();
      return {};
    } else {
      return f();
    }
  } catch (const BadResult& thrown) {
    return Error{ErrorCode::callback_threw, thrown.error().argument, thrown.error().body, thrown.what()};
  } catch (const std::exception& thrown) {
    return Error{ErrorCode::callback_threw, "callback", no_body, thrown.what()};
  } catch (...) {
    return Error{ErrorCode::callback_threw, "callback", no_body, "something that is no std::exception"};
  }
}

}  // namespace kinesphere
