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

  SearchCost& operator+=(const SearchCost& more) {
    capsules += more.capsules;
    rows += more.rows;
    found += more.found;
    hot += more.hot;
    return *this;
  }
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [seen, runs, near, due] = self;
    archive(seen, runs, near, due);
  }
};

/// Bodies that have got another capsule by themselves, within a window, and how many pairs became hot by
/// that. Nothing more is counted of them: what their searches cost depends on the order in which they come,
/// and the length of windows must not.
struct Kicks {
  std::uint64_t bodies = 0;
  std::uint64_t hot = 0;

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [count, due] = self;
    archive(count, due);
  }
};

/// Most bodies share windows of one length, the main one, 2^main_tier. In longer windows searches find more,
/// in shorter ones all bodies start more often. Those that are much faster than most have windows 8, 64, ...
/// times shorter, in which they may go farther than most if there is little in their way.
class Tempo {
 public:
  static constexpr int powers_between_tiers = 3;

  /// No body goes more than four times as far in a window as `longest_way` (length, > 0) if there is a
  /// shorter one.
  Tempo(double longest_way, int dimensions) : longest_way_(longest_way), dimensions_(dimensions) {}

  bool is_chosen() const { return typical_way_ > 0.0; }
  /// Before anything is known: windows in which a body of this pace goes this way (> 0) or the longest one.
  void choose(double way, const Pace& typical);
  int tier_for(const Pace& pace) const;
  /// Few bodies go farther in a main window (length).
  double typical_way() const { return typical_way_; }

  class Round;
  /// Most bodies are going to start. Chooses the length of the main windows, knowing what the searches of
  /// those that started last time have cost, and how many have been kicked since then.
  void start_main(double now, const Kicks& kicks);
  /// All of a round have started, so that there are so many bodies, and their searches have cost this much.
  void finish_start(const Round& round, const SearchCost& cost, std::size_t bodies);
  /// What it costs that the capsule of a typical body is so much wider (length), in looks at a capsule.
  double cost_of_width(double more) const;

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [longest, dimensions, tier, way, fast_way, bodies, main, fast, start, price] = self;
    archive(tier, way, fast_way, bodies, main, fast, start, price);
  }
  /// For one that was read.
  bool is_sound() const;

 private:
  static constexpr int least_magnitude = 40;

  /// Bodies that have started, and what that has cost.
  struct Starts {
    std::uint64_t bodies = 0;
    std::uint64_t in_main = 0;  ///< of them, in a main window
    /// How many went about 2^(k - least_magnitude) times the typical way, or less for k = 0.
    std::array<std::uint64_t, 64> magnitudes{};
    // Sums of what makes capsules large.
    double widths = 0.0;
    double ways = 0.0;     ///< straight on
    double growths = 0.0;  ///< on all sides, by what acceleration may do
    SearchCost cost;

    void add(double width, const Pace& pace, double time, double most);
    Starts& operator+=(const Starts& more);
    /// How much more they would be, and in how much more space, if windows were so many times as long.
    double times_longer(double factor) const { return long_side(factor) / long_side(1.0); }
    double times_larger(double factor, int dimensions) const;
    /// What they would cost then, among so many bodies, with so many rows, in looks at a capsule.
    double units(double factor, int dimensions, double among, double rows) const;
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [count, most, ways_gone, width, way, growth, searches] = self;
      archive(count, most, ways_gone, width, way, growth, searches);
    }

   private:
    double short_side(double factor) const { return widths + growths * factor * factor; }
    double long_side(double factor) const { return short_side(factor) + ways * factor; }
  };

  /// What those that started last as most did tell of wider capsules.
  struct PriceOfWidth {
    double short_side = 0.0;
    double long_side = 0.0;
    double capsules = 0.0;  ///< of each body
    double pairs = 0.0;     ///< the same: their price, in looks at a capsule

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [across, along, seen, due] = self;
      archive(across, along, seen, due);
    }
  };

  double main_rate(double times_longer, const Kicks& kicks, double windows) const;
  double fast_rate(double times_longer) const;
  void note_price();
  void adapt_main(const Kicks& kicks, double windows);
  void adapt_fast();

  double longest_way_;
  int dimensions_;
  int main_tier_ = 0;
  double typical_way_ = 0.0;
  double fast_way_ = 0.0;     ///< those that are much faster than most go no farther in their windows
  std::uint64_t bodies_ = 0;  ///< in all windows
  Starts main_;               ///< when most bodies started
  Starts fast_;               ///< of those that have started between
  double main_start_ = 0.0;   ///< when most did
  PriceOfWidth price_;
};

/// Bodies that start together, or some of them: rounds may be made side by side, and added up.
class Tempo::Round {
 public:
  /// Needs the tempo to stay as it is. `most`: of all bodies, after start_main().
  Round(const Tempo& tempo, bool most) : tempo_(&tempo), most_(most) {}

  /// A body starts in a window; `width` is that of its capsule without its way.
  void note(const Pace& pace, double width, int tier);
  /// Sums depend on the order in which they are made: always the same one, where results have to be.
  Round& operator+=(const Round& more) {
    starts_ += more.starts_;
    return *this;
  }

 private:
  friend class Tempo;
  const Tempo* tempo_;
  bool most_;
  Starts starts_;
};

}  // namespace kinesphere
