// Writes messages of AIS, field by field as ITU-R M.1371-5 lists them. It shares nothing with the decoder:
// bits are characters.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

namespace kinesphere::program {

/// What a station reports, in the units of messages 1 and 18; the defaults are "not available".
struct EncodedStation {
  std::uint32_t mmsi = 211'000'001;
  std::int64_t longitude = 181 * 600'000, latitude = 91 * 600'000;  ///< 1/10,000 minute
  int speed = 1023, course = 3600;                                  ///< 0.1 knots, 0.1 degrees
  int second = 60;
  int accuracy = 0;
  int status = 15;
  int bow = 0, stern = 0, port = 0, starboard = 0;  ///< metres
  int ship_type = 0;
  int off_position = 0;  ///< of an aid to navigation
};

/// A message as a text of 0 and 1.
class AisWriter {
 public:
  AisWriter& add(int bits, std::int64_t value) {
    for (int k = bits - 1; k >= 0; --k) text_ += (value >> std::min(k, 63) & 1) != 0 ? '1' : '0';
    return *this;
  }
  AisWriter& spare(int bits) { return add(bits, 0); }
  /// What all messages begin with.
  AisWriter& begin(int type, const EncodedStation& s) { return add(6, type).spare(2).add(30, s.mmsi); }
  AisWriter& movement(const EncodedStation& s) {
    add(10, s.speed).add(1, s.accuracy).add(28, s.longitude);
    return add(27, s.latitude).add(12, s.course);
  }
  AisWriter& dimensions(const EncodedStation& s) {
    return add(9, s.bow).add(9, s.stern).add(6, s.port).add(6, s.starboard);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

inline std::int64_t encoded_degrees(double degrees) { return std::llround(degrees * 600'000.0); }

/// Message 1, 2 or 3.
inline std::string class_a_message(const EncodedStation& s, int type = 1) {
  return AisWriter()
      .begin(type, s)
      .add(4, s.status)
      .add(8, -128)
      .movement(s)
      .add(9, 511)
      .add(6, s.second)
      .spare(2 + 3 + 1 + 19)
      .text();
}

inline std::string static_message(const EncodedStation& s) {
  AisWriter writer;
  writer.begin(5, s).spare(2 + 30 + 42 + 120).add(8, s.ship_type);
  return writer.dimensions(s).spare(4 + 20 + 8 + 120 + 2).text();
}

inline std::string search_aircraft_message(const EncodedStation& s) {
  return AisWriter()
      .begin(9, s)
      .add(12, 303)
      .movement(s)
      .add(6, s.second)
      .spare(8 + 1 + 3 + 1 + 1 + 20)
      .text();
}

inline std::string class_b_message(const EncodedStation& s) {
  return AisWriter().begin(18, s).spare(8).movement(s).add(9, 511).add(6, s.second).spare(2 + 7 + 20).text();
}

/// Message 19.
inline std::string extended_class_b_message(const EncodedStation& s) {
  return AisWriter()
      .begin(19, s)
      .spare(8)
      .movement(s)
      .add(9, 511)
      .add(6, s.second)
      .spare(4 + 120)
      .add(8, s.ship_type)
      .dimensions(s)
      .spare(4 + 1 + 1 + 1 + 4)
      .text();
}

inline std::string aid_to_navigation_message(const EncodedStation& s) {
  return AisWriter()
      .begin(21, s)
      .spare(5 + 120)
      .add(1, s.accuracy)
      .add(28, s.longitude)
      .add(27, s.latitude)
      .dimensions(s)
      .spare(4)
      .add(6, s.second)
      .add(1, s.off_position)
      .spare(8 + 1 + 1 + 1 + 1)
      .text();
}

/// Part B of message 24.
inline std::string class_b_static_message(const EncodedStation& s) {
  return AisWriter().begin(24, s).add(2, 1).add(8, s.ship_type).spare(42 + 42).dimensions(s).spare(6).text();
}

/// Message 27: longitude and latitude in 1/10 minute, speed in knots, course in degrees. `late`: the position
/// was 5 s old or more.
inline std::string long_range_message(const EncodedStation& s, int late) {
  return AisWriter()
      .begin(27, s)
      .add(1, s.accuracy)
      .spare(1)
      .add(4, s.status)
      .add(18, s.longitude)
      .add(17, s.latitude)
      .add(6, s.speed)
      .add(9, s.course)
      .add(1, late)
      .spare(1)
      .text();
}

inline unsigned char checksum_of(std::string_view text) {
  unsigned char sum = 0;
  for (const char c : text) sum = static_cast<unsigned char>(sum ^ static_cast<unsigned char>(c));
  return sum;
}

/// Returns !BODY*hh.
inline std::string sentence(std::string_view body) {
  return fmt::format("!{}*{:02X}", body, checksum_of(body));
}
/// Returns \BODY*hh\.
inline std::string tag_block(std::string_view body) {
  return fmt::format("\\{}*{:02X}\\", body, checksum_of(body));
}

struct EncodedPayload {
  std::string characters;
  int fill_bits = 0;
};

inline EncodedPayload payload_of(std::string bits) {
  EncodedPayload payload;
  for (; bits.size() % 6 != 0; ++payload.fill_bits) bits += '0';
  for (std::size_t k = 0; k < bits.size(); k += 6) {
    const int value = std::stoi(bits.substr(k, 6), nullptr, 2);
    payload.characters += static_cast<char>(value < 40 ? value + 48 : value + 56);
  }
  return payload;
}

/// Returns the message in one sentence, with a tag block that has the time if there is one.
inline std::string vdm(const std::string& bits, std::string_view time = "",
                       std::string_view talker = "AIVDM") {
  const auto [characters, fill] = payload_of(bits);
  return (time.empty() ? "" : tag_block(fmt::format("c:{}", time))) +
         sentence(fmt::format("{},1,1,,A,{},{}", talker, characters, fill));
}

/// Returns sentence `number`, from 1, of the message in `count` sentences, without tag block.
inline std::string vdm_part(const std::string& bits, int number, int count, int sequence,
                            char channel = 'A') {
  const auto [characters, fill] = payload_of(bits);
  const std::size_t each =
      (characters.size() + static_cast<std::size_t>(count) - 1) / static_cast<std::size_t>(count);
  const std::string part = characters.substr(each * static_cast<std::size_t>(number - 1), each);
  return sentence(fmt::format("AIVDM,{},{},{},{},{},{}", count, number, sequence, channel, part,
                              number == count ? fill : 0));
}

}  // namespace kinesphere::program
