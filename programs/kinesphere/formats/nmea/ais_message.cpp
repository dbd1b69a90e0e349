// What a message of AIS says, by the tables of ITU-R M.1371-5, annex 8.
#include "formats/nmea/ais_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/fields/wrong_input.hpp"

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

std::uint32_t AisBits::number(std::size_t begin, std::size_t count) const {
  std::uint32_t value = 0;
  for (std::size_t k = begin; k < begin + count; ++k) value = value << 1U | (flag(k) ? 1U : 0U);
  return value;
}

std::int32_t AisBits::signed_number(std::size_t begin, std::size_t count) const {
  const auto value = static_cast<std::int32_t>(number(begin, count));
  return flag(begin) ? value - (std::int32_t{1} << count) : value;
}

namespace {

/// First bits of the fields of a position; longitude (28 bits) and latitude (27) follow each other.
struct PositionPlaces {
  AisStation station;
  std::size_t accuracy, longitude, second;
  std::size_t speed = 0, course = 0;  ///< 0: the message has none
  double speed_step = 0.1;            ///< knots
};
constexpr PositionPlaces class_a{AisStation::class_a, 60, 61, 137, 50, 116};
constexpr PositionPlaces search_aircraft{AisStation::search_aircraft, 60, 61, 128, 50, 116, 1.0};
constexpr PositionPlaces class_b{AisStation::class_b, 56, 57, 133, 46, 112};
constexpr PositionPlaces aid_to_navigation{AisStation::aid_to_navigation, 163, 164, 253};

/// What a type of messages has, and where; 0 or null: it has none.
struct MessageForm {
  int type;
  std::size_t least_bits;
  const PositionPlaces* position;
  std::size_t name = 0, dimensions = 0, ship_type = 0;
};
constexpr MessageForm message_forms[] = {{1, 149, &class_a},
                                         {2, 149, &class_a},
                                         {3, 149, &class_a},
                                         {5, 270, nullptr, 112, 240, 232},
                                         {9, 148, &search_aircraft},
                                         {18, 148, &class_b},
                                         {19, 306, &class_b, 143, 271, 263},
                                         {21, 270, &aid_to_navigation, 43, 219}};

/// Units of coordinates to a degree: 1/10,000 minute, and 1/10 minute in message 27.
constexpr double fine_units = 600'000.0, coarse_units = 600.0;

/// Returns the angle in degrees if it is at most `most`; AIS has 181 and 91 for "not available".
std::optional<double> angle(std::int32_t value, double units, double most) {
  const double degrees = value / units;
  if (std::abs(degrees) > most) return std::nullopt;
  return degrees;
}

void require_bits(const AisBits& bits, std::size_t least, int type) {
  if (bits.size() < least)
    throw MalformedRecord(
        fmt::format("expected {} bits or more of message {}, but got {}", least, type, bits.size()));
}

std::optional<int> status_of(std::uint32_t value) {
  if (value == 15) return std::nullopt;
  return static_cast<int>(value);
}

AisPosition position_at(const AisBits& bits, const PositionPlaces& at) {
  AisPosition position{.station = at.station};
  position.is_accurate = bits.flag(at.accuracy);
  position.longitude = angle(bits.signed_number(at.longitude, 28), fine_units, 180.0);
  position.latitude = angle(bits.signed_number(at.longitude + 28, 27), fine_units, 90.0);
  const auto second = static_cast<int>(bits.number(at.second, 6));
  if (second < 60) position.second = second;
  if (second == 61) position.origin = AisPosition::Origin::manual;
  if (second == 62) position.origin = AisPosition::Origin::dead_reckoning;
  if (second == 63) position.origin = AisPosition::Origin::inoperative;
  if (at.station == AisStation::class_a) position.status = status_of(bits.number(38, 4));
  if (at.station == AisStation::aid_to_navigation) position.is_off_position = bits.flag(259);
  if (at.speed == 0) return position;
  // 1023 is "not available", 1022 "or higher"; the course has steps of 0.1 degrees, 3600 is "not available".
  const std::uint32_t speed = bits.number(at.speed, 10), course = bits.number(at.course, 12);
  if (speed < 1022) position.speed = speed * at.speed_step;
  if (course < 3600) position.course = course / 10.0;
  return position;
}

AisPosition long_range_position(const AisBits& bits) {
  AisPosition position{.station = AisStation::class_a, .is_coarse = true};
  position.is_accurate = bits.flag(38);
  position.status = status_of(bits.number(40, 4));
  position.longitude = angle(bits.signed_number(44, 18), coarse_units, 180.0);
  position.latitude = angle(bits.signed_number(62, 17), coarse_units, 90.0);
  const std::uint32_t speed = bits.number(79, 6), course = bits.number(85, 9);
  if (speed < 63) position.speed = speed;
  if (course < 360) position.course = course;
  position.is_prompt = !bits.flag(94);
  return position;
}

/// Reads the four distances (9, 9, 6 and 6 bits).
ShipDimensions dimensions_at(const AisBits& bits, std::size_t at) {
  const auto distance = [&](std::size_t begin, std::size_t count) {
    return static_cast<int>(bits.number(begin, count));
  };
  return {distance(at, 9), distance(at + 9, 9), distance(at + 18, 6), distance(at + 24, 6)};
}

/// Reads a name of 20 characters; @ ends it.
std::string name_at(const AisBits& bits, std::size_t at) {
  std::string name;
  for (std::size_t k = 0; k < 20 && at + 6 * (k + 1) <= bits.size(); ++k) {
    const std::uint32_t six = bits.number(at + 6 * k, 6);
    if (six == 0) break;
    name += static_cast<char>(six < 32 ? six + 64 : six);
  }
  name.erase(name.find_last_not_of(' ') + 1);
  return name;
}

/// Returns true for the MMSI of a craft of a mother ship, 98XXXXXXX: its message 24 has that ship's MMSI in
/// place of dimensions.
bool is_craft_of_a_ship(std::uint32_t mmsi) { return mmsi / 10'000'000 == 98; }

}  // namespace

double ShipDimensions::radius() const {
  if (bow == 0 && stern == 0 && port == 0 && starboard == 0) return 0.0;
  constexpr double rounded = 1.0;
  return std::hypot(std::max(bow, stern) + rounded, std::max(port, starboard) + rounded);
}

namespace {

constexpr std::size_t head_bits = 38;

/// Message 24: a name, or what kind of craft it is and how large.
void read_static_data(const AisBits& bits, AisMessage& message) {
  constexpr std::size_t bits_of_part = 2;
  require_bits(bits, head_bits + bits_of_part, message.type);
  const auto part = bits.number(head_bits, bits_of_part);
  if (part == 0) message.name = name_at(bits, 40);
  if (part != 1 || is_craft_of_a_ship(message.mmsi)) return;
  require_bits(bits, 162, message.type);
  message.dimensions = dimensions_at(bits, 132);
  message.ship_type = static_cast<int>(bits.number(40, 8));
}

/// Reads what a type of messages has behind its head; returns false for a type that is not read.
bool read_body(const AisBits& bits, AisMessage& message) {
  if (message.type == 24) {
    read_static_data(bits, message);
    return true;
  }
  if (message.type == 27) {
    require_bits(bits, 95, message.type);
    message.position = long_range_position(bits);
    return true;
  }
  const auto* const form = std::ranges::find(message_forms, message.type, &MessageForm::type);
  if (form == std::end(message_forms)) return false;
  require_bits(bits, form->least_bits, message.type);
  if (form->position != nullptr) message.position = position_at(bits, *form->position);
  if (form->name > 0) message.name = name_at(bits, form->name);
  if (form->dimensions > 0) message.dimensions = dimensions_at(bits, form->dimensions);
  if (form->ship_type > 0) message.ship_type = static_cast<int>(bits.number(form->ship_type, 8));
  return true;
}

}  // namespace

std::optional<AisMessage> ais_message_of(const AisBits& bits) {
  if (bits.size() < head_bits)
    throw MalformedRecord(
        fmt::format("expected {} bits or more of a message, but got {}", head_bits, bits.size()));
  AisMessage message{.type = static_cast<int>(bits.number(0, 6)), .mmsi = bits.number(8, 30)};
  if (!read_body(bits, message)) return std::nullopt;
  if (message.mmsi == 0 || message.mmsi > 999'999'999)
    throw MalformedRecord(fmt::format("expected an MMSI of at most nine digits in message {}, but got {}",
                                      message.type, message.mmsi));
  return message;
}

}  // namespace kinesphere::program
