#include "lab/orbits/orbit_oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace kinesphere {
namespace {

/// From the middle of a span, over this long to both sides, each pair is looked at once (s).
constexpr double half_span = 60.0;
/// Pieces of time in which the distance differs by less are not divided (km).
constexpr double finest = 2e-5;
/// The distance of two computed positions is off by less (km).
constexpr double rounding_error = 4.0 * Orbit::position_error;

/// Two satellites around a time: their distance is that of straight lines, to within `error`.
struct Piece {
  double least, most;

  Piece(const Orbit& a, const Orbit& b, double begin, double end) {
    const double middle = 0.5 * (begin + end);
    const double half = 0.5 * (end - begin);
    const State x = a.state_at(middle), y = b.state_at(middle);
    const Vec3 offset = x.position - y.position, velocity = x.velocity - y.velocity;
    const double error =
        0.5 * (a.largest_acceleration() + b.largest_acceleration()) * half * half + rounding_error;
    const double v2 = norm_squared(velocity);
    const double nearest = v2 > 0.0 ? std::clamp(-dot(offset, velocity) / v2, -half, half) : 0.0;
    least = norm(offset + velocity * nearest) - error;
    most = std::max(norm(offset - velocity * half), norm(offset + velocity * half)) + error;
  }
};

/// What becomes of one pair as time goes on.
class PairCourse {
 public:
  PairCourse(const Orbit& a, const Orbit& b, double distance) : a_(a), b_(b), distance_(distance) {}

  /// Calls within(begin, end), or otherwise(begin, end), for pieces of time in their order.
  template <class Within, class Otherwise>
  void look(double begin, double end, const Within& within, const Otherwise& otherwise) const {
    const Piece piece(a_, b_, begin, end);
    if (piece.least > distance_) return otherwise(begin, end);
    if (piece.most <= distance_) return within(begin, end);
    const double middle = 0.5 * (begin + end);
    if (piece.most - piece.least < finest || !(begin < middle && middle < end)) return otherwise(begin, end);
    look(begin, middle, within, otherwise);
    look(middle, end, within, otherwise);
  }

 private:
  const Orbit& a_;
  const Orbit& b_;
  double distance_;
};

/// All satellites in the middle of a span, in single precision, in columns.
struct Columns {
  std::array<std::vector<float>, 6> of;

  void fill(const std::vector<Orbit>& orbits, const std::vector<std::uint32_t>& order, double time) {
    for (std::vector<float>& column : of) column.resize(orbits.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto [position, velocity] = orbits[order[k]].state_at(time);
      for (int axis = 0; axis < 3; ++axis) {
        of[static_cast<std::size_t>(axis)][k] = static_cast<float>(position[axis]);
        of[static_cast<std::size_t>(axis) + 3][k] = static_cast<float>(velocity[axis]);
      }
    }
  }
};

constexpr std::size_t at_once = 256;

/// The squared least distance of straight lines, within `half` to both sides, of satellite `a` from each of
/// `count` others from `first` on.
void least_squares(const Columns& columns, std::size_t a, std::size_t first, std::size_t count, float half,
                   float* squares) {
  const float* const x = columns.of[0].data();
  const float* const y = columns.of[1].data();
  const float* const z = columns.of[2].data();
  const float* const vx = columns.of[3].data();
  const float* const vy = columns.of[4].data();
  const float* const vz = columns.of[5].data();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t b = first + k;
    const float dx = x[b] - x[a], dy = y[b] - y[a], dz = z[b] - z[a];
    const float ux = vx[b] - vx[a], uy = vy[b] - vy[a], uz = vz[b] - vz[a];
    const float nearest = -(dx * ux + dy * uy + dz * uz) / (ux * ux + uy * uy + uz * uz + 1e-20f);
    const float t = std::min(std::max(nearest, -half), half);
    const float cx = dx + ux * t, cy = dy + uy * t, cz = dz + uz * t;
    squares[k] = cx * cx + cy * cy + cz * cz;
  }
}

}  // namespace

std::vector<OrbitApproach> true_approaches(const std::vector<Orbit>& orbits, double begin, double end,
                                           double distance) {
  // By perigee: who has its perigee above another's apogee never comes near it.
  std::vector<std::uint32_t> order(orbits.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return orbits[a].perigee() != orbits[b].perigee() ? orbits[a].perigee() < orbits[b].perigee() : a < b;
  });
  std::vector<std::size_t> last(order.size());  // of those that are not above
  for (std::size_t a = 0; a < order.size(); ++a) {
    const double top = orbits[order[a]].apogee() + distance + 1e-3;
    last[a] = static_cast<std::size_t>(
        std::partition_point(order.begin(), order.end(),
                             [&](std::uint32_t b) { return orbits[b].perigee() <= top; }) -
        order.begin());
  }
  double acceleration = 0.0, farthest = 0.0, fastest = 0.0;
  for (const Orbit& orbit : orbits) {
    acceleration = std::max(acceleration, orbit.largest_acceleration());
    farthest = std::max(farthest, orbit.apogee());
    fastest = std::max(fastest, orbit.largest_speed());
  }
  // Single precision is off by less than 2^-19 of the sizes.
  const double size = 2.0 * (farthest + fastest * half_span);
  const double reach = distance + acceleration * half_span * half_span + 0x1p-19 * size;
  const auto limit = static_cast<float>(reach * reach * 1.001);

  std::vector<OrbitApproach> approaches;
  Columns columns;
  std::array<float, at_once> squares{};
  for (double from = begin; from < end; from += 2.0 * half_span) {
    const double to = std::min(end, from + 2.0 * half_span);
    columns.fill(orbits, order, 0.5 * (from + to));
    const auto half = static_cast<float>(0.5 * (to - from));
    for (std::size_t a = 0; a < order.size(); ++a) {
      for (std::size_t b = a + 1; b < last[a]; b += at_once) {
        const std::size_t count = std::min(at_once, last[a] - b);
        least_squares(columns, a, b, count, half, squares.data());
        float least = squares[0];
        for (std::size_t k = 1; k < count; ++k) least = std::min(least, squares[k]);
        if (!(least <= limit)) continue;
        for (std::size_t k = 0; k < count; ++k) {
          if (!(squares[k] <= limit)) continue;
          const auto [first, second] = std::minmax(order[a], order[b + k]);
          PairCourse(orbits[first], orbits[second], distance)
              .look(
                  from, to,
                  [&](double piece_begin, double piece_end) {
                    approaches.push_back({first, second, piece_begin, piece_end});
                  },
                  [](double, double) {});
        }
      }
    }
  }
  sort_by_pair(approaches);
  // Pieces that touch are one approach.
  std::vector<OrbitApproach> joined;
  for (const OrbitApproach& approach : approaches) {
    if (!joined.empty() && joined.back().first == approach.first && joined.back().second == approach.second &&
        joined.back().end >= approach.begin)
      joined.back().end = approach.end;
    else
      joined.push_back(approach);
  }
  return joined;
}

bool are_within(const Orbit& a, const Orbit& b, double begin, double end, double distance) {
  bool certain = true;
  PairCourse(a, b, distance)
      .look(
          begin, end, [](double, double) {}, [&certain](double, double) { certain = false; });
  return certain;
}

}  // namespace kinesphere
