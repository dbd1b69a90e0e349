// Text as JSON writes it.
#pragma once

#include <string>

namespace kinesphere::program {

/// In quotes. What is no UTF-8 becomes the replacement character U+FFFD.
std::string json_text(const std::string& text);

}  // namespace kinesphere::program
