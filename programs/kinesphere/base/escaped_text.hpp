// Text as JSON and XML write it.
#pragma once

#include <string>
#include <string_view>

namespace kinesphere::program {

/// Returns the text as a quoted JSON string. Invalid UTF-8 becomes the replacement character U+FFFD.
std::string json_text(const std::string& text);
/// Returns the text for content and attributes: & < > " as entities, control characters as blanks (XML does
/// not allow them). Invalid UTF-8 becomes the replacement character U+FFFD.
std::string xml_text(std::string_view text);

}  // namespace kinesphere::program
