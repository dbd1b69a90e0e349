// The interface between the module and its JavaScript: numbers pass through tables of doubles in the module's
// memory, objects are addresses, and errors are kept until they are fetched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/kinesphere.hpp"

/// Exports a function to JavaScript under this name. In the small module a list says which are exported
/// (small_exports.txt), and what the others need is left out.
#ifdef KINESPHERE_EXPORTS_BY_LIST
#define KINESPHERE_EXPORT(name) extern "C"
#else
#define KINESPHERE_EXPORT(name) extern "C" __attribute__((export_name(#name), used))
#endif
/// Imports a JavaScript function under this name.
#define KINESPHERE_IMPORT(name) extern "C" __attribute__((import_module("kinesphere"), import_name(#name)))

namespace kinesphere::browser {

/// A body's id is a whole number that JavaScript represents exactly: its index and, above 32 bits, its
/// generation.
constexpr double no_id = -1.0;
double number_of(BodyId body);
/// Returns the id of a number; for an invalid number, an id that no world has.
BodyId body_of(double number);

/// Stores the error for error_message() and the like; returns false.
bool fail(const Error& error);
template <class T>
bool is_good(const Result<T>& result) {
  return result ? true : fail(result.error());
}

/// The result of the last call, of any length.
std::vector<double>& answer();
std::vector<std::byte>& answer_bytes();
void answer_ids(std::span<const BodyId> ids);
/// Returns 0 if there is no event; 1 if it is in answer(); -1 for an error.
int answer_event(const Result<std::optional<Event>>& event);

/// How events are answered in world_run() and in games.
enum class Responding : int { nothing, bounces, asks_javascript, as_in_scene, by_potential, rough };
/// Calls the package's function. If it throws, the response is one that the world refuses; the package
/// rethrows the exception.
Response ask_javascript(const Event& event);
/// Returns the bounce at a begin. Given masses are by index; bodies beyond them, or all if there are none,
/// have their own.
Response bounce_off(const Event& event, std::span<const double> masses, double restitution,
                    double resting_speed);
/// Returns the bounce of rough balls at a begin. `numbers`: tangential restitution, friction, inertia.
Response bounce_roughly(const Event& event, double restitution, const double* numbers);

inline Vec3 vector_at(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }
inline State state_at(const double* numbers) { return {vector_at(numbers), vector_at(numbers + 3)}; }
void put(const Vec3& vector, double* numbers);
void put(const State& state, double* numbers);

/// The numbers of an event (numbers.hpp); EventFields in package/src/records.ts reads them.
void put(const Event& event, double* numbers);
Event event_at(const double* numbers);

}  // namespace kinesphere::browser
