#include "scenes/busiest_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "kinesphere/inspection.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

std::string reason_words(ProbeReason reason) {
  std::string words(name_of(reason));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// Returns the reason, with the figures that show it.
std::string note_on(const BusyBody& busy) {
  std::string note = reason_words(busy.reason);
  if (busy.contacts > 0) note += fmt::format(", {} contacts", grouped(busy.contacts));
  if (busy.acceleration_limit > 0.0)
    note += fmt::format(", acceleration limit {}, reports showed {}", number(busy.acceleration_limit),
                        number(busy.largest_acceleration));
  return note;
}

}  // namespace

std::string text_of_busiest(std::span<const BusyBody> busiest, std::uint64_t probes) {
  if (busiest.empty()) return "\nbusiest bodies  none was probed\n";
  Summary rows;
  rows.space();
  rows.row("busiest bodies", "probes", "reason");
  std::vector<ProbeReason> reasons;
  for (const BusyBody& busy : busiest) {
    rows.row(
        fmt::format("  body {}", busy.body.index), grouped(busy.probes),
        fmt::format("{} of all: {}", percent(static_cast<double>(busy.probes), static_cast<double>(probes)),
                    note_on(busy)));
    if (std::find(reasons.begin(), reasons.end(), busy.reason) == reasons.end())
      reasons.push_back(busy.reason);
  }
  std::string text = rows.text();
  for (const ProbeReason reason : reasons)
    text += fmt::format("\n{}: {}\n", reason_words(reason), advice_on(reason));
  return text;
}

}  // namespace kinesphere::program
