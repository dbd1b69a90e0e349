// Measures what the parts of the event-driven detectors cost, one by one.
#include "lab/rivals/event_driven/unit_costs.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/random.hpp"
#include "lab/rivals/event_driven/crossing.hpp"
#include "lab/rivals/event_driven/event_tree.hpp"
#include "lab/rivals/event_driven/subspace_tree.hpp"

namespace kinesphere {
namespace {

/// Bodies in the trees that are measured.
constexpr std::uint32_t fewest_measured = 64, most_measured = 20000;
/// Of the least disturbed of a few batches of `count` calls work(0), work(1), ... . Their results are added
/// up, so that no compiler can leave them out.
template <class Work>
double nanoseconds_of(std::uint32_t count, Work work) {
  using Clock = std::chrono::steady_clock;
  constexpr int batches = 5;
  double least = std::numeric_limits<double>::infinity();
  volatile double sum = 0.0;
  for (int batch = 0; batch < batches; ++batch) {
    const Clock::time_point start = Clock::now();
    for (std::uint32_t k = 0; k < count; ++k) sum = sum + work(k);
    const std::chrono::duration<double, std::nano> taken = Clock::now() - start;
    least = std::min(least, taken.count() / count);
  }
  return least;
}

/// As many as there are bodies, one in a unit cube on average.
std::vector<Bound> random_bounds(std::uint32_t bodies) {
  Random random(1);
  double side = 1.0;
  while (side * side * side < bodies) side += 1.0;
  std::vector<Bound> bounds(bodies);
  for (Bound& bound : bounds) {
    for (int axis = 0; axis < 3; ++axis) bound.position[axis] = random.uniform(0.0, side);
    bound.velocity = random.point_in_ball();
    bound.radius = 0.25 * random.uniform();
    bound.growth_acceleration = random.uniform();
  }
  return bounds;
}

double pair_test(const std::vector<Bound>& bounds) {
  constexpr double horizon = 0.5;
  return nanoseconds_of(1000, [&](std::uint32_t k) {
    return earliest_meeting(bounds[k % bounds.size()], bounds[(7 * k + 1) % bounds.size()], 0.0, horizon);
  });
}

double probe(const Motion& motion, double time) {
  const auto bodies = static_cast<std::uint32_t>(motion.size());
  const BodyDefinition body{.radius = 0.25, .acceleration_limit = 1.0};
  const Box walls{{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}};
  return nanoseconds_of(1000, [&](std::uint32_t k) {
    Bound bound = bound_of(body, motion.state(k % bodies, time), 0.0);
    double next = std::min(outgrowing_time(bound, 1.0), earliest_exit(bound, walls, 0.0, 1.0));
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true})
        next = std::min(next, MovingSide(bound, axis, upper, 0.0).earliest_entering(1e3, next));
    return next;
  });
}

/// With five candidates of each body in the tree.
double tree_operation(std::uint32_t bodies) {
  constexpr std::uint32_t candidates = 5;
  Random random(2);
  EventTree tree;
  tree.resize(bodies);
  const auto insert = [&](std::uint32_t body) {
    const std::uint32_t other = (body + 1) % bodies;
    tree.insert({random.uniform(), CandidateKind::colliding, std::min(body, other), std::max(body, other)});
  };
  for (std::uint32_t k = 0; k < candidates * bodies; ++k) insert(k % bodies);
  constexpr std::uint32_t inserted = 2000;
  const double both = nanoseconds_of(inserted, [&](std::uint32_t) {
    const Candidate candidate = tree.pop();
    insert(candidate.first);
    return candidate.time;
  });
  return 0.5 * both;
}

struct CellCosts {
  double operation;
  double visit;
};

CellCosts cells(const std::vector<Bound>& bounds) {
  const Grids grids(2.0);
  SubspaceTree tree;
  const auto cell_of = [&](const Vec3& point) {
    return Cell{0, {grids.index_of(0, point.x), grids.index_of(0, point.y), grids.index_of(0, point.z)}};
  };
  const auto bodies = static_cast<std::uint32_t>(bounds.size());
  for (std::uint32_t k = 0; k < bodies; ++k) tree.insert(cell_of(bounds[k].position), k);
  const double both = nanoseconds_of(bodies, [&](std::uint32_t k) {
    const Cell cell = cell_of(bounds[(17 * k) % bodies].position);
    tree.insert(cell, bodies);
    tree.erase(cell, bodies);
    return 0.0;
  });
  std::vector<double> seen(bodies);
  double visits = 0.0, cells_searched = 0.0;
  const double search = nanoseconds_of(bodies, [&](std::uint32_t k) {
    const CellRange range = grids.cells_of(0, swept_box(bounds[(17 * k) % bodies], 0.0, 0.0));
    tree.for_each_neighbour(range, [&](std::uint32_t other) {
      seen[other] += 1.0;
      visits += 1.0;
    });
    range.for_each_cell([&](const Cell&) { cells_searched += 1.0; });
    return visits;
  });
  const double searches = 5.0 * bodies;
  const double operation = 0.5 * both;
  const double visit = (search - operation * cells_searched / searches) / (visits / searches);
  return {operation, std::max(visit, 0.01 * operation)};
}

}  // namespace

UnitCosts calibrate_unit_costs(const Motion& motion, double time) {
  const auto bodies =
      static_cast<std::uint32_t>(std::clamp<std::size_t>(motion.size(), fewest_measured, most_measured));
  const std::vector<Bound> bounds = random_bounds(bodies);
  const CellCosts cell_costs = cells(bounds);
  UnitCosts costs;
  costs.pair_test = pair_test(bounds);
  costs.visit = cell_costs.visit;
  costs.tree_operation = tree_operation(bodies);
  costs.cell_operation = cell_costs.operation;
  if (motion.size() > 0) costs.probe = probe(motion, time);
  return costs;
}

}  // namespace kinesphere
