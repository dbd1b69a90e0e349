// Recordings of worlds and their replays, and profiling: where the time of a world goes.
#include "kinesphere/recording.hpp"

#include <functional>

#include "exchange.hpp"
#include "kinesphere/inspection.hpp"
#include "objects.hpp"

namespace kinesphere::c {
namespace {

ks_busy_body c_busy(const BusyBody& busy) {
  return {.body = c_id(busy.body),
          .reason = static_cast<ks_probe_reason>(busy.reason),
          .probes = busy.probes,
          .touching = busy.touching,
          .near_others = busy.near,
          .windows = busy.windows,
          .changes = busy.changes,
          .queries = busy.queries,
          .contacts = busy.contacts,
          .acceleration_limit = busy.acceleration_limit,
          .largest_acceleration = busy.largest_acceleration};
}

bool is_reason(ks_probe_reason reason) {
  return reason >= KS_PROBE_REASON_TOUCHING && reason <= KS_PROBE_REASON_QUERIES;
}

}  // namespace
}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

ks_status ks_world_start_recording(ks_world world) {
  return changing(__func__, world, [](WorldObject& object) {
    object.world().start_recording().value();
    object.recording.reset();
  });
}

ks_status ks_world_stop_recording(ks_world world) {
  return changing(__func__, world,
                  [](WorldObject& object) { object.recording = object.world().stop_recording().value(); });
}

ks_status ks_world_recording(ks_world world, void* bytes, size_t capacity, size_t* count) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    if (!object.recording) {
      throw Failure{KS_ERROR_NOT_RECORDING, "world",
                    std::string(call) + ": no recording of this world has been stopped since the last start"};
    }
    write_all(call, *object.recording, static_cast<std::byte*>(bytes), capacity, count, std::identity());
  });
}

ks_status ks_replay_open(const void* bytes, size_t count, ks_pair_filter filter, void* user,
                         ks_replay* replay) {
  return guarded([&, call = __func__] {
    require_array(call, bytes, count, "bytes");
    const std::span recording(static_cast<const std::byte*>(bytes), count);
    create<ReplayObject>(call, replay, Replay::open(recording, pair_filter_of(filter, user)).value());
  });
}

ks_status ks_replay_destroy(ks_replay replay) { return destroy(__func__, replay); }

ks_status ks_replay_advance(ks_replay replay, ks_event* event) {
  return changing(__func__, replay, [&, call = __func__](ReplayObject& object) {
    require_record(call, event, "event");
    const auto next = object.replay.advance().value();
    write_next(next, object.replay.world().time(), event);
  });
}

ks_status ks_replay_finished(ks_replay replay, int32_t* finished) {
  return reading(__func__, replay, [&, call = __func__](const ReplayObject& object) {
    require_pointer(call, finished, "finished");
    *finished = object.replay.finished();
  });
}

ks_status ks_replay_steps(ks_replay replay, size_t* repeated, size_t* total) {
  return reading(__func__, replay, [&, call = __func__](const ReplayObject& object) {
    require_pointer(call, repeated, "repeated");
    require_pointer(call, total, "total");
    *repeated = object.replay.step();
    *total = object.replay.step_count();
  });
}

ks_status ks_replay_hash(ks_replay replay, uint64_t* hash) {
  return reading(__func__, replay, [&, call = __func__](const ReplayObject& object) {
    require_pointer(call, hash, "hash");
    *hash = object.replay.hash();
  });
}

ks_status ks_replay_world(ks_replay replay, ks_world* copy) {
  return reading(__func__, replay, [&, call = __func__](const ReplayObject& object) {
    create<WorldObject>(call, copy, Simulation(object.replay.world().clone().value()));
  });
}

ks_status ks_world_set_profiling(ks_world world, int32_t on) {
  return changing(__func__, world,
                  [&](WorldObject& object) { object.world().set_profiling(on != 0).value(); });
}

ks_status ks_world_timings(ks_world world, ks_timings* timings) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, timings, "timings");
    const Timings spent = object.world().inspection().timings();
    *timings = {spent.advances, spent.advance, spent.probes};
  });
}

ks_status ks_world_busiest(ks_world world, size_t most, ks_busy_body* bodies, size_t capacity,
                           size_t* count) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    write_all(call, object.world().inspection().busiest(most).value(), bodies, capacity, count, c_busy);
  });
}

// Names and advice are literals, which end with a zero.

const char* ks_probe_reason_name(ks_probe_reason reason) {
  return is_reason(reason) ? name_of(static_cast<ProbeReason>(reason)).data() : "";
}

const char* ks_probe_reason_advice(ks_probe_reason reason) {
  return is_reason(reason) ? advice_on(static_cast<ProbeReason>(reason)).data() : "";
}
