// Safe regions: how large, where, and who their neighbours are.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "contact/contact_event.hpp"
#include "core/core.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core {
namespace {

/// How far ahead of a ball its next safe region is centred, in radii of it. Larger values let fast balls stay
/// longer in it, and those that are turned back leave it sooner.
constexpr double ahead = 0.75;
/// A ball that may leave its safe region reports first if its bound has grown by this part of the region.
constexpr double growth_worth_a_report = 0.25;
/// The largest radius of a safe region (region units), whose square is an ordinary number in single
/// precision.
constexpr double largest_region = 0x1p60;
/// It keeps its safe region if it stays in it for this part of the time since its last report.
constexpr double stay_worth_keeping = 0.0625;
/// A ball in exact flight reports after this many radii of a safe region: the way from an old report loses
/// digits, and it may have turned, which nothing else would reveal.
constexpr double longest_flight = 64.0;

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
  return RegionCells::raised(static_cast<float>((double{ball.region} + lengths / unit_) * (1.0 + 0x1p-20)));
}

/// Returns the radius (length) of the widest safe region with which two neighbours can meet only in the image
/// in which their bounds are nearest, while both are in their regions (docs/guarantee.md has the proof).
/// Where a ball is so far away on an axis that does not repeat that single precision tells no such lengths
/// apart, its region is wider, and keeps_image() limits its time there.
double Core::widest_region(const Ball& ball) const {
  double widest = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double period = balls_.periods().length[axis];
    // The error of its reports is not known here, but less than its radius, and such that rule (1) of
    // space/space.hpp holds.
    const double room = std::max(0.25 * period - 3.0 * ball.radius - tolerance_, 0.0625 * period);
    if (period > 0.0) widest = std::min(widest, 0.33 * room);
  }
  return space_.slides() ? std::min(widest, widest_on_x(ball)) : widest;
}

/// Returns the same on x where images slide: so much farther the images of two balls may come.
double Core::widest_on_x(const Ball& ball) const {
  const double period = balls_.periods().length.x;
  const double room = std::max(0.25 * period - 3.0 * ball.radius - tolerance_, 0.0625 * period);
  return 0.33 * room - 0.17 * Space::most_slide * period;
}

/// A ball may leave its safe region: it reports if that helps, and gets another one.
Result<void> Core::leave_region(std::uint32_t number, Host& host) {
  Ball& ball = balls_[number];
  // The bound may be tighter than when `own` was computed.
  const double stay = stays(number);
  if (stay > stay_worth_keeping * (balls_.time() - ball.time) + 0x1p-40 * std::abs(balls_.time())) {
    set_own_later(number, stay, host);
    schedule_anew(number, host);
    return {};
  }
  const double radius = std::min(double{ball.region} * unit_, widest_region(ball));
  const bool is_wide = balls_.growth(number) > growth_worth_a_report * radius;
  const bool is_far = norm_one(balls_.position(number) - ball.position) > longest_flight * radius;
  if (is_wide || is_far)
    if (auto reported = host.report(std::span(&number, 1), Host::Reason::region); !reported)
      return reported.error();
  move_region(number, host);
  note_change(number, host);
  schedule(number, true, host);
  return {};
}

/// Gives the ball another safe region, neighbours, and an own time. Memory is what takes the time: each step
/// fetches what a later one needs.
void Core::move_region(std::uint32_t number, Host& host) {
  ++host.work_counters(number).starts;
  place_region(number, next_radius(number));
  if (space_.slides()) set_search_end(number);
  const Ball& ball = balls_[number];
  if (balls_.periods().any) host.note_image(number, region_centre(ball));
  cells_.start_search(ball, reach(ball), search_);
  set_own_later(number, stays(number), host);
  compare_neighbours(number, host);
  cells_.leave(balls_, number);
  cells_.enter(balls_, number, reach(ball));
  update_lists(number);
}

/// Returns the radius of the next safe region (length). A wider one lasts longer, but has more neighbours,
/// apart from those that are near in any case. The sum of both costs is least where their derivatives cancel;
/// how many neighbours there are, and how often they are scanned in each region, is known from the last ones.
double Core::next_radius(std::uint32_t number) {
  Ball& ball = balls_[number];
  ball.scans_by_region =
      static_cast<std::uint8_t>(std::min((3u * ball.scans_by_region + 8u * ball.scans + 2u) / 4u, 255u));
  ball.scans = 0;
  const double radius = std::max(double{ball.region} * unit_, 0x1p-10 * ball.radius + tolerance_);
  const double neighbours = std::max(static_cast<double>(lists_.at(ball.list).size()), 0.5);
  const double others = std::max(neighbours - near_now(number), 0.5);
  const double scans = 0.125 * ball.scans_by_region;
  const double wanted = 2.0 * (radius + ball.radius) * (cost_of_region + cost_of_neighbour * neighbours) /
                        (dimensions_ * others * (cost_of_neighbour + cost_of_scan * scans));
  const double ratio = std::clamp(wanted / radius, 0.25, 16.0);
  return radius * std::sqrt(std::sqrt(ratio));
}

/// Returns how many neighbours may be in touch with the ball now.
double Core::near_now(std::uint32_t number) const {
  if (!balls_[number].is(Ball::crowded)) return 0.0;
  const auto neighbours = lists_.at(balls_[number].list);
  int near = 0;
  std::array<double, most_lanes> apart;
  for (std::size_t k = 0; k < neighbours.size(); k += most_lanes)
    near += std::popcount(
        candidates(number, neighbours.subspan(k, std::min(neighbours.size() - k, most_lanes)), 0.0, apart));
  return near;
}

/// Gives the ball a safe region of about this radius (length), around and ahead of where its bound is now.
void Core::place_region(std::uint32_t number, double radius) {
  Ball& ball = balls_[number];
  const Vec3 motion = balls_.velocity(number);
  const double speed = norm(motion), growth = balls_.growth(number);
  Vec3 centre = balls_.position(number);
  // Single precision tells so much apart here. A ball that stands still needs no more.
  const double resolved = 0x1p-20 * (norm_one(centre - origin_) + ball.radius) + tolerance_;
  const bool stands = speed == 0.0 && balls_.is_exact(number) && balls_.plan(number) == Vec3{};
  // Times may be so coarse that it goes farther in the least step.
  const double step = 0x1p-49 * std::abs(balls_.time());
  radius = std::max(radius, (speed + balls_.growth_speed(number) + ball.acceleration_limit * step) * step);
  const double widest = std::min(widest_region(ball), largest_region * unit_);
  const double room = widest - growth - resolved;
  radius = stands ? 0.0 : std::min(radius, room > 0.0 ? room : 0.5 * std::max(widest - growth, 0.0));
  if (speed > 0.0) centre += motion * (ahead * radius / speed);
  if (space_.slides()) move_to_row(number, centre);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(balls_.periods().length[axis] > 0.0) || ball.is(Ball::passive)) continue;
    const double images = std::floor((centre[axis] - origin_[axis]) * balls_.periods().inverse[axis]);
    centre[axis] -= images * balls_.periods().length[axis];
    ball.position[axis] -= images * balls_.periods().length[axis];
  }
  ball.region = static_cast<float>((radius + resolved + growth) / unit_);
  for (int axis = 0; axis < 3; ++axis)
    ball.centre[axis] = static_cast<float>((centre[axis] - origin_[axis]) / unit_);
  if (ghosts_ != nullptr) ghosts_->note_region(number, region_centre(ball), double{reach(ball)} * unit_);
  if (space_.slides()) largest_reach_ = std::max(largest_reach_, reach(ball));
  ball.walls &= Ball::at_walls;
  if (!ball.is(Ball::meets_walls)) return;
  const double extent = double{reach(ball)} * unit_;
  const Vec3 middle = region_centre(ball);
  for (const auto& [wall, inside] : walls_)
    if (dot(inside.normal, middle) - inside.offset < extent) ball.walls |= wall_bit(wall);
}

/// Moves a ball, and with it a place near it, to the row of images in which this place is in the primary box.
void Core::move_to_row(std::uint32_t number, Vec3& place) {
  Ball& ball = balls_[number];
  const double rows = std::floor((place.y - origin_.y) * balls_.periods().inverse.y);
  if (rows == 0.0) return;
  const double speed = rows * space_.slide_speed(), since = balls_.time() - ball.time;
  place.x -= rows * balls_.periods().slide;
  ball.position.x -= rows * balls_.periods().slide - speed * since;
  ball.velocity.x -= speed;
}

/// Gives the ball another safe region, which has no part in the lists of neighbours yet. Those of many balls
/// are put into cells together, later.
void Core::enter_region(std::uint32_t number, double radius, bool is_of_many, Host& host) {
  place_region(number, radius);
  const Ball& ball = balls_[number];
  if (ball.has_region()) {
    cells_.prefetch(ball, reach(ball));
    cells_.leave(balls_, number);
  }
  if (is_of_many)
    cells_.add_unsorted(balls_, number, reach(ball));
  else
    cells_.enter(balls_, number, reach(ball));
  if (balls_.periods().any) host.note_image(number, region_centre(ball));
}

/// Makes those within reach the neighbours of the ball, and it theirs; others are no longer.
void Core::find_neighbours(std::uint32_t number, Host& host) {
  const Ball& ball = balls_[number];
  if (space_.slides()) set_search_end(number);
  cells_.start_search(ball, cells_.reach_of(ball.slot), search_);
  if (ball.is(Ball::passive)) {
    join_lists(number, host);
  } else {
    compare_neighbours(number, host);
    update_lists(number);
  }
}

/// Puts a passive ball into the lists of those that were found, which look for it then.
void Core::join_lists(std::uint32_t number, Host& host) {
  cells_.finish_search(search_);
  ++host.work_counters(number).searches;
  for (const std::uint32_t other : search_.found.first(host.keep_partners(number, search_.found))) {
    if (balls_[other].is(Ball::passive)) continue;
    // One that arrives with it may have found it already.
    if (!lists_.contains(balls_[other].list, number)) lists_.add_to(balls_[other].list, number);
    settling_.push_back(other);
  }
}

/// Finds out who is not in reach of the ball any more, and who has come within reach.
void Core::compare_neighbours(std::uint32_t number, Host& host) {
  cells_.finish_search(search_);
  if (space_.slides() && search_ends_[number] < infinity)
    search_rows(balls_[number], reach(balls_[number]), search_ends_[number] - balls_.time(), search_);
  std::size_t count = 0;
  for (const std::uint32_t other : search_.found) {
    search_.found[count] = other;
    count += static_cast<std::size_t>(other != number);
  }
  count = host.keep_partners(number, search_.found.first(count));
  find_changes(lists_.at(balls_[number].list), search_.found.first(count), gone_, new_);
  for (const std::uint32_t other : new_) prefetch_line(&balls_[other]);
  for (const auto* const others : {&gone_, &new_})
    for (const std::uint32_t other : *others) prefetch_line(&balls_[other].due);
  ++host.work_counters(number).searches;
  host.work_counters(number).candidates += lists_.at(balls_[number].list).size() + new_.size() - gone_.size();
}

/// Makes those who have come within reach the neighbours of a ball, and it theirs; those who left, no longer.
void Core::update_lists(std::uint32_t number) {
  for (const auto* const others : {&gone_, &new_})
    for (const std::uint32_t other : *others)
      if (!balls_[other].is(Ball::passive)) prefetch_line(lists_.address(balls_[other].list));
  for (const std::uint32_t other : gone_) {
    lists_.erase(balls_[number].list, other);
    if (!balls_[other].is(Ball::passive)) forget(other, number);
  }
  for (const std::uint32_t other : new_) {
    if (ghosts_ != nullptr) ghosts_->note_neighbours(number, other);
    lists_.add_to(balls_[number].list, other);
    if (!balls_[other].is(Ball::passive)) lists_.add_to(balls_[other].list, number);
  }
}

/// The ball no longer has this neighbour. If it is due about it, it looks for others then.
void Core::forget(std::uint32_t number, std::uint32_t neighbour) {
  lists_.erase(balls_[number].list, neighbour);
  if (balls_[number].about == neighbour) balls_[number].about = number;
}

void Core::forget_neighbours(std::uint32_t number) {
  const Ball& ball = balls_[number];
  if (ball.is(Ball::arriving)) return;
  if (ball.is(Ball::passive)) {
    cells_.search(ball, cells_.reach_of(ball.slot), search_);
    for (const std::uint32_t other : search_.found) {
      if (balls_[other].list != none && lists_.contains(balls_[other].list, number)) forget(other, number);
    }
    return;
  }
  for (const std::uint32_t other : lists_.at(ball.list))
    if (!balls_[other].is(Ball::passive)) forget(other, number);
  lists_.assign(balls_[number].list, {});
}

std::vector<std::uint32_t> Core::all_with_regions() const {
  std::vector<std::uint32_t> all;
  for (std::uint32_t number = 0; number < balls_.size(); ++number)
    if (balls_[number].has_region()) all.push_back(number);
  return all;
}

/// Finds the largest reach of a safe region.
void Core::measure_reaches() {
  largest_reach_ = 0.0F;
  reach_uses_ = 0;
  for (const Ball& ball : balls_.all())
    if (ball.has_region()) largest_reach_ = std::max(largest_reach_, reach(ball));
}

/// Chooses how long the search of a ball that has got a safe region holds in images that slide. They slide by
/// its reach then, unless that is less than in the least steps of time, or more than Space::most_slide: a gas
/// at a packing of 0.1 takes least time so.
void Core::set_search_end(std::uint32_t number) {
  const Ball& ball = balls_[number];
  if (++reach_uses_ > 4 * present_) measure_reaches();
  // So far, on y, it can reach others in the images across y.
  const double across = double{reach(ball)} + double{largest_reach_} + parting_ / unit_;
  const double y = double{ball.centre[1]};
  const double height = balls_.periods().length.y / unit_;
  search_ends_[number] = infinity;
  if (y - across > 0.0 && y + across < height) return;
  const double speed = std::abs(space_.slide_speed());
  const double least = 0x1p-49 * std::abs(balls_.time()) * speed;
  const double slide =
      std::min(std::max(double{reach(ball)} * unit_, least), Space::most_slide * balls_.periods().length.x);
  search_ends_[number] = balls_.time() + std::min(slide / speed, 1e300);
}

/// Adds to what a search in cells has found what comes within reach of the ball in the images across y within
/// this time from now on, while these slide.
void Core::search_rows(const Ball& ball, float reach, double duration, RegionSearch& search) const {
  const double height = balls_.periods().length.y / unit_, width = balls_.periods().length.x / unit_;
  const double slide = duration * space_.slide_speed() / unit_;
  const double middle = balls_.periods().slide / unit_ + 0.5 * slide;
  const float enlarged = RegionCells::raised(
      static_cast<float>((double{reach} + 0.5 * std::abs(slide) + 0x1p-20 * (width + height))));
  RegionSearch beyond;
  for (const double row : {-1.0, 1.0}) {
    const double y = double{ball.centre[1]} - row * height, x = double{ball.centre[0]} - row * middle;
    Ball at = ball;
    at.centre[0] = static_cast<float>(x - std::floor(x / width) * width);
    at.centre[1] = static_cast<float>(y);
    cells_.search(at, enlarged, beyond);
    if (beyond.found.empty()) continue;
    const std::size_t count = search.found.size();
    if (search.room.size() < count + beyond.found.size())
      search.room.resize(2 * (count + beyond.found.size()));
    std::copy(beyond.found.begin(), beyond.found.end(),
              search.room.begin() + static_cast<std::ptrdiff_t>(count));
    search.found = std::span(search.room).first(count + beyond.found.size());
    search.may_repeat = true;
  }
}

/// Finds balls by their safe regions.
std::vector<std::uint32_t> Core::find(const Vec3& centre, double radius) const {
  Vec3 place = centre - origin_;
  if (space_.slides()) place = space_.wrapped(centre, balls_.time()).position - origin_;
  for (int axis = 0; axis < 3; ++axis)
    if (const double period = balls_.periods().length[axis]; period > 0.0)
      place[axis] -= std::floor(place[axis] * balls_.periods().inverse[axis]) * period;
  const double resolved = 0x1p-20 * (norm_one(place) + radius) + tolerance_;
  Ball at;
  for (int axis = 0; axis < 3; ++axis) at.centre[axis] = static_cast<float>(place[axis] / unit_);
  at.region = static_cast<float>((radius + resolved) / unit_);
  RegionSearch search;
  // A wide region reaches images beyond the next rows.
  if (space_.slides() && !(radius < 0.5 * balls_.periods().length.y)) return all_with_regions();
  cells_.search(at, reach(at), search);
  if (space_.slides()) search_rows(at, reach(at), 0.0, search);
  search.drop_repeats();
  return {search.found.begin(), search.found.end()};
}

std::vector<std::pair<Box, std::size_t>> Core::cells() const {
  auto all = cells_.filled();
  for (auto& [box, count] : all) box = {origin_ + box.lower * unit_, origin_ + box.upper * unit_};
  return all;
}

}  // namespace kinesphere::core
