#include "distributed/partition.hpp"

#include <algorithm>
#include <numeric>

#include "distributed/bisection.hpp"

namespace kinesphere {

Partition::Partition(int ranks) : cuts_{{}}, regions_(static_cast<std::size_t>(ranks), nowhere) {
  regions_[0] = everywhere;
}

Partition Partition::choose(Communicator& communicator, std::span<const Vec3> positions,
                            std::span<const double> costs) {
  // Without any positions, all of space remains with rank 0.
  if (communicator.ranks() == 1 || communicator.sum(positions.size()) == 0)
    return Partition(communicator.ranks());
#ifdef KINESPHERE_ZOLTAN
  return along(bisect_by_zoltan(communicator, positions, costs));
#else
  return along(bisect(communicator, positions, costs));
#endif
}

Partition Partition::along(std::span<const Box> boxes) {
  Partition partition(static_cast<int>(boxes.size()));
  std::vector<int> all(boxes.size());
  std::iota(all.begin(), all.end(), 0);
  partition.cuts_.clear();
  partition.regions_.front() = nowhere;
  partition.cut(all, everywhere, boxes);
  return partition;
}

/// Divides `space` among `ranks` along their boxes, which may be approximate, and returns the index of the
/// new cut. Points on a cut belong to the upper side.
int Partition::cut(std::span<const int> ranks, const Box& space, std::span<const Box> boxes) {
  const auto place = cuts_.size();
  cuts_.emplace_back();
  const auto box_of = [&](int rank) { return boxes[static_cast<std::size_t>(rank)]; };
  for (int axis = 0; axis < 3 && ranks.size() > 1; ++axis) {
    for (const int candidate : ranks) {
      const double at = box_of(candidate).lower[axis];
      if (!(at > space.lower[axis] && at < space.upper[axis])) continue;
      std::vector<int> below;
      std::vector<int> above;
      bool cuts_none = true;
      for (const int rank : ranks) {
        const Box box = box_of(rank);
        cuts_none = cuts_none && (box.upper[axis] <= at || box.lower[axis] >= at);
        (box.lower[axis] >= at ? above : below).push_back(rank);
      }
      if (!cuts_none || below.empty() || above.empty()) continue;
      Box lower = space;
      Box upper = space;
      lower.upper[axis] = upper.lower[axis] = at;
      const int first = cut(below, lower, boxes);
      const int second = cut(above, upper, boxes);
      cuts_[place] = {axis, at, first, second};
      return static_cast<int>(place);
    }
  }
  // If no cut separates several ranks, the first one gets all of the space.
  cuts_[place].below = ranks.front();
  regions_[static_cast<std::size_t>(ranks.front())] = space;
  return static_cast<int>(place);
}

int Partition::owner_of(const Vec3& position) const {
  const Cut* cut = cuts_.data();
  while (cut->axis >= 0)
    cut = &cuts_[static_cast<std::size_t>(position[cut->axis] < cut->at ? cut->below : cut->above)];
  return cut->below;
}

}  // namespace kinesphere
