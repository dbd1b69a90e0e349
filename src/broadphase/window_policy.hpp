// The tempo: how long windows are. A cost model, which counts and measures no time, so that it is the same on
// all machines; and which knows of bodies and of pairs that may meet alone, not of the order of bodies nor of
// where capsules are kept, so that it is the same wherever they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// How a body moves during a window: the way in a time t is at most speed t + acceleration t^2 / 2.
struct SpeedBound {
  double speed;
  double acceleration;

  double way(double time) const { return (speed + 0.5 * acceleration * time) * time; }
};

/// Bodies that have got another capsule by themselves, within a window, and how many near pairs their
/// searches have found: two bodies that may meet before the window of either ends.
struct RenewalCounts {
  std::uint64_t bodies = 0;
  std::uint64_t near = 0;

  RenewalCounts& operator+=(const RenewalCounts& more) {
    bodies += more.bodies;
    near += more.near;
    return *this;
  }
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [count, due] = self;
    archive(count, due);
  }
};

/// Where bodies are and how fast, about, before anything is known of them.
class MotionStatistics {
 public:
  void note(const Vec3& centre, const SpeedBound& speed_bound);
  /// About the distance between neighbours (length), if they are spread evenly along a line or in a layer, if
  /// their box is thinner than that, or in a cube around it. The same on all machines.
  double spacing() const;
  /// The speed of the body in the middle, and the mean acceleration, each to within a factor of two.
  SpeedBound typical() const;
  /// Of a part of the bodies becomes that of all: sum(numbers) and least(numbers) put in the place of each
  /// number the sum, or the least, of those of all parts.
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
  /// How many numbers there are of each power of two.
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

/// Most bodies share windows of one length, the main one, 2^main_tier. In longer windows searches find more,
/// in shorter ones all bodies start more often. Those that are much faster than most have windows 8, 64, ...
/// times shorter, in which they may go farther than most if there is little in their way.
class WindowPolicy {
 public:
  static constexpr int powers_between_rungs = 3;

  /// No body goes more than four times as far in a window as `longest_way` (length, > 0) if there is a
  /// shorter one.
  WindowPolicy(double longest_way, int dimensions) : longest_way_(longest_way), dimensions_(dimensions) {}

  bool is_chosen() const { return typical_way_ > 0.0; }
  /// Before anything is known: windows in which a body of this pace goes this way (> 0) or the longest one.
  void choose(double way, const SpeedBound& typical);
  int rung_for(const SpeedBound& speed_bound) const;
  /// Few bodies go farther in a main window (length).
  double typical_way() const { return typical_way_; }

  class Sample;
  /// Most bodies are going to start. Chooses the length of the main windows, knowing how many near pairs
  /// those that started last time have found, and how many have been kicked since then.
  void start_main(double now, const RenewalCounts& updates);
  /// All of a round have started, so that there are so many bodies, and found so many near pairs.
  void finish_start(const Sample& round, std::uint64_t near, std::uint64_t bodies);
  /// What it costs that the capsule of a typical body is so much wider (length), in looks at a capsule.
  double cost_of_width(double more) const;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [longest, dimensions, tier, way, fast_way, bodies, main, fast, start, price] = self;
    archive(tier, way, fast_way, bodies, main, fast, start, price);
  }
  /// For one that was read.
  bool is_valid() const;

 private:
  static constexpr int least_magnitude = 40;
  static constexpr std::size_t magnitudes = 64;

  /// Bodies that have started, and what that has cost.
  struct Starts {
    std::uint64_t bodies = 0;
    std::uint64_t in_main = 0;  ///< of them, in a window no shorter than the main one
    /// How many went about 2^(k - least_magnitude) times the typical way, or less for k = 0.
    std::array<std::uint64_t, magnitudes> ways_gone{};
    // Sums of what makes capsules large.
    double widths = 0.0;
    double ways = 0.0;       ///< straight on
    double growths = 0.0;    ///< on all sides, by what acceleration may do
    std::uint64_t near = 0;  ///< pairs that they found

    Starts& operator+=(const Sample& round);
    /// What they would be if windows were so many times as long.
    double short_side(double factor) const { return widths + growths * factor * factor; }
    double long_side(double factor) const { return short_side(factor) + ways * factor; }
    /// In how much more space they would be.
    double times_larger(double factor, int dimensions) const;
    /// What a search for one of them costs for each near pair that it finds, in looks at a capsule.
    double cost_of_finding(double factor, int dimensions) const;

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [count, most, by_way, width, way, growth, due] = self;
      archive(count, most, by_way, width, way, growth, due);
    }
  };

  /// What those that started last as most did tell of wider capsules.
  struct PriceOfWidth {
    double short_side = 0.0;
    double long_side = 0.0;
    double pairs = 0.0;  ///< the price of those of a body, in looks at a capsule

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [across, along, due] = self;
      archive(across, along, due);
    }
  };

  double looks(std::uint64_t searches, double found, double times_longer) const;
  double main_rate(double times_longer, const RenewalCounts& updates, double windows) const;
  double fast_rate(double times_longer) const;
  void note_price();
  void adapt_main(const RenewalCounts& updates, double windows);
  void adapt_fast();

  double longest_way_;
  int dimensions_;
  int main_rung_ = 0;
  double typical_way_ = 0.0;
  double fast_way_ = 0.0;     ///< those that are much faster than most go no farther in their windows
  std::uint64_t bodies_ = 0;  ///< in all windows
  Starts main_;               ///< when most bodies started
  Starts fast_;               ///< of those that have started between
  double main_start_ = 0.0;   ///< when most did
  PriceOfWidth price_;
};

/// Bodies that start together, or some of them: rounds may be made side by side, and added up in any order.
class WindowPolicy::Sample {
 public:
  /// Needs the tempo to stay as it is. `most`: of all bodies, after start_main().
  Sample(const WindowPolicy& window_policy, bool most) : policy_(&window_policy), most_(most) {}

  /// A body starts in a window; `width` is that of its capsule without its way.
  void note(const SpeedBound& speed_bound, double width, int rung);
  Sample& operator+=(const Sample& more);
  /// Of a part of the bodies becomes that of all, as Survey::reduce() has it.
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
  double quantum() const;
  std::uint64_t quanta_in(double length) const;
  void add(double width, const SpeedBound& speed_bound, double time, double most);

  const WindowPolicy* policy_;
  bool most_;
  std::uint64_t bodies_ = 0;
  std::uint64_t in_main_ = 0;
  std::array<std::uint64_t, magnitudes> ways_gone_{};
  // Lengths in whole quanta, the sums of which do not depend on their order.
  std::uint64_t widths_ = 0;
  std::uint64_t ways_ = 0;
  std::uint64_t growths_ = 0;
};

}  // namespace kinesphere
