// Worlds: definitions, snapshots, what a world knows.
#include "kinesphere/world.hpp"

#include <functional>
#include <string>

#include "exchange.hpp"
#include "objects.hpp"

namespace kinesphere::c {

ks_world_definition c_world(const WorldDefinition& definition) {
  ks_world_definition record{.struct_size = sizeof record,
                             .has_box = definition.box.has_value(),
                             .box = c_box(definition.box.value_or(Box{})),
                             .has_wall_filter = definition.wall_filter.has_value(),
                             .wall_filter = c_filter(definition.wall_filter.value_or(Filter{}))};
  fields::each_world_definition_field(convert_fields, definition, record);
  return record;
}

ks_body_view c_view(const BodyView& view) {
  return {.struct_size = sizeof(ks_body_view),
          .enabled = view.enabled,
          .is_static = view.is_static,
          .sleeping = view.sleeping,
          .report_time = view.bound.time,
          .box = c_box(view.box),
          .box_end = view.box_end,
          .image = {view.image[0], view.image[1], view.image[2]},
          .definition = c_body(view.definition)};
}

WorldDefinition world_of(std::string_view call, const ks_world_definition& caller) {
  const ks_world_definition given = read_record(caller, c_world({}));
  require_number(call, "contacts", given.contacts, KS_CONTACTS_IMPACTS, KS_CONTACTS_ALL);
  require_number(call, "periodic", given.periodic, 0, KS_AXIS_X | KS_AXIS_Y | KS_AXIS_Z);
  WorldDefinition definition;
  fields::each_world_definition_field(convert_fields, given, definition);
  const Box box = box_of(given.box);
  if (given.has_box) {
    definition.box = box;
  } else if (box != Box{}) {
    detail::bad_result({ErrorCode::out_of_range, "has_box", no_body,
                        std::string(call) + ": has_box must be 1 for a world with a box, but is 0"});
  }
  if (given.has_wall_filter) definition.wall_filter = filter_of(given.wall_filter);
  return definition;
}

}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

ks_status ks_world_definition_init(ks_world_definition* definition, uint32_t struct_size) {
  return initialise(__func__, definition, struct_size, c_world({}));
}

ks_status ks_world_create(const ks_world_definition* definition, ks_world* world) {
  return guarded([&, call = __func__] {
    require_record(call, definition, "definition");
    create<WorldObject>(call, world, Simulation(World::create(world_of(call, *definition)).value()));
  });
}

ks_status ks_world_destroy(ks_world world) { return destroy(__func__, world); }

ks_status ks_world_clone(ks_world world, ks_world* copy) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    std::visit([&](const auto& owner) { create<WorldObject>(call, copy, owner.clone().value()); },
               object.owner);
  });
}

ks_status ks_world_save(ks_world world, void* bytes, size_t capacity, size_t* count) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    const auto snapshot = object.is_game() ? object.game().save() : object.world().save();
    write_all(call, snapshot.value(), static_cast<std::byte*>(bytes), capacity, count, std::identity());
  });
}

ks_status ks_world_restore(const void* bytes, size_t count, ks_pair_filter filter, void* user,
                           ks_world* world) {
  return guarded([&, call = __func__] {
    require_array(call, bytes, count, "bytes");
    const std::span snapshot(static_cast<const std::byte*>(bytes), count);
    create<WorldObject>(call, world,
                        Simulation(World::restore(snapshot, pair_filter_of(filter, user)).value()));
  });
}

ks_status ks_world_time(ks_world world, double* time) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, time, "time");
    *time = object.world().time();
  });
}

ks_status ks_world_size(ks_world world, size_t* bodies) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, bodies, "bodies");
    *bodies = object.world().size();
  });
}

ks_status ks_world_contains(ks_world world, ks_body_id body, int32_t* contains) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, contains, "contains");
    *contains = object.world().contains(id_of(body));
  });
}

ks_status ks_world_body(ks_world world, ks_body_id body, ks_body_view* view) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_record(call, view, "view");
    *view = c_view(object.world().body(id_of(body)).value());
  });
}

ks_status ks_world_rotation(ks_world world, ks_body_id body, ks_rotation* rotation) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, rotation, "rotation");
    const BodyView view = object.world().body(id_of(body)).value();
    if (!view.rigid)
      throw BadResult(
          {ErrorCode::unsupported, "body", id_of(body), std::string(call) + ": body must be rigid"});
    *rotation = c_rotation(view.rigid->rotation);
  });
}

ks_status ks_world_bodies(ks_world world, ks_body_id* bodies, size_t capacity, size_t* count) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    write_all(call, object.world().bodies(), bodies, capacity, count, c_id);
  });
}

ks_status ks_world_touching(ks_world world, ks_body_id body, ks_body_id* partners, size_t capacity,
                            size_t* count) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    write_all(call, object.world().touching(id_of(body)).value(), partners, capacity, count, c_id);
  });
}

ks_status ks_world_sensor_overlaps(ks_world world, ks_body_id body, ks_sensor_overlap* overlaps,
                                   size_t capacity, size_t* count) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    write_all(call, object.world().sensor_overlaps(id_of(body)).value(), overlaps, capacity, count,
              [](const SensorOverlap& overlap) {
                return ks_sensor_overlap{c_id(overlap.body), overlap.distance};
              });
  });
}

ks_status ks_world_probe_count(ks_world world, uint64_t* probes) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, probes, "probes");
    *probes = object.world().counters().probes;
  });
}
