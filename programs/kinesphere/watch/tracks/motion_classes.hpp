// Classes of tracks by their limits of motion: presets, and those of --class.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "formats/fields/units.hpp"
#include "formats/tables/craft_kinds.hpp"
#include "kinesphere/monitor/report.hpp"

namespace kinesphere::program {

/// No acceleration and no speed is larger; infinite: any.
struct MotionLimits {
  ErrorBound acceleration = std::numeric_limits<double>::infinity();
  ErrorBound largest_speed = std::numeric_limits<double>::infinity();

  friend bool operator==(const MotionLimits&, const MotionLimits&) = default;
};

struct MotionClass {
  std::string name;  ///< in alerts; empty for the default class
  MotionLimits limits{};
  /// A track that moves over ground with a reported speed above `given_up_to` is not given the class, and one
  /// that has the class loses it above `kept_up_to` >= given_up_to. Unit: metres per second.
  double given_up_to = std::numeric_limits<double>::infinity();
  double kept_up_to = std::numeric_limits<double>::infinity();
  /// The class is one of craft at rest: a track without a reported speed is not given it, and one that has
  /// lost it by its speed is not given it again for a while (TrackClasses).
  bool is_at_rest = false;
};

/// Returns "acceleration: 6:3; speed: 400:60".
std::string promise_text(const MotionLimits& limits);

MotionClass motion_class(MotionPreset preset);

/// Parses "3", for all directions, or "3:1", for horizontal and vertical. Throws like parse_measure().
ErrorBound parse_spread(std::string_view text, Measure measure, std::string_view option);
/// Parses the name of a preset, or limits ACCELERATION[:VERTICAL],SPEED[:VERTICAL], such as "5:2,40:10" and
/// "0.3g,60kt"; one of the two may be missing. Throws ProgramError naming --class.
MotionClass parse_motion_class(const std::string& text);

}  // namespace kinesphere::program
