// The families of pairs, the truth about them, and the clock.
#include "bench/meeting_solvers.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bound/quartic.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::program {
namespace {

using Wide = long double;

constexpr double time_to_horizon = 5.0;

struct Pair {
  Bound a, b;
  double from = 0.0;
};

// Each family draws by statements of its own, so that all compilers draw the same pairs.

/// As in the paper's first experiment, with a report that is up to half a second old.
Bound paper_bound(Random& random) {
  Bound bound;
  bound.time = -random.uniform(0.0, 0.5);
  for (int axis = 0; axis < 3; ++axis) bound.position[axis] = random.uniform(0.0, 200.0);
  bound.velocity = random.unit_vector();
  bound.velocity *= random.uniform(2.5, 25.0) * std::sqrt(3.0);
  bound.radius = random.uniform(0.1, 10.0);
  bound.growth_acceleration = random.uniform(10.0, 20.0);
  return bound;
}

/// Puts b where the gap between the bounds is `gap` at time t, in a random direction.
void set_gap(Pair& pair, Random& random, double gap, double t) {
  const double reach = pair.a.radius_at(t) + pair.b.radius_at(t) + gap;
  pair.b.position += pair.a.centre_at(t) + random.unit_vector() * reach - pair.b.centre_at(t);
}

Pair paper(Random& random) {
  Pair pair{paper_bound(random), paper_bound(random)};
  set_gap(pair, random, random.uniform(0.0, 40.0), 0.0);
  return pair;
}

Pair points(Random& random) {
  Pair pair = paper(random);
  pair.a.radius = pair.b.radius = 0.0;
  return pair;
}

Pair ballistic(Random& random) {
  Pair pair = paper(random);
  pair.a.growth_acceleration = pair.b.growth_acceleration = 0.0;
  return pair;
}

Pair nearly_ballistic(Random& random) {
  Pair pair = paper(random);
  pair.a.growth_acceleration = pair.b.growth_acceleration = 1e-4 * random.uniform();
  return pair;
}

Pair near_contact(Random& random) {
  Pair pair = paper(random);
  set_gap(pair, random, 1e-6, 0.0);
  return pair;
}

Pair far_away(Random& random) {
  Pair pair = paper(random);
  const Vec3 place = 1e6 * random.unit_vector();
  pair.a.position += place;
  pair.b.position += place;
  return pair;
}

/// Bounds that move past each other and overlap by `depth` when they are nearest, with a gap that rises again
/// before their growth closes it for good.
Pair grazing(Random& random, double depth) {
  Pair pair = paper(random);
  pair.a.growth_acceleration = random.uniform(1.0, 2.0);
  pair.b.growth_acceleration = random.uniform(1.0, 2.0);
  const double nearest = random.uniform(0.5, 2.0);
  const Vec3 direction = random.unit_vector();
  const Vec3 velocity = pair.b.velocity - pair.a.velocity;
  const Vec3 across = velocity - direction * dot(velocity, direction);
  const double growth_speed = pair.a.growth_acceleration * (nearest - pair.a.time) +
                              pair.b.growth_acceleration * (nearest - pair.b.time);
  pair.b.velocity = pair.a.velocity + across + direction * growth_speed;
  const double reach = pair.a.radius_at(nearest) + pair.b.radius_at(nearest) - depth;
  pair.b.position += pair.a.centre_at(nearest) + direction * reach - pair.b.centre_at(nearest);
  return pair;
}

struct Family {
  std::string_view name;
  Pair (*draw)(Random&);
};

constexpr std::array families{
    Family{"as in the paper", paper},
    Family{"gap 1e-6", near_contact},
    Family{"points", points},
    Family{"ballistic", ballistic},
    Family{"nearly ballistic", nearly_ballistic},
    Family{"grazing by 1e-6", [](Random& random) { return grazing(random, 1e-6); }},
    Family{"grazing by 1e-12", [](Random& random) { return grazing(random, 1e-12); }},
    Family{"1e6 from the origin", far_away},
};

using Solve = double (*)(const Bound&, const Bound&, double from, double horizon, double distance);

struct Solver {
  std::string_view name;
  Solve solve;
};

constexpr std::array solvers{Solver{"certified", earliest_meeting}, Solver{"numeric", meeting_time_numeric},
                             Solver{"closed form", meeting_time_closed_form}};

/// A pair from time `from` on, in wide numbers: eq 9, and its square, eq 10.
class WidePair {
 public:
  explicit WidePair(const Pair& pair) {
    for (const auto& [bound, sign] : {std::pair{&pair.a, Wide(1)}, std::pair{&pair.b, Wide(-1)}}) {
      const Wide s = Wide(pair.from) - bound->time;
      for (int axis = 0; axis < 3; ++axis)
        add(centre_[static_cast<std::size_t>(axis)], sign, s, bound->position[axis], bound->velocity[axis],
            bound->planned_acceleration[axis]);
      add(reach_, 1, s, bound->radius, bound->growth_speed, bound->growth_acceleration);
    }
  }

  Wide gap_at(Wide d) const {
    Wide squared = 0;
    for (const Quadratic& x : centre_) squared += polynomial::value(x, d) * polynomial::value(x, d);
    return std::sqrt(squared) - polynomial::value(reach_, d);
  }

  /// From `from` on.
  Wide time_to_meeting(Wide end) const {
    QuarticOf<Wide> quartic{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        for (const Quadratic& x : centre_) quartic[i + k] += x[i] * x[k];
        quartic[i + k] -= reach_[i] * reach_[k];
      }
    return polynomial::first_root(quartic, end);
  }

 private:
  using Quadratic = std::array<Wide, 3>;

  /// Adds sign * (x + v (s + d) + 1/2 a (s + d)^2), as a polynomial in d.
  static void add(Quadratic& sum, Wide sign, Wide s, Wide x, Wide v, Wide a) {
    sum[0] += sign * (x + (v + a * s / 2) * s);
    sum[1] += sign * (v + a * s);
    sum[2] += sign * a / 2;
  }

  std::array<Quadratic, 3> centre_{};
  Quadratic reach_{};
};

/// Adds up what the answers of one solver to one family are worth.
class Verdict {
 public:
  void add(const Pair& pair, double answer) {
    ++pairs_;
    const WidePair wide(pair);
    const Wide truth = wide.time_to_meeting(time_to_horizon);
    if (!(truth <= Wide(time_to_horizon))) return;
    ++meetings_;
    const Wide lateness = Wide(answer) - pair.from - truth;
    late_ += lateness > 0;
    if (lateness > truth * missed_part) {
      ++missed_;
    } else if (lateness > 0) {
      largest_lateness_ = std::max(largest_lateness_, lateness);
      deepest_overlap_ = std::max(deepest_overlap_, -wide.gap_at(truth + lateness));
    } else {
      largest_earliness_ = std::max(largest_earliness_, -lateness);
    }
  }

  MeetingSolverRow row(std::string_view family, std::string_view solver, double seconds) const {
    const auto share = [](std::uint64_t part, std::uint64_t whole) {
      return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
    };
    return {.pairs = family,
            .solver = solver,
            .nanoseconds = 1e9 * seconds / static_cast<double>(pairs_),
            .late_share = share(late_, meetings_),
            .largest_lateness = static_cast<double>(largest_lateness_),
            .deepest_overlap = static_cast<double>(deepest_overlap_),
            .missed_share = share(missed_, meetings_),
            .largest_earliness = static_cast<double>(largest_earliness_)};
  }

 private:
  static constexpr Wide missed_part = 1e-3L;

  std::uint64_t pairs_ = 0, meetings_ = 0, late_ = 0, missed_ = 0;
  Wide largest_lateness_ = 0, deepest_overlap_ = 0, largest_earliness_ = 0;
};

/// Answers all questions, and returns the seconds that took.
double time_answers(Solve solve, const std::vector<Pair>& pairs, std::vector<double>& answers) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  for (std::size_t k = 0; k < pairs.size(); ++k)
    answers[k] = solve(pairs[k].a, pairs[k].b, pairs[k].from, pairs[k].from + time_to_horizon, 0.0);
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

std::vector<MeetingSolverRow> compare_meeting_solvers(std::uint64_t pairs, std::uint64_t seed) {
  // Blocks that stay in the cache, and in which the solvers take turns: all see the same load of the machine.
  constexpr std::uint64_t block_size = 1024;
  std::vector<MeetingSolverRow> rows;
  for (std::size_t f = 0; f < families.size(); ++f) {
    std::array<Verdict, solvers.size()> verdicts;
    std::array<double, solvers.size()> seconds{};
    for (std::uint64_t start = 0; start < pairs; start += block_size) {
      std::vector<Pair> block;
      for (std::uint64_t k = start; k < std::min(pairs, start + block_size); ++k) {
        Random random = Random::at(seed, f, k);
        block.push_back(families[f].draw(random));
      }
      std::vector<double> answers(block.size());
      for (std::size_t s = 0; s < solvers.size(); ++s) {
        seconds[s] += time_answers(solvers[s].solve, block, answers);
        for (std::size_t k = 0; k < block.size(); ++k) verdicts[s].add(block[k], answers[k]);
      }
    }
    for (std::size_t s = 0; s < solvers.size(); ++s)
      rows.push_back(verdicts[s].row(families[f].name, solvers[s].name, seconds[s]));
  }
  return rows;
}

}  // namespace kinesphere::program
