// Text as JSON writes it.
#include "base/json_text.hpp"

#include <nlohmann/json.hpp>

namespace kinesphere::program {

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace kinesphere::program
