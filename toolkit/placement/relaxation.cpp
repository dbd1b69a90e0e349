#include "placement/relaxation.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "placement/sphere_grid.hpp"

namespace kinesphere {
namespace {

/// Pairs are pushed to this much more than the distance they need, so that a finite number of pushes frees
/// all. More takes more pushes, less leaves more pairs in contact; where it cannot be had it is halved.
constexpr double first_excess = 0.03;
constexpr double least_excess = 1e-4;
/// A push overshoots by this factor (over-relaxation). At 49 % 1.5 takes half of the sweeps that 1 takes; 1.7
/// takes more at 60 %.
constexpr double overshoot = 1.5;
/// Neighbours are remembered up to this part of their radius, and of the mean, beyond the excess. More gives
/// longer lists, less makes them out of date sooner.
constexpr double skin = 0.15;
/// Sweeps in which the overlap must shrink by the factor `least_progress`; fewer give up arrangements that
/// would be found, more delay failure.
constexpr int patience = 50;
constexpr double least_progress = 0.7;
/// Sweeps of random moves at the end. 20 bring the collision rate of a gas in its first unit of time
/// (diameter, mass and temperature are 1) to 1.06 of that in equilibrium at 40 %, and to 1.13 at 49 %.
constexpr int moving_sweeps = 20;

/// Returns spheres in another order: entry k of the result is entry order[k] of the argument.
template <class Item>
std::vector<Item> reordered(const std::vector<Item>& items, const std::vector<std::uint32_t>& order) {
  std::vector<Item> result;
  result.reserve(order.size());
  for (const std::uint32_t item : order) result.push_back(items[item]);
  return result;
}

class Relaxation {
 public:
  /// Precondition: spheres are in the order of SphereGrid.
  Relaxation(const SphereRoom& room, std::vector<Vec3> centres, Random random)
      : room_(room),
        random_(random),
        ranges_(ranges_of(room)),
        grid_(room_, ranges_),
        centres_(std::move(centres)) {}

  /// The ranges of the grid: half of the distance of neighbours.
  static std::vector<double> ranges_of(const SphereRoom& room) {
    std::vector<double> ranges;
    for (std::uint32_t sphere = 0; sphere < room.count(); ++sphere)
      ranges.push_back((1.0 + first_excess) * half_distance(room, sphere));
    const double mean = std::accumulate(ranges.begin(), ranges.end(), 0.0) / room.count();
    for (double& range : ranges) range += skin * (range + mean);
    return ranges;
  }

  bool run() {
    find_neighbours();
    double to_beat = infinity;
    for (int sweeps = 1; excess_ > least_excess; ++sweeps) {
      const double overlap = sweep();
      const std::size_t strayed = count_strayed();
      if (100 * strayed > centres_.size() || (overlap == 0.0 && strayed > 0)) find_neighbours();
      if (overlap == 0.0 && is_free()) return true;
      if (sweeps % patience != 0) continue;
      if (!(overlap < least_progress * to_beat)) excess_ *= 0.5;
      to_beat = overlap;
    }
    return false;
  }

  /// Moves each sphere at random where it finds room (Metropolis), with steps of which two in five succeed.
  void make_random_moves() {
    double step = 0.1;
    for (int sweep = 0; sweep < moving_sweeps; ++sweep) {
      if (sweep % 10 == 0) find_both_neighbours();
      std::uint32_t moves = 0;
      for (std::uint32_t sphere = 0; sphere < room_.count(); ++sphere) moves += try_to_move(sphere, step);
      step *= moves > 0.4 * room_.count() ? 1.1 : 0.9;
    }
  }

  std::vector<Vec3> centres() const { return centres_; }

 private:
  static double half_distance(const SphereRoom& room, std::uint32_t sphere) {
    return 0.5 * room.least_distance(sphere, sphere);
  }
  bool has_strayed(std::uint32_t sphere, const Vec3& centre) const {
    const double most = ranges_[sphere] - (1.0 + first_excess) * half_distance(room_, sphere);
    return norm_squared(centre - found_at_[sphere]) > most * most;
  }
  /// Returns how many spheres may have neighbours that are not in the list.
  std::size_t count_strayed() const {
    std::size_t strayed = 0;
    for (std::uint32_t sphere = 0; sphere < room_.count(); ++sphere)
      strayed += has_strayed(sphere, centres_[sphere]) ? 1 : 0;
    return strayed;
  }
  std::span<const std::uint32_t> neighbours(std::uint32_t sphere) const {
    return std::span(neighbours_).subspan(begins_[sphere], begins_[sphere + 1] - begins_[sphere]);
  }

  /// Lists each pair of neighbours with the later sphere.
  void find_neighbours() {
    grid_.clear();
    neighbours_.clear();
    begins_.assign(1, 0);
    for (std::uint32_t sphere = 0; sphere < room_.count(); ++sphere) {
      const Vec3 centre = centres_[sphere] = room_.wrapped(centres_[sphere]);
      grid_.all_near(sphere, centre, [&](std::uint32_t other) {
        const double distance = ranges_[sphere] + ranges_[other];
        if (norm_squared(room_.offset(centre, centres_[other])) < distance * distance)
          neighbours_.push_back(other);
        return true;
      });
      grid_.enter(sphere, centre);
      begins_.push_back(neighbours_.size());
    }
    found_at_ = centres_;
  }
  /// Lists each pair of neighbours with both.
  void find_both_neighbours() {
    find_neighbours();
    std::vector<std::size_t> begins(room_.count() + 2);
    for (std::uint32_t sphere = 0; sphere < room_.count(); ++sphere) {
      begins[sphere + 2] += neighbours(sphere).size();
      for (const std::uint32_t other : neighbours(sphere)) ++begins[other + 2];
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::uint32_t> both(begins.back());
    for (std::uint32_t sphere = 0; sphere < room_.count(); ++sphere) {
      for (const std::uint32_t other : neighbours(sphere)) {
        both[begins[sphere + 1]++] = other;
        both[begins[other + 1]++] = sphere;
      }
    }
    begins.pop_back();
    begins_ = std::move(begins);
    neighbours_ = std::move(both);
  }

  /// Pushes all neighbours apart once that are too close. Returns the sum of the overlaps as they were found,
  /// in parts of the distances that they need.
  double sweep() {
    double overlap = 0.0;
    for (std::uint32_t sphere = 0; sphere < room_.count(); ++sphere)
      for (const std::uint32_t other : neighbours(sphere)) overlap += push_apart(sphere, other);
    return overlap;
  }
  /// The smaller one moves more, as its cross-section is smaller.
  double push_apart(std::uint32_t a, std::uint32_t b) {
    const Vec3 apart = room_.offset(centres_[a], centres_[b]);
    const double needed = room_.least_distance(a, b);
    const double wanted = (1.0 + excess_) * needed;
    if (norm_squared(apart) > wanted * wanted) return 0.0;
    const double distance = norm(apart);
    const Vec3 push = (distance > 0.0 ? apart / distance : direction()) * (overshoot * (wanted - distance));
    const double area_a = room_.radii[a] * room_.radii[a], area_b = room_.radii[b] * room_.radii[b];
    const double share = area_a + area_b > 0.0 ? area_b / (area_a + area_b) : 0.5;
    centres_[a] = room_.inside_walls(a, centres_[a] - push * share);
    centres_[b] = room_.inside_walls(b, centres_[b] + push * (1.0 - share));
    return distance > needed ? 0.0 : 1.0 - distance / needed;
  }
  Vec3 direction() {
    Vec3 direction = random_.unit_vector();
    if (room_.dimensions == 2) direction = {direction.x < 0.0 ? -1.0 : 1.0, 0.0, 0.0};
    return direction;
  }

  bool is_free() const {
    for (std::uint32_t sphere = 0; sphere < room_.count(); ++sphere)
      if (!has_room(sphere, centres_[sphere])) return false;
    return true;
  }
  bool has_room(std::uint32_t sphere, const Vec3& centre) const {
    const auto near = neighbours(sphere);
    return std::none_of(near.begin(), near.end(), [&](std::uint32_t other) {
      return room_.overlap(sphere, centre, other, centres_[other]);
    });
  }
  bool try_to_move(std::uint32_t sphere, double step) {
    Vec3 centre = centres_[sphere];
    const double most = step * 2.0 * half_distance(room_, sphere);
    for (int axis = 0; axis < room_.dimensions; ++axis) centre[axis] += random_.uniform(-most, most);
    if (room_.inside_walls(sphere, centre) != centre || has_strayed(sphere, centre) ||
        !has_room(sphere, centre))
      return false;
    centres_[sphere] = centre;
    return true;
  }

  const SphereRoom& room_;
  Random random_;
  std::vector<double> ranges_;  ///< neighbours are as far apart as the sum of their ranges
  SphereGrid grid_;
  std::vector<Vec3> centres_;
  double excess_ = first_excess;
  std::vector<Vec3> found_at_;       ///< the centres when neighbours were last found
  std::vector<std::size_t> begins_;  ///< of each sphere and at the end, an index of neighbours_
  std::vector<std::uint32_t> neighbours_;
};

}  // namespace

std::optional<std::vector<Vec3>> relax_spheres(const SphereRoom& room, std::uint64_t seed) {
  Random random = Random::at(seed, 1, 0);
  std::vector<Vec3> centres;
  for (std::uint32_t sphere = 0; sphere < room.count(); ++sphere)
    centres.push_back(room.random_centre(sphere, random));
  const std::vector<double> ranges = Relaxation::ranges_of(room);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places;
  const SphereGrid grid(room, ranges);
  for (std::uint32_t sphere = 0; sphere < room.count(); ++sphere)
    places.emplace_back(grid.order(sphere, centres[sphere]), sphere);
  std::sort(places.begin(), places.end());
  std::vector<std::uint32_t> order;
  order.reserve(places.size());
  for (const auto& [place, sphere] : places) order.push_back(sphere);

  SphereRoom sorted = room;
  sorted.radii = reordered(room.radii, order);
  Relaxation relaxation(sorted, reordered(centres, order), random);
  if (!relaxation.run()) return std::nullopt;
  relaxation.make_random_moves();
  const std::vector<Vec3> found = relaxation.centres();
  for (std::uint32_t place = 0; place < room.count(); ++place)
    centres[order[place]] = room.wrapped(found[place]);
  return centres;
}

}  // namespace kinesphere
