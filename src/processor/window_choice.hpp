// WindowChoice selects windows for bodies at an instant, and the bodies to probe before their windows start.
#pragma once

#include <cstdint>
#include <optional>

#include "processor/world_state.hpp"

namespace kinesphere {

class WindowChoice {
 public:
  WindowChoice(const WorldState& state, double time) : state_(state), time_(time) {}

  /// Returns the rung of the window from now on that suits the speed of the body.
  int rung_for(std::uint32_t number, const SpeedBound& speed_bound) const {
    return rung_in_space(number, state_.window_policy.rung_for(speed_bound));
  }
  Window window_for(std::uint32_t number) const {
    return window_of(rung_for(number, speed_bound_of(BoundAt(bodies()[number].bound, time_))));
  }
  /// Returns the next window of a body whose window is `present`, if any. It stays in that one, unless it
  /// lasts longer than the window that suits the body, or is much shorter.
  Window next_window(std::uint32_t number, const std::optional<Window>& present) const;
  /// Returns the next window of a body whose individual window ends now. The body had no discontinuity for a
  /// while, so the next window is longer, if periodic space permits, to keep such renewals rare.
  Window longer_window(std::uint32_t number, const Window& ended) const;
  /// Returns true if, by the end of the next window, the bound would grow so much that a report at
  /// `report_time` costs less, or the body would move too far from its last report for an accurate position,
  /// or would be too large for any window in periodic space.
  bool needs_report(std::uint32_t number, double report_time) const;
  bool needs_report(std::uint32_t number) const { return needs_report(number, time_); }

 private:
  /// Main windows may be entered before they begin (BroadPhase::take_over).
  bool is_entered_early(int rung) const {
    return time_ < state_.broad_phase.search_begin() && rung >= state_.window_policy.main_rung();
  }
  Window window_of(int rung) const {
    return Window::at(is_entered_early(rung) ? state_.broad_phase.search_begin() : time_, rung);
  }
  int rung_in_space(std::uint32_t number, int rung) const;
  double longest_in_period(std::uint32_t number, double length, double release_gap) const;
  const Bodies& bodies() const { return state_.bodies; }

  const WorldState& state_;
  double time_;
};

}  // namespace kinesphere
