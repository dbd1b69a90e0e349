#include "distributed/rank_state.hpp"

#include <algorithm>

#include "distributed/halo_region.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

RankState::RankState(const WorldDefinition& definition, int rank)
    : state(definition), main(state, definition.start_time), directory(rank) {
  state.contacts.find_numbers_in_tags();
  main.queue().order_by(CertificateOrder(bodies().table().names()));
}

Box RankState::box_of(const SweptSphereUpdate& update) const {
  const InflatedBound bound = margin_for(bodies(), update.number, BoundAt(update.bound, update.time));
  return bodies().space().within(
      bound.box_of_way(update.window.end < infinity ? update.window.end - update.time : 0.0));
}

std::size_t RankState::own_registered() const {
  const auto copies =
      std::count_if(directory.ghosts().begin(), directory.ghosts().end(),
                    [this](std::uint32_t number) { return state.broad_phase.contains(number); });
  return state.broad_phase.size() - static_cast<std::size_t>(copies);
}

std::size_t RankState::own_moving() const {
  const auto copies =
      std::count_if(directory.ghosts().begin(), directory.ghosts().end(), [this](std::uint32_t number) {
        return state.broad_phase.contains(number) && state.broad_phase.end_of(number) < infinity;
      });
  return state.broad_phase.moving() - static_cast<std::size_t>(copies);
}

std::vector<std::uint32_t> RankState::own_bodies() const {
  std::vector<std::uint32_t> own;
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number)
    if (bodies()[number].alive && directory.is_own(number)) own.push_back(number);
  return own;
}

std::vector<std::uint32_t> RankState::own_bodies_in(std::span<const Box> boxes) const {
  std::vector<std::uint32_t> found;
  NeighbourSearch search;
  for (const Box& box : boxes) {
    Bound ball{.time = time(), .position = 0.5 * (box.lower + box.upper)};
    ball.radius = 0.5 * norm(box.upper - box.lower);
    const InflatedBound bound{BoundAt(ball, time()), 0.0};
    for (const std::uint32_t number : search.near(state.broad_phase, no_body.index, bound, time(), infinity))
      if (directory.is_own(number) && meet(box, box_of(number), bodies().space())) found.push_back(number);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace kinesphere
