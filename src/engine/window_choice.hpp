// Which windows suit bodies at an instant, and which of them are to report before they start in one.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/world_state.hpp"

namespace kinesphere {

class WindowChoice {
 public:
  WindowChoice(const WorldState& tables, double time) : state_(tables), time_(time) {}

  /// Of the window, from now on, that suits the pace of a body.
  int rung_for(std::uint32_t number, const SpeedBound& speed_bound) const {
    return rung_in_space(number, state_.window_policy.rung_for(speed_bound));
  }
  Window window_for(std::uint32_t number) const {
    return Window::at(time_, rung_for(number, speed_bound_of(BoundAt(bodies()[number].bound, time_))));
  }
  /// The window in which a body is to be from now on that is in this one, if it is in any: there, unless that
  /// lasts longer than the one that suits it, or is far shorter.
  Window next_window(std::uint32_t number, const std::optional<Window>& present) const;
  /// For a body that had a window for itself, which ends now. Nothing has happened to it for a while, so the
  /// next one is longer, where space lets it, so that there are not many.
  Window longer_window(std::uint32_t number, const Window& ended) const;
  /// Whether, until the next window ends, the bound would grow so much that a report costs less, or the body
  /// go so far from its last report that its place could not be computed well, or so large that no window
  /// suits it.
  bool needs_report(std::uint32_t number) const;

 private:
  int rung_in_space(std::uint32_t number, int rung) const;
  double longest_in_period(std::uint32_t number, double length, double release_gap) const;
  const Bodies& bodies() const { return state_.bodies; }

  const WorldState& state_;
  double time_;
};

}  // namespace kinesphere
