#include "distributed/partition.hpp"

#include <mpi.h>
#include <zoltan.h>

#include <algorithm>
#include <memory>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

struct Points {
  std::span<const Vec3> positions;
  std::span<const double> costs;
};

// Zoltan query callbacks.
const Points& points_of(void* data) { return *static_cast<const Points*>(data); }
int count_of(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(points_of(data).positions.size());
}
void list(void* data, int, int, ZOLTAN_ID_PTR ids, ZOLTAN_ID_PTR, int, float* weights, int* error) {
  const Points& points = points_of(data);
  for (std::size_t k = 0; k < points.costs.size(); ++k) {
    ids[k] = static_cast<ZOLTAN_ID_TYPE>(k);
    weights[k] = static_cast<float>(points.costs[k]);
  }
  *error = ZOLTAN_OK;
}
int dimensions(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}
void positions(void* data, int, int, int count, ZOLTAN_ID_PTR ids, ZOLTAN_ID_PTR, int, double* coordinates,
               int* error) {
  for (int k = 0; k < count; ++k) {
    const Vec3& position = points_of(data).positions[ids[k]];
    for (int axis = 0; axis < 3; ++axis) coordinates[3 * k + axis] = position[axis];
  }
  *error = ZOLTAN_OK;
}

struct Destroy {
  void operator()(Zoltan_Struct* zoltan) const { Zoltan_Destroy(&zoltan); }
};

/// Converts Zoltan's representation of an unbounded coordinate to infinity.
double unbounded(double value) {
  constexpr double far = 1e300;
  return value > far ? infinity : value < -far ? -infinity : value;
}

constexpr Box everywhere{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
constexpr Box nowhere{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

}  // namespace

Partition::Partition(int ranks) : cuts_{{}}, regions_(static_cast<std::size_t>(ranks), nowhere) {
  regions_[0] = everywhere;
}

Partition Partition::choose(Communicator& communicator, std::span<const Vec3> positions_here,
                            std::span<const double> costs) {
  const int ranks = communicator.ranks();
  Partition partition(ranks);
  if (ranks == 1) return partition;
  float version = 0.0f;
  Zoltan_Initialize(0, nullptr, &version);
  const std::unique_ptr<Zoltan_Struct, Destroy> zoltan(Zoltan_Create(MPI_COMM_WORLD));
  const auto set = [&](const char* name, const char* value) { Zoltan_Set_Param(zoltan.get(), name, value); };
  set("DEBUG_LEVEL", "0");
  set("DEBUG_MEMORY", "0");
  set("LB_METHOD", "RCB");
  set("KEEP_CUTS", "1");
  set("RCB_OUTPUT_LEVEL", "0");
  set("RETURN_LISTS", "NONE");
  set("OBJ_WEIGHT_DIM", "1");
  set("NUM_GID_ENTRIES", "1");
  set("NUM_LID_ENTRIES", "0");
  Points points{positions_here, costs};
  Zoltan_Set_Num_Obj_Fn(zoltan.get(), count_of, &points);
  Zoltan_Set_Obj_List_Fn(zoltan.get(), list, &points);
  Zoltan_Set_Num_Geom_Fn(zoltan.get(), dimensions, nullptr);
  Zoltan_Set_Geom_Multi_Fn(zoltan.get(), positions, &points);
  int changes = 0, id_entries = 0, local_entries = 0, imported = 0, exported = 0;
  ZOLTAN_ID_PTR import_ids = nullptr, import_locals = nullptr, export_ids = nullptr, export_locals = nullptr;
  int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr, *export_parts = nullptr;
  // Without any positions, all of space remains with rank 0.
  if (communicator.sum(positions_here.size()) == 0) return partition;
  Zoltan_LB_Partition(zoltan.get(), &changes, &id_entries, &local_entries, &imported, &import_ids,
                      &import_locals, &import_ranks, &import_parts, &exported, &export_ids, &export_locals,
                      &export_ranks, &export_parts);
  std::vector<Box> boxes;
  std::vector<int> all;
  for (int rank = 0; rank < ranks; ++rank) {
    Box box;
    int count = 0;
    Zoltan_RCB_Box(zoltan.get(), rank, &count, &box.lower.x, &box.lower.y, &box.lower.z, &box.upper.x,
                   &box.upper.y, &box.upper.z);
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = unbounded(box.lower[axis]);
      box.upper[axis] = unbounded(box.upper[axis]);
    }
    boxes.push_back(box);
    all.push_back(rank);
  }
  partition.cuts_.clear();
  std::fill(partition.regions_.begin(), partition.regions_.end(), nowhere);
  partition.cut(all, everywhere, boxes);
  return partition;
}

/// Divides `space` among `ranks` along the boxes reported by Zoltan, which are approximate, and returns the
/// index of the new cut. Zoltan may put points on a cut on either side; here they belong to the upper side.
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
