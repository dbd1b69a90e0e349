// What detectors cannot do unless they say otherwise.
#include "lab/detector/detector.hpp"

#include <string>

namespace kinesphere {
namespace {

Error no_recording(std::string_view call, std::string_view name) {
  return {ErrorCode::unsupported, "detector", no_body,
          std::string(call) + ": detector must be one that can be recorded, but is " + std::string(name)};
}

}  // namespace

Result<void> Detector::start_recording() { return no_recording("start_recording", name()); }
Result<std::vector<std::byte>> Detector::stop_recording() { return no_recording("stop_recording", name()); }

}  // namespace kinesphere
