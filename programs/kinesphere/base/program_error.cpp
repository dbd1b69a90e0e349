#include "base/program_error.hpp"

#include <string_view>

namespace kinesphere::program {

std::string message_of(const Error& error) {
  constexpr std::string_view of_names = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_:";
  const std::string_view message = error.message;
  // "World::create: box must ..."
  const std::size_t end = message.find(": ");
  if (end == std::string_view::npos || message.find_first_not_of(of_names) < end) return error.message;
  return std::string(message.substr(end + 2));
}

}  // namespace kinesphere::program
