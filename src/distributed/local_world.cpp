#include "distributed/local_world.hpp"

#include <algorithm>

#include "distributed/known_space.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

LocalWorld::LocalWorld(const WorldDefinition& definition, int rank)
    : tables(definition), everybody(tables, definition.start_time), roster(rank) {
  tables.book.find_numbers_in_tags();
  everybody.agenda().order_by(HotPairOrder(bodies().table().names()));
}

Box LocalWorld::box_of(const BodyKick& kick) const {
  const RoomyBound bound = room_for(bodies(), kick.number, MovedBound(kick.bound, kick.time));
  return bodies().space().within(
      bound.box_of_way(kick.window.end < infinity ? kick.window.end - kick.time : 0.0));
}

std::size_t LocalWorld::own_registered() const {
  const auto copies = std::count_if(roster.copies().begin(), roster.copies().end(),
                                    [this](std::uint32_t number) { return tables.windows.contains(number); });
  return tables.windows.size() - static_cast<std::size_t>(copies);
}

std::size_t LocalWorld::own_moving() const {
  const auto copies =
      std::count_if(roster.copies().begin(), roster.copies().end(), [this](std::uint32_t number) {
        return tables.windows.contains(number) && tables.windows.end_of(number) < infinity;
      });
  return tables.windows.moving() - static_cast<std::size_t>(copies);
}

std::vector<std::uint32_t> LocalWorld::own_bodies_in(std::span<const Box> boxes) const {
  std::vector<std::uint32_t> found;
  NeighbourSearch search;
  for (const Box& box : boxes) {
    Bound ball{.time = time(), .position = 0.5 * (box.lower + box.upper)};
    ball.radius = 0.5 * norm(box.upper - box.lower);
    const RoomyBound bound{MovedBound(ball, time()), 0.0};
    for (const std::uint32_t number : search.near(tables.windows, no_body.index, bound, time(), infinity))
      if (roster.is_own(number) && meet(box, box_of(number), bodies().space())) found.push_back(number);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace kinesphere
