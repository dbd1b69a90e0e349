// Text as JSON writes it.
#pragma once

#include <string>

namespace kinesphere::program {

/// Returns the text as a quoted JSON string. Invalid UTF-8 becomes the replacement character U+FFFD.
std::string json_text(const std::string& text);

}  // namespace kinesphere::program
