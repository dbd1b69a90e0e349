// The bits of a message of AIS, and what they say, by the tables of ITU-R M.1371-5, annex 8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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
  bool flag(std::size_t at) const { return at < size() && bits_[at]; }
  static void serialize(auto& self, auto& archive) { archive(self.bits_); }

 private:
  std::vector<bool> bits_;
};

enum class AisStation { class_a, class_b, search_aircraft, aid_to_navigation };

/// A reported position. Messages 1, 2 and 3 (table 48), 9 (table 57), 18 (table 67), 19 (table 70), 21 (table
/// 73), 27 (table 85). What a station says is "not available", and what the tables do not allow, is empty.
struct AisPosition {
  AisStation station = AisStation::class_a;
  std::optional<double> longitude, latitude;  ///< degrees east and north, WGS 84
  std::optional<double> speed;                ///< over ground, knots; "or higher" is empty
  std::optional<double> course;               ///< over ground, degrees clockwise from north, below 360
  std::optional<int> status;                  ///< navigational status, 0 to 14: 1 at anchor, 5 moored, ...
  bool is_accurate = false;                   ///< the position accuracy flag: within 10 m, else worse
  std::optional<int> second;                  ///< UTC second of the position, 0 to 59
  /// Whose position it is, where no second is given (values 61 to 63 of it).
  enum class Origin { sensor, manual, dead_reckoning, inoperative } origin = Origin::sensor;
  bool is_coarse = false;  ///< message 27: steps of 1/10 minute, 1 knot and 1 degree
  /// Message 27: the position was less than 5 s old when it was sent.
  bool is_prompt = false;
  bool is_off_position = false;  ///< message 21: the aid is not where it belongs
};

/// Distances of the ends of a ship from the antenna whose position it reports. Unit: metres, rounded to whole
/// ones. Where the place of the antenna is unknown, bow and port are 0 (figure 41).
struct ShipDimensions {
  int bow = 0, stern = 0, port = 0, starboard = 0;

  /// Returns the radius of a disc around the antenna that covers the ship, wherever it heads: the way to the
  /// farthest corner, with a metre more in each direction for what was rounded; 0 if nothing is known.
  double radius() const;
};

struct AisMessage {
  int type = 0;
  std::uint32_t mmsi = 0;
  std::optional<AisPosition> position;
  /// Messages 5, 19, 21, and 24 part A: of the characters of six-bit ASCII (table 47), without the blanks
  /// at its end; empty: not available.
  std::string name;
  std::optional<ShipDimensions> dimensions;  ///< messages 5, 19, 21, and 24 part B
  int ship_type = 0;  ///< type of ship and cargo of messages 5, 19, and 24 part B; 0: not available
};

/// Returns the message; nothing for types other than 1, 2, 3, 5, 9, 18, 19, 21, 24 and 27. Throws
/// MalformedRecord if it is too short for its fields, or its MMSI is 0 or has more than nine digits.
std::optional<AisMessage> ais_message_of(const AisBits& bits);

}  // namespace kinesphere::program
