// guarded() converts exceptions of the caller's functions into errors, which can be sent to other ranks.
#pragma once

#include <exception>
#include <type_traits>

#include "kinesphere/result.hpp"

namespace kinesphere {

/// Returns the result of f(), or callback_threw if f() throws. The error of a BadResult keeps its argument
/// and body.
template <class F>
auto guarded(F f)
    -> std::conditional_t<std::is_void_v<std::invoke_result_t<F>>, Result<void>, std::invoke_result_t<F>> {
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
