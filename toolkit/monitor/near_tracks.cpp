#include "monitor/near_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinesphere {
namespace {

// In units of cells: where lengths are larger, a region is everywhere. Squares of sums of these are ordinary
// numbers in single precision.
constexpr double largest_ordinary = 0x1p59;
constexpr float everywhere = 0x1p61F;

/// Places a ball over a region, and returns its reach. The reach covers the rounding of the centre.
float reach_over(const Region& region, double unit, core::Ball& ball) {
  const Vec3 centre = region.centre * (1.0 / unit);
  const double size = norm_one(centre) + region.radius / unit;
  const bool is_ordinary = size < largest_ordinary;
  ball.position = region.centre;
  ball.radius = region.radius;
  for (int axis = 0; axis < 3; ++axis)
    ball.centre[axis] = is_ordinary ? static_cast<float>(centre[axis]) : 0.0F;
  const double reach = (region.radius / unit + 0x1p-22 * size) * (1.0 + 0x1p-20);
  return is_ordinary ? core::RegionCells::raised(std::max(static_cast<float>(reach), 0x1p-60F)) : everywhere;
}

}  // namespace

void NearTracks::enter(std::uint32_t track, std::span<const Region> regions) {
  for (auto region = regions.rbegin(); region != regions.rend(); ++region) {
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
    const float reach = reach_over(*region, unit_, balls_[ball]);
    cells_.enter(balls_, ball, reach);
  }
}

void NearTracks::leave(std::uint32_t track) {
  for (std::uint32_t ball = std::exchange(tracks_[track].first_ball, none); ball != none;) {
    cells_.leave(balls_, ball);
    const std::uint32_t next = std::exchange(next_[ball], free_ball_);
    free_ball_ = std::exchange(ball, next);
  }
}

/// Finds the other tracks whose regions touch those of a track.
void NearTracks::find(std::uint32_t track) {
  found_.clear();
  for (std::uint32_t ball = tracks_[track].first_ball; ball != none; ball = next_[ball]) {
    cells_.search(balls_[ball], cells_.reach_of(balls_[ball].slot), search_);
    for (const std::uint32_t other : search_.found)
      if (track_of_[other] != track) found_.push_back(track_of_[other]);
  }
  std::sort(found_.begin(), found_.end());
  found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
}

std::size_t NearTracks::place(std::uint32_t track, std::span<const Region> regions, const Matter& matter) {
  if (track >= tracks_.size()) tracks_.resize(track + 1);
  if (tracks_[track].list == none) tracks_[track].list = lists_.add();
  leave(track);
  enter(track, regions);
  find(track);
  const std::size_t touching = found_.size();
  std::erase_if(found_, [&](std::uint32_t other) { return !matter(track, other); });
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

Region NearTracks::region(std::uint32_t track, std::size_t k) const {
  std::uint32_t ball = tracks_[track].first_ball;
  for (; k > 0; --k) ball = next_[ball];
  return {balls_[ball].position, balls_[ball].radius};
}

std::vector<std::vector<Region>> NearTracks::saved() const {
  std::vector<std::vector<Region>> saved(tracks_.size());
  for (std::uint32_t track = 0; track < tracks_.size(); ++track)
    for (std::uint32_t ball = tracks_[track].first_ball; ball != none; ball = next_[ball])
      saved[track].push_back({balls_[ball].position, balls_[ball].radius});
  while (!saved.empty() && saved.back().empty()) saved.pop_back();
  return saved;
}

bool NearTracks::rebuild(std::size_t tracks, const std::function<std::size_t(std::uint32_t)>& count_of,
                         const Matter& matter) {
  std::vector<std::vector<Region>> read = std::exchange(read_, {});
  if (read.size() > tracks) return false;
  read.resize(tracks);
  tracks_.resize(tracks);
  for (std::uint32_t track = 0; track < tracks; ++track) {
    if (read[track].size() != count_of(track)) return false;
    for (const Region& region : read[track])
      if (!is_finite(region.centre) || !(region.radius >= 0.0)) return false;
    if (read[track].empty()) continue;
    tracks_[track].list = lists_.add();
    enter(track, read[track]);
  }
  for (std::uint32_t track = 0; track < tracks; ++track) {
    if (read[track].empty()) continue;
    find(track);
    std::erase_if(found_, [&](std::uint32_t other) { return !matter(track, other); });
    lists_.assign(tracks_[track].list, found_);
  }
  return true;
}

}  // namespace kinesphere
