// The window policy: how long windows are. It is a cost model that counts and never measures time, so it
// chooses alike on all machines. It depends on bodies and on pairs that may meet, not on the order of bodies
// or on where swept spheres are kept, so it chooses alike wherever bodies are stored.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {

/// Bound on how far a body moves in a window: in a time t at most speed t + acceleration t^2 / 2.
struct SpeedBound {
  double speed;
  double acceleration;

  double way(double time) const { return (speed + 0.5 * acceleration * time) * time; }
};

/// Counts individual updates: bodies that got another swept sphere by themselves within a window, and near
/// pairs that their searches found. A near pair is two bodies that may meet before the window of either ends.
struct RenewalCounts {
  std::uint64_t bodies = 0;
  std::uint64_t near = 0;

  RenewalCounts& operator+=(const RenewalCounts& more) {
    bodies += more.bodies;
    near += more.near;
    return *this;
  }
};

/// Statistics of where bodies are and how fast they move, for the first choice of windows.
class MotionStatistics {
 public:
  void note(const Vec3& centre, const SpeedBound& speed_bound);
  /// Returns the approximate distance between neighbours (length), if the bodies are spread evenly along a
  /// line, or in a plane or a cube if their box is thick enough for that. The result is equal on all
  /// machines.
  double spacing() const;
  /// Returns the median speed and the mean acceleration, each to within a factor of two.
  SpeedBound typical() const;
  /// Combines the statistics of parts of the bodies into those of all bodies. sum(numbers) and least(numbers)
  /// replace each number by the sum, or the least, over all parts.
  template <class Sum, class Least>
  void reduce(Sum sum, Least least) {
    sum(std::span(&bodies_, 1));
    for (Magnitudes* magnitudes : {&speeds_, &accelerations_}) magnitudes->reduce(sum);
    std::array<double, 6> ends{lower_.x, lower_.y, lower_.z, -upper_.x, -upper_.y, -upper_.z};
    least(std::span<double>(ends));
    lower_ = {ends[0], ends[1], ends[2]};
    upper_ = {-ends[3], -ends[4], -ends[5]};
  }

 private:
  /// Histogram of numbers by power of two.
  class Magnitudes {
   public:
    void note(double value);
    double median() const;
    double mean() const;
    template <class Sum>
    void reduce(Sum sum) {
      sum(std::span(&all_, 1));
      sum(std::span<std::uint64_t>(counts_));
    }

   private:
    static constexpr int least = -512;
    double value_of(std::size_t k) const;
    std::uint64_t all_ = 0;
    std::array<std::uint64_t, 1024> counts_{};
  };

  std::uint64_t bodies_ = 0;
  Vec3 lower_{infinity, infinity, infinity};
  Vec3 upper_{-infinity, -infinity, -infinity};
  Magnitudes speeds_;
  Magnitudes accelerations_;
};

/// Chooses the window of each body. Most bodies share windows of one length, the main one, 2^main_rung.
/// Searches find more in longer windows; all bodies start more often in shorter ones. Bodies that are much
/// faster than most have windows 8, 64, ... times shorter, in which they may go farther than most if there is
/// little in their way.
class WindowPolicy {
 public:
  static constexpr int powers_between_rungs = 3;

  /// No body goes more than four times as far as `longest_way` (length, > 0) in a window, if there is a
  /// shorter one.
  WindowPolicy(double longest_way, int dimensions) : longest_way_(longest_way), dimensions_(dimensions) {}

  bool is_chosen() const { return typical_way_ > 0.0; }
  /// Rung of the main windows.
  int main_rung() const { return main_rung_; }
  /// Returns the length of main windows; infinity if none was chosen.
  double main_length() const { return is_chosen() ? power_of_two(main_rung_) : infinity; }
  /// Chooses windows before any statistics of starts exist: a body with the speed bound `typical` goes `way`
  /// (length, > 0), or the longest way if that is less, in a main window.
  void choose(double way, const SpeedBound& typical);
  int rung_for(const SpeedBound& speed_bound) const;
  /// Way in a main window that few bodies exceed (length).
  double typical_way() const { return typical_way_; }

  class Sample;
  /// Chooses the length of the main windows, when most bodies are about to start. The choice depends on the
  /// near pairs found at the last such start, and on the individual updates since then.
  void start_main(double now, const RenewalCounts& updates);
  /// Records that all bodies of a sample have started, that their searches found `near` near pairs, and that
  /// there are `bodies` bodies in all windows.
  void finish_start(const Sample& round, std::uint64_t near, std::uint64_t bodies);
  /// Records a part of the bodies that start, whose pairs finish_start() records with the last part.
  void add_starters(const Sample& round);
  /// Takes over the statistics of bodies that are much faster than most from a policy of which this was a
  /// copy.
  void keep_fast(const WindowPolicy& present);
  /// Returns the cost of widening a typical body's swept sphere by `more` (length), in swept-sphere tests.
  double cost_of_width(double more) const;

  static void serialize(auto& self, auto& archive) {
    auto& [longest, dimensions, main_rung, way, fast_way, bodies, main, fast, start, price] = self;
    archive(main_rung, way, fast_way, bodies, main, fast, start, price);
  }
  /// True if the deserialized state is consistent.
  bool is_valid() const;

 private:
  static constexpr int least_magnitude = 40;
  static constexpr std::size_t magnitudes = 64;

  /// Sums over bodies that have started, and what their start has cost.
  struct Starts {
    std::uint64_t bodies = 0;
    std::uint64_t in_main = 0;  ///< bodies in a window no shorter than the main one
    /// Number of bodies that went about 2^(k - least_magnitude) times the typical way, or less for k = 0.
    std::array<std::uint64_t, magnitudes> ways_gone{};
    // Sums of the lengths that make swept spheres large.
    double widths = 0.0;
    double ways = 0.0;       ///< ways straight on
    double growths = 0.0;    ///< growth on all sides, by what acceleration may do
    std::uint64_t near = 0;  ///< near pairs found

    Starts& operator+=(const Sample& round);
    /// Sums of the short and the long sides of the swept spheres, if windows were `factor` times as long.
    double short_side(double factor) const { return widths + growths * factor * factor; }
    double long_side(double factor) const { return short_side(factor) + ways * factor; }
    /// Returns the factor by which the volume of the swept spheres (the area, in two dimensions) would grow.
    double times_larger(double factor, int dimensions) const;
    /// Returns the cost of a search for each near pair that it finds, in swept-sphere tests.
    double cost_of_finding(double factor, int dimensions) const;
  };

  /// Mean sides of the swept spheres, and mean cost of near pairs, at the last start of most bodies.
  struct PriceOfWidth {
    double short_side = 0.0;
    double long_side = 0.0;
    double pairs = 0.0;  ///< cost of a body's near pairs, in swept-sphere tests
  };

  double cost_of_searches(std::uint64_t searches, double found, double times_longer) const;
  double main_rate(double times_longer, const RenewalCounts& updates, double windows) const;
  double fast_rate(double times_longer) const;
  void note_price();
  void adapt_main(const RenewalCounts& updates, double windows);
  void adapt_fast();

  double longest_way_;
  int dimensions_;
  int main_rung_ = 0;
  double typical_way_ = 0.0;
  double fast_way_ = 0.0;     ///< upper limit of the way of much faster bodies in their windows
  std::uint64_t bodies_ = 0;  ///< number of bodies in all windows
  Starts main_;               ///< starts of most bodies together
  Starts fast_;               ///< starts of other bodies in between
  double main_start_ = 0.0;   ///< time of the last start of most bodies
  PriceOfWidth price_;
};

/// Statistics of bodies that start together, or of a part of them. Samples of parts can be made concurrently
/// and added up in any order.
class WindowPolicy::Sample {
 public:
  /// Makes an empty sample. `most` is true if most bodies start, after start_main(). Precondition: the policy
  /// does not change while the sample is in use.
  Sample(const WindowPolicy& policy, bool most);

  /// Adds a body that starts in a window of this rung. `width` (length) is the width of its swept sphere
  /// without its way.
  void note(const SpeedBound& speed_bound, double width, int rung);
  Sample& operator+=(const Sample& more);
  /// Combines the samples of parts of the bodies into that of all bodies, as MotionStatistics::reduce() does.
  template <class Sum>
  void reduce(Sum sum) {
    std::vector<std::uint64_t> all{bodies_, in_main_, widths_, ways_, growths_};
    all.insert(all.end(), ways_gone_.begin(), ways_gone_.end());
    sum(std::span<std::uint64_t>(all));
    bodies_ = all[0];
    in_main_ = all[1];
    widths_ = all[2];
    ways_ = all[3];
    growths_ = all[4];
    std::copy(all.begin() + 5, all.end(), ways_gone_.begin());
  }

 private:
  friend class WindowPolicy;
  std::uint64_t quanta_in(double length) const;
  void add(double width, const SpeedBound& speed_bound, double time, double most);

  const WindowPolicy* policy_;
  bool most_;
  double quantum_;  ///< a power of two (length)
  double per_quantum_;
  std::uint64_t bodies_ = 0;
  std::uint64_t in_main_ = 0;
  std::array<std::uint64_t, magnitudes> ways_gone_{};
  // Lengths in whole quanta; integer sums do not depend on the order of addition.
  std::uint64_t widths_ = 0;
  std::uint64_t ways_ = 0;
  std::uint64_t growths_ = 0;
};

}  // namespace kinesphere
