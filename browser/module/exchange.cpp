#include "exchange.hpp"

#include <cmath>
#include <string>

#include "kinesphere/version.hpp"
#include "numbers.hpp"

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

void put(const Vec3& vector, double* numbers) { NumberWriter(numbers).put(vector); }
void put(const State& state, double* numbers) { NumberWriter(numbers).put(state); }
void put(const Event& event, double* numbers) { fields::each_event_field(NumberWriter(numbers), event); }

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
  fields::each_event_field(NumberReader(numbers), event);
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
