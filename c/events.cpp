// Names and hashes of events.
#include "kinesphere/event.hpp"

#include "exchange.hpp"
#include "kinesphere/event_hash.hpp"

using namespace kinesphere;
using namespace kinesphere::c;

const char* ks_event_kind_name(ks_event_kind kind) {
  if (kind == KS_EVENT_NONE) return "none";
  if (kind < KS_EVENT_BOUND_VIOLATION || kind > KS_EVENT_TIMER) return "";
  return name_of(static_cast<EventKind>(kind - KS_EVENT_BOUND_VIOLATION)).data();
}

ks_status ks_event_hash_add(ks_event_hash* hash, const ks_event* event) {
  return guarded([&, call = __func__] {
    require_pointer(call, hash, "hash");
    require_record(call, event, "event");
    EventHash parts = EventHash::of({hash->sum, hash->count});
    parts.add(event_of(call, *event));
    *hash = {parts.parts()[0], parts.parts()[1]};
  });
}

ks_status ks_event_hash_value(const ks_event_hash* hash, uint64_t* value) {
  return guarded([&, call = __func__] {
    require_pointer(call, hash, "hash");
    require_pointer(call, value, "value");
    *value = EventHash::of({hash->sum, hash->count}).value();
  });
}
