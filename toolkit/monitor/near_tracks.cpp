#include "monitor/near_tracks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "number/powers.hpp"

namespace kinesphere {
namespace {

// In units of cells: where lengths are larger, a region is everywhere. Squares of sums of these are ordinary
// numbers in single precision.
constexpr double largest_ordinary = 0x1p59;
constexpr float everywhere = 0x1p61F, smallest = 0x1p-60F;

/// Returns true for what NearTracks can have made.
bool is_valid(const std::array<float, 3>& centre, float radius) {
  const auto is_ordinary = [](float value) {
    return std::abs(value) <= static_cast<float>(largest_ordinary);
  };
  return radius >= smallest && radius <= everywhere && std::all_of(centre.begin(), centre.end(), is_ordinary);
}

/// Zones whose lengths are at most so many tolerances meet within a tolerance of what double precision says.
constexpr double largest_zone = 0x1p44;

/// Returns a zone that can be compared with others: those of all sizes that can be, if it is too large.
Bound comparable(const Bound& zone, double until, double tolerance) {
  const double duration = until - zone.time;
  const double size = norm_one(zone.position) +
                      (norm_one(zone.velocity) + norm_one(zone.planned_acceleration) * duration) * duration +
                      zone.radius_at(until);
  if (size < largest_zone * tolerance) return zone;
  return {.time = zone.time, .radius = 2.0 * largest_zone * tolerance};
}

}  // namespace

NearTracks::NearTracks(double tolerance, int dimensions)
    : tolerance_(tolerance),
      unit_(power_of_two(exponent_of(tolerance) + 20)),
      balls_(core::Periods(), 0.0),
      cells_(Vec3(), dimensions) {}

/// Returns a region of single precision around this one.
NearTracks::Saved NearTracks::in_units(const Region& region) const {
  const Vec3 centre = region.centre * (1.0 / unit_);
  const double size = norm_one(centre) + region.radius / unit_;
  if (!(size < largest_ordinary)) return {.radius = everywhere};
  Saved saved;
  for (int axis = 0; axis < 3; ++axis)
    saved.centre[static_cast<std::size_t>(axis)] = static_cast<float>(centre[axis]);
  const double radius = (region.radius / unit_ + 0x1p-22 * size) * (1.0 + 0x1p-20);
  saved.radius = std::max(static_cast<float>(radius), smallest);
  return saved;
}

/// Gives a track a region before its other ones.
void NearTracks::enter(std::uint32_t track, const Saved& region) {
  std::uint32_t ball = free_ball_;
  if (ball == none) {
    ball = balls_.size();
    balls_.grow(ball + 1);
    track_of_.push_back(track);
    next_.push_back(none);
  } else {
    free_ball_ = next_[ball];
  }
  track_of_[ball] = track;
  next_[ball] = std::exchange(tracks_[track].first_ball, ball);
  several_ = several_ || next_[ball] != none;
  std::copy(region.centre.begin(), region.centre.end(), balls_[ball].centre);
  balls_[ball].region = region.radius;
  balls_.set_bound(ball, region.zone);
  cells_.enter(balls_, ball, core::RegionCells::raised(region.radius));
}

void NearTracks::leave(std::uint32_t track) {
  for (std::uint32_t ball = std::exchange(tracks_[track].first_ball, none); ball != none;) {
    cells_.leave(balls_, ball);
    const std::uint32_t next = std::exchange(next_[ball], free_ball_);
    free_ball_ = std::exchange(ball, next);
  }
}

/// Finds the other tracks whose regions touch those of a track, each once.
void NearTracks::find(std::uint32_t track) {
  found_.clear();
  std::size_t regions = 0;
  for (std::uint32_t ball = tracks_[track].first_ball; ball != none; ball = next_[ball], ++regions) {
    cells_.search(balls_[ball], cells_.reach_of(balls_[ball].slot), search_);
    search_.drop_repeats();
    for (const std::uint32_t other : search_.found)
      if (track_of_[other] != track) found_.push_back(track_of_[other]);
  }
  if (regions == 1 && !several_) return;
  std::sort(found_.begin(), found_.end());
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
}

std::size_t NearTracks::place(std::uint32_t track, std::span<const Region> regions, const Matter& matter) {
  if (track >= tracks_.size()) tracks_.resize(track + 1);
  if (tracks_[track].list == none) tracks_[track].list = lists_.add();
  leave(track);
  for (auto region = regions.rbegin(); region != regions.rend(); ++region) enter(track, in_units(*region));
  find(track);
  const std::size_t touching = found_.size();
  if (matter) std::erase_if(found_, [&](std::uint32_t other) { return !matter(track, other); });
  core::find_changes(lists_.at(tracks_[track].list), found_, gone_, fresh_);
  for (const std::uint32_t other : fresh_) join(track, other);
  return touching;
}

void NearTracks::join(std::uint32_t a, std::uint32_t b) {
  lists_.add_to(tracks_[a].list, b);
  lists_.add_to(tracks_[b].list, a);
}

void NearTracks::part(std::uint32_t a, std::uint32_t b) {
  lists_.erase(tracks_[a].list, b);
  lists_.erase(tracks_[b].list, a);
}

void NearTracks::remove(std::uint32_t track) {
  if (track >= tracks_.size() || tracks_[track].list == none) return;
  leave(track);
  for (const std::uint32_t other : near(track)) lists_.erase(tracks_[other].list, track);
  lists_.assign(tracks_[track].list, {});
  lists_.remove(std::exchange(tracks_[track].list, none));
}

std::span<const std::uint32_t> NearTracks::near(std::uint32_t track) const {
  if (track >= tracks_.size() || tracks_[track].list == none) return {};
  return lists_.at(tracks_[track].list);
}

bool NearTracks::are_near(std::uint32_t a, std::uint32_t b) const {
  const auto others = near(a);
  return std::find(others.begin(), others.end(), b) != others.end();
}

bool NearTracks::touch(std::uint32_t a, std::uint32_t b) const {
  const auto reach = [this](std::uint32_t ball) { return cells_.reach_of(balls_[ball].slot); };
  for (std::uint32_t one = tracks_[a].first_ball; one != none; one = next_[one])
    for (std::uint32_t other = tracks_[b].first_ball; other != none; other = next_[other])
      if (cells_.are_near(balls_[one], reach(one), balls_[other], reach(other))) return true;
  return false;
}

std::uint32_t NearTracks::ball_of(std::uint32_t track, std::size_t k) const {
  std::uint32_t ball = tracks_[track].first_ball;
  for (; k > 0; --k) ball = next_[ball];
  return ball;
}

Region NearTracks::region(std::uint32_t track, std::size_t k) const {
  const core::Ball& ball = balls_[ball_of(track, k)];
  return {Vec3{ball.centre[0], ball.centre[1], ball.centre[2]} * unit_, double{ball.region} * unit_};
}

void NearTracks::set_zone(std::uint32_t track, std::size_t k, const Bound& zone, double until) {
  balls_.set_bound(ball_of(track, k), comparable(zone, until, tolerance_));
}

std::vector<std::vector<NearTracks::Saved>> NearTracks::saved() const {
  std::vector<std::vector<Saved>> saved(tracks_.size());
  for (std::uint32_t track = 0; track < tracks_.size(); ++track)
    for (std::uint32_t ball = tracks_[track].first_ball; ball != none; ball = next_[ball]) {
      const auto& centre = balls_[ball].centre;
      saved[track].push_back({{centre[0], centre[1], centre[2]}, balls_[ball].region, balls_.bound(ball)});
    }
  while (!saved.empty() && saved.back().empty()) saved.pop_back();
  return saved;
}

std::span<const NearTracks::Meeting> NearTracks::meetings(std::uint32_t track, double now, double duration) {
  meetings_.clear();
  balls_.set_time(now);
  std::array<std::uint32_t, core::most_lanes> others{};
  std::size_t count = 0;
  const auto find_all = [&] {
    for (std::uint32_t ball = tracks_[track].first_ball; ball != none; ball = next_[ball])
      find_meetings(ball, std::span(others).first(count), duration);
    count = 0;
  };
  for (const std::uint32_t other : near(track))
    for (std::uint32_t ball = tracks_[other].first_ball; ball != none; ball = next_[ball]) {
      others[count++] = ball;
      if (count == others.size()) find_all();
    }
  find_all();
  return meetings_;
}

/// Appends the meetings of a ball with some others.
void NearTracks::find_meetings(std::uint32_t ball, std::span<const std::uint32_t> others, double duration) {
  const BoundAt zone = balls_.bound_now(ball);
  const core::NearQuery query{.pairs = balls_.pair_query(tolerance_, 0.0),
                              .duration = duration,
                              .position = zone.centre,
                              .velocity = zone.velocity,
                              .radius = zone.radius + tolerance_,
                              .speed = zone.speed,
                              .growth = zone.growth,
                              .plan = zone.acceleration};
  std::array<double, core::most_lanes> apart;
  for (std::uint32_t left =
           core::may_meet(balls_.all().data(), others.data(), others.size(), query, apart.data());
       left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    meetings_.push_back({track_of_[others[lane]], std::max(apart[lane], 0.0)});
  }
}

bool NearTracks::rebuild(std::size_t tracks, const std::function<std::size_t(std::uint32_t)>& count_of,
                         const Matter& matter) {
  std::vector<std::vector<Saved>> read = std::exchange(read_, {});
  if (read.size() > tracks) return false;
  read.resize(tracks);
  tracks_.resize(tracks);
  for (std::uint32_t track = 0; track < tracks; ++track) {
    if (read[track].size() != count_of(track)) return false;
    if (read[track].empty()) continue;
    tracks_[track].list = lists_.add();
    for (auto region = read[track].rbegin(); region != read[track].rend(); ++region) {
      if (!is_valid(region->centre, region->radius)) return false;
      enter(track, *region);
    }
  }
  for (std::uint32_t track = 0; track < tracks; ++track) {
    if (read[track].empty()) continue;
    find(track);
    if (matter) std::erase_if(found_, [&](std::uint32_t other) { return !matter(track, other); });
    lists_.assign(tracks_[track].list, found_);
  }
  return true;
}

}  // namespace kinesphere
