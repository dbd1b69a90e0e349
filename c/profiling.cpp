// Profiling: where the time of a world goes.
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
