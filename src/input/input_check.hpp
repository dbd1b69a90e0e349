// Validation of caller input. The first failed check becomes the error.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// `digits`: significant ones, up to 17; so many give the number back.
std::string text_of(double number, int digits = 17);
std::string text_of(std::unsigned_integral auto number) { return std::to_string(number); }
/// Returns the text unchanged.
std::string text_of(std::string_view text);
std::string text_of(const Vec3& vector);
std::string text_of(const Box& box);
std::string text_of(const State& state);
/// Returns "body 7" or "body 7 (generation 2)".
std::string text_of(BodyId body);

/// The value that is checked, e.g. "start of body 3, velocity" or "trajectories of body 3, segment 2".
struct Subject {
  std::string_view argument;
  BodyId body = no_body;
  std::string_view part = {};
  std::optional<std::size_t> part_number = {};
};

/// Chain of input checks. Frequent checks are inlined into the caller and format nothing unless they fail,
/// since nearly all input is valid. Every check returns *this, so that checks can be chained:
///
///   const auto check = InputCheck("SteeredMotion::create").positive({"interval"}, interval);
///   if (check.error()) return *check.error();
class InputCheck {
 public:
  /// `call` is the name that begins the message; it must outlive this object.
  explicit InputCheck(std::string_view call) : call_(call) {}

  [[gnu::always_inline]] InputCheck& finite(const Subject& subject, double value) {
    return require(std::isfinite(value), ErrorCode::not_finite, subject, "must be finite", value);
  }
  [[gnu::always_inline]] InputCheck& finite(const Subject& subject, const Vec3& value) {
    return require(is_finite(value), ErrorCode::not_finite, subject, "must be finite", value);
  }
  InputCheck& positive(const Subject& subject, double value) {
    return finite(subject, value).require(value > 0, ErrorCode::out_of_range, subject, "must be > 0", value);
  }
  [[gnu::always_inline]] InputCheck& not_negative(const Subject& subject, double value) {
    return finite(subject, value)
        .require(value >= 0, ErrorCode::out_of_range, subject, "must be >= 0", value);
  }
  /// Requires a finite number from 0 to `most`.
  [[gnu::always_inline]] InputCheck& from_zero_to(const Subject& subject, double value, double most) {
    return not_negative(subject, value)
        .require(value <= most, ErrorCode::out_of_range, subject, "must be at most", most, value);
  }
  /// Requires a number >= 0, which may be infinite.
  InputCheck& not_negative_or_infinite(const Subject& subject, double value) {
    return require(!std::isnan(value), ErrorCode::not_finite, subject, "must be a number", value)
        .require(value >= 0, ErrorCode::out_of_range, subject, "must be >= 0", value);
  }
  /// Requires a finite number in [-limit, limit].
  [[gnu::always_inline]] InputCheck& within(const Subject& subject, double value, double limit) {
    return finite(subject, value)
        .require(std::abs(value) <= limit, ErrorCode::out_of_range, subject, "must lie within +-", limit,
                 value);
  }
  /// Requires a finite vector with each coordinate in [-limit, limit].
  [[gnu::always_inline]] InputCheck& within(const Subject& subject, const Vec3& value, double limit) {
    const double largest = std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
    return finite(subject, value)
        .require(largest <= limit, ErrorCode::out_of_range, subject, "must be on each axis within +-", limit,
                 value);
  }
  /// Requires a finite box with lower < upper on every axis.
  InputCheck& box(const Subject& subject, const Box& box);
  InputCheck& start(const std::vector<State>& states, double start_time);
  /// Requires one limit per body, each finite and >= 0.
  InputCheck& acceleration_limits(const std::vector<double>& limits, std::size_t bodies);

  /// Requires any other condition. Message: "<call>: <subject> <expectation>, but is <came>".
  template <class Value>
  [[gnu::always_inline]] InputCheck& require(bool condition, ErrorCode code, const Subject& subject,
                                             std::string_view expectation, const Value& came) {
    if (!condition && !error_) fail_with(code, subject, expectation, came);
    return *this;
  }

  /// Requires a condition with an expected value. Message: "..., <expectation> <value>, but is <came>".
  template <class Expected, class Value>
  [[gnu::always_inline]] InputCheck& require(bool condition, ErrorCode code, const Subject& subject,
                                             std::string_view expectation, const Expected& value,
                                             const Value& came) {
    if (!condition && !error_) fail_against(code, subject, expectation, value, came);
    return *this;
  }

  const std::optional<Error>& error() const { return error_; }
  Result<void> result() const { return error_ ? Result<void>(*error_) : Result<void>(); }

 private:
  template <class Value>
  [[gnu::cold, gnu::noinline]] void fail_with(ErrorCode code, const Subject& subject,
                                              std::string_view expectation, const Value& came) {
    fail(code, subject, expectation, text_of(came));
  }
  template <class Expected, class Value>
  [[gnu::cold, gnu::noinline]] void fail_against(ErrorCode code, const Subject& subject,
                                                 std::string_view expectation, const Expected& value,
                                                 const Value& came) {
    fail(code, subject, std::string(expectation) + " " + text_of(value), text_of(came));
  }
  void fail(ErrorCode code, const Subject& subject, std::string_view expectation, const std::string& came);

  std::string_view call_;
  std::optional<Error> error_;
};

}  // namespace kinesphere
