// Wrong input is answered with a value: which argument, of which body, and why.
//
//   auto id = world.add({.radius = -1});
//   if (!id) std::puts(id.error().message.c_str());
//   // add: radius must be >= 0, but is -1
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

enum class ErrorCode {
  not_finite,          ///< a number is NaN or infinite
  out_of_range,        ///< a number is finite but outside the range that its description gives
  time_backwards,      ///< a time lies before the world's current time
  unknown_body,        ///< an id that this world never gave out
  stale_body,          ///< an id of a body that has been removed
  foreign_body,        ///< an id that another world gave out
  disabled_body,       ///< the call needs a body that is enabled
  enabled_body,        ///< the call needs a body that is disabled
  static_body,         ///< the call needs a body that can move
  outside_domain,      ///< a body does not lie inside the box of its world
  overlapping,         ///< two bodies overlap where the world does not allow it
  probe_in_progress,   ///< the world was called from inside its own probe
  filter_in_progress,  ///< the world was called from inside its own pair filter
  run_in_progress,     ///< the world is in a run(), or has yet to tell the events of an interrupted one
  workers_busy,        ///< the workers are at work in another run()
  no_threads,          ///< the system does not give as many threads
  null_probe,          ///< the probe is a null function pointer or an empty std::function
  null_callback,       ///< so is respond or the sink of a run(), or a function of a task system
  callback_threw,      ///< in a distributed world, which ends then: a function of the caller's threw
  rank_failed,         ///< a distributed world cannot go on after an error
  moved_from,          ///< the world has been moved from: only assigning to it and destroying it are left
  unsupported,         ///< this detector cannot do what the scene asks for
  bad_snapshot,        ///< bytes that no world can be restored from
  bad_bytes,           ///< bytes that no body of a motion can be read from
  recording,           ///< the world is being recorded already
  not_recording,       ///< the world is not being recorded
  bad_recording,       ///< bytes that are no recording
  diverged,            ///< a replay went another way than its recording
};

/// "not_finite" and so on.
std::string_view name_of(ErrorCode code);

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

/// Either a value or an Error. value(), `*` and `->` throw BadResult when there is only an error; error()
/// throws std::logic_error when there is none. Where exceptions are switched off they print the message and
/// abort instead.
///
/// Of a temporary Result, value() and `*` give the value itself, not a reference, so that
///   for (const Found& found : *world.overlapping(centre, radius)) ...
/// is safe. `->` on a temporary is good within its own expression, as with std::expected:
///   if (world.body(id)->enabled) ...
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return content_.index() == 0; }
  const Error& error() const& {
    require_error();
    return std::get<1>(content_);
  }
  Error error() && {
    require_error();
    return std::get<1>(std::move(content_));
  }

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

/// Success, or an Error; success costs next to nothing.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::make_shared<const Error>(std::move(error))) {}

  explicit operator bool() const { return !error_; }
  const Error& error() const& {
    require_error();
    return *error_;
  }
  Error error() && {
    require_error();
    return *error_;
  }
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
