// Safe regions: how large, where, and who their neighbours are.
#include <algorithm>
#include <cmath>

#include "contact/contact_event.hpp"
#include "core/core.hpp"
#include "number/infinity.hpp"
#include "number/roots.hpp"

namespace kinesphere::core {
namespace {

/// How far ahead of a ball its next safe region is centred, in radii of it. Larger values let fast balls stay
/// longer in it, and those that are turned back leave it sooner.
constexpr double ahead = 0.6;
/// A ball that may leave its safe region reports first if its bound has grown by this part of the region.
constexpr double growth_worth_a_report = 0.25;
/// It keeps its safe region if it stays in it for this part of the time since its last report.
constexpr double stay_worth_keeping = 0.0625;
/// A ball in exact flight goes on from where it is after this many radii of a safe region.
constexpr double longest_flight = 0x1p12;

// What it costs to choose a safe region, beside what each neighbour adds then, and what a scan costs for each
// neighbour. Only their ratios matter. They are instructions, as measured.
constexpr double cost_of_region = 600.0;
constexpr double cost_of_neighbour = 75.0;
constexpr double cost_of_scan = 40.0;

}  // namespace

Vec3 Core::region_centre(const Ball& ball) const {
  return Vec3{double{ball.centre[0]}, double{ball.centre[1]}, double{ball.centre[2]}} * unit_ + origin_;
}

/// Returns the reach of a ball's safe region (region units), raised for rounding and for the error that
/// images in a periodic box have in single precision.
float Core::reach(const Ball& ball) const {
  const double lengths = ball.radius + tolerance_ + 0x1p-21 * norm_one(balls_.periods().length);
  return static_cast<float>((double{ball.region} + lengths / unit_) * (1.0 + 0x1p-20));
}

/// Returns the radius (length) of the widest safe region with which two neighbours can meet in one image only
/// while both are in theirs: their centres are closer than half the period then.
double Core::widest_region(const Ball& ball) const {
  double widest = infinity;
  for (int axis = 0; axis < 3; ++axis)
    if (balls_.periods().length[axis] > 0.0)
      widest = std::min(widest, 0.49 * (0.25 * balls_.periods().length[axis] - ball.radius - tolerance_));
  return widest;
}

/// A ball may leave its safe region: it reports if that helps, and gets another one.
void Core::leave_region(std::uint32_t number) {
  Ball& ball = balls_[number];
  // The bound may be tighter than when `own` was computed.
  if (stays(number) > stay_worth_keeping * (balls_.time() - ball.time) + 0x1p-40 * std::abs(balls_.time())) {
    compute_own(number);
  } else {
    if (balls_.growth(number) > growth_worth_a_report * double{ball.region} * unit_) probe(number);
    cells_.leave(balls_, number);
    place_region(number, next_radius(ball));
    cells_.enter(balls_, number, reach(ball));
    find_neighbours(number);
    compute_own(number);
  }
  schedule(number);
}

/// Returns the radius of the next safe region (length). A wider one lasts longer, but has more neighbours.
/// The sum of both costs is least where their derivatives cancel; how many neighbours there are, and how
/// often they are scanned in each region, is known from the last ones.
double Core::next_radius(Ball& ball) const {
  ball.scans_by_region =
      static_cast<std::uint8_t>(std::min((3u * ball.scans_by_region + 8u * ball.scans + 2u) / 4u, 255u));
  ball.scans = 0;
  const double radius = std::max(double{ball.region} * unit_, 0x1p-10 * ball.radius + tolerance_);
  const double neighbours = std::max(static_cast<double>(lists_.at(ball.list).size()), 0.5);
  const double scans = 0.125 * ball.scans_by_region;
  const double wanted = 2.0 * (radius + ball.radius) * (cost_of_region + cost_of_neighbour * neighbours) /
                        (dimensions_ * neighbours * (cost_of_neighbour + cost_of_scan * scans));
  const double ratio = std::clamp(wanted / radius, 0.25, 4.0);
  return radius * std::sqrt(std::sqrt(ratio));
}

/// Gives the ball a safe region of about this radius (length), around and ahead of where its bound is now.
void Core::place_region(std::uint32_t number, double radius) {
  Ball& ball = balls_[number];
  ++counters_.regions;
  const Vec3 motion = balls_.velocity(number);
  const double speed = norm(motion), growth = balls_.growth(number);
  // The way from an old report loses digits, so a ball that is in exact flight for long begins anew.
  if (growth == 0.0 && speed * (balls_.time() - ball.time) > longest_flight * radius)
    balls_.set_state(number, {balls_.position(number), motion});
  Vec3 centre = balls_.position(number);
  // Single precision tells so much apart here. A ball that stands still needs no more.
  const double resolved = 0x1p-20 * (norm_one(centre - origin_) + ball.radius) + tolerance_;
  const bool stands = speed == 0.0 && balls_.is_exact(number) && balls_.plan(number) == Vec3{};
  radius = stands ? 0.0 : std::min(radius, widest_region(ball) - growth - resolved);
  if (speed > 0.0) centre += motion * (ahead * radius / speed);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(balls_.periods().length[axis] > 0.0)) continue;
    const double images = std::floor((centre[axis] - origin_[axis]) * balls_.periods().inverse[axis]);
    centre[axis] -= images * balls_.periods().length[axis];
    ball.position[axis] -= images * balls_.periods().length[axis];
  }
  ball.region = static_cast<float>((radius + resolved + growth) / unit_);
  for (int axis = 0; axis < 3; ++axis)
    ball.centre[axis] = static_cast<float>((centre[axis] - origin_[axis]) / unit_);
  ball.walls = 0;
  if (!walls_) return;
  const double extent = double{reach(ball)} * unit_;
  for (const Wall wall : kinesphere::walls) {
    if (!kinesphere::stands(*walls_, wall)) continue;
    const HalfSpace inside = half_space(*walls_, wall);
    if (dot(inside.normal, region_centre(ball)) - inside.offset < extent) ball.walls |= wall_bit(wall);
  }
}

/// Makes those within reach the neighbours of the ball, and it theirs; others are no longer.
void Core::find_neighbours(std::uint32_t number) {
  cells_.search(balls_[number], reach(balls_[number]), found_);
  std::sort(found_.begin(), found_.end());
  const auto former = lists_.at(balls_[number].list);
  gone_.clear();
  new_.clear();
  auto next = former.begin();
  std::size_t count = 0;
  for (const std::uint32_t other : found_) {
    if (other == number) continue;
    found_[count++] = other;
    while (next != former.end() && *next < other) gone_.push_back(*next++);
    if (next != former.end() && *next == other)
      ++next;
    else
      new_.push_back(other);
  }
  found_.resize(count);
  gone_.insert(gone_.end(), next, former.end());
  for (const std::uint32_t other : gone_) lists_.erase(balls_[other].list, number);
  for (const std::uint32_t other : new_) lists_.insert(balls_[other].list, number);
  lists_.assign(balls_[number].list, found_);
}

void Core::forget_neighbours(std::uint32_t number) {
  for (const std::uint32_t other : lists_.at(balls_[number].list)) lists_.erase(balls_[other].list, number);
  lists_.assign(balls_[number].list, {});
}

/// Gives the changed balls that have no safe region one, and their neighbours.
void Core::place_arrivals() {
  std::vector<std::uint32_t> arrivals;
  for (const std::uint32_t number : changed_)
    if (!balls_[number].has_region()) arrivals.push_back(number);
  if (arrivals.empty()) return;
  const double radius = first_radius();
  for (const std::uint32_t number : arrivals) {
    Ball& ball = balls_[number];
    if (ball.has_region()) continue;  // it was listed twice
    place_region(number, radius);
    cells_.enter(balls_, number, reach(ball));
  }
  if (2 * arrivals.size() > balls_.size()) cells_.rebuild(balls_);
  for (const std::uint32_t number : arrivals) find_neighbours(number);
}

/// Returns the radius of the first safe region of a ball (length): about a third of the mean distance of all
/// balls, in as many dimensions as they fill.
double Core::first_radius() const {
  Vec3 lower{infinity, infinity, infinity}, upper = lower * -1.0;
  double count = 0.0;
  for (const Ball& ball : balls_.all()) {
    if (ball.list == none) continue;
    ++count;
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], ball.position[axis]);
      upper[axis] = std::max(upper[axis], ball.position[axis]);
    }
  }
  double edges[3] = {upper.x - lower.x, upper.y - lower.y, upper.z - lower.z};
  std::sort(std::begin(edges), std::end(edges));
  const double volume = edges[0] * edges[1] * edges[2];
  double distance = volume > 0.0 ? cube_root(volume / count) : 0.0;
  if (!(edges[0] > distance)) distance = std::sqrt(edges[1] * edges[2] / count);
  if (!(edges[1] > distance)) distance = edges[2] / count;
  return 0.35 * distance + tolerance_;
}

}  // namespace kinesphere::core
