// Names of the reasons for which bodies are probed, and advice on them.
#include <array>

#include "kinesphere/inspection.hpp"

namespace kinesphere {
namespace {

struct ReasonText {
  std::string_view name;
  std::string_view advice;
};

constexpr std::array<ReasonText, 7> reason_texts{{
    {"touching",
     "It stays in touch, and its acceleration limit would let it leave at any time. Let it sleep while it "
     "lies still, or lower the limit."},
    {"narrow_misses",
     "It comes near other bodies, walls or sensor distances without touching them. Filter out pairs that "
     "need not meet, and declare no wider limits and sensors than it needs."},
    {"loose_limit",
     "Its acceleration limit is over 4 times the largest acceleration that its reports showed. Lower the "
     "limit, and declare what is known, such as gravity, as planned acceleration."},
    {"contacts",
     "Its contacts begin often, and each needs probes. Bodies that hop upon each other come to rest by "
     "settle() in place of bounce(), with a larger resting speed sooner; otherwise there is nothing to gain "
     "but fewer contacts."},
    {"travel",
     "It moves through space, and reports keep its bound narrow. A lower acceleration limit or velocity "
     "error makes them rarer."},
    {"changes",
     "It is changed often, or its reports violate its bound. Change a body only when something about it "
     "changes, and look for events bound_violation."},
    {"queries", "Queries and predictions with a probe ask for it. Without a probe they cost no report."},
}};

const ReasonText& reason_text_of(ProbeReason reason) {
  return reason_texts[static_cast<std::size_t>(reason)];
}

}  // namespace

std::string_view name_of(ProbeReason reason) { return reason_text_of(reason).name; }
std::string_view advice_on(ProbeReason reason) { return reason_text_of(reason).advice; }

}  // namespace kinesphere
