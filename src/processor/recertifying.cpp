// Recertification: single bodies get new swept spheres, and certificates for the pairs that may change before
// their windows end.
#include <algorithm>

#include "number/infinity.hpp"
#include "processor/event_processor.hpp"

namespace kinesphere {
/// Gives each dirty body a new swept sphere and new certificates.
Result<void> EventProcessor::recertify_dirty() {
  // Listed bodies may have been removed, disabled or restarted with all others since.
  round_ = dirty_.sort(bodies());
  PoolLease alone;
  if (auto probed = probe_stale(round_, ProbeCause::change, alone); !probed) return probed.error();
  // Reports that violate bounds may have made further bodies dirty.
  round_ = dirty_.numbers();
  if (uses_core()) {
    settle_core();
    return {};
  }
  recertify(round_);
  for (const std::uint32_t number : round_) bodies()[number].mark_visited();
  dirty_.clear();
  return {};
}

void EventProcessor::restart(std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t number : numbers) ++bodies()[number].revision;
  recertify(numbers);
}

void EventProcessor::recertify(std::span<const std::uint32_t> numbers) {
  entered_.clear();
  for (const std::uint32_t number : numbers)
    enter(number, window_choice().next_window(number, certifier().window_of(number)));
  search(numbers);
}

/// Searches for the neighbours of bodies that have a new swept sphere, and certifies the pairs. Precondition:
/// entered_ has the bounds of all of them.
void EventProcessor::search(std::span<const std::uint32_t> numbers) {
  work_.counters.restarts += numbers.size();
  if (!log_) state_->broad_phase.tidy();
  // A run that stopped at a conflict may have left results.
  found_.clear();
  const PairCertifier certifier = this->certifier();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const std::uint32_t number = numbers[k];
    if (log_) note_linked_conflicts(number);
    ++found_.searches;
    for (const std::uint32_t other : near(number, entered_[k])) {
      if (log_ && !log_->is_own(other)) {
        certify_speculatively(number, other);
      } else if (!bodies()[other].visited) {
        certifier.certify(number, other, found_);
      }
    }
    if (log_ && !log_->conflicts.empty()) return;
    bodies()[number].visited = true;
  }
  for (const std::uint32_t number : numbers) {
    certifier.certify_linked(number, found_);
    certifier.certify_walls(number, found_);
  }
  for (const std::uint32_t number : numbers) bodies()[number].visited = false;
  work_.recertified += {numbers.size(), found_.near};
  found_.hand_over(queue_, work_.counters);
}

/// Starts a new window for a body whose individual window ends.
Result<void> EventProcessor::renew(std::uint32_t number) {
  const WindowChoice choice = this->window_choice();
  if (choice.needs_report(number)) {
    if (auto probed = probe(std::span(&number, 1), ProbeCause::window); !probed) return probed;
  }
  if (bodies()[number].dirty) return {};
  const auto ended = certifier().window_of(number);
  const bool lasted = ended && ended->end <= time_;
  entered_.clear();
  enter(number, lasted ? choice.longer_window(number, *ended) : choice.window_for(number));
  search(std::span(&number, 1));
  return {};
}

/// Registers a swept sphere of the body from now on, and adds its bound to entered_. A velocity change does
/// not end the epoch, so the window may end earlier; a window_end certificate then renews it. A relocated
/// body shortens the epoch instead.
void EventProcessor::enter(std::uint32_t number, const Window& window) {
  const Body& body = bodies()[number];
  if (bodies().space().repeats())
    bodies().wrap_to_primary(number, time_, window.end < infinity ? window.end - time_ : 0.0);
  if (body.relocated) {
    epoch_end_ = std::min(epoch_end_, window.end);
  } else if (window.end < epoch_end_) {
    queue_.add({window.end, number, PairCertificate::window_end, body.revision, 0});
  }
  const InflatedBound& bound = entered_.emplace_back(inflated_bound(bodies(), number, time_));
  if (log_) {
    const Vec3 middle = bodies().space().repeats() ? bodies().images[number].middle : Vec3{};
    log_->add({number, body.revision, time_, window, body.bound, middle});
  } else {
    state_->broad_phase.enter(number, bound, time_, window);
  }
}

/// Returns the bodies whose swept spheres may touch the new one of the body, which entered with this bound.
/// The result may contain others.
std::span<const std::uint32_t> EventProcessor::near(std::uint32_t number, const InflatedBound& bound) {
  if (!log_) return found_.search.near_entered(state_->broad_phase, number, bound, time_);
  std::vector<std::uint32_t>& numbers =
      found_.search.near(state_->broad_phase, number, bound, time_, certifier().window_end_of(number));
  std::erase_if(numbers, [&](std::uint32_t other) { return log_->last_update(other) != nullptr; });
  log_->for_each_updated([&](std::uint32_t other) {
    if (other != number) numbers.push_back(other);
  });
  return numbers;
}

}  // namespace kinesphere
