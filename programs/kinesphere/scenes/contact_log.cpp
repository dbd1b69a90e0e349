// Writes every event of a run to a table, one row each.
#include "scenes/contact_log.hpp"

#include <utility>

namespace kinesphere::program {
namespace {

Cell cell_of(BodyId body) {
  if (body == no_body) return {};
  return std::uint64_t{body.index};
}

Cell cell_of(Wall wall) {
  if (wall == Wall::none) return {};
  return std::string(name_of(wall));
}

}  // namespace

ContactLog::ContactLog(const std::string& path) : ContactLog(table_format_of(path), {path}) {}

ContactLog::ContactLog(TableFormat format, OutputPlace place)
    : table_(format, std::move(place),
             {"time", "kind", "first", "second", "wall", "gap", "approach_speed", "point_x", "point_y",
              "point_z", "normal_x", "normal_y", "normal_z", "repeated", "already_touching",
              "position_excess", "velocity_excess"}) {}

void ContactLog::write(const Event& event) {
  const Cell cells[] = {event.time,
                        std::string(name_of(event.kind)),
                        cell_of(event.first),
                        cell_of(event.second),
                        cell_of(event.wall),
                        event.gap,
                        event.approach_speed,
                        event.point.x,
                        event.point.y,
                        event.point.z,
                        event.normal.x,
                        event.normal.y,
                        event.normal.z,
                        event.repeated,
                        event.already_touching,
                        event.position_excess,
                        event.velocity_excess};
  table_.write(cells);
}

}  // namespace kinesphere::program
