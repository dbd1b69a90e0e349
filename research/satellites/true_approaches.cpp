#include "research/satellites/true_approaches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace kinesphere {
namespace {

/// Pieces of time with bounds on the distance closer together than this are not divided (km). Smaller values
/// make the truth sharper and the search longer.
constexpr double finest = 2e-5;
/// Bound on the error of the distance of two computed positions, seams included (km).
constexpr double rounding_error = 4.0 * SatelliteMotion::position_error;

/// Bounds on the distance of two satellites during a piece of time: that of straight lines, with an error.
struct Piece {
  double least, most;

  Piece(const Arc& a, const Arc& b, double begin, double end) {
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

/// Calls within(begin, end) or otherwise(begin, end) for pieces of time in their order: the former where the
/// two are certainly within the distance.
template <class Within, class Otherwise>
void look(const Arc& a, const Arc& b, double begin, double end, double distance, const Within& within,
          const Otherwise& otherwise) {
  const Piece piece(a, b, begin, end);
  if (piece.least > distance) return otherwise(begin, end);
  if (piece.most <= distance) return within(begin, end);
  const double middle = 0.5 * (begin + end);
  if (piece.most - piece.least < finest || !(begin < middle && middle < end)) return otherwise(begin, end);
  look(a, b, begin, middle, distance, within, otherwise);
  look(a, b, middle, end, distance, within, otherwise);
}

constexpr std::size_t at_once = 256;

/// Shells holds all satellites in the middle of their arcs, in single precision, in columns, sorted by their
/// least distances from the earth's centre.
class Shells {
 public:
  void fill(SatelliteMotion& motion, double time, double distance) {
    const std::uint32_t size = motion.size();
    arcs_.clear();
    for (std::uint32_t k = 0; k < size; ++k) arcs_.push_back(&motion.arc(k, time));
    order_.resize(size);
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(), [this](std::uint32_t a, std::uint32_t b) {
      return std::pair(arcs_[a]->nearest(), a) < std::pair(arcs_[b]->nearest(), b);
    });
    for (std::vector<float>& column : columns_) column.resize(size);
    double acceleration = 0.0, farthest = 0.0;
    last_.resize(size);
    for (std::size_t place = 0; place < size; ++place) {
      const Arc& arc = *arcs_[order_[place]];
      const auto [position, velocity] = arc.state_at(arc.middle());
      for (int axis = 0; axis < 3; ++axis) {
        columns_[static_cast<std::size_t>(axis)][place] = static_cast<float>(position[axis]);
        columns_[static_cast<std::size_t>(axis) + 3][place] = static_cast<float>(velocity[axis]);
      }
      acceleration = std::max(acceleration, arc.largest_acceleration());
      farthest = std::max(farthest, arc.farthest());
      const double top = arc.farthest() + distance;
      const auto above = std::partition_point(
          order_.begin(), order_.end(), [&](std::uint32_t other) { return arcs_[other]->nearest() <= top; });
      last_[place] = static_cast<std::size_t>(above - order_.begin());
    }
    // The reach allows for straight lines from the middle of the arcs, and for single precision with 2^-18 of
    // all sizes.
    constexpr double half = Arc::half_length;
    const double reach = distance + acceleration * half * half + rounding_error + 0x1p-18 * 2.0 * farthest;
    limit_ = static_cast<float>(reach * reach * 1.001);
  }

  /// Calls visit(a, b), a < b, for all pairs that may come within the distance in these arcs.
  template <class Visit>
  void for_each_near(Visit visit) const {
    std::array<float, at_once> squares{};
    for (std::size_t a = 0; a < order_.size(); ++a)
      for (std::size_t b = a + 1; b < last_[a]; b += at_once) {
        const std::size_t count = std::min(at_once, last_[a] - b);
        least_squares(a, b, count, squares.data());
        float least = squares[0];
        for (std::size_t k = 1; k < count; ++k) least = std::min(least, squares[k]);
        if (least > limit_) continue;
        for (std::size_t k = 0; k < count; ++k)
          if (!(squares[k] > limit_)) {
            const auto [first, second] = std::minmax(order_[a], order_[b + k]);
            visit(first, second);
          }
      }
  }

 private:
  /// Computes the squared least distances of satellite `a` from each of `count` others, on straight lines.
  void least_squares(std::size_t a, std::size_t first, std::size_t count, float* squares) const {
    constexpr auto half = static_cast<float>(Arc::half_length);
    const float* const x = columns_[0].data();
    const float* const y = columns_[1].data();
    const float* const z = columns_[2].data();
    const float* const vx = columns_[3].data();
    const float* const vy = columns_[4].data();
    const float* const vz = columns_[5].data();
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

  std::vector<const Arc*> arcs_;
  std::vector<std::uint32_t> order_;
  std::vector<std::size_t> last_;  ///< by place: end of the places not entirely above it
  std::array<std::vector<float>, 6> columns_;
  float limit_ = 0.0f;
};

}  // namespace

std::vector<SatelliteApproach> true_approaches(SatelliteMotion motion, double until, double distance) {
  std::vector<SatelliteApproach> approaches;
  Shells shells;
  for (double begin = 0.0; begin < until; begin += SatelliteMotion::arc_length) {
    const double end = std::min(until, begin + SatelliteMotion::arc_length);
    shells.fill(motion, begin, distance);
    shells.for_each_near([&](std::uint32_t first, std::uint32_t second) {
      look(
          motion.arc(first, begin), motion.arc(second, begin), begin, end, distance,
          [&](double piece_begin, double piece_end) {
            approaches.push_back({first, second, piece_begin, piece_end});
          },
          [](double, double) {});
    });
  }
  sort_by_pair(approaches);
  // Pieces that touch are joined to one approach.
  std::vector<SatelliteApproach> joined;
  for (const SatelliteApproach& approach : approaches) {
    if (!joined.empty() && joined.back().first == approach.first && joined.back().second == approach.second &&
        joined.back().end >= approach.begin)
      joined.back().end = approach.end;
    else
      joined.push_back(approach);
  }
  return joined;
}

std::vector<SatelliteApproach> not_within(SatelliteMotion motion, std::vector<SatelliteApproach> approaches,
                                          double distance) {
  std::sort(approaches.begin(), approaches.end(),
            [](const SatelliteApproach& a, const SatelliteApproach& b) { return a.begin < b.begin; });
  std::vector<SatelliteApproach> wrong;
  std::vector<SatelliteApproach> open;
  std::size_t next = 0;
  for (double begin = 0.0; next < approaches.size() || !open.empty(); begin += SatelliteMotion::arc_length) {
    const double end = begin + SatelliteMotion::arc_length;
    for (; next < approaches.size() && approaches[next].begin < end; ++next) open.push_back(approaches[next]);
    std::erase_if(open, [&](const SatelliteApproach& approach) {
      bool is_wrong = false;
      look(
          motion.arc(approach.first, begin), motion.arc(approach.second, begin),
          std::max(begin, approach.begin), std::min(end, approach.end), distance, [](double, double) {},
          [&](double, double) { is_wrong = true; });
      if (is_wrong) wrong.push_back(approach);
      return is_wrong || approach.end <= end;
    });
  }
  return wrong;
}

}  // namespace kinesphere
