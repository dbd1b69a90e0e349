// Wrong input is answered with a value: which argument, of which body, and why.
//
//   auto id = world.add({.radius = -1});
//   if (!id) std::puts(id.error().message.c_str());
//   // add: radius must be a finite number >= 0, but is -1
#pragma once

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "kinesphere/body.hpp"

namespace kinesphere {

enum class ErrorCode {
  not_finite,          ///< a number is NaN or infinite
  out_of_range,        ///< a number is finite but outside the range that its description gives
  time_backwards,      ///< a time lies before the world's current time
  unknown_body,        ///< an id that this world never gave out
  stale_body,          ///< an id of a body that has been removed
  disabled_body,       ///< the call needs a body that is enabled
  enabled_body,        ///< the call needs a body that is disabled
  fixed_body,          ///< the call needs a body that can move
  outside_domain,      ///< a body does not lie inside the box of its world
  overlapping,         ///< two bodies overlap where the world does not allow it
  probe_in_progress,   ///< the world was called from inside its own probe
  filter_in_progress,  ///< the world was called from inside its own pair filter
  unsupported,         ///< this detector cannot do what the scene asks for
  bad_snapshot,        ///< bytes that no world can be restored from
  recording,           ///< the world is being recorded already
  not_recording,       ///< the world is not being recorded
  bad_recording,       ///< bytes that are no recording
  diverged,            ///< a replay went another way than its recording
};

struct Error {
  ErrorCode code = ErrorCode::out_of_range;
  /// The argument that is wrong, as its declaration spells it.
  std::string argument;
  /// The body that it concerns, or no_body.
  BodyId body = no_body;
  /// One line for a person: the call, the argument, the body, what was expected and what came.
  std::string message;
};

/// What Result::value() throws. Code that checks its results never sees it.
class BadResult : public std::runtime_error {
 public:
  explicit BadResult(Error error) : std::runtime_error(error.message), error_(std::move(error)) {}
  const Error& error() const { return error_; }

 private:
  Error error_;
};

namespace detail {

[[noreturn]] inline void bad_result(const Error& error) {
#if defined(__cpp_exceptions)
  throw BadResult(error);
#else
  std::fputs(error.message.c_str(), stderr);
  std::abort();
#endif
}

}  // namespace detail

/// Either a value or an Error. `value()` throws BadResult when there is only an error (and aborts
/// with its message where exceptions are switched off).
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return content_.index() == 0; }
  const Error& error() const { return std::get<1>(content_); }

  T& value() & {
    require_value();
    return std::get<0>(content_);
  }
  const T& value() const& {
    require_value();
    return std::get<0>(content_);
  }
  T value() && {
    require_value();
    return std::get<0>(std::move(content_));
  }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

 private:
  void require_value() const {
    if (content_.index() != 0) detail::bad_result(error());
  }

  std::variant<T, Error> content_;
};

/// Success, or an Error; success costs next to nothing.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::make_shared<const Error>(std::move(error))) {}

  explicit operator bool() const { return !error_; }
  const Error& error() const { return *error_; }
  void value() const {
    if (error_) detail::bad_result(*error_);
  }

 private:
  std::shared_ptr<const Error> error_;
};

}  // namespace kinesphere
