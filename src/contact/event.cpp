// Names of event kinds and walls.
#include "kinesphere/event.hpp"

#include <array>

namespace kinesphere {

std::string_view name_of(EventKind kind) {
  static constexpr std::array<std::string_view, event_kind_count> names{
      "bound_violation", "contact_begin", "contact_end",  "wall_begin", "wall_end",
      "zeno_guard",      "sensor_enter",  "sensor_leave", "woke",       "timer"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(Wall wall) {
  static constexpr std::array<std::string_view, wall_count + 1> names{
      "none", "x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"};
  return names[static_cast<std::size_t>(wall)];
}

}  // namespace kinesphere
