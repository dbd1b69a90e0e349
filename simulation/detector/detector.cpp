// The default answers of a detector: run, recording and profiling are unsupported.
#include "simulation/detector/detector.hpp"
#include "kinesphere/inspection.hpp"

#include <string>

namespace kinesphere {
namespace {

Error cannot(std::string_view call, std::string_view be_what, std::string_view name) {
  return {ErrorCode::unsupported, "detector", no_body,
          std::string(call) + ": detector must be one that can " + std::string(be_what) + ", but is " +
              std::string(name)};
}

}  // namespace

Result<void> Detector::run(double, Motion&, const ResponseFn&, const EventFn&, Workers&) {
  return cannot("run", "go on by itself", name());
}
Result<void> Detector::start_recording() { return cannot("start_recording", "be recorded", name()); }
Result<std::vector<std::byte>> Detector::stop_recording() {
  return cannot("stop_recording", "be recorded", name());
}
Result<void> Detector::set_profiling(bool) { return cannot("set_profiling", "be profiled", name()); }
Result<std::vector<BusyBody>> Detector::busiest(std::size_t) const {
  return cannot("busiest", "be profiled", name());
}

}  // namespace kinesphere
