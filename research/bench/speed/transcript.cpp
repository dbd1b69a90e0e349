#include "research/bench/speed/transcript.hpp"
#include "kinesphere/inspection.hpp"

#include <cassert>
#include <memory>
#include <optional>
#include <string_view>

#include "base/program_error.hpp"
#include "research/bench/measurement.hpp"

namespace kinesphere::program {
namespace {

Error not_changeable() {
  return {ErrorCode::unsupported, "body", no_body, "set_velocity: a transcript cannot be changed"};
}

/// WrittenMotion passes every call on to a motion and records the answer.
class WrittenMotion final : public Motion {
 public:
  WrittenMotion(const Motion& motion, std::vector<State>& answers) : motion_(motion), answers_(answers) {}

  std::size_t size() const override { return motion_.size(); }
  BodyDefinition definition(std::uint32_t body, double t) const override {
    return motion_.definition(body, t);
  }
  State state(std::uint32_t body, double t) const override {
    answers_.push_back(motion_.state(body, t));
    return answers_.back();
  }
  Trajectory trajectory(std::uint32_t body, double begin, double end) const override {
    return motion_.trajectory(body, begin, end);
  }
  Result<void> set_velocity(std::uint32_t, double, const Vec3&) override { return not_changeable(); }
  std::unique_ptr<Motion> clone() const override { return std::make_unique<WrittenMotion>(*this); }

 private:
  const Motion& motion_;
  std::vector<State>& answers_;
};

/// Prefetches recorded data: a detector's time must not include cache misses of the transcript.
template <class T>
[[gnu::always_inline]] inline void fetch_ahead(const std::vector<T>& written, std::size_t now) {
  constexpr std::size_t ahead = 8;
  if (now + ahead < written.size()) __builtin_prefetch(&written[now + ahead]);
}

/// PlayedMotion returns the recorded answers in their order, whatever the arguments.
class PlayedMotion final : public Motion {
 public:
  explicit PlayedMotion(const Transcript& transcript) : transcript_(transcript) {}

  std::size_t size() const override { return transcript_.bodies.size(); }
  BodyDefinition definition(std::uint32_t body, double) const override { return transcript_.bodies[body]; }
  State state(std::uint32_t, double) const override {
    const State& answer = transcript_.answers[next_];
    fetch_ahead(transcript_.answers, next_);
    if (next_ + 1 < transcript_.answers.size()) ++next_;
    return answer;
  }
  Trajectory trajectory(std::uint32_t, double, double) const override { return {}; }
  Result<void> set_velocity(std::uint32_t, double, const Vec3&) override { return not_changeable(); }
  std::unique_ptr<Motion> clone() const override { return std::make_unique<PlayedMotion>(*this); }

 private:
  const Transcript& transcript_;
  mutable std::size_t next_ = 0;
};

/// WrittenDetector records the bodies and velocity changes of a detector.
class WrittenDetector final : public Detector {
 public:
  WrittenDetector(std::unique_ptr<WrittenMotion> motion, std::unique_ptr<Detector> detector,
                  Transcript& transcript)
      : motion_(std::move(motion)), detector_(std::move(detector)), transcript_(transcript) {}

  std::string_view name() const override { return detector_->name(); }
  Result<void> add(std::uint32_t body, const BodyDefinition& definition) override {
    assert(body == transcript_.bodies.size());
    transcript_.bodies.push_back(definition);
    return detector_->add(body, definition);
  }
  Result<void> remove(std::uint32_t body) override { return detector_->remove(body); }
  Result<void> set_velocity(std::uint32_t body, const Vec3& velocity) override {
    transcript_.kicks.push_back({body, velocity});
    ++transcript_.kicks_after.back();
    return detector_->set_velocity(body, velocity);
  }
  Result<std::optional<Event>> advance(double until) override {
    auto event = detector_->advance(until);
    if (event && *event) transcript_.kicks_after.push_back(0);
    return event;
  }
  double time() const override { return detector_->time(); }
  DetectorCounters counters() const override { return detector_->counters(); }
  Result<Bound> bound(std::uint32_t body) const override { return detector_->bound(body); }
  std::optional<Memory> memory() const override { return detector_->memory(); }

 private:
  std::unique_ptr<WrittenMotion> motion_;
  std::unique_ptr<Detector> detector_;
  Transcript& transcript_;
};

/// Player runs a detector to a time and repeats the recorded velocity changes after each event.
class Player {
 public:
  Player(const Transcript& transcript, Detector& detector) : transcript_(transcript), detector_(detector) {}

  void go_to(double until) {
    while (require(detector_.advance(until))) {
      if (event_ == transcript_.kicks_after.size())
        throw ProgramError("bench: a detector found more contacts when it ran again");
      for (std::uint32_t k = 0; k < transcript_.kicks_after[event_]; ++k, ++kick_) {
        fetch_ahead(transcript_.kicks, kick_);
        require(detector_.set_velocity(transcript_.kicks[kick_].body, transcript_.kicks[kick_].velocity));
      }
      ++event_;
    }
  }
  bool finished() const { return event_ == transcript_.kicks_after.size(); }

 private:
  const Transcript& transcript_;
  Detector& detector_;
  std::size_t event_ = 0;
  std::size_t kick_ = 0;
};

}  // namespace

std::uint64_t Transcript::contacts() const {
  return result.counters.count(EventKind::contact_begin) + result.counters.count(EventKind::wall_begin) +
         result.counters.count(EventKind::sensor_enter);
}

Transcript write_down(const Scene& scene, const DetectorMaker& make) {
  Transcript transcript{.world = scene.world, .end_time = scene.end_time};
  std::uint64_t probes_at_start = 0;
  bool started = false;
  SceneObserver observer;
  observer.frame_interval = scene.end_time - scene.world.start_time;
  observer.on_frame = [&](const Detector& detector, const Motion&, double) {
    if (!started) probes_at_start = detector.counters().probes;
    started = true;
  };
  const auto written = [&](const WorldDefinition& world,
                           const Motion& motion) -> Result<std::unique_ptr<Detector>> {
    auto written_motion = std::make_unique<WrittenMotion>(motion, transcript.answers);
    auto detector = make(world, *written_motion);
    if (!detector) return detector.error();
    return std::unique_ptr<Detector>(
        std::make_unique<WrittenDetector>(std::move(written_motion), std::move(*detector), transcript));
  };
  transcript.result = require(run_scene(scene, written, observer));
  transcript.probes = transcript.result.counters.probes - probes_at_start;
  return transcript;
}

Playing play(const Transcript& transcript, const DetectorMaker& make) {
  const PlayedMotion motion(transcript);
  const double begin = cpu_seconds();
  const auto detector = require(make(transcript.world, motion));
  for (std::uint32_t body = 0; body < transcript.bodies.size(); ++body)
    require(detector->add(body, transcript.bodies[body]));
  Player player(transcript, *detector);
  player.go_to(transcript.world.start_time);
  const double built = cpu_seconds();
  player.go_to(transcript.end_time);
  const Playing playing{built - begin, cpu_seconds() - built};
  if (!player.finished()) throw ProgramError("bench: a detector found fewer contacts when it ran again");
  return playing;
}

}  // namespace kinesphere::program
