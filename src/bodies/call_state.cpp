#include "bodies/call_state.hpp"

#include <string>

namespace kinesphere {

Error busy_error(CallState activity, std::string_view call) {
  if (activity == CallState::probing) {
    return {ErrorCode::probe_in_progress, "probe", no_body,
            std::string(call) + ": a probe may not call the world that asked it"};
  }
  if (activity == CallState::running) {
    return {ErrorCode::run_in_progress, "world", no_body,
            std::string(call) + ": source, respond and sink may not make this call to the world that runs"};
  }
  return {ErrorCode::filter_in_progress, "pair_filter", no_body,
          std::string(call) + ": a pair filter may not make this call to the world that asked it"};
}

}  // namespace kinesphere
