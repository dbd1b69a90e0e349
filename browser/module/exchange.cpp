#include "exchange.hpp"

#include <cmath>
#include <string>

#include "kinesphere/version.hpp"

namespace kinesphere::browser {
namespace {

constexpr double two_to_32 = 4294967296.0;

struct LastError {
  std::string code;
  double body = no_id;
  std::string argument;
  std::string message;
};
LastError last_error;

/// A body's traits as bits: static 1, zone 2, sleeping 4.
double bits_of(const BodyTraits& traits) {
  return (traits.is_static ? 1 : 0) + (traits.is_zone ? 2 : 0) + (traits.is_sleeping ? 4 : 0);
}

BodyTraits traits_at(double number) {
  const int bits = static_cast<int>(number);
  return {.is_static = (bits & 1) != 0, .is_zone = (bits & 2) != 0, .is_sleeping = (bits & 4) != 0};
}

}  // namespace

double number_of(BodyId body) { return body == no_body ? no_id : two_to_32 * body.generation + body.index; }

BodyId body_of(double number) {
  const double generation = std::floor(number / two_to_32);
  if (!(number >= 0.0) || number != std::floor(number) || generation >= two_to_32) return no_body;
  return {static_cast<std::uint32_t>(number - generation * two_to_32),
          static_cast<std::uint32_t>(generation)};
}

bool fail(const Error& error) {
  last_error = {std::string(name_of(error.code)), number_of(error.body), std::string(error.argument),
                error.message};
  return false;
}

std::vector<double>& answer() {
  static std::vector<double> numbers;
  return numbers;
}

std::vector<std::byte>& answer_bytes() {
  static std::vector<std::byte> bytes;
  return bytes;
}

void put(const Vec3& vector, double* numbers) {
  numbers[0] = vector.x;
  numbers[1] = vector.y;
  numbers[2] = vector.z;
}

void put(const State& state, double* numbers) {
  put(state.position, numbers);
  put(state.velocity, numbers + 3);
}

void put(const Event& event, double* numbers) {
  numbers[0] = static_cast<double>(event.kind);
  numbers[1] = event.time;
  numbers[2] = number_of(event.first);
  numbers[3] = number_of(event.second);
  numbers[4] = static_cast<double>(event.wall);
  numbers[5] = event.repeated ? 1.0 : 0.0;
  numbers[6] = event.jammed ? 1.0 : 0.0;
  numbers[7] = static_cast<double>(event.senses);
  put(event.first_state, numbers + 8);
  put(event.second_state, numbers + 14);
  put(event.point, numbers + 20);
  put(event.normal, numbers + 23);
  numbers[26] = event.gap;
  numbers[27] = event.approach_speed;
  numbers[28] = event.position_excess;
  numbers[29] = event.velocity_excess;
  numbers[30] = event.distance;
  // Exact up to 2^53.
  numbers[31] = static_cast<double>(event.first_user_data);
  numbers[32] = static_cast<double>(event.second_user_data);
  numbers[33] = event.first_mass;
  numbers[34] = event.second_mass;
  numbers[35] = bits_of(event.first_traits);
  numbers[36] = bits_of(event.second_traits);
  numbers[37] = event.already_touching ? 1.0 : 0.0;
  numbers[38] = event.first_part;
  numbers[39] = event.second_part;
  put(event.first_angular_velocity, numbers + 40);
  put(event.second_angular_velocity, numbers + 43);
  put(event.first_spin_gain, numbers + 46);
  put(event.second_spin_gain, numbers + 49);
  numbers[52] = event.acceleration_limit;
}

void answer_ids(std::span<const BodyId> ids) {
  answer().clear();
  for (const BodyId id : ids) answer().push_back(number_of(id));
}

int answer_event(const Result<std::optional<Event>>& event) {
  if (!is_good(event)) return -1;
  if (!*event) return 0;
  answer().resize(event_numbers);
  put(**event, answer().data());
  return 1;
}

Event event_at(const double* numbers) {
  Event event;
  event.kind = static_cast<EventKind>(numbers[0]);
  event.time = numbers[1];
  event.first = body_of(numbers[2]);
  event.second = body_of(numbers[3]);
  event.wall = static_cast<Wall>(numbers[4]);
  event.repeated = numbers[5] != 0.0;
  event.jammed = numbers[6] != 0.0;
  event.already_touching = numbers[37] != 0.0;
  event.senses = static_cast<decltype(event.senses)>(numbers[7]);
  event.first_state = state_at(numbers + 8);
  event.second_state = state_at(numbers + 14);
  event.point = vector_at(numbers + 20);
  event.normal = vector_at(numbers + 23);
  event.gap = numbers[26];
  event.approach_speed = numbers[27];
  event.position_excess = numbers[28];
  event.velocity_excess = numbers[29];
  event.distance = numbers[30];
  event.first_user_data = static_cast<std::uint64_t>(numbers[31]);
  event.second_user_data = static_cast<std::uint64_t>(numbers[32]);
  event.first_mass = numbers[33];
  event.second_mass = numbers[34];
  event.first_traits = traits_at(numbers[35]);
  event.second_traits = traits_at(numbers[36]);
  event.first_part = static_cast<std::uint32_t>(numbers[38]);
  event.second_part = static_cast<std::uint32_t>(numbers[39]);
  event.first_angular_velocity = vector_at(numbers + 40);
  event.second_angular_velocity = vector_at(numbers + 43);
  event.first_spin_gain = vector_at(numbers + 46);
  event.second_spin_gain = vector_at(numbers + 49);
  event.acceleration_limit = numbers[52];
  return event;
}

KINESPHERE_EXPORT(error_code) const char* error_code() { return last_error.code.c_str(); }
KINESPHERE_EXPORT(error_body) double error_body() { return last_error.body; }
KINESPHERE_EXPORT(error_argument) const char* error_argument() { return last_error.argument.c_str(); }
KINESPHERE_EXPORT(error_message) const char* error_message() { return last_error.message.c_str(); }

KINESPHERE_EXPORT(answer_numbers) const double* answer_numbers() { return answer().data(); }
KINESPHERE_EXPORT(answer_count) std::size_t answer_count() { return answer().size(); }
KINESPHERE_EXPORT(bytes) const std::byte* bytes() { return answer_bytes().data(); }
KINESPHERE_EXPORT(byte_count) std::size_t byte_count() { return answer_bytes().size(); }

KINESPHERE_EXPORT(hash_add) void hash_add(double* parts, const double* events, std::size_t count) {
  EventHash hash;
  for (std::size_t k = 0; k < count; ++k) hash.add(event_at(events + k * event_numbers));
  // Each part as two halves of 32 bits.
  const EventHash before =
      EventHash::of({static_cast<std::uint64_t>(parts[1]) << 32 | static_cast<std::uint64_t>(parts[0]),
                     static_cast<std::uint64_t>(parts[3]) << 32 | static_cast<std::uint64_t>(parts[2])});
  hash += before;
  const auto sum = hash.parts();
  for (std::size_t k = 0; k < 2; ++k) {
    parts[2 * k] = static_cast<double>(sum[k] & 0xffffffffu);
    parts[2 * k + 1] = static_cast<double>(sum[k] >> 32);
  }
  parts[4] = static_cast<double>(hash.value() & 0xffffffffu);
  parts[5] = static_cast<double>(hash.value() >> 32);
}

KINESPHERE_EXPORT(library_version) const char* library_version() { return kinesphere::version.data(); }

}  // namespace kinesphere::browser
