// Two rectangles on their ways.
#include "simulation/tracks/rectangle_pair.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

RectanglePair::RectanglePair(const Motion& motion, const Approach& approach,
                             const std::vector<RectangleBody>& bodies, const PositionErrors& errors,
                             Errors counted)
    : first_(bodies[approach.first]),
      second_(bodies[approach.second]),
      first_track_(approach.first),
      second_track_(approach.second),
      errors_(counted == Errors::none || !errors.any() ? nullptr : &errors),
      sign_(counted == Errors::nearer ? -1.0 : 1.0) {
  const auto first = pieces_of(motion, approach.first, first_, approach.begin, approach.end);
  const auto second = pieces_of(motion, approach.second, second_, approach.begin, approach.end);
  for (std::size_t i = 0, k = 0; i < first.size() && k < second.size();) {
    const double begin = std::max(first[i].begin, second[k].begin);
    const double end = std::min(first[i].end, second[k].end);
    if (begin < end) pieces_.push_back({begin, end, first[i], second[k]});
    (first[i].end <= second[k].end ? i : k) += 1;
  }
  // An approach may be of one moment.
  if (pieces_.empty() && !first.empty() && !second.empty())
    pieces_.push_back({approach.begin, approach.end, first.front(), second.front()});
}

double RectanglePair::gap(const Piece& piece, double t) const {
  const double gap = gap_between(first_, piece.first.pose(t), second_, piece.second.pose(t));
  return errors_ == nullptr ? gap
                            : gap + sign_ * (errors_->at(first_track_, t) + errors_->at(second_track_, t));
}

double RectanglePair::fastest(const Piece& piece, double from, double to) const {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  const Segment &a = piece.first.segment, &b = piece.second.segment;
  return norm(a.state_at(middle).velocity - b.state_at(middle).velocity) +
         norm(a.acceleration_at(middle) - b.acceleration_at(middle)) * half +
         0.5 * norm(a.jerk - b.jerk) * half * half + std::abs(piece.first.turn_rate) * first_.reach() +
         std::abs(piece.second.turn_rate) * second_.reach() +
         (errors_ == nullptr
              ? 0.0
              : errors_->steepest(first_track_, from, to) + errors_->steepest(second_track_, from, to));
}

int RectanglePair::parts_of(const Piece& piece) const {
  constexpr double fewest = 8.0, most = 1024.0, part_of_size = 0.1;
  const double change = fastest(piece, piece.begin, piece.end) * (piece.end - piece.begin);
  const double size = 2.0 * std::min(first_.reach(), second_.reach());
  return static_cast<int>(size > 0.0 ? std::clamp(std::ceil(change / (part_of_size * size)), fewest, most)
                                     : fewest);
}

DistanceMinimum RectanglePair::minimum(const Piece& piece, double t) const {
  const RectanglePose a = piece.first.pose(t), b = piece.second.pose(t);
  return {.closest = {.time = t,
                      .distance = gap_between(first_, a, second_, b),
                      .first = a.position,
                      .second = b.position,
                      .relative_speed = norm(a.velocity - b.velocity)},
          .first_velocity = a.velocity,
          .second_velocity = b.velocity};
}

}  // namespace kinesphere
