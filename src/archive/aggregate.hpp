// The fields of aggregates, found without a list of their names.
#pragma once

#include <cstddef>
#include <type_traits>

namespace kinesphere::detail {

/// Converts to anything, so that the compiler tells how many initializers an aggregate takes.
struct AnyValue {
  template <class T>
  operator T() const;
};

/// Number of fields of an aggregate without bases and arrays of the language.
template <class T, class... Values>
constexpr std::size_t field_count() {
  if constexpr (requires { T{Values{}..., AnyValue{}}; })
    return field_count<T, Values..., AnyValue>();
  else
    return sizeof...(Values);
}

/// Calls visit(field, ...) with all fields of an aggregate in their order.
template <class T, class Visit>
void visit_fields(T& value, Visit& visit) {
  using Class = std::remove_const_t<T>;
  static_assert(std::is_aggregate_v<Class>, "a class with private fields needs serialize()");
  constexpr std::size_t count = field_count<Class>();
  static_assert(0 < count && count <= 14, "an aggregate with more fields needs serialize()");
  if constexpr (count == 1) {
    auto& [a] = value;
    visit(a);
  } else if constexpr (count == 2) {
    auto& [a, b] = value;
    visit(a, b);
  } else if constexpr (count == 3) {
    auto& [a, b, c] = value;
    visit(a, b, c);
  } else if constexpr (count == 4) {
    auto& [a, b, c, d] = value;
    visit(a, b, c, d);
  } else if constexpr (count == 5) {
    auto& [a, b, c, d, e] = value;
    visit(a, b, c, d, e);
  } else if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = value;
    visit(a, b, c, d, e, f);
  } else if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = value;
    visit(a, b, c, d, e, f, g);
  } else if constexpr (count == 8) {
    auto& [a, b, c, d, e, f, g, h] = value;
    visit(a, b, c, d, e, f, g, h);
  } else if constexpr (count == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = value;
    visit(a, b, c, d, e, f, g, h, i);
  } else if constexpr (count == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = value;
    visit(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (count == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (count == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (count == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (count == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  }
}

}  // namespace kinesphere::detail
