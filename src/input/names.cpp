// Names of ids and error codes.
#include "kinesphere/result.hpp"

namespace kinesphere {

std::string to_string(const BodyId& body) {
  if (body == no_body) return "no_body";
  std::string text = std::to_string(body.index);
  if (body.generation != 0) text += " (generation " + std::to_string(body.generation) + ")";
  return text;
}

std::string_view name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::not_finite:
      return "not_finite";
    case ErrorCode::out_of_range:
      return "out_of_range";
    case ErrorCode::time_backwards:
      return "time_backwards";
    case ErrorCode::unknown_body:
      return "unknown_body";
    case ErrorCode::stale_body:
      return "stale_body";
    case ErrorCode::foreign_body:
      return "foreign_body";
    case ErrorCode::disabled_body:
      return "disabled_body";
    case ErrorCode::enabled_body:
      return "enabled_body";
    case ErrorCode::static_body:
      return "static_body";
    case ErrorCode::outside_domain:
      return "outside_domain";
    case ErrorCode::overlapping:
      return "overlapping";
    case ErrorCode::probe_in_progress:
      return "probe_in_progress";
    case ErrorCode::filter_in_progress:
      return "filter_in_progress";
    case ErrorCode::run_in_progress:
      return "run_in_progress";
    case ErrorCode::callback_threw:
      return "callback_threw";
    case ErrorCode::rank_failed:
      return "rank_failed";
    case ErrorCode::workers_busy:
      return "workers_busy";
    case ErrorCode::no_threads:
      return "no_threads";
    case ErrorCode::null_probe:
      return "null_probe";
    case ErrorCode::null_callback:
      return "null_callback";
    case ErrorCode::moved_from:
      return "moved_from";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::bad_snapshot:
      return "bad_snapshot";
    case ErrorCode::bad_bytes:
      return "bad_bytes";
    case ErrorCode::recording:
      return "recording";
    case ErrorCode::not_recording:
      return "not_recording";
    case ErrorCode::not_profiling:
      return "not_profiling";
    case ErrorCode::bad_recording:
      return "bad_recording";
    case ErrorCode::diverged:
      return "diverged";
  }
  return "";
}

}  // namespace kinesphere
