// Writes JSON objects of alerts and of the state.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <string>
#include <string_view>

#include "base/escaped_text.hpp"

namespace kinesphere::program {

/// Returns a finite number; null for any other.
inline std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}
/// Returns a length with six digits; null if it is infinite.
inline std::string json_length(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
}

/// The text of an object, which grows field by field.
class JsonObject {
 public:
  /// Adds a field whose value is written as JSON already.
  JsonObject& add(std::string_view name, std::string_view json) {
    text_ += text_.size() > 1 ? ", \"" : "\"";
    ((text_ += name) += "\": ") += json;
    return *this;
  }
  JsonObject& text(std::string_view name, const std::string& value) { return add(name, json_text(value)); }
  JsonObject& number(std::string_view name, double value) { return add(name, json_number(value)); }
  JsonObject& length(std::string_view name, double value) { return add(name, json_length(value)); }
  template <std::integral Value>
  JsonObject& count(std::string_view name, Value value) {
    return add(name, fmt::to_string(value));
  }
  /// Adds two limits of a length.
  JsonObject& limits(std::string_view name, double lower, double upper) {
    return add(name, fmt::format("[{}, {}]", json_length(lower), json_length(upper)));
  }

  /// Returns the object, with all its fields.
  std::string whole() const { return text_ + '}'; }
  /// Returns it as a line.
  std::string line() const { return text_ + "}\n"; }

 private:
  std::string text_ = "{";
};

}  // namespace kinesphere::program
