// Fields of records in tables of numbers, one after the other: package/src/records.ts has their places.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "exchange.hpp"
#include "interface/fields.hpp"
#include "kinesphere/monitor/report.hpp"

namespace kinesphere::browser {

/// How many numbers a field takes.
template <class Field>
constexpr std::size_t width() {
  if (std::same_as<Field, State>) return 6;
  return std::same_as<Field, Vec3> || std::same_as<Field, Axes> || std::same_as<Field, Filter> ||
                 std::same_as<Field, ErrorBound>
             ? 3
             : 1;
}
/// Adds up the widths of the fields that it visits.
struct NumberCounter {
  std::size_t* count;
  template <class Field>
  constexpr void operator()(const char* /*name*/, const Field& /*field*/) const {
    *count += width<Field>();
  }
};

/// Sizes of records in numbers.
inline constexpr std::size_t event_numbers = [] {
  std::size_t count = 0;
  const Event event;
  fields::each_event_field(NumberCounter{&count}, event);
  return count;
}();
inline constexpr std::size_t body_numbers = [] {
  std::size_t count = 0;
  const BodyDefinition body;
  fields::each_body_definition_field(NumberCounter{&count}, body);
  return count;
}();
inline constexpr std::size_t report_field_numbers = [] {
  std::size_t count = 0;
  const TrackReport report;
  fields::each_track_report_field(NumberCounter{&count}, report);
  return count;
}();

/// A mask of bits, exact up to 2^53; a negative number is that of all.
inline std::uint64_t mask_of(double number) {
  return number < 0.0 ? Filter{}.mask : static_cast<std::uint64_t>(number);
}

/// Appends fields to a table. The numbers of ids and of user data are exact up to 2^53.
class NumberWriter {
 public:
  explicit NumberWriter(double* next) : next_(next) {}
  double* next() const { return next_; }

  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void put(Number number) { *next_++ = static_cast<double>(number); }
  void put(const std::optional<ContactEvents>& contacts) { put(contacts ? static_cast<int>(*contacts) : 0); }
  void put(BodyId body) { put(number_of(body)); }
  void put(const Vec3& vector) {
    for (const double part : {vector.x, vector.y, vector.z}) put(part);
  }
  void put(const State& state) {
    put(state.position);
    put(state.velocity);
  }
  void put(const Axes& axes) {
    for (int axis = 0; axis < 3; ++axis) put(axes[axis]);
  }
  /// Bits: static 1, zone 2, sleeping 4.
  void put(const BodyTraits& traits) {
    put((traits.is_static ? 1 : 0) + (traits.is_zone ? 2 : 0) + (traits.is_sleeping ? 4 : 0));
  }
  /// Category, mask and group; -1 is the mask of all.
  void put(const Filter& filter) {
    put(filter.category);
    put(filter.mask == Filter{}.mask ? -1.0 : static_cast<double>(filter.mask));
    put(filter.group);
  }
  /// 0 or, for a cylinder, 1; the horizontal and the vertical limit.
  void put(const ErrorBound& bound) {
    put(bound != ErrorBound(bound.horizontal()));
    put(bound.horizontal());
    put(bound.vertical());
  }

  /// Visits fields, as interface/fields.hpp goes through them.
  template <class T>
  void operator()(const char* /*name*/, const T& field) {
    put(field);
  }

 private:
  double* next_;
};

/// Reads what NumberWriter has written.
class NumberReader {
 public:
  explicit NumberReader(const double* next) : next_(next) {}

  double number() { return *next_++; }
  bool flag() { return number() != 0.0; }
  template <class T>
  T take() {
    T taken;
    read(taken);
    return taken;
  }

  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void read(Number& field) { field = static_cast<Number>(number()); }
  void read(bool& field) { field = flag(); }
  void read(BodyId& body) { body = body_of(number()); }
  void read(Vec3& vector) {
    for (double* const part : {&vector.x, &vector.y, &vector.z}) *part = number();
  }
  void read(State& state) {
    read(state.position);
    read(state.velocity);
  }
  void read(Axes& axes) {
    for (bool* const axis : {&axes.x, &axes.y, &axes.z}) *axis = flag();
  }
  void read(BodyTraits& traits) {
    const int bits = take<int>();
    traits = {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
  }
  void read(Filter& filter) {
    read(filter.category);
    filter.mask = mask_of(number());
    read(filter.group);
  }
  /// 0 if the body does not say it itself.
  void read(std::optional<ContactEvents>& contacts) {
    const int events = take<int>();
    contacts.reset();
    if (events != 0) contacts = static_cast<ContactEvents>(events);
  }
  void read(ErrorBound& bound) {
    const bool is_cylinder = flag();
    const double horizontal = number(), vertical = number();
    bound = is_cylinder ? ErrorBound::cylinder(horizontal, vertical) : ErrorBound(horizontal);
  }

  /// Visits fields, as interface/fields.hpp goes through them.
  template <class T>
  void operator()(const char* /*name*/, T& field) {
    read(field);
  }

 private:
  const double* next_;
};

}  // namespace kinesphere::browser
