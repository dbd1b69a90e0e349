// Core finds which balls may touch, and when, as they move.
//
// Each ball has a *safe region*, a ball of space that does not move; its *neighbours*, which are the balls
// whose safe regions come within reach of its own; and one *due time*. Three invariants hold whenever time
// advances. Nothing else is needed for no contact to be missed:
//
//   H  The centre of a ball is in its safe region until Ball::own, and the ball meets no wall before.
//   N  If the safe regions of two balls come within reach of each other, each is in the other's list.
//   D  Of two neighbours, at least one has computed Ball::due since the velocity or the safe region of either
//      last changed, and the two do not touch before it. No ball is due after its own time.
//
// By H, two balls that touch are in safe regions within reach of each other, or one of the two is due. By N
// they are neighbours then, and by D one of the two is due no later than they touch.
//
// The invariants concern the true motion. A report makes a bound tighter, so it breaks none of them. A new
// velocity breaks H and D of that ball: `own` and `due` are computed anew, from its list. A ball that may
// leave its safe region gets another one, which breaks N, too: one search mends it.
//
// Sources: safe regions are those of continuous queries (Prabhakar et al., IEEE Trans. Computers 51, 2002),
// neighbour lists those of Verlet (Phys. Rev. 159, 1967), and one due time for each body that of Lubachevsky
// (J. Comp. Phys. 94, 1991). Bounds and their certificates are the paper's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/balls.hpp"
#include "core/due_queue.hpp"
#include "core/neighbour_lists.hpp"
#include "core/region_cells.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere::core {

/// Two balls, or a ball and a wall, that are within the contact tolerance by reports of the present time.
struct Near {
  std::uint32_t first;   ///< the one that was due
  std::uint32_t second;  ///< none for a wall
  Wall wall = Wall::none;
};

/// Gives the states of balls to the core.
class Reporter {
 public:
  /// Returns the state of a ball at the present time.
  virtual State report(std::uint32_t ball, double time) = 0;

 protected:
  ~Reporter() = default;
};

struct CoreCounters {
  std::uint64_t probes = 0;
  std::uint64_t due = 0;         ///< balls that came to be due
  std::uint64_t regions = 0;     ///< safe regions that were chosen
  std::uint64_t scans = 0;       ///< lists that were scanned
  std::uint64_t scanned = 0;     ///< neighbours in them
  std::uint64_t candidates = 0;  ///< those of them that may be met before what is known to be due
};

class Core {
 public:
  /// The space, walls, tolerance and start time are those of the definition, which has been checked. The
  /// reporter must outlive the core.
  Core(const WorldDefinition& definition, Reporter& reporter);

  double time() const { return balls_.time(); }
  /// Returns the balls by number, and their bounds.
  const Balls& balls() const { return balls_; }
  const CoreCounters& counters() const { return counters_; }
  std::size_t bytes() const;

  /// Adds a ball with this bound, which begins at the present time. Returns its number: the least that is
  /// free.
  std::uint32_t add(const Bound& bound);
  void remove(std::uint32_t number);
  /// Returns the number that the next ball to be added gets.
  std::uint32_t lowest_free() const { return free_.empty() ? balls_.size() : free_.front(); }
  /// Gives a ball another bound, which begins at the present time.
  void replace(std::uint32_t number, const Bound& bound);
  /// Gives a ball another velocity from now on. Precondition: its position at present is known, by a report
  /// or since its bound does not grow.
  void set_velocity(std::uint32_t number, const Vec3& velocity);

  /// Advances until two may be in touch, at most to `until`. Returns the two; nothing at `until`. The caller
  /// then gives at least one of the two another velocity or bound, or calls put_off().
  std::optional<Near> next(double until);
  /// The caller is certain that what it does about these two can wait until `time`, which is later than now.
  void put_off(const Near& near, double time);

  /// Checks the invariants by brute force, as far as bounds tell. Returns the name of the first one that does
  /// not hold, or nullptr. Cost: O(n^2).
  const char* audit();

 private:
  // core.cpp: the loop.
  std::optional<Near> handle(std::uint32_t number);
  std::optional<Near> meet(std::uint32_t number, std::uint32_t other);
  std::optional<Near> meet_wall(std::uint32_t number);
  void postpone(std::uint32_t number, double time);
  void schedule(std::uint32_t number);
  void consider(Ball& ball, std::uint32_t other, double time);
  std::uint32_t candidates(std::uint32_t number, std::span<const std::uint32_t> neighbours) const;
  double apart_until(std::uint32_t number, std::uint32_t neighbour, double horizon) const;
  double least_gap(std::uint32_t number, std::uint32_t other) const;
  void probe(std::uint32_t number);
  void settle_changes();
  void prefetch() const;

  // safe_regions.cpp
  void leave_region(std::uint32_t number);
  void place_region(std::uint32_t number, double radius);
  void find_neighbours(std::uint32_t number);
  void forget_neighbours(std::uint32_t number);
  void place_arrivals();
  double first_radius() const;
  double next_radius(Ball& ball) const;
  double widest_region(const Ball& ball) const;
  float reach(const Ball& ball) const;
  Vec3 region_centre(const Ball& ball) const;

  // own_time.cpp
  void compute_own(std::uint32_t number, Wall without = Wall::none);
  double stays(std::uint32_t number) const;
  double clear_of_wall(std::uint32_t number, Wall wall) const;
  double wall_gap(std::uint32_t number, Wall wall) const;

  int dimensions_;
  std::optional<Box> walls_;
  Vec3 origin_{};     ///< of region units: the corner of the primary box on axes that repeat
  double unit_;       ///< one region unit (length), a power of two
  double margin_;     ///< for rounding (length)
  double tolerance_;  ///< contact tolerance (length)

  Balls balls_;
  NeighbourLists lists_;
  RegionCells cells_;
  DueQueue queue_;
  std::vector<std::uint32_t> changed_;  ///< balls for which invariants do not hold, in order of the changes
  std::vector<std::uint32_t> free_;     ///< numbers without a ball, as a heap
  std::optional<Near> near_;            ///< what next() has returned and the caller has not dealt with
  std::size_t queued_for_ = 0;          ///< how many numbers there were when the queue was filled
  Reporter& reporter_;
  CoreCounters counters_;
  // Members only to reuse their memory.
  std::vector<std::uint32_t> found_, gone_, new_;
};

}  // namespace kinesphere::core
