// The bits of a message of AIS, from the characters of its sentences.
#include "formats/nmea/ais_bits.hpp"

#include <algorithm>

namespace kinesphere::program {
namespace {

constexpr std::size_t bits_of_character = 6;

constexpr bool is_six_bit(char c) { return ('0' <= c && c <= 'W') || ('`' <= c && c <= 'w'); }

/// Precondition: is_six_bit(c).
constexpr unsigned six_bits(char c) {
  const auto value = static_cast<unsigned>(c - '0');
  return value < 40 ? value : value - 8;
}

}  // namespace

bool is_six_bit_text(std::string_view characters) { return std::ranges::all_of(characters, is_six_bit); }

void AisBits::append(std::string_view characters, std::size_t fill_bits) {
  const std::size_t count = bits_of_character * characters.size();
  for (std::size_t k = 0; k + fill_bits < count; ++k) {
    const unsigned six = six_bits(characters[k / bits_of_character]);
    bits_.push_back((six >> (bits_of_character - 1 - k % bits_of_character) & 1U) != 0);
  }
}

std::string AisBits::digits() const {
  std::string text;
  for (const bool bit : bits_) text += bit ? '1' : '0';
  return text;
}

AisBits AisBits::of_digits(std::string_view digits) {
  AisBits bits;
  for (const char digit : digits) bits.bits_.push_back(digit == '1');
  return bits;
}

std::uint32_t AisBits::number(std::size_t begin, std::size_t count) const {
  std::uint32_t value = 0;
  for (std::size_t k = begin; k < begin + count; ++k) value = value << 1U | (flag(k) ? 1U : 0U);
  return value;
}

std::int32_t AisBits::signed_number(std::size_t begin, std::size_t count) const {
  const auto value = static_cast<std::int32_t>(number(begin, count));
  return flag(begin) ? value - (std::int32_t{1} << count) : value;
}

}  // namespace kinesphere::program
