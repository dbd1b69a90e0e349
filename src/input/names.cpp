// Names of ids and error codes.
#include <array>

#include "kinesphere/result.hpp"

namespace kinesphere {

std::string to_string(const BodyId& body) {
  if (body == no_body) return "no_body";
  std::string text = std::to_string(body.index);
  if (body.generation != 0) text += " (generation " + std::to_string(body.generation) + ")";
  return text;
}

std::string_view name_of(ErrorCode code) {
  static constexpr std::array<std::string_view, 29> names{
      "not_finite",    "out_of_range",      "time_backwards",     "unknown_body",    "stale_body",
      "foreign_body",  "disabled_body",     "enabled_body",       "static_body",     "outside_domain",
      "overlapping",   "probe_in_progress", "filter_in_progress", "run_in_progress", "workers_busy",
      "no_threads",    "null_probe",        "null_callback",      "callback_threw",  "rank_failed",
      "moved_from",    "unsupported",       "bad_snapshot",       "bad_bytes",       "recording",
      "not_recording", "not_profiling",     "bad_recording",      "diverged"};
  static_assert(names.size() == static_cast<std::size_t>(ErrorCode::diverged) + 1);
  const auto index = static_cast<std::size_t>(code);
  // Not an empty view without data: the C interface takes the data for a text that ends with a zero.
  return index < names.size() ? names[index] : "";
}

}  // namespace kinesphere
