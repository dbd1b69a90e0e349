// What a snapshot holds of a core, and how the rest is made anew.
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/core.hpp"

namespace kinesphere::core {
namespace {

/// More than a world can make of changes.
constexpr std::uint64_t most_changes = std::uint64_t{1} << 62;

}  // namespace

Core::Saved Core::saved() const {
  Saved saved;
  saved.reaches.resize(balls_.size());
  saved.lists.resize(balls_.size());
  for (std::uint32_t number = 0; number < balls_.size(); ++number) {
    const Ball& ball = balls_[number];
    if (ball.has_region()) saved.reaches[number] = cells_.reach_of(ball.slot);
    if (ball.list == none) continue;
    const auto neighbours = lists_.at(ball.list);
    saved.lists[number].assign(neighbours.begin(), neighbours.end());
  }
  return saved;
}

Core::Record Core::record_of(std::uint32_t number) const {
  Record record{.ball = balls_[number], .drift = balls_.drift(number), .change = changes_[number]};
  if (record.ball.has_region()) record.reach = cells_.reach_of(record.ball.slot);
  if (record.ball.list != none) {
    const auto neighbours = lists_.at(record.ball.list);
    record.neighbours.assign(neighbours.begin(), neighbours.end());
  }
  return record;
}

void Core::adopt(std::uint32_t number, const Record& record) {
  balls_.grow(number + 1);
  changes_.resize(balls_.size());
  saved_.reaches.resize(balls_.size());
  saved_.lists.resize(balls_.size());
  balls_.adopt(number, record.ball, record.drift);
  changes_[number] = record.change;
  saved_.reaches[number] = record.reach;
  saved_.lists[number] = record.neighbours;
}

void Core::be_part(Ghosts& ghosts, double first_radius, bool grows, bool drifts) {
  saved_.reaches.resize(balls_.size());
  saved_.lists.resize(balls_.size());
  assemble();
  ghosts_ = &ghosts;
  first_radius_ = first_radius;
  balls_.expect(grows, drifts);
  for (std::uint32_t number = 0; number < balls_.size(); ++number) {
    if (balls_[number].list == none) continue;
    for (const std::uint32_t other : lists_.at(balls_[number].list)) ghosts.note_neighbours(number, other);
    if (balls_[number].has_region()) ghosts.note_region(number, region_centre(number), region_reach(number));
  }
}

/// Notes what others see of a ball.
void Core::note_all(std::uint32_t number) {
  const Ball& ball = balls_[number];
  ghosts_->note(number, ball.position.x, ball.position.y, ball.position.z, ball.velocity.x, ball.velocity.y,
                ball.velocity.z, ball.time, ball.radius, ball.due, ball.own, ball.acceleration_limit,
                ball.centre[0], ball.centre[1], ball.centre[2], ball.region, ball.walls, ball.flags,
                changes_[number]);
}

bool Core::can_hold(const Bound& bound, double time) const {
  return norm_one(bound.centre_at(time)) + bound.radius_at(time) < 0x1p61 * unit_;
}

bool Core::reports_now(std::uint32_t number, double time) const {
  if (!contains(number)) return false;
  const Ball& ball = balls_[number];
  return !ball.is(Ball::arriving) && ball.about == none && !ball.is(Ball::at_wall) && ball.due <= time &&
         ball.time < time;
}

bool Core::rebuild(double time) {
  set_time(time);
  if (search_ends_.size() != (space_.slides() ? balls_.size() : 0)) return false;
  for (const double end : search_ends_)
    if (std::isnan(end)) return false;
  if (!(largest_reach_ >= 0.0F && largest_reach_ < 0x1p62F)) return false;
  if (!balls_.has_valid_drifts() || saved_.reaches.size() != balls_.size() ||
      changes_.size() != balls_.size() || saved_.lists.size() != balls_.size())
    return false;
  std::vector<std::vector<std::uint32_t>> sorted = saved_.lists;
  for (std::vector<std::uint32_t>& list : sorted) std::sort(list.begin(), list.end());
  for (std::uint32_t number = 0; number < balls_.size(); ++number)
    if (!is_valid(number, sorted)) return false;
  assemble();
  return true;
}

/// Puts the balls that have been read or adopted into lists, cells and the queue.
void Core::assemble() {
  for (std::uint32_t number = 0; number < balls_.size(); ++number) {
    Ball& ball = balls_[number];
    if (!ball.is_present()) continue;
    ++present_;
    arriving_ += static_cast<std::size_t>(ball.is(Ball::arriving));
    if (saved_.reaches[number] > 0.0F) cells_.add_unsorted(balls_, number, saved_.reaches[number]);
    if (ball.is(Ball::passive)) continue;
    ball.list = lists_.add();
    lists_.assign(ball.list, saved_.lists[number]);
  }
  cells_.sort(balls_);
  saved_ = {};
  queue_.refill(balls_.all(), balls_.time());
  queued_for_ = balls_.size();
}

/// Returns true if two balls with these reaches may have found each other: where images slide, in any place
/// along x of a row.
bool Core::may_be_near(const Ball& a, float reach_of_a, const Ball& b, float reach_of_b) const {
  if (cells_.are_near(a, reach_of_a, b, reach_of_b)) return true;
  if (!space_.slides()) return false;
  const double height = balls_.periods().length.y / unit_;
  const double slide = Space::most_slide * balls_.periods().length.x / unit_;
  for (const double row : {-1.0, 1.0}) {
    Ball image = b;
    image.centre[0] = a.centre[0];
    image.centre[1] += static_cast<float>(row * height);
    if (cells_.are_near(a, reach_of_a + static_cast<float>(slide), image, reach_of_b)) return true;
  }
  return false;
}

/// Returns false if no ball can be like this one, which was read from bytes. `lists`: in ascending order.
bool Core::is_valid(std::uint32_t number, std::span<const std::vector<std::uint32_t>> lists) const {
  const Ball& ball = balls_[number];
  if (!balls_.is_valid(number) || !(ball.radius < 0x1p32 * unit_)) return false;
  if (ball.is_present() && !can_hold(balls_.bound(number), balls_.time()) &&
      !reports_now(number, balls_.time()))
    return false;
  const std::vector<std::uint32_t>& neighbours = lists[number];
  if (!ball.is_present()) return neighbours.empty();
  if (changes_[number] > most_changes || (ball.is(Ball::passive) && changes_[number] != 0)) return false;
  if (ball.is(Ball::passive) && std::min({ball.due, ball.second, ball.own}) < infinity) return false;
  unsigned walls = 0;
  for (const auto& [wall, inside] : walls_) walls |= wall_bit(wall);
  if (walls != 0) walls |= Ball::at_walls;
  if ((ball.walls & ~walls) != 0 || (walls == 0 && ball.is(Ball::at_wall))) return false;
  const float reach = saved_.reaches[number];
  if (ball.is(Ball::arriving) && (!neighbours.empty() || ball.about != none)) return false;
  if (ball.is(Ball::arriving) && reach == 0.0F) return true;
  if (!(reach > 0.0F && reach < 0x1p62F)) return false;
  if (ball.is(Ball::passive) && !neighbours.empty()) return false;
  const bool waits = ball.about != none && ball.about != number;
  if (waits && (ball.is(Ball::passive) || !contains(ball.about))) return false;
  if (std::adjacent_find(neighbours.begin(), neighbours.end(), std::greater_equal()) != neighbours.end())
    return false;
  // Each of two that are neighbours has the other, but for passive ones.
  return std::all_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t other) {
    if (!contains(other) || other == number || balls_[other].is(Ball::arriving) ||
        !may_be_near(ball, reach, balls_[other], saved_.reaches[other]))
      return false;
    const std::vector<std::uint32_t>& others = lists[other];
    return balls_[other].is(Ball::passive) || std::binary_search(others.begin(), others.end(), number);
  });
}

}  // namespace kinesphere::core
