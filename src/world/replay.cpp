// Replay: drives a world from a recording, and compares the two at each step.
#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "engine/engine.hpp"
#include "input/input_check.hpp"
#include "kinesphere/queries.hpp"
#include "number/bit_cast.hpp"
#include "recording/expectation.hpp"
#include "recording/step.hpp"

namespace kinesphere {
namespace {

std::string hex(std::uint64_t hash) {
  std::array<char, 17> text;
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

std::string outcome_text(const std::optional<Event>& event, bool failed) {
  if (failed) return "a refused answer of the probe";
  if (!event) return "no event";
  std::string text(name_of(event->kind));
  text += " of " + text_of(event->first);
  if (event->second != no_body) text += " and " + text_of(event->second);
  if (event->wall != Wall::none) text += " at " + std::string(name_of(event->wall));
  return text + " at time " + text_of(event->time);
}

bool same_bits(double a, double b) { return bit_cast<std::uint64_t>(a) == bit_cast<std::uint64_t>(b); }

/// Returns the recorded answers of a step. The first question that has none gets a NaN position, which makes
/// the asking call fail.
class RecordedProbe {
 public:
  RecordedProbe(const World& world, const std::vector<step::Answer>& answers, Expectation& expectation,
                StepHash& hash)
      : world_(world), answers_(answers), expectation_(expectation), hash_(hash) {}

  void operator()(std::span<const BodyId> ids, double time, std::span<State> states) {
    hash_.ask(ids, time);
    last_call_ = given_.size();
    for (std::size_t k = 0; k < ids.size() && difference_.empty(); ++k) {
      if (given_.size() == answers_.size()) {
        constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
        states[k].position = {nothing, nothing, nothing};
        difference_ = "expected no further probe, but found a probe of " + text_of(ids[k]) + " at time " +
                      text_of(time);
        return;
      }
      states[k] = expectation_.answer(world_, ids[k], time, answers_[given_.size()]);
      given_.push_back({time, ids[k], states[k]});
    }
  }

  /// Describes the first deviation from the recording; empty if there was none.
  std::string difference() const {
    if (!difference_.empty() || given_.size() == answers_.size()) return difference_;
    return "expected " + std::to_string(answers_.size()) + " probes, but found the end of the call after " +
           std::to_string(given_.size());
  }

  /// Returns the answers that were given; those of the last call do not count if it failed.
  std::span<const ProbedState> accepted(bool failed) const {
    return std::span(given_).first(failed ? last_call_ : given_.size());
  }

 private:
  const World& world_;
  const std::vector<step::Answer>& answers_;
  Expectation& expectation_;
  StepHash& hash_;
  std::vector<ProbedState> given_;
  std::size_t last_call_ = 0;  ///< number of answers before it
  std::string difference_;
};

}  // namespace

class Replay::Player {
 public:
  Player(World world, RecordingContent content, PairFilter pair_filter)
      : world_(std::move(world)),
        bytes_(std::move(content.steps)),
        steps_(bytes_),
        step_count_(content.step_count),
        pair_filter_(std::move(pair_filter)) {
    set_rotation_probe(content.has_rotation_probe).value();
  }

  Result<std::optional<Event>> advance() {
    probed_.clear();
    while (!finished()) {
      if (divergence_) return *divergence_;
      steps_(step_);
      std::visit([this](const auto& each) { repeat(each); }, step_);
      if (divergence_) return *divergence_;
      ++next_;
      const auto* asking = std::get_if<step::Asking>(&step_);
      if (asking && asking->advances) return event_;
    }
    return std::optional<Event>();
  }

  bool finished() const { return next_ == step_count_; }
  const World& world() const { return world_; }
  std::size_t step() const { return next_; }
  std::size_t step_count() const { return step_count_; }
  std::uint64_t hash() const { return hash_.value(); }
  std::span<const ProbedState> probed_states() const { return probed_; }

 private:
  template <class Change>
  void repeat(const Change& change) {
    expectation_.note(world_, change);
    require(change.repeat(world_));
  }

  void repeat(const step::Rebound& rebound) {
    const auto change = expectation_.change_of(world_, rebound);
    if (!change) return diverge("expected an event that turns a body, but found none");
    expectation_.note(world_, *change);
    if (rebound.spin)
      require(std::get<step::SetAngularVelocity>(*change).repeat(world_));
    else
      require(std::get<step::SetVelocity>(*change).repeat(world_));
  }

  void repeat(const step::SetPairFilter& change) {
    require(world_.set_pair_filter(change.given ? pair_filter_ : PairFilter()));
  }

  void repeat(const step::SetRotationProbe& change) { require(set_rotation_probe(change.given)); }

  void require(const Result<void>& made) {
    if (!made) diverge("expected a change that can be made, but found: " + made.error().message);
  }
  Result<void> set_rotation_probe(bool given) {
    RotationProbe probe;
    if (given) probe = std::ref(rotations_);
    return world_.set_rotation_probe(std::move(probe));
  }

  void repeat(const step::Asking& recorded) {
    rotations_.start(recorded.rotations, recorded.failed);
    RecordedProbe probe(world_, recorded.answers, expectation_, hash_);
    std::string refused;
    bool failed = false;
    event_.reset();
    if (recorded.advances) {
      until_ = recorded.until.number(0, until_);
      const auto event = world_.advance(until_, probe);
      failed = !event;
      if (event) event_ = *event;
      if (!event) refused = event.error().message;
      expectation_.note(event_);
    } else {
      const auto refreshed = world_.queries(probe).refresh(recorded.bodies);
      failed = !refreshed;
      if (!refreshed) refused = refreshed.error().message;
    }
    hash_.add(world_, failed, event_);
    if (const auto difference = probe.difference(); !difference.empty()) return diverge(difference);
    if (!rotations_.are_complete())
      return diverge("expected the rotations of other bodies, or at other times, to be asked for");
    const std::string came = outcome_text(event_, failed) + (refused.empty() ? "" : ": ") + refused;
    if (failed != recorded.failed || event_.has_value() != recorded.has_event) {
      return diverge(std::string("expected ") +
                     (recorded.failed      ? "a refused answer of the probe"
                      : recorded.has_event ? "an event"
                                           : "no event") +
                     ", but found " + came);
    }
    if (static_cast<std::uint16_t>(hash_.value()) != recorded.hash)
      return diverge("expected other work or another outcome, but found " + came);
    const auto accepted = probe.accepted(failed);
    probed_.insert(probed_.end(), accepted.begin(), accepted.end());
  }

  void repeat(const step::End& end) {
    if (!same_bits(world_.time(), end.time)) {
      return diverge("expected the end to come at time " + text_of(end.time) + ", but found it at " +
                     text_of(world_.time()));
    }
    const std::uint64_t found = checksum(world_.save().value());
    if (found != end.checksum) {
      diverge("expected to end as the world with the checksum " + hex(end.checksum) + ", but found " +
              hex(found));
    }
  }

  void diverge(const std::string& what) {
    divergence_ = Error{ErrorCode::diverged, "recording", no_body,
                        "Replay::advance: recording, step " + std::to_string(next_ + 1) + " of " +
                            std::to_string(step_count_) + " at time " + text_of(world_.time()) + ": " + what};
  }

  /// Returns the recorded rotations of a call while the questions match the recording.
  class RecordedRotations {
   public:
    /// `fails`: the recorded call failed after these answers.
    void start(const std::vector<step::RotationAnswer>& answers, bool fails) {
      answers_ = answers;
      fails_ = fails;
      differs_ = false;
    }
    /// Leaves the rotations invalid, which makes the asking call fail, from the first question on that
    /// differs. A probe that threw has no question behind it; in its place the replay has states that are
    /// refused, after one.
    void operator()(std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
      if (fails_ && answers_.empty()) return;
      for (std::size_t k = 0; k < ids.size() && !differs_; ++k) {
        differs_ =
            answers_.empty() || answers_.front().body != ids[k] || !same_bits(answers_.front().time, time);
        if (differs_) break;
        rotations[k] = answers_.front().rotation;
        answers_ = answers_.subspan(1);
      }
    }
    /// Returns true if the questions so far have been all of the recorded ones, and no others.
    bool are_complete() const { return !differs_ && answers_.empty(); }

   private:
    std::span<const step::RotationAnswer> answers_;
    bool fails_ = false;
    bool differs_ = false;
  };

  World world_;
  std::vector<std::byte> bytes_;
  ByteReader steps_;
  std::size_t step_count_;
  PairFilter pair_filter_;
  RecordedRotations rotations_;
  Expectation expectation_;
  StepHash hash_;
  std::size_t next_ = 0;
  Step step_;                        ///< the last one
  double until_ = 0.0;               ///< argument of the last advance
  std::optional<Event> event_;       ///< outcome of the last step
  std::vector<ProbedState> probed_;  ///< of the last advance()
  std::optional<Error> divergence_;
};

Result<Replay> Replay::open(std::span<const std::byte> recording, PairFilter pair_filter) {
  auto content = read_content(recording);
  if (!content) return content.error();
  if (content->needs_pair_filter && !pair_filter) {
    return Error{ErrorCode::out_of_range, "pair_filter", no_body,
                 "Replay::open: pair_filter must be given, as the recorded world had one, but is empty"};
  }
  auto world = World::restore(content->snapshot, content->has_pair_filter ? pair_filter : PairFilter());
  if (!world) return world.error();
  return Replay(std::make_unique<Player>(std::move(*world), std::move(*content), std::move(pair_filter)));
}

Replay::Replay(std::unique_ptr<Player> player) : player_(std::move(player)) {}
Replay::Replay(Replay&&) noexcept = default;
Replay& Replay::operator=(Replay&&) noexcept = default;
Replay::~Replay() = default;

Result<std::optional<Event>> Replay::advance() { return player_->advance(); }
bool Replay::finished() const { return player_->finished(); }
std::span<const ProbedState> Replay::probed_states() const { return player_->probed_states(); }
const World& Replay::world() const { return player_->world(); }
std::size_t Replay::step() const { return player_->step(); }
std::size_t Replay::step_count() const { return player_->step_count(); }
std::uint64_t Replay::hash() const { return player_->hash(); }

Result<RecordedRun> read_recording(std::span<const std::byte> recording, PairFilter pair_filter) {
  auto replay = Replay::open(recording, std::move(pair_filter));
  if (!replay) return replay.error();
  RecordedRun run;
  run.start_time = replay->world().time();
  while (!replay->finished()) {
    const auto event = replay->advance();
    if (!event) return event.error();
    if (*event) run.events.push_back(**event);
    const auto probed = replay->probed_states();
    run.probed_states.insert(run.probed_states.end(), probed.begin(), probed.end());
  }
  run.end_time = replay->world().time();
  return run;
}

}  // namespace kinesphere
