// Meetings of space-time bounds, from exchanges of their faces.
#include "research/rivals/hubbard/space_time_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinesphere {

SpaceTimeSweep::SpaceTimeSweep(const std::optional<Box>& box, double wall_clearance)
    : box_(box), wall_clearance_(wall_clearance) {
  if (!box_) return;
  for (Sweep& plane : planes_) {
    plane.insert(lower_wall, {});
    plane.insert(upper_wall, {});
  }
}

void SpaceTimeSweep::insert(std::uint32_t body) {
  for (Sweep& plane : planes_) {
    plane.insert(lower_face(body), {});
    plane.insert(upper_face(body), {});
  }
  if (body >= partners_.size()) partners_.resize(body + 1);
}

void SpaceTimeSweep::erase(std::uint32_t body) {
  for (Sweep& plane : planes_) {
    plane.erase(lower_face(body));
    plane.erase(upper_face(body));
  }
  partners_[body].clear();
  for (std::uint32_t other = 0; other < body; ++other) remove_overlap(other, body);
}

void SpaceTimeSweep::set(std::uint32_t body, const Hypertrapezoid& bound) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes_[axis].line(lower_face(body)) = bound.lower[axis];
    planes_[axis].line(upper_face(body)) = bound.upper[axis];
    for (const Line& face : {bound.lower[axis], bound.upper[axis]}) {
      reach_ = std::max(reach_, std::abs(face.start));
      reach_speed_ = std::max(reach_speed_, std::abs(face.speed));
    }
  }
}

void SpaceTimeSweep::begin(double duration) {
  set_walls();
  order_error_ = Sweep::order_error(planes_[0].size(), reach_ + reach_speed_ * duration);
  widen(order_error_);
  reach_ = reach_speed_ = 0.0;
  for (Sweep& plane : planes_) {
    plane.sort([this](std::uint32_t below, std::uint32_t above) { exchanged(below, above); });
    plane.begin(duration);
  }
}

void SpaceTimeSweep::set_walls() {
  if (!box_) return;
  for (int axis = 0; axis < 3; ++axis) {
    Sweep& plane = planes_[static_cast<std::size_t>(axis)];
    plane.line(lower_wall) = {box_->lower[axis] + wall_clearance_, 0.0};
    plane.line(upper_wall) = {box_->upper[axis] - wall_clearance_, 0.0};
    reach_ = std::max({reach_, std::abs(box_->lower[axis]), std::abs(box_->upper[axis])});
  }
}

/// Moves all faces outward.
void SpaceTimeSweep::widen(double margin) {
  for (Sweep& plane : planes_)
    plane.for_each_line([margin](std::uint32_t number, Line& line) {
      if (!is_wall(number)) line.start += is_lower(number) ? -margin : margin;
    });
}

std::optional<SpaceTimeSweep::Meeting> SpaceTimeSweep::next_meeting() {
  for (;;) {
    const auto first = std::min_element(planes_.begin(), planes_.end(), [](const Sweep& a, const Sweep& b) {
      return a.next_time() < b.next_time();
    });
    if (first->next_time() == std::numeric_limits<double>::infinity()) return std::nullopt;
    const auto [time, below, above] = first->step();
    if (!exchanged(below, above)) continue;
    if (is_wall(below)) return Meeting{time, body_of(above), body_of(above)};
    if (is_wall(above)) return Meeting{time, body_of(below), body_of(below)};
    return Meeting{time, std::min(body_of(below), body_of(above)), std::max(body_of(below), body_of(above))};
  }
}

/// Handles the exchange of two faces, of which `below` was the lower one. Returns true if a bound meets
/// another or a wall by that.
bool SpaceTimeSweep::exchanged(std::uint32_t below, std::uint32_t above) {
  if (is_wall(below) || is_wall(above)) {
    return (below == lower_wall && is_lower(above)) || (above == upper_wall && !is_lower(below));
  }
  if (is_lower(below) == is_lower(above)) return false;
  const std::uint32_t a = std::min(body_of(below), body_of(above));
  const std::uint32_t b = std::max(body_of(below), body_of(above));
  if (is_lower(below)) {
    remove_overlap(a, b);
    return false;
  }
  if (!overlaps_now(a, b)) return false;
  partners_[a].push_back(b);
  return true;
}

bool SpaceTimeSweep::overlaps_on(std::size_t axis, std::uint32_t a, std::uint32_t b) const {
  const Sweep& plane = planes_[axis];
  return plane.is_below(lower_face(a), upper_face(b)) && plane.is_below(lower_face(b), upper_face(a));
}

bool SpaceTimeSweep::overlaps_now(std::uint32_t a, std::uint32_t b) const {
  return overlaps_on(0, a, b) && overlaps_on(1, a, b) && overlaps_on(2, a, b);
}

bool SpaceTimeSweep::overlap(std::uint32_t a, std::uint32_t b) const {
  return a != b && contains(a) && contains(b) && overlaps_now(a, b);
}

bool SpaceTimeSweep::reaches_wall(std::uint32_t body) const {
  if (!box_) return false;
  return std::any_of(planes_.begin(), planes_.end(), [body](const Sweep& plane) {
    return plane.is_below(lower_face(body), lower_wall) || plane.is_below(upper_wall, upper_face(body));
  });
}

void SpaceTimeSweep::remove_overlap(std::uint32_t a, std::uint32_t b) {
  auto& partners = partners_[a];
  const auto found = std::find(partners.begin(), partners.end(), b);
  if (found == partners.end()) return;
  *found = partners.back();
  partners.pop_back();
}

}  // namespace kinesphere
