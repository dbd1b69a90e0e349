#include "simulation/detector/checked_detector.hpp"
#include "kinesphere/inspection.hpp"

#include <string>
#include <utility>
#include <vector>

#include "input/input_check.hpp"

namespace kinesphere {
namespace {

class CheckedDetector final : public Detector {
 public:
  CheckedDetector(std::unique_ptr<Detector> detector, const WorldDefinition& definition, std::size_t bodies,
                  NewBodies new_bodies)
      : detector_(std::move(detector)),
        definition_(definition),
        checks_new_bodies_(new_bodies == NewBodies::unchecked),
        present_(bodies, false) {}

  std::string_view name() const override { return detector_->name(); }

  Result<void> add(std::uint32_t body, const BodyDefinition& definition) override {
    if (body >= present_.size()) {
      return wrong(ErrorCode::unknown_body, body,
                   "add: body must be one of the motion's " + std::to_string(present_.size()));
    }
    if (present_[body]) return wrong(ErrorCode::out_of_range, body, "add: body must not be there yet");
    if (checks_new_bodies_) {
      if (auto valid = check_body(definition, definition_, "add"); !valid) return valid;
    }
    auto added = detector_->add(body, definition);
    if (added) present_[body] = true;
    return added;
  }

  Result<void> remove(std::uint32_t body) override {
    if (!is_present(body)) return absent("remove", body);
    auto removed = detector_->remove(body);
    if (removed) present_[body] = false;
    return removed;
  }

  Result<void> set_velocity(std::uint32_t body, const Vec3& velocity) override {
    if (!is_present(body)) return absent("set_velocity", body);
    if (auto valid = check_velocity(velocity, {body, 0}, definition_, "set_velocity"); !valid) return valid;
    return detector_->set_velocity(body, velocity);
  }

  Result<std::optional<Event>> advance(double until) override {
    if (auto valid = check_time(until, time(), {}); !valid) return valid.error();
    return detector_->advance(until);
  }

  Result<void> run(double until, Motion& motion, const ResponseFn& respond, const EventFn& sink,
                   Workers& workers) override {
    return detector_->run(until, motion, respond, sink, workers);
  }

  double time() const override { return detector_->time(); }
  DetectorCounters counters() const override { return detector_->counters(); }
  Result<Bound> bound(std::uint32_t body) const override {
    if (!is_present(body)) return absent("bound", body).error();
    return detector_->bound(body);
  }
  std::optional<AuditFinding> audit() const override { return detector_->audit(); }
  std::optional<Memory> memory() const override { return detector_->memory(); }
  Result<void> start_recording() override { return detector_->start_recording(); }
  Result<std::vector<std::byte>> stop_recording() override { return detector_->stop_recording(); }
  Result<void> set_profiling(bool on) override { return detector_->set_profiling(on); }
  Result<std::vector<BusyBody>> busiest(std::size_t count) const override {
    return detector_->busiest(count);
  }

 private:
  bool is_present(std::uint32_t body) const { return body < present_.size() && present_[body]; }

  static Result<void> wrong(ErrorCode code, std::uint32_t body, const std::string& expectation) {
    return Error{code, "body", {body, 0}, expectation + ", but is " + std::to_string(body)};
  }

  Result<void> absent(const std::string& call, std::uint32_t body) const {
    const ErrorCode code = body < present_.size() ? ErrorCode::stale_body : ErrorCode::unknown_body;
    return wrong(code, body, call + ": body must be one that is there");
  }

  std::unique_ptr<Detector> detector_;
  WorldDefinition definition_;
  bool checks_new_bodies_;
  std::vector<bool> present_;
};

}  // namespace

Result<void> check_whole_space(const WorldDefinition& definition) {
  return InputCheck("detector")
      .require(!definition.periodic.any(), ErrorCode::unsupported, {"periodic"},
               "must be false on all axes for any detector but world",
               std::string_view(definition.periodic.x   ? "true on x"
                                : definition.periodic.y ? "true on y"
                                                        : "true on z"))
      .require(definition.dimensions == 3, ErrorCode::unsupported, {"dimensions"},
               "must be 3 for any detector but world", static_cast<double>(definition.dimensions))
      .result();
}

std::unique_ptr<Detector> with_checked_input(std::unique_ptr<Detector> detector,
                                             const WorldDefinition& definition, std::size_t bodies,
                                             NewBodies new_bodies) {
  return std::make_unique<CheckedDetector>(std::move(detector), definition, bodies, new_bodies);
}

}  // namespace kinesphere
