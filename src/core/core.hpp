// Core finds which balls may touch, and when, as they move.
//
// Each ball has a *safe region*, a ball of space that does not move; its *neighbours*, which are the balls
// whose safe regions come within reach of its own; and one *due time*. Three invariants hold whenever time
// advances. Nothing else is needed for no contact to be missed:
//
//   H  The centre of a ball is in its safe region until Ball::own, and the ball meets no wall before.
//   N  If the safe regions of two balls come within reach of each other, each is in the other's list, unless
//      the two never have to do with each other (Host::keep_partners()). A ball that never moves, a passive
//      one, has no list: it is in those of others.
//   D  Of two neighbours, the one whose velocity or safe region has changed last looks out for the other: it
//      has computed Ball::due since, and the two do not touch before it. Of two that have changed together,
//      it is the one with the higher number. No ball is due after its own time. A ball in exact flight that
//      stays in its safe region for longer than it knew has changed, too.
//
// By H, two balls that touch are in safe regions within reach of each other, or one of the two is due. By N
// they are neighbours then, and by D one of the two is due no later than they touch.
//
// Where images slide (space/space.hpp), two regions may come within reach across y while neither moves. So a
// ball whose search reaches across y looks in these images for all that come within reach until the end of
// its search, `search_ends_`, by when they slide by no more than Space::most_slide: its own time comes no
// later, and it searches anew. Of the two the one that has searched last has found the other one, if they
// are within reach of each other at any time until then. In sum: N holds of the images at each time.
//
// The invariants concern the true motion. A report makes a bound tighter, so it breaks none of them. A new
// velocity breaks H and D of that ball: `own` and `due` are computed anew, from its list. A ball that may
// leave its safe region gets another one, which breaks N, too: one search mends it.
//
// A ball of the core is a body with the space around it in which others matter to it: the ball around its
// shape, so large that those of two that sense each other overlap. Where two of these may overlap, or one
// reaches a wall, the host says what that means: nothing until a certain time, or a contact.
//
// Sources: safe regions are those of continuous queries (Prabhakar et al., IEEE Trans. Computers 51, 2002),
// neighbour lists those of Verlet (Phys. Rev. 159, 1967), and one due time for each body that of Lubachevsky
// (J. Comp. Phys. 94, 1991). Bounds and their certificates are the paper's.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/balls.hpp"
#include "core/due_queue.hpp"
#include "core/first_radii.hpp"
#include "core/ghosts.hpp"
#include "core/host.hpp"
#include "core/neighbour_lists.hpp"
#include "core/region_cells.hpp"
#include "core/stay_counts.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/world_definition.hpp"
#include "number/infinity.hpp"
#include "parallel/thread_pool.hpp"
#include "space/space.hpp"

namespace kinesphere::core {

class Core {
 public:
  /// The space, walls and start time are those of the definition, which has been checked.
  explicit Core(const WorldDefinition& definition);

  double time() const { return balls_.time(); }
  /// Advances the clock. Precondition: nothing is due before.
  void set_time(double time) {
    balls_.set_time(time);
    if (space_.slides()) [[unlikely]]
      balls_.set_slide(space_.slide_at(time));
  }
  /// Returns the balls by number, and their bounds.
  const Balls& balls() const { return balls_; }
  /// Returns the memory in use (bytes): of balls and their safe regions, and of who is due and why.
  std::size_t region_bytes() const { return balls_.bytes() + cells_.bytes(); }
  std::size_t due_bytes() const { return lists_.bytes() + queue_.bytes(); }

  bool contains(std::uint32_t number) const { return number < balls_.size() && balls_[number].is_present(); }
  /// Enters a ball with this bound, the radius of which includes the space in which it senses others. A
  /// passive one never moves. It has to be told as changed before anything else.
  void enter(std::uint32_t number, const Bound& bound, bool is_passive, bool meets_walls);
  /// Lets find() find a ball that has entered from now on, before it is told as changed.
  void show(std::uint32_t number);
  void leave(std::uint32_t number);
  /// The ball has reported: its bound begins anew, within what was known.
  void report(std::uint32_t number, const State& state) {
    balls_.set_state(number, state);
    note_course(number);
  }
  /// The ball has another bound, which may be anywhere. It has to be told as changed.
  void set_bound(std::uint32_t number, const Bound& bound);
  /// The ball begins or ceases to touch or sense others, to touch walls (it is linked then, too), or to be
  /// one that meets others just where its bound does (Ball::plain). It has to be told as changed.
  void set_kind(std::uint32_t number, bool is_linked, bool touches_walls, bool is_plain) {
    Ball& ball = balls_[number];
    ball.set(Ball::linked, is_linked);
    ball.set(Ball::plain, is_plain);
    ball.walls =
        static_cast<std::uint8_t>(touches_walls ? ball.walls | Ball::at_walls : ball.walls & ~Ball::at_walls);
  }
  /// Restores the invariants, which hold but for these balls: they have arrived, or move in another way, or
  /// what they are to others has changed. The threads of the lease share what concerns many. Cost: one scan
  /// for each.
  void settle(std::span<const std::uint32_t> changed, Host& host, PoolLease& lease);

  /// Returns when something is due next; infinity if that is later than `until`.
  double next_due(double until) { return queue_.first(balls_.all(), until).time; }
  /// Handles what is due now. Precondition: next_due() has just returned now. Errors: those of the reports;
  /// it is due again then.
  Result<void> handle_next(Host& host);

  /// Serializes what rebuild() cannot find again.
  static void serialize(auto& self, auto& archive) {
    archive(self.balls_, self.changes_, self.search_ends_, self.largest_reach_, self.reach_uses_,
            self.first_radius_, self.measured_);
    if constexpr (std::is_const_v<std::remove_reference_t<decltype(self)>>) {
      archive(self.saved());
    } else {
      archive(self.saved_);
    }
  }
  /// Returns true if a ball with this bound, which was read from bytes, can have a safe region at `time`.
  bool can_hold(const Bound& bound, double time) const;
  /// Returns true if the ball may leave its safe region at `time`: it reports before it gets another one, so
  /// its bound may be of any size.
  bool reports_now(std::uint32_t number, double time) const;
  /// Makes the rest anew after reading, at this time. Returns false if no core could have been so.
  bool rebuild(double time);

  // A core with ghosts has a part of the balls of a world.
  /// What a core knows of a ball.
  struct Record {
    Ball ball{};
    Drift drift{};
    std::uint64_t change = 0;
    float reach = 0.0F;                       ///< of its safe region; 0 without one (region units)
    std::vector<std::uint32_t> neighbours{};  ///< in their order
    static void serialize(auto& self, auto& archive) {
      archive(self.ball, self.drift.planned_acceleration, self.drift.growth_speed, self.change, self.reach,
              self.neighbours);
    }
  };
  Record record_of(std::uint32_t number) const;
  /// Adopts a ball as another core knows it at this time, its neighbours by their numbers here. be_part() has
  /// to follow when all are there, and of two neighbours each has to have the other.
  void adopt(std::uint32_t number, const Record& record);
  /// Takes part of a world: `ghosts` says which balls are ghosts, and notes what happens. `first_radius`
  /// (length): Core::first_radius() of the whole world. `grows`, `drifts`: what Balls::any_grows() and
  /// Balls::drifts() say of the whole.
  void be_part(Ghosts& ghosts, double first_radius, bool grows, bool drifts);
  bool is_ghost(std::uint32_t number) const { return ghosts_ != nullptr && ghosts_->is_ghost(number); }
  /// Notes numbers on which the course of others depends, beside what the core knows of the ball.
  void note_beside(std::uint32_t number, auto... numbers) {
    if (ghosts_ != nullptr) ghosts_->note(number, numbers...);
  }

  // Queries.
  /// What a ball is due about, and when.
  struct Certificate {
    std::uint32_t other;  ///< none for the walls
    double until;
  };
  /// Returns the certificate that a ball waits for; nullopt if it is that of its safe region.
  std::optional<Certificate> certificate_of(std::uint32_t number) const;
  /// Returns a time before which the ball stays in its safe region, and is due for nothing of which
  /// certificate_of() does not tell.
  double stays_until(std::uint32_t number) const {
    const Ball& ball = balls_[number];
    return ball.about == number ? ball.due : ball.own;
  }
  /// Returns the numbers of all balls that may be within `radius` of `centre` (lengths), and possibly others,
  /// in any order.
  std::vector<std::uint32_t> find(const Vec3& centre, double radius) const;
  /// Returns the centre (length) and the reach (length) of the safe region of a ball: it is within.
  Vec3 region_centre(std::uint32_t number) const { return region_centre(balls_[number]); }
  double region_reach(std::uint32_t number) const {
    return double{cells_.reach_of(balls_[number].slot)} * unit_;
  }
  /// Returns the cells of safe regions that are not empty, each with the number of regions whose centres are
  /// in it. Cost: O(n log n).
  std::vector<std::pair<Box, std::size_t>> cells() const;
  /// Returns the median reach of safe regions (length), as it was when cells were last chosen.
  double median_reach() const { return cells_.median_reach() * unit_; }
  /// Counts the balls that move, other than ghosts, by how long they stay in their safe regions from now on.
  /// Cost: O(n).
  StayCounts count_stays() const;

  /// What a check may expect of two balls. Of a ball with itself: `nothing` while it waits for settle(), and
  /// that it is in its safe region if it meets others as a ball.
  enum class Claim { nothing, neighbours, meet_as_balls };
  /// Checks the invariants by brute force, as far as bounds tell. Returns the name of the first one that does
  /// not hold, or nullptr. Cost: O(n^2).
  const char* audit(const std::function<Claim(std::uint32_t, std::uint32_t)>& claim_of) const;

 private:
  void note_course(std::uint32_t number) {
    if (ghosts_ != nullptr) note_all(number);
  }

  double least_distance(const Ball& a, const Ball& b, double end) const;

  // core.cpp: the loop.
  Result<void> handle(std::uint32_t number, Host& host);
  Result<void> handle_own(std::uint32_t number, Host& host);
  Result<double> recheck(std::uint32_t number, std::uint32_t other, Host& host);
  void postpone(std::uint32_t number, double time);
  void schedule_anew(std::uint32_t number, Host& host);
  double holds_until(std::uint32_t number, std::uint32_t other) const;
  void prefetch() const;

  /// A changed ball may be elsewhere than in its safe region, by which others find it.
  bool may_be_elsewhere(std::uint32_t number) const {
    return !balls_[number].is(Ball::at_wall) && !(balls_[number].own > balls_.time());
  }

  // batch.cpp
  /// A ball and one that it looks out for, which it may meet but not for the time `apart` from now.
  struct Meeting {
    std::uint32_t ball, other;
    double apart;
  };
  /// What a thread finds out about a part of a batch, and its memory, to reuse.
  struct Part {
    std::vector<std::uint32_t> first, second;  ///< pairs of some balls
    std::vector<double> apart;
    std::vector<Meeting> undecided;
    std::vector<std::uint32_t> leaving;  ///< those that may be elsewhere than in their safe regions
    std::vector<std::uint32_t> near;     ///< those that may be in touch
    std::vector<std::uint32_t> linked;
    std::vector<std::uint32_t> queued;  ///< those that the queue has to enter
    Counters work;
  };
  bool is_batch(std::span<const std::uint32_t> changed) const;
  void for_each_part(std::span<const std::uint32_t> changed, PoolLease& lease, auto work);
  void set_own_of_many(std::span<const std::uint32_t> changed, Host& host, PoolLease& lease);
  void set_own_of_some(std::span<const std::uint32_t> some, Part& part, Host& host);
  void note_changes(std::span<const std::uint32_t> changed, Host& host, PoolLease& lease);
  void schedule_many(std::span<const std::uint32_t> changed, Host& host, PoolLease& lease);
  std::size_t list_pairs(std::span<const std::uint32_t> some, Part& part);
  void find_due_of(std::span<const std::uint32_t> some, Part& part);
  void ask_host(Part& part, Host& host);

  // scan.cpp
  void note_change(std::uint32_t number, Host& host);
  void schedule(std::uint32_t number, bool is_last, Host& host);
  void find_due(std::uint32_t number, bool is_last, Host& host);
  static void begin_scan(Ball& ball);
  void find_linked(std::uint32_t number, std::vector<std::uint32_t>& linked, Host& host) const;
  [[nodiscard]] bool look_out_for(std::uint32_t number, std::uint32_t other, double apart,
                                  std::span<const std::uint32_t> linked, Counters& work, Host& host);
  void look_out_for_linked(std::uint32_t number, std::span<const std::uint32_t> linked, Counters& work,
                           Host& host);
  /// Returns true if of two neighbours the first one looks out for the other: it has changed last.
  bool looks_out_for(std::uint32_t number, std::uint32_t other) const {
    const std::uint64_t own = changes_[number], change = changes_[other];
    // Without a branch, which nobody can predict.
    return (change < own) | ((change == own) & (other < number));
  }
  std::span<const std::uint32_t> looked_out_for(std::uint32_t number,
                                                std::span<const std::uint32_t> neighbours,
                                                std::span<std::uint32_t> room) const;
  void consider(Ball& ball, std::uint32_t other, double time);
  PairQuery pair_query() const;
  std::uint32_t candidates(std::uint32_t number, std::span<const std::uint32_t> neighbours, double duration,
                           std::span<double, most_lanes> apart) const;
  double apart_until(std::uint32_t number, std::uint32_t neighbour, double horizon) const;
  double apart_until(const BoundAt& own, const BoundAt& other, double horizon) const;
  [[gnu::cold]] double apart_in_rows_until(std::uint32_t number, std::uint32_t neighbour,
                                           double horizon) const;

  // safe_regions.cpp
  Result<void> leave_region(std::uint32_t number, Host& host);
  void move_region(std::uint32_t number, Host& host);
  void place_region(std::uint32_t number, double radius);
  void enter_region(std::uint32_t number, double radius, bool is_of_many, Host& host);
  void find_neighbours(std::uint32_t number, Host& host);
  void join_lists(std::uint32_t number, Host& host);
  void compare_neighbours(std::uint32_t number, Host& host);
  void update_lists(std::uint32_t number);
  void forget(std::uint32_t number, std::uint32_t neighbour);
  void forget_neighbours(std::uint32_t number);
  void set_search_end(std::uint32_t number);
  void search_rows(const Ball& ball, float reach, double duration, RegionSearch& search) const;
  void measure_reaches();
  void move_to_row(std::uint32_t number, Vec3& place);
  std::vector<std::uint32_t> all_with_regions() const;
  double next_radius(std::uint32_t number);
  double near_now(std::uint32_t number) const;
  double widest_region(const Ball& ball) const;
  [[gnu::cold]] double widest_on_x(const Ball& ball) const;
  float reach(const Ball& ball) const;
  Vec3 region_centre(const Ball& ball) const;

  // rebuild.cpp
  void assemble();
  [[gnu::cold]] void note_all(std::uint32_t number);
  /// What a snapshot holds beside the balls, by number.
  struct Saved {
    std::vector<float> reaches;  ///< with which safe regions were entered
    std::vector<std::vector<std::uint32_t>> lists;
    static void serialize(auto& self, auto& archive) { archive(self.reaches, self.lists); }
  };
  Saved saved() const;
  bool may_be_near(const Ball& a, float reach_of_a, const Ball& b, float reach_of_b) const;
  bool is_valid(std::uint32_t number, std::span<const std::vector<std::uint32_t>> lists) const;

  // arrivals.cpp
  void place_arrivals(std::span<const std::uint32_t> changed, Host& host);
  void choose_radii(std::span<Arrival> arrivals);
  double radius_among_others(std::uint32_t number);
  void join_crowd(std::uint32_t number, Host& host);
  void choose_first_radius();

  // own_time.cpp
  void set_own(std::uint32_t number, double stay, Host& host);
  void set_own_later(std::uint32_t number, double stay, Host& host);
  void set_stay(std::uint32_t number, double stay);
  void limit_own(std::uint32_t number, double walls_until);
  double stays(std::uint32_t number) const;
  double stays_inside(std::uint32_t number) const;
  double keeps_image(std::uint32_t number) const;
  double searched_for(std::uint32_t number) const {
    return space_.slides() ? std::max(search_ends_[number] - balls_.time(), 0.0) : infinity;
  }
  double clear_of_walls(std::uint32_t number, Host& host) const;
  double clear_of_wall(std::uint32_t number, const HalfSpace& inside) const;

  int dimensions_;
  Space space_;
  std::vector<std::pair<Wall, HalfSpace>> walls_;  ///< that there are, and what is on the inner side of each
  Vec3 origin_{};     ///< of region units: the corner of the primary box on axes that repeat
  double unit_;       ///< one region unit (length), a power of two
  double margin_;     ///< for rounding (length)
  double tolerance_;  ///< contact tolerance (length)
  double parting_;    ///< gap at which two certainly touch no longer (length)

  Balls balls_;
  NeighbourLists lists_;
  RegionCells cells_;
  DueQueue queue_;
  /// By number: of two neighbours, the one that has changed last has the larger value; those that have
  /// changed together may have the same one. 0 for passive ones.
  std::vector<std::uint64_t> changes_;
  /// By number, empty unless images slide: until when the last search of the ball holds in the images across
  /// y; infinity if it does not reach there.
  std::vector<double> search_ends_;
  /// Where images slide: no reach of a safe region is larger (region units). So often it has been used since
  /// it was the least such number.
  float largest_reach_ = 0.0F;
  std::size_t reach_uses_ = 0;
  Ghosts* ghosts_ = nullptr;    ///< nullptr where each ball is the world's own
  double first_radius_ = 0.0;   ///< of the first safe region of a ball that arrives alone (length)
  Saved saved_;                 ///< from a snapshot, until rebuild()
  std::size_t present_ = 0;     ///< how many balls there are
  std::size_t arriving_ = 0;    ///< how many of them are arriving
  std::size_t measured_ = 0;    ///< how many there were when first_radius_ was chosen
  std::size_t queued_for_ = 0;  ///< how many numbers there were when the queue was filled
  // Members only to reuse their memory.
  RegionSearch search_;
  std::vector<std::uint32_t> gone_, new_, settling_, linked_;
  std::vector<Part> parts_;
};

}  // namespace kinesphere::core
