// The bits of a message of AIS, from the characters of its sentences.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinesphere::program {

/// Returns true if all characters are those of a six-bit field (IEC 61162-1): 0 to W and ` to w.
bool is_six_bit_text(std::string_view characters);

class AisBits {
 public:
  /// Appends six bits for each character, less the last `fill_bits` (0 to 5). Precondition:
  /// is_six_bit_text().
  void append(std::string_view characters, std::size_t fill_bits);

  std::size_t size() const { return bits_.size(); }
  /// Returns the bits begin, ..., begin + count - 1 as a number, the first one highest; bits behind the end
  /// are 0. Range: count <= 32.
  std::uint32_t number(std::size_t begin, std::size_t count) const;
  /// Returns the same as a two's complement. Range: 0 < count <= 31.
  std::int32_t signed_number(std::size_t begin, std::size_t count) const;
  /// Returns the bits as digits 0 and 1, or makes bits of them.
  std::string digits() const;
  static AisBits of_digits(std::string_view digits);
  bool flag(std::size_t at) const { return at < size() && bits_[at]; }

 private:
  std::vector<bool> bits_;
};

}  // namespace kinesphere::program
