// The two schedules.
#include "lab/index/schedule.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

std::size_t groups_for(std::size_t times) { return (times + TimeGroup::width - 1) / TimeGroup::width; }

/// Equal times get equal bits.
double without_sign_of_zero(double time) { return time + 0.0; }

}  // namespace

void LinearSchedule::set(std::uint32_t body, double time) {
  if (time < infinity) {
    times_[body] = time;
  } else {
    remove(body);
  }
}

double LinearSchedule::next_time() const { return times_.empty() ? infinity : times_.at(next_body()); }

std::uint32_t LinearSchedule::next_body() const {
  const auto sooner = [](const auto& one, const auto& other) { return one.second < other.second; };
  return std::min_element(times_.begin(), times_.end(), sooner)->first;
}

double LinearSchedule::time_of(std::uint32_t body) const {
  const auto found = times_.find(body);
  return found == times_.end() ? infinity : found->second;
}

void TreeSchedule::set(std::uint32_t body, double time) {
  assert(!std::isnan(time));
  if (body >= room()) {
    if (time == infinity) return;
    make_room(body);
  }
  double least = without_sign_of_zero(time);
  std::size_t index = body;
  for (std::size_t level = 0; level < height_; ++level) {
    TimeGroup& group = levels_[level][index / width];
    double& changed = group[index % width];
    if (changed == least) return;
    changed = least;
    least = group.least();
    index /= width;
  }
  next_time_ = least;
}

std::uint32_t TreeSchedule::next_body() const {
  assert(next_time_ < infinity);
  return first_within(0, height_, next_time_);
}

/// The first one outside of that part of the highest group in which the next one is.
std::optional<std::uint32_t> TreeSchedule::soon() const {
  if (next_time_ == infinity) return std::nullopt;
  TimeGroup others = levels_[height_ - 1].front();
  others[others.find(next_time_)] = infinity;
  const double time = others.least();
  if (time == infinity) return std::nullopt;
  return first_within(others.find(time), height_ - 1, time);
}

/// The first body with this time, the least, in the part of the levels below `level` that begins with the
/// group of this index.
std::uint32_t TreeSchedule::first_within(std::size_t index, std::size_t level, double time) const {
  while (level-- > 0) index = index * width + levels_[level][index].find(time);
  return static_cast<std::uint32_t>(index);
}

void TreeSchedule::make_room(std::uint32_t body) {
  std::size_t groups = body / width + 1;
  levels_[0].resize(groups);
  for (std::size_t level = 1; level < height_; ++level) {
    groups = groups_for(groups);
    levels_[level].resize(groups);
  }
  height_ = std::max<std::size_t>(height_, 1);
  complete();
}

/// From the lowest level alone.
void TreeSchedule::build() {
  height_ = levels_[0].empty() ? 0 : 1;
  complete();
  next_time_ = height_ == 0 ? infinity : levels_[height_ - 1].front().least();
}

/// Adds levels until the highest has one group.
void TreeSchedule::complete() {
  for (; height_ > 0 && levels_[height_ - 1].size() > 1; ++height_) {
    const Level& below = levels_[height_ - 1];
    Level& level = levels_[height_];
    level.assign(groups_for(below.size()), TimeGroup());
    for (std::size_t k = 0; k < below.size(); ++k) level[k / width][k % width] = below[k].least();
  }
}

bool TreeSchedule::is_valid(std::size_t bodies) const {
  if (levels_[0].size() > groups_for(bodies)) return false;
  for (std::size_t body = 0; body < room(); ++body) {
    const double time = levels_[0][body / width][body % width];
    if (std::isnan(time) || (time == 0.0 && std::signbit(time))) return false;
    if (body >= bodies && time < infinity) return false;
  }
  return true;
}

}  // namespace kinesphere
