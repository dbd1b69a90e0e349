// Error values: a call with invalid input returns the argument, the body and the reason.
//
//   auto id = world.add({.radius = -1});
//   if (!id) std::puts(id.error().message.c_str());
//   // add: radius must be >= 0, but is -1
//
// Which calls return errors, and which throw? A call that returns a Result returns every error in it. A call
// that returns anything else throws BadResult, with the same Error. These are the calls that are used inside
// expressions and other calls: plain values of an object that only a moved-from one lacks (World::time()),
// definitions and states of motions, and the probes and sources made of them; and the steps of a loop over
// events. Exceptions of the caller's own callbacks pass through the call that called them. Apart from these
// only std::bad_alloc is thrown and, as the caller asks for it, BadResult by Result::value().
#pragma once

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// Why a call failed. name_of() returns the names.
enum class ErrorCode {
  not_finite,          ///< a number is NaN or infinite
  out_of_range,        ///< a number is finite but outside its documented range
  time_backwards,      ///< a time lies before the current time of the world or monitor
  unknown_body,        ///< the world, monitor or motion never issued this id
  stale_body,          ///< the body has been removed
  foreign_body,        ///< another world issued this id
  disabled_body,       ///< the call needs an enabled body
  enabled_body,        ///< the call needs a disabled body
  static_body,         ///< the call needs a body that can move
  outside_domain,      ///< a body does not lie inside the box of its world
  overlapping,         ///< two bodies overlap in a world that does not allow it
  probe_in_progress,   ///< a world or monitor was called inside its own callback (a probe, a sink)
  filter_in_progress,  ///< the world was called inside its own pair filter
  run_in_progress,     ///< the world is in a run(), or an interrupted one left undelivered events
  workers_busy,        ///< the workers are busy in another run()
  no_threads,          ///< the system cannot start as many threads
  null_probe,          ///< a probe or a monitor's poll is a null pointer or an empty std::function
  null_callback,       ///< a response, event or task function is a null pointer or an empty std::function
  callback_threw,      ///< a caller's function threw in a distributed world, which ends then
  rank_failed,         ///< a distributed world cannot continue after an error
  moved_from,          ///< the object has been moved from: it may only be assigned to and destroyed
  unsupported,         ///< the object does not support this operation
  bad_snapshot,        ///< no world or monitor can be restored from these bytes
  bad_bytes,           ///< no body of a motion can be read from these bytes
  recording,           ///< the world is already recorded
  not_recording,       ///< the world is not recorded
  not_profiling,       ///< profiling of the world was never on
  bad_recording,       ///< these bytes are not a recording
  diverged,            ///< a replay differs from its recording
};

/// Returns the name of a code, such as "not_finite".
std::string_view name_of(ErrorCode code);

/// Why a call failed, and what is to blame.
struct Error {
  ErrorCode code = ErrorCode::out_of_range;
  /// The invalid argument, spelled as in its declaration.
  std::string argument;
  /// The body concerned, or no_body.
  BodyId body = no_body;
  /// One line for a person: the call, the argument, the body, the expected and the actual value.
  std::string message;

  friend bool operator==(const Error&, const Error&) = default;
};

/// Exception that Result::value() throws. Code that checks its results never sees it.
class BadResult : public std::runtime_error {
 public:
  /// The error of the failed call; what() is its message.
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
  std::fprintf(stderr, "%s\n", error.message.c_str());
  std::abort();
#endif
}

[[noreturn]] inline void no_error() {
  constexpr const char* message = "Result::error(): there is no error, as the call has succeeded";
#if defined(__cpp_exceptions)
  throw std::logic_error(message);
#else
  std::fprintf(stderr, "%s\n", message);
  std::abort();
#endif
}

}  // namespace detail

/// Either a value or an Error. value(), `*` and `->` throw BadResult if there is only an error; error()
/// throws std::logic_error if there is none. Without exceptions they print the message and abort instead.
///
/// On a temporary Result, value() and `*` return the value itself, not a reference, so that this is safe:
///   for (const OverlapHit& hit : *world.overlapping(centre, radius)) ...
/// `->` on a temporary is valid within its own expression, as with std::expected:
///   if (world.body(id)->enabled) ...
template <class T>
class [[nodiscard]] Result {
 public:
  /// A success, and a failure.
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  /// Returns true for a success.
  bool has_value() const { return content_.index() == 0; }
  /// Does the same.
  explicit operator bool() const { return has_value(); }
  /// Returns the error of a failure; throws std::logic_error for a success.
  const Error& error() const& {
    require_error();
    return std::get<1>(content_);
  }
  Error error() && {
    require_error();
    return std::get<1>(std::move(content_));
  }

  /// Return the value of a success; throw BadResult for a failure.
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
  T value() const&& {
    require_value();
    return std::get<0>(content_);
  }
  /// Returns the value or, after an error, `other`.
  template <class Other>
  T value_or(Other&& other) const& {
    return has_value() ? std::get<0>(content_) : static_cast<T>(std::forward<Other>(other));
  }
  template <class Other>
  T value_or(Other&& other) && {
    return has_value() ? std::get<0>(std::move(content_)) : static_cast<T>(std::forward<Other>(other));
  }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T operator*() && { return std::move(*this).value(); }
  T operator*() const&& { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

 private:
  void require_value() const {
    if (content_.index() != 0) detail::bad_result(std::get<1>(content_));
  }
  void require_error() const {
    if (content_.index() != 1) detail::no_error();
  }

  std::variant<T, Error> content_;
};

/// Success or an Error. Success needs no allocation.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  /// A failure.
  Result(Error error) : error_(std::make_shared<const Error>(std::move(error))) {}

  /// Returns true for a success.
  bool has_value() const { return !error_; }
  /// Does the same.
  explicit operator bool() const { return has_value(); }
  /// Returns the error of a failure; throws std::logic_error for a success.
  const Error& error() const& {
    require_error();
    return *error_;
  }
  Error error() && {
    require_error();
    return *error_;
  }
  /// Throws BadResult for a failure.
  void value() const {
    if (error_) detail::bad_result(*error_);
  }

 private:
  void require_error() const {
    if (!error_) detail::no_error();
  }

  std::shared_ptr<const Error> error_;
};

}  // namespace kinesphere
