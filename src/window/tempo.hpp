// The tempo: how long windows are. A cost model, which counts and measures no time, so that it is the same on
// all machines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace kinesphere {

/// How a body moves during a window: the way in a time t is at most speed t + acceleration t^2 / 2.
struct Pace {
  double speed;
  double acceleration;

  double way(double time) const { return (speed + 0.5 * acceleration * time) * time; }
};

/// What searches have cost: capsules that were looked at, and rows of them; those that were found to be near,
/// and pairs that became hot.
struct SearchCost {
  std::uint64_t capsules = 0;
  std::uint64_t rows = 0;
  std::uint64_t found = 0;
  std::uint64_t hot = 0;

  /// In looks at a capsule.
  double units() const {
    return static_cast<double>(capsules) + 4.0 * static_cast<double>(rows) +
           12.0 * static_cast<double>(found) + 60.0 * static_cast<double>(hot);
  }
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [seen, runs, near, due] = self;
    archive(seen, runs, near, due);
  }
};

/// Most bodies share windows of one length, the main one, 2^main_tier. In longer windows searches find more,
/// in shorter ones all bodies start more often. Those that are much faster than most have windows 8, 64, ...
/// times shorter.
class Tempo {
 public:
  static constexpr int powers_between_tiers = 3;

  /// Most bodies never go farther than `longest_way` (length, > 0) in a main window.
  explicit Tempo(double longest_way) : longest_way_(longest_way) {}

  bool is_chosen() const { return typical_way_ > 0.0; }
  /// Before anything is known: windows in which a body of this pace goes this way (> 0) or the longest one.
  void choose(double way, const Pace& typical);
  int tier_for(const Pace& pace) const;
  /// Few bodies go farther in a main window (length).
  double typical_way() const { return typical_way_; }

  /// A body starts in a window; `width` is that of its capsule without its way.
  void note_start(const Pace& pace, double width, int tier);
  /// Chooses the length of the main windows, knowing what searches have cost since most bodies started: for
  /// these, and since then, for `elapsed`.
  void adapt(const SearchCost& starts, const SearchCost& later, double elapsed, int dimensions);

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [longest, tier, way, bodies, in_main, ways, widths, magnitudes] = self;
    archive(tier, way, bodies, in_main, ways, widths, magnitudes);
  }
  /// For one that was read.
  bool is_sound() const;

 private:
  static constexpr int least_magnitude = 40;

  double longest_way_;
  int main_tier_ = 0;
  double typical_way_ = 0.0;
  // Of those that have started.
  std::uint64_t bodies_ = 0;
  std::uint64_t in_main_ = 0;  ///< in a main window
  double ways_ = 0.0;
  double widths_ = 0.0;
  /// How many went about 2^(k - least_magnitude) times the typical way, or less for k = 0.
  std::array<std::uint64_t, 64> magnitudes_{};
};

}  // namespace kinesphere
