// The kinetic theory behind the cost model. A bound lives from one reset to the next: it grows, may meet
// another bound or a wall at any age, and is reset at the latest when it fills its cell.
#include "research/rivals/event_driven/cost_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Returns e^-x for x >= 0, to 1e-7, by operations that give the same bits on every machine.
double exp_minus(double x) {
  const double y = x / 1024.0;
  double power = 1.0 / (1.0 + y * (1.0 + y * (1.0 / 2.0 + y * (1.0 / 6.0))));
  for (int squaring = 0; squaring < 10; ++squaring) power *= power;
  return power;
}

/// Returns the mean of max(0, u + growth) for u uniform in [-speed, speed], which is the distribution of one
/// component of a velocity with random direction: the speed at which a growing surface sweeps over what is
/// ahead.
double closing_speed(double speed, double growth) {
  return growth < speed ? (speed + growth) * (speed + growth) / (4.0 * speed) : growth;
}

/// Meetings and resets for each contact. Before a contact is certain the two bounds meet again and again,
/// each time after a shorter time; then the bodies bounce, which makes all predictions about them stale.
constexpr double looks_at_contact = 2.5;
constexpr double resets_at_bounce = 1.0;

/// Returns the time until the bound has the diameter `edge` (paper, eq 8).
double time_to_reset(const MovingSphere& sphere, double edge) {
  constexpr double longest = 1e30;
  const double margin = std::max(0.0, 0.5 * edge - sphere.radius);
  const double speed = sphere.growth_speed;
  return std::min(2.0 * margin / (speed + std::sqrt(speed * speed + 2.0 * sphere.limit * margin)), longest);
}

}  // namespace

/// One grid, and the bounds assigned to it at a random instant.
struct CostModel::Level {
  double edge = 0.0;
  std::size_t first = 0, last = 0;  ///< samples of the level, [first, last), which are sorted by radius
  double bodies = 0.0;
  // Means over the bodies of the level.
  double radius = 0.0, radius_squared = 0.0;  ///< of the bound
  double growth_speed = 0.0;
  double speed_squared = 0.0;
};

/// Averages over a bound's life from one reset to the next.
struct CostModel::Cycle {
  double length = 0.0;                 ///< time
  double meetings = 0.0, walls = 0.0;  ///< probabilities that a colliding event ends the cycle
  double candidates_kept = 0.0;        ///< meetings predicted before the reset
  // Means over the length of the cycle.
  double radius = 0.0, radius_squared = 0.0, growth_speed = 0.0;
  double face_speed = 0.0;  ///< mean of max(0, speed at which a face of its box advances)
};

/// Averages over what a search finds.
struct CostModel::Neighbours {
  double cells = 0.0, new_cells = 0.0;  ///< cells searched: all of the body; those of a layer that it enters
  double pairs = 0.0, new_pairs = 0.0;  ///< pairs in these cells; pairs that were no neighbours before
  double visits = 0.0, new_visits = 0.0;  ///< bodies visited, once for each shared cell
};

CostModel::CostModel(const std::vector<MovingSphere>& spheres, const Box& extent, bool has_walls)
    : extent_(extent), walls_(has_walls) {
  constexpr std::size_t most_samples = 200;
  std::vector<MovingSphere> sorted = spheres;
  const auto key = [](const MovingSphere& s) {
    return std::tuple(s.radius, s.speed, s.limit, s.growth_speed);
  };
  std::sort(sorted.begin(), sorted.end(),
            [&](const MovingSphere& a, const MovingSphere& b) { return key(a) < key(b); });
  const std::size_t count = std::min(sorted.size(), most_samples);
  for (std::size_t k = 0; k < count; ++k)
    samples_.push_back(sorted[(2 * k + 1) * sorted.size() / (2 * count)]);
  const auto bodies = static_cast<double>(sorted.size());
  weight_ = bodies / static_cast<double>(std::max<std::size_t>(count, 1));
  others_ = sorted.empty() ? 0.0 : (bodies - 1.0) / bodies;

  const Vec3 size = extent.upper - extent.lower;
  const double largest = std::max({size.x, size.y, size.z});
  const double widest = sorted.empty() ? 0.0 : 2.0 * sorted.back().radius;
  double least_side = std::max(widest, largest / 1024.0);
  if (!(least_side > 0.0)) least_side = 1.0;
  double filled = 0.0;
  for (const MovingSphere& s : sorted)
    filled += 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius;
  for (int axis = 0; axis < 3; ++axis) sides_[axis] = std::max(size[axis], least_side);
  // Hard spheres crowd around each other (Carnahan and Starling 1969).
  const double packing = std::min(filled / (sides_.x * sides_.y * sides_.z), 0.5);
  contact_density_ = (1.0 - 0.5 * packing) / ((1.0 - packing) * (1.0 - packing) * (1.0 - packing));
}

/// Returns the number of planes between cells inside of the extent, per length of an axis; the mean of the
/// axes. A plane that coincides with a face of the extent has bounds on one side only and counts half.
double CostModel::planes_per_length(double edge) const {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = extent_.lower[axis] / edge;
    const double upper = extent_.upper[axis] / edge;
    const double inside = std::ceil(upper) - std::floor(lower) - 1.0;
    const double inside_or_on = std::floor(upper) - std::ceil(lower) + 1.0;
    sum += 0.5 * (std::max(0.0, inside) + std::max(0.0, inside_or_on)) / sides_[axis];
  }
  return sum / 3.0;
}

/// Returns the volume of a cube, cut to the size of the extent.
double CostModel::volume_within(double length) const {
  return std::min(length, sides_.x) * std::min(length, sides_.y) * std::min(length, sides_.z);
}

/// Returns the grids in use, with bounds as they are just after a reset.
std::vector<CostModel::Level> CostModel::levels_of(double finest_edge) const {
  std::vector<Level> levels;
  double edge = finest_edge;
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const double radius = samples_[k].radius;
    while (edge < 4.0 * radius) edge *= 2.0;
    if (levels.empty() || levels.back().edge != edge) levels.push_back({.edge = edge, .first = k});
    levels.back().last = k + 1;
  }
  for (Level& level : levels) {
    const auto count = static_cast<double>(level.last - level.first);
    level.bodies = count * weight_ * others_;
    for (std::size_t k = level.first; k < level.last; ++k) {
      const MovingSphere& sphere = samples_[k];
      level.radius += sphere.radius / count;
      level.radius_squared += sphere.radius * sphere.radius / count;
      level.growth_speed += sphere.growth_speed / count;
      level.speed_squared += sphere.speed * sphere.speed / count;
    }
  }
  return levels;
}

/// Returns the colliding events per time of a growing bound of this radius with all other bounds. In a gas of
/// density n, the spheres that come into touch with one sphere are those that its surface, enlarged by their
/// own radius, sweeps up: n times its area times the mean closing speed.
double CostModel::meeting_rate(double radius, double growth_speed, double speed,
                               const std::vector<Level>& levels) const {
  double rate = 0.0;
  for (const Level& level : levels) {
    const double reach_squared = radius * radius + 2.0 * radius * level.radius + level.radius_squared;
    const double relative_speed = std::sqrt(speed * speed + level.speed_squared);
    rate += level.bodies * 4.0 * std::numbers::pi * reach_squared *
            closing_speed(relative_speed, growth_speed + level.growth_speed);
  }
  return rate * contact_density_ / volume_within(infinity);
}

double CostModel::wall_rate(double growth_speed, double speed) const {
  if (!walls_) return 0.0;
  const double walls_per_length = 2.0 / sides_.x + 2.0 / sides_.y + 2.0 / sides_.z;
  return walls_per_length * closing_speed(speed, growth_speed);
}

/// Integrates over the age of the bound. The steps are shorter early in the cycle, as many bounds are reset
/// early.
CostModel::Cycle CostModel::cycle_of(const MovingSphere& sphere, const Level& own,
                                     const std::vector<Level>& levels) const {
  constexpr int steps = 10;
  const double whole = time_to_reset(sphere, own.edge);
  Cycle cycle;
  double alive = 1.0;
  for (int step = 0; step < steps; ++step) {
    const double part = static_cast<double>(step) / steps;
    const double width = whole * (2.0 * part + 1.0 / steps) / steps;
    const double age = whole * part * part + 0.5 * width;
    const double radius = sphere.radius + (sphere.growth_speed + 0.5 * sphere.limit * age) * age;
    const double growth_speed = sphere.growth_speed + sphere.limit * age;
    const double meetings = meeting_rate(radius, growth_speed, sphere.speed, levels);
    const double wall_hits = wall_rate(growth_speed, sphere.speed);
    const double rate = meetings + wall_hits;

    const double alive_after = alive * exp_minus(rate * width);
    const double spent = rate * width > 1e-6 ? (alive - alive_after) / rate : alive * width;
    alive = alive_after;
    cycle.length += spent;
    cycle.meetings += meetings * spent;
    cycle.walls += wall_hits * spent;
    cycle.candidates_kept += rate * width;
    cycle.radius += radius * spent;
    cycle.radius_squared += radius * radius * spent;
    cycle.growth_speed += growth_speed * spent;
    cycle.face_speed += closing_speed(sphere.speed, growth_speed) * spent;
  }
  for (double* sum : {&cycle.radius, &cycle.radius_squared, &cycle.growth_speed, &cycle.face_speed})
    *sum /= cycle.length;
  return cycle;
}

/// Returns the level with means over bounds of all ages, weighted by the time they last.
CostModel::Level CostModel::aged(const Level& level, const std::vector<Level>& levels) const {
  Level result = level;
  result.radius = result.radius_squared = result.growth_speed = 0.0;
  const auto count = static_cast<double>(level.last - level.first);
  for (std::size_t k = level.first; k < level.last; ++k) {
    const Cycle cycle = cycle_of(samples_[k], level, levels);
    result.radius += cycle.radius / count;
    result.radius_squared += cycle.radius_squared / count;
    result.growth_speed += cycle.growth_speed / count;
  }
  return result;
}

/// Returns the neighbours of a bound of this width. Two bodies are neighbours if cells of theirs intersect,
/// on the coarser of their two grids. On each axis a pair reaches as far as a cell and the widths of the two
/// bounds.
CostModel::Neighbours CostModel::neighbours_of(double width, const Level& own,
                                               const std::vector<Level>& levels) const {
  const auto cells_along = [this](double length, double edge) {
    return 1.0 + length * planes_per_length(edge);
  };
  const auto squared = [](double x) { return x * x; };
  const auto cubed = [](double x) { return x * x * x; };
  Neighbours neighbours;
  neighbours.cells = cubed(cells_along(width, own.edge));
  neighbours.new_cells = squared(cells_along(width, own.edge));
  for (const Level& other : levels) {
    const double other_width = 2.0 * other.radius;
    const double density = other.bodies / volume_within(infinity);
    const double edge = std::max(own.edge, other.edge);
    const double reach = edge + width + other_width;
    const double pairs = density * volume_within(reach);
    neighbours.pairs += pairs;
    neighbours.new_pairs += pairs * std::min(1.0, own.edge / reach);
    const double in_cell = density * volume_within(edge) * cubed(cells_along(other_width, other.edge));
    neighbours.visits += in_cell * cubed(cells_along(width, edge));
    neighbours.new_visits += in_cell * squared(cells_along(width, edge));
  }
  return neighbours;
}

/// Adds the rates and the cost of the bodies that one sample stands for.
void CostModel::add_rates(ExpectedRates& rates, const MovingSphere& sphere, const Level& own,
                          const std::vector<Level>& levels, const std::vector<Level>& fresh) const {
  const Cycle cycle = cycle_of(sphere, own, levels);
  const double contacts = meeting_rate(sphere.radius, sphere.growth_speed, sphere.speed, fresh);
  const double wall_contacts = wall_rate(sphere.growth_speed, sphere.speed);
  const double meetings = cycle.meetings / cycle.length + looks_at_contact * contacts;
  const double wall_hits = cycle.walls / cycle.length + looks_at_contact * wall_contacts;
  const double outgrown = std::max(0.0, 1.0 - cycle.meetings - cycle.walls) / cycle.length;
  const double resets = outgrown + meetings + wall_hits + resets_at_bounce * (contacts + wall_contacts);
  const double planes = 3.0 * planes_per_length(own.edge);
  const double entering = 2.0 * planes * cycle.face_speed;
  const double leaving = 2.0 * planes * (cycle.face_speed - cycle.growth_speed);
  const Neighbours all = neighbours_of(2.0 * sphere.radius, own, levels);
  const Neighbours grown = neighbours_of(2.0 * cycle.radius, own, levels);
  const double searches = static_cast<double>(levels.size());
  const double own_candidates = 2.0 + (entering + leaving) * cycle.length;
  const double kept_part = std::min(1.0, cycle.candidates_kept / std::max(all.pairs, 1e-300));
  const double reset_cost = UnitCosts::probe + all.pairs * UnitCosts::pair_test +
                            all.visits * UnitCosts::visit +
                            2.0 * (own_candidates + all.pairs * kept_part) * UnitCosts::tree_operation +
                            (searches * all.cells + 2.0 * (grown.cells - 1.0)) * UnitCosts::cell_operation;
  const double entering_cost =
      grown.new_pairs * (UnitCosts::pair_test + kept_part * UnitCosts::tree_operation) +
      grown.new_visits * UnitCosts::visit + 4.0 * UnitCosts::tree_operation +
      (1.0 + searches) * grown.new_cells * UnitCosts::cell_operation;
  const double leaving_cost = 4.0 * UnitCosts::tree_operation + grown.new_cells * UnitCosts::cell_operation;

  rates.entering += weight_ * entering;
  rates.leaving += weight_ * leaving;
  rates.resetting += weight_ * outgrown;
  rates.colliding += weight_ * (0.5 * meetings + wall_hits);
  rates.pair_tests += weight_ * (resets * all.pairs + entering * grown.new_pairs);
  rates.visits += weight_ * (resets * all.visits + entering * grown.new_visits);
  rates.cost += weight_ * (resets * reset_cost + entering * entering_cost + leaving * leaving_cost);
}

ExpectedRates CostModel::expected_rates(double finest_edge) const {
  const std::vector<Level> fresh = levels_of(finest_edge);
  std::vector<Level> levels = fresh;
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Level> before = levels;
    for (Level& level : levels) level = aged(level, before);
  }
  ExpectedRates rates;
  for (const Level& level : levels)
    for (std::size_t k = level.first; k < level.last; ++k)
      add_rates(rates, samples_[k], level, levels, fresh);
  return rates;
}

double CostModel::choose_cell_edge() const {
  constexpr double root_of_two = 1.4142135623730951, fourth_root_of_two = 1.189207115002721;
  double best = 2.0 * std::max({sides_.x, sides_.y, sides_.z});
  double least_cost = infinity;
  const auto consider = [&](double edge) {
    const double cost = expected_rates(edge).cost;
    if (!(cost < least_cost)) return;
    least_cost = cost;
    best = edge;
  };
  constexpr int ladder_steps = 24;
  double edge = best;
  for (int step = 0; step < ladder_steps; ++step, edge /= root_of_two) consider(edge);
  const double coarse = best;
  for (const double factor : {fourth_root_of_two, 1.0 / fourth_root_of_two}) consider(coarse * factor);
  return best;
}

}  // namespace kinesphere
