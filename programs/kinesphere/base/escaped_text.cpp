// Text as JSON and XML write it.
#include "base/escaped_text.hpp"

#include <nlohmann/json.hpp>

namespace kinesphere::program {

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string xml_text(std::string_view text) {
  // JSON's writer replaces invalid UTF-8.
  const auto valid = nlohmann::json::parse(json_text(std::string(text))).get<std::string>();
  std::string safe;
  for (const char c : valid) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return safe;
}

}  // namespace kinesphere::program
