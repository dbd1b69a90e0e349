// How the module and the JavaScript beside it talk to each other: numbers go through tables of doubles in the
// module's memory, objects are addresses, and what goes wrong is kept until it is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/kinesphere.hpp"

/// A function that JavaScript calls by this name.
#define KINESPHERE_EXPORT(name) extern "C" __attribute__((export_name(#name), used))
/// A function of JavaScript's that the module calls by this name.
#define KINESPHERE_IMPORT(name) extern "C" __attribute__((import_module("kinesphere"), import_name(#name)))

namespace kinesphere::browser {

/// A body's id is a whole number that JavaScript holds exactly: its index and, above 32 bits, its generation.
constexpr double no_id = -1.0;
double number_of(BodyId body);
/// An id that no world has given out, for a number that is none.
BodyId body_of(double number);

/// Keeps the error for error_message() and the like; false.
bool fail(const Error& error);
template <class T>
bool is_good(const Result<T>& result) {
  return result ? true : fail(result.error());
}

/// What the last call gave back, of any length.
std::vector<double>& answer();
std::vector<std::byte>& answer_bytes();
void answer_ids(std::span<const BodyId> ids);
/// 0: there is none; 1: it is in answer(); -1: an error.
int answer_event(const Result<std::optional<Event>>& event);

inline Vec3 vector_at(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }
inline State state_at(const double* numbers) { return {vector_at(numbers), vector_at(numbers + 3)}; }
void put(const Vec3& vector, double* numbers);
void put(const State& state, double* numbers);

/// How many numbers an event takes; the class Event in package/src/event.ts reads them.
constexpr std::size_t event_numbers = 33;
void put(const Event& event, double* numbers);
Event event_at(const double* numbers);

}  // namespace kinesphere::browser
