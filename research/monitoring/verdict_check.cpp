#include "research/monitoring/verdict_check.hpp"

#include <algorithm>

namespace kinesphere {
namespace {

std::uint64_t key(std::uint64_t a, std::uint64_t b) { return std::min(a, b) << 32 | std::max(a, b); }

}  // namespace

VerdictCheck::VerdictCheck(const FaultySettings& settings, const RandomForces& motion, double distance,
                           double tolerance)
    // near_ is below the distance, and far_ above the distance and the tolerance, by more than the world's
    // tolerances.
    : near_(distance - margin),
      far_(distance + tolerance + margin),
      begin_(2.0 * settings.interval + settings.delay),
      motion_(motion.clone()),
      world_(World::create({.contact_tolerance = 1e-4 * margin}).value()) {
  world_.set_sensor(0, {.distances = {far_, near_}}).value();
  for (std::uint32_t track = 0; track < settings.tracks; ++track) {
    BodyDefinition body = motion_->definition(track, 0.0);
    body.radius = 0.0;
    body.solid = false;
    body.user_data = track;
    world_.add(body).value();
  }
}

void VerdictCheck::compare(double until, std::span<const MonitorEvent> reported) {
  auto next = reported.begin();
  const auto take_reported = [&](double time) {
    for (; next != reported.end() && next->time <= time; ++next) take(*next);
  };
  const auto probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = motion_->state(ids[k].index, time);
  };
  for (const Event& event : world_.events(until, probe)) {
    take_reported(event.time);
    take(event);
  }
  take_reported(until);
}

/// Counts an approach, as missed if the pair is not reported yet. A pair has to stay reported until it has
/// parted.
void VerdictCheck::approach(std::uint64_t pair, double time) {
  if (time < begin_) return;
  ++approaches;
  if (!verdicts_.contains(pair)) ++missed;
}

void VerdictCheck::begin() {
  if (begun_) return;
  begun_ = true;
  for (const std::uint64_t pair : truly_near_) approach(pair, begin_);
}

void VerdictCheck::take(const Event& event) {
  const std::uint64_t pair = key(event.first_user_data, event.second_user_data);
  const bool enters = event.kind == EventKind::sensor_enter;
  if (event.time >= begin_) begin();
  if (event.distance == near_) {
    if (enters) {
      truly_near_.insert(pair);
      approach(pair, event.time);
    } else {
      truly_near_.erase(pair);
    }
  } else if (enters) {
    truly_within_.insert(pair);
  } else {
    truly_within_.erase(pair);
    const auto verdict = verdicts_.find(pair);
    if (verdict != verdicts_.end() && verdict->second == Verdict::within) ++wrongly_within;
  }
}

void VerdictCheck::take(const MonitorEvent& event) {
  if (event.kind != MonitorEventKind::verdict) return;
  const std::uint64_t pair = key(event.first, event.second);
  if (event.before == Verdict::apart) ++warnings;
  if (event.verdict == Verdict::apart) {
    verdicts_.erase(pair);
    if (begun_ && truly_near_.contains(pair)) ++missed;
    return;
  }
  verdicts_[pair] = event.verdict;
  if (event.verdict == Verdict::within && !truly_within_.contains(pair)) ++wrongly_within;
}

}  // namespace kinesphere
