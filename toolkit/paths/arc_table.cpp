#include "paths/arc_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t arcs_at_once = 1024;

/// Bounds on an arc's polynomials: sums, over the coefficients, of the largest sizes that their terms and the
/// derivatives of these reach on the arc.
struct ArcBounds {
  double size = 0.0;   ///< largest coordinate
  double speed = 0.0;  ///< largest component of the velocity
  double jerk = 0.0;   ///< largest third derivative, as a vector
};

ArcBounds bounds_of(const PolynomialPaths& paths, std::size_t arc) {
  const double duration = paths.ends[arc] - paths.begins[arc];
  const bool is_chebyshev = paths.basis == PolynomialPaths::Basis::chebyshev;
  const double unit = is_chebyshev ? 0.5 * duration : duration;
  ArcBounds bounds;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double* c = paths.coefficients.data() + (3 * arc + axis) * paths.terms;
    double size = 0.0, speed = 0.0, jerk = 0.0, power = 1.0;
    for (std::size_t k = 0; k < paths.terms; ++k) {
      const auto n = static_cast<double>(k);
      const double term = std::abs(c[k]) * power;
      size += term;
      // Chebyshev polynomials in [-1, 1] and powers in [0, 1] have their largest derivatives at 1.
      speed += term * (is_chebyshev ? n * n : n);
      jerk +=
          term * (is_chebyshev ? n * n * (n * n - 1.0) * (n * n - 4.0) / 15.0 : n * (n - 1.0) * (n - 2.0));
      if (!is_chebyshev) power *= duration;
    }
    bounds.size = std::max(bounds.size, size);
    bounds.speed = std::max(bounds.speed, speed / unit);
    bounds.jerk += jerk * jerk;
  }
  bounds.jerk = std::sqrt(bounds.jerk) / (unit * unit * unit);
  return bounds;
}

/// Requires that the arrays have one entry for each arc and body.
void check_sizes(InputCheck& check, const PolynomialPaths& paths) {
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  const std::size_t arcs = paths.bodies.size();
  const auto size = [&](std::string_view argument, std::size_t expected, std::size_t came) {
    check.require(came == expected, ErrorCode::out_of_range, {argument}, "must have a size of", expected,
                  came);
  };
  check.require(paths.terms >= 1 && paths.terms <= PolynomialPaths::most_terms, ErrorCode::out_of_range,
                {"paths.terms"}, "must be from 1 to", PolynomialPaths::most_terms, paths.terms);
  size("paths.begins", arcs, paths.begins.size());
  size("paths.ends", arcs, paths.ends.size());
  size("paths.coefficients", 3 * paths.terms * arcs, paths.coefficients.size());
  // Where std::size_t has 32 bits, the count of a number equal to `most` wraps to 0.
  check.require(paths.body_count() <= most && (arcs == 0 || paths.bodies.back() < most),
                ErrorCode::out_of_range, {"paths.bodies"}, "must be of at most as many bodies as", most,
                paths.body_count());
  if (!paths.errors.empty() && arcs > 0)
    check.require(paths.bodies.back() < paths.errors.size(), ErrorCode::out_of_range, {"paths.errors"},
                  "must have one number for each body, and so more than", std::size_t{paths.bodies.back()},
                  paths.errors.size());
}

void check_arc(InputCheck& check, const PolynomialPaths& paths, std::size_t arc) {
  const BodyId body{.index = paths.bodies[arc]};
  const double begin = paths.begins[arc], end = paths.ends[arc];
  check.finite({"paths.begins", body, "arc", arc}, begin).finite({"paths.ends", body, "arc", arc}, end);
  const double largest = std::max(std::abs(begin), std::abs(end));
  check.require(largest <= limits::largest_time, ErrorCode::out_of_range, {"paths.ends", body, "arc", arc},
                "must be within +-", limits::largest_time, end);
  check.require(begin < end && begin + (end - begin) * 0x1p-20 > begin, ErrorCode::out_of_range,
                {"paths.ends", body, "arc", arc}, "must be well after the arc's begin at", begin, end);
  if (arc > 0) {
    check.require(paths.bodies[arc] >= paths.bodies[arc - 1], ErrorCode::out_of_range,
                  {"paths.bodies", no_body, "arc", arc}, "must be at least that of the arc before,",
                  paths.bodies[arc - 1], paths.bodies[arc]);
    if (paths.bodies[arc] == paths.bodies[arc - 1])
      check.require(begin >= paths.ends[arc - 1], ErrorCode::out_of_range, {"paths.begins", body, "arc", arc},
                    "must be at or after the end of the arc before,", paths.ends[arc - 1], begin);
  }
  if (check.error()) return;
  constexpr double largest_number = 1e100;
  const ArcBounds bounds = bounds_of(paths, arc);
  for (const double value : {bounds.size, bounds.speed, bounds.jerk}) {
    const Subject subject{"paths.coefficients", body, "arc", arc};
    check.require(!std::isnan(value) && value < infinity, ErrorCode::not_finite, subject, "must be finite",
                  value);
    check.require(value <= largest_number, ErrorCode::out_of_range, subject,
                  "must keep positions and their derivatives within +-", largest_number, value);
  }
}

}  // namespace

std::size_t PolynomialPaths::body_count() const {
  return !errors.empty() ? errors.size() : bodies.empty() ? 0 : std::size_t{bodies.back()} + 1;
}

std::optional<Error> first_error(const char* call, const PolynomialPaths& paths, PoolLease& lease) {
  InputCheck sizes(call);
  check_sizes(sizes, paths);
  for (std::size_t body = 0; body < paths.errors.size(); ++body)
    sizes.not_negative({"paths.errors", BodyId{.index = static_cast<std::uint32_t>(body)}},
                       paths.errors[body]);
  if (sizes.error()) return sizes.error();
  const std::size_t arcs = paths.bodies.size();
  std::vector<std::optional<Error>> errors(arcs / arcs_at_once + 1);
  lease.for_each(errors.size(), 1, [&](std::size_t k, std::size_t) {
    InputCheck check(call);
    for (std::size_t arc = k * arcs_at_once; arc < std::min(arcs, (k + 1) * arcs_at_once); ++arc)
      check_arc(check, paths, arc);
    errors[k] = check.error();
  });
  for (const auto& error : errors)
    if (error) return error;
  return {};
}

ArcTable::ArcTable(const PolynomialPaths& paths, PoolLease& lease)
    : paths_(paths), jerks_(paths.bodies.size()), errors_(paths.body_count()) {
  for (std::size_t body = 0; body <= paths.body_count(); ++body)
    firsts_.push_back(static_cast<std::size_t>(
        std::lower_bound(paths.bodies.begin(), paths.bodies.end(), body) - paths.bodies.begin()));
  std::vector<double> speeds(lease.count());
  lease.for_each(bodies(), 16, [&](std::size_t body, std::size_t worker) {
    double rounding = 0.0;
    for (std::size_t arc = first_of(body); arc < first_of(body + 1); ++arc) {
      const ArcBounds bounds = bounds_of(paths, arc);
      jerks_[arc] = bounds.jerk;
      speeds[worker] = std::max(speeds[worker], bounds.speed);
      const double time = std::max(std::abs(begin(arc)), std::abs(end(arc)));
      rounding = std::max(rounding, 0x1p-44 * bounds.size + 0x1p-48 * time * bounds.speed);
    }
    errors_[body] = declared_error(body) + rounding;
  });
  largest_speed_ = *std::max_element(speeds.begin(), speeds.end());
}

std::size_t ArcTable::arc_after(std::size_t body, double t) const {
  const auto first = paths_.ends.begin() + static_cast<std::ptrdiff_t>(first_of(body));
  const auto last = paths_.ends.begin() + static_cast<std::ptrdiff_t>(first_of(body + 1));
  return static_cast<std::size_t>(std::upper_bound(first, last, t) - paths_.ends.begin());
}

bool ArcTable::continues(std::size_t arc) const {
  return arc > 0 && paths_.bodies[arc] == paths_.bodies[arc - 1] && begin(arc) == end(arc - 1);
}

double ArcTable::local_time(std::size_t arc, double t) const {
  const double since = t - begin(arc);
  if (basis() == PolynomialPaths::Basis::monomial) return since;
  return (since - (end(arc) - t)) / duration(arc);
}

ArcTable::Positions ArcTable::positions_at(std::size_t arc, const Times& times) const {
  Lanes u;
  for (std::size_t i = 0; i < lanes; ++i) u[i] = local_time(arc, times[i]);
  const bool is_chebyshev = basis() == PolynomialPaths::Basis::chebyshev;
  const Lanes factor = is_chebyshev ? u + u : u;
  const std::array<const double*, 3> c{coefficients(arc, 0), coefficients(arc, 1), coefficients(arc, 2)};
  std::array<Lanes, 3> here{}, after{};
  for (std::size_t k = terms() - 1; k > 0; --k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Lanes old = here[axis];
      here[axis] = factor * old + c[axis][k];
      if (is_chebyshev) here[axis] -= after[axis];
      after[axis] = old;
    }
  }
  Positions result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Lanes last = u * here[axis] + c[axis][0];
    if (is_chebyshev) last -= after[axis];
    for (std::size_t i = 0; i < lanes; ++i) result[i][static_cast<int>(axis)] = last[i];
  }
  return result;
}

State ArcTable::state_at(std::size_t arc, double t) const {
  const double u = local_time(arc, t);
  const bool is_chebyshev = basis() == PolynomialPaths::Basis::chebyshev;
  State state;
  for (int axis = 0; axis < 3; ++axis) {
    const double* c = coefficients(arc, static_cast<std::size_t>(axis));
    double value = 0.0, slope = 0.0, value_after = 0.0, slope_after = 0.0;
    for (std::size_t k = terms(); k-- > 0;) {
      // Of T_0 Clenshaw's scheme takes half the factor of the others.
      const double factor = is_chebyshev && k > 0 ? 2.0 : 1.0;
      const double next_slope = factor * (value + u * slope) - (is_chebyshev ? slope_after : 0.0);
      const double next = factor * u * value - (is_chebyshev ? value_after : 0.0) + c[k];
      value_after = value;
      slope_after = slope;
      value = next;
      slope = next_slope;
    }
    state.position[axis] = value;
    state.velocity[axis] = is_chebyshev ? slope * (2.0 / duration(arc)) : slope;
  }
  return state;
}

}  // namespace kinesphere
