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

std::vector<std::byte> bytes_of(const std::optional<Event>& event) {
  ByteWriter writer;
  writer(event);
  return writer.take();
}

bool same_bits(double a, double b) { return bit_cast<std::uint64_t>(a) == bit_cast<std::uint64_t>(b); }

/// Returns the recorded answers while the questions match the recording. The first question that differs gets
/// a NaN position, which makes the asking call fail.
class RecordedProbe {
 public:
  explicit RecordedProbe(const std::vector<step::Answer>& answers) : answers_(answers) {}

  void operator()(std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size() && difference_.empty(); ++k) {
      const step::Answer* const answer = next_ < answers_.size() ? &answers_[next_] : nullptr;
      const bool same = answer && answer->report.body == ids[k] && same_bits(answer->report.time, time) &&
                        answer->last == (k + 1 == ids.size());
      if (!same) {
        difference_ = expected() + ", but found a probe of " + text_of(ids[k]) + " at time " + text_of(time);
        if (ids.size() > 1)
          difference_ += ", number " + std::to_string(k + 1) + " of " + std::to_string(ids.size());
        break;
      }
      states[k] = answer->report.state;
      ++next_;
    }
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    if (!difference_.empty() && !ids.empty()) states[0].position = {nothing, nothing, nothing};
  }

  /// Describes the first deviation from the recording; empty if there was none.
  std::string difference() const {
    if (!difference_.empty() || next_ == answers_.size()) return difference_;
    return expected() + ", but found the end of the call";
  }

 private:
  std::string expected() const {
    if (next_ >= answers_.size()) return "expected no further probe";
    const ProbedState& report = answers_[next_].report;
    return "expected a probe of " + text_of(report.body) + " at time " + text_of(report.time) +
           (answers_[next_].last ? ", the last of its call" : "");
  }

  const std::vector<step::Answer>& answers_;
  std::size_t next_ = 0;
  std::string difference_;
};

}  // namespace

class Replay::Player {
 public:
  Player(World world, RecordingContent content, PairFilter pair_filter)
      : world_(std::move(world)), steps_(std::move(content.steps)), pair_filter_(std::move(pair_filter)) {
    set_rotation_probe(content.has_rotation_probe).value();
  }

  Result<std::optional<Event>> advance() {
    while (!finished()) {
      if (divergence_) return *divergence_;
      const Step& step = steps_[next_];
      std::visit([this](const auto& each) { repeat(each); }, step);
      if (divergence_) return *divergence_;
      ++next_;
      const auto* asking = std::get_if<step::Asking>(&step);
      if (asking && asking->until) return asking->event;
    }
    return std::optional<Event>();
  }

  bool finished() const { return next_ == steps_.size(); }
  const World& world() const { return world_; }
  std::size_t step() const { return next_; }
  std::size_t step_count() const { return steps_.size(); }
  std::uint64_t hash() const { return hash_.value(); }

 private:
  template <class Change>
  void repeat(const Change& change) {
    require(change.repeat(world_));
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
    step::Asking found;
    rotations_.start(recorded.rotations, recorded.failed);
    RecordedProbe probe(recorded.answers);
    std::string refused;
    if (recorded.until) {
      const auto event = world_.advance(*recorded.until, probe);
      found.failed = !event;
      if (event) found.event = *event;
      if (!event) refused = event.error().message;
    } else {
      const auto refreshed = refresh(recorded, probe);
      found.failed = !refreshed;
      if (!refreshed) refused = refreshed.error().message;
    }
    hash_.add(world_, found);
    if (const auto difference = probe.difference(); !difference.empty()) return diverge(difference);
    if (!rotations_.are_complete())
      return diverge("expected the rotations of other bodies, or at other times, to be asked for");
    if (found.failed == recorded.failed && bytes_of(found.event) == bytes_of(recorded.event)) {
      if (hash_.value() == recorded.hash) return;
      return diverge("expected the hash " + hex(recorded.hash) + ", but found " + hex(hash_.value()) + ": " +
                     outcome_text(found.event, found.failed) + " took other work");
    }
    const std::string expected = outcome_text(recorded.event, recorded.failed);
    const std::string came = outcome_text(found.event, found.failed);
    diverge("expected " + expected + ", but found " +
            (came == expected ? "it with other figures" : came + (refused.empty() ? "" : ": ") + refused));
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

  Result<bool> refresh(const step::Asking& recorded, const Probe& probe) {
    std::vector<BodyId> bodies;
    for (const step::Answer& answer : recorded.answers) bodies.push_back(answer.report.body);
    return world_.queries(probe).refresh(bodies);
  }

  void diverge(const std::string& what) {
    divergence_ =
        Error{ErrorCode::diverged, "recording", no_body,
              "Replay::advance: recording, step " + std::to_string(next_ + 1) + " of " +
                  std::to_string(steps_.size()) + " at time " + text_of(world_.time()) + ": " + what};
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
  std::vector<Step> steps_;
  PairFilter pair_filter_;
  RecordedRotations rotations_;
  std::size_t next_ = 0;
  StepHash hash_;
  std::optional<Error> divergence_;
};

Result<Replay> Replay::open(std::span<const std::byte> recording, PairFilter pair_filter) {
  auto content = read_content(recording);
  if (!content) return content.error();
  bool needs_filter = content->has_pair_filter;
  for (const Step& step : content->steps) {
    const auto* set = std::get_if<step::SetPairFilter>(&step);
    needs_filter = needs_filter || (set && set->given);
  }
  if (needs_filter && !pair_filter) {
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
const World& Replay::world() const { return player_->world(); }
std::size_t Replay::step() const { return player_->step(); }
std::size_t Replay::step_count() const { return player_->step_count(); }
std::uint64_t Replay::hash() const { return player_->hash(); }

}  // namespace kinesphere
