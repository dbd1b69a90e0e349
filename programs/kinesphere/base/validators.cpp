// Checks of numbers on the command line, stricter and clearer than the parser's own.
#include "base/validators.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string>

#include "base/number_text.hpp"

namespace kinesphere::program {
namespace {

bool is_whole_number(const std::string& text, std::uint64_t largest, std::uint64_t least) {
  if (text.size() > 1 && text.front() == '0') return false;
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && least <= number && number <= largest;
}

}  // namespace

CLI::Validator finite_number() {
  const auto problem = [](const std::string& text) {
    return parse_number(text) ? std::string() : fmt::format("expected a finite number, but got '{}'", text);
  };
  return CLI::Validator(problem, "", "finite number");
}

CLI::Validator whole_number(std::uint64_t largest, std::uint64_t least) {
  const auto problem = [largest, least](const std::string& text) {
    return is_whole_number(text, largest, least)
               ? std::string()
               : fmt::format("expected a whole number from {} to {}, but got '{}'", least, largest, text);
  };
  return CLI::Validator(problem, "", "whole number");
}

}  // namespace kinesphere::program
