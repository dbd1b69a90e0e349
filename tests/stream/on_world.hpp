// Calls of the world that are repeated on its twin while there is one.
#pragma once

#include "kinesphere/event_hash.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {

inline bool same_value(const std::optional<Event>& a, const std::optional<Event>& b) {
  if (!a || !b) return !a && !b;
  EventHash first, second;
  first.add(*a);
  second.add(*b);
  return first.value() == second.value();
}
template <class T>
bool same_value(const T& a, const T& b) {
  return a == b;
}

template <class T>
bool same_result(const Result<T>& a, const Result<T>& b) {
  if (!a || !b) return !a && !b && a.error().message == b.error().message;
  if constexpr (std::is_void_v<T>)
    return true;
  else
    return same_value(*a, *b);
}

/// Calls `call(world)` for the world, and for the twin with an equal result.
template <class Call>
auto Player::on_world(Call call) {
  auto result = call(world_);
  if (twin_) require(same_result(result, call(*twin_)), "a restored world does not go on the same");
  return result;
}

/// Calls `call` for the world and its twin; it wakes this island unless it is refused.
template <class Call>
auto Player::waking(const EventProcessor& island, Call call) {
  auto result = on_world(call);
  if (result) check_woken(island);
  return result;
}

}  // namespace kinesphere::stream
