// Reads JSON with simdjson: values of an expected type.
#pragma once

#include <simdjson.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/fields/wrong_input.hpp"

namespace kinesphere::program {

namespace ondemand = simdjson::ondemand;

/// Replaces NaN, Infinity and -Infinity outside strings, which Python and JavaScript write although JSON has
/// none of them, by null.
inline void replace_no_numbers(std::string& text) {
  if (text.find("NaN") == text.npos && text.find("Infinity") == text.npos) return;
  std::string replaced;
  bool is_string = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = std::string_view(text).substr(at);
    std::size_t taken = 0;
    for (const std::string_view word : {"NaN", "-Infinity", "Infinity"})
      if (!is_string && taken == 0 && rest.starts_with(word)) taken = word.size();
    if (taken > 0) {
      replaced += "null";
      at += taken;
      continue;
    }
    // What a backslash stands before belongs to the string.
    const std::size_t size = is_string && rest[0] == '\\' ? std::min<std::size_t>(2, rest.size()) : 1;
    if (rest[0] == '"') is_string = !is_string;
    replaced += rest.substr(0, size);
    at += size;
  }
  text = std::move(replaced);
}

/// Returns the text of a number or word as it is written. Precondition: no string, list or object.
inline std::string_view token_of(ondemand::value& value) {
  const std::string_view token = value.raw_json_token();
  return token.substr(0, token.find_last_not_of(" \t\r\n") + 1);
}

/// Keeps the text of a document, with the padding that simdjson requires.
class JsonDocumentReader {
 public:
  /// Returns the document, valid until the next call. Throws MalformedRecord.
  ondemand::document open(std::string_view text) {
    text_.assign(text);
    replace_no_numbers(text_);
    text_.reserve(text_.size() + simdjson::SIMDJSON_PADDING);
    ondemand::document document;
    if (const auto error = parser_.iterate(text_.data(), text_.size(), text_.capacity()).get(document))
      throw MalformedRecord(std::string("expected JSON: ") + simdjson::error_message(error));
    return document;
  }

 private:
  ondemand::parser parser_;
  std::string text_;
};

/// Throws MalformedRecord with `expected` unless the document has been read to its end.
inline void require_end(ondemand::document& document, std::string_view expected) {
  const char* more = nullptr;
  if (!document.current_location().get(more))
    throw MalformedRecord("expected " + std::string(expected) + ", but there is more");
}

/// Returns a number; nothing for null. Sets `wrong` to `name` for any other value.
inline std::optional<double> number_in(ondemand::value value, const char* name, const char*& wrong) {
  const ondemand::json_type type = value.type();
  if (type == ondemand::json_type::number) return double(value.get_double());
  if (type != ondemand::json_type::null) wrong = name;
  return std::nullopt;
}

/// Returns a text, valid as long as the document; nothing for null. Sets `wrong` to `name` for any other
/// value.
inline std::optional<std::string_view> text_in(ondemand::value value, const char* name, const char*& wrong) {
  const ondemand::json_type type = value.type();
  if (type == ondemand::json_type::string) return std::string_view(value.get_string());
  if (type != ondemand::json_type::null) wrong = name;
  return std::nullopt;
}

/// Returns a text, valid as long as the document; nothing for any other value.
inline std::optional<std::string_view> text_if_any(ondemand::value value) {
  const char* ignored = nullptr;
  return text_in(value, "", ignored);
}

}  // namespace kinesphere::program
