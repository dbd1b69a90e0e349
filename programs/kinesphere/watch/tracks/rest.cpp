#include "watch/tracks/rest.hpp"

#include <utility>

namespace kinesphere::program {

bool RestRule::take(Rest& rest, const Vec3& position, const std::optional<double>& now, double stamp,
                    bool is_first) const {
  const bool is_slow = speed > 0.0 && now && *now <= speed;
  if (is_slow && is_first) {
    rest = {true, stamp, position};
    return false;
  }
  const Vec3 moved = position - rest.place;
  const bool stays = rest.slow_since <= stamp && norm({moved.x, moved.y, 0.0}) <= room;
  if (is_slow && stays) {
    rest.is_at_rest = rest.is_at_rest || stamp - rest.slow_since >= time;
    return false;
  }
  const bool was_at_rest = rest.is_at_rest;
  rest = {.place = position};
  if (is_slow) rest.slow_since = stamp;
  return was_at_rest;
}

}  // namespace kinesphere::program
