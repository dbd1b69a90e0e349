// Bisection by Zoltan.
#include <mpi.h>
#include <zoltan.h>

#include <memory>

#include "distributed/bisection.hpp"

namespace kinesphere {
namespace {

struct Objects {
  std::span<const Vec3> positions;
  std::span<const double> costs;
};

// Zoltan query callbacks.
const Objects& objects_of(void* data) { return *static_cast<const Objects*>(data); }
int count_of(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(objects_of(data).positions.size());
}
void list(void* data, int, int, ZOLTAN_ID_PTR ids, ZOLTAN_ID_PTR, int, float* weights, int* error) {
  const Objects& objects = objects_of(data);
  for (std::size_t k = 0; k < objects.costs.size(); ++k) {
    ids[k] = static_cast<ZOLTAN_ID_TYPE>(k);
    weights[k] = static_cast<float>(objects.costs[k]);
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
    const Vec3& position = objects_of(data).positions[ids[k]];
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

}  // namespace

std::vector<Box> bisect_by_zoltan(Communicator& communicator, std::span<const Vec3> positions_here,
                                  std::span<const double> costs) {
  float version = 0.0f;
  Zoltan_Initialize(0, nullptr, &version);
  const std::unique_ptr<Zoltan_Struct, Destroy> zoltan(
      Zoltan_Create(MPI_Comm_f2c(communicator.fortran_handle())));
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
  Objects objects{positions_here, costs};
  Zoltan_Set_Num_Obj_Fn(zoltan.get(), count_of, &objects);
  Zoltan_Set_Obj_List_Fn(zoltan.get(), list, &objects);
  Zoltan_Set_Num_Geom_Fn(zoltan.get(), dimensions, nullptr);
  Zoltan_Set_Geom_Multi_Fn(zoltan.get(), positions, &objects);
  int changes = 0, id_entries = 0, local_entries = 0, imported = 0, exported = 0;
  ZOLTAN_ID_PTR import_ids = nullptr, import_locals = nullptr, export_ids = nullptr, export_locals = nullptr;
  int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr, *export_parts = nullptr;
  Zoltan_LB_Partition(zoltan.get(), &changes, &id_entries, &local_entries, &imported, &import_ids,
                      &import_locals, &import_ranks, &import_parts, &exported, &export_ids, &export_locals,
                      &export_ranks, &export_parts);
  std::vector<Box> boxes;
  for (int rank = 0; rank < communicator.ranks(); ++rank) {
    Box box;
    int count = 0;
    Zoltan_RCB_Box(zoltan.get(), rank, &count, &box.lower.x, &box.lower.y, &box.lower.z, &box.upper.x,
                   &box.upper.y, &box.upper.z);
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = unbounded(box.lower[axis]);
      box.upper[axis] = unbounded(box.upper[axis]);
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace kinesphere
