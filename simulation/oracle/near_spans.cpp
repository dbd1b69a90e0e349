#include "simulation/oracle/near_spans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "number/infinity.hpp"
#include "simulation/oracle/gap_course.hpp"

namespace kinesphere {
namespace {

/// Relative margin of a coordinate, far above the rounding of its computation; larger margins make longer
/// spans.
constexpr double rounding = 0x1p-44;
/// Bounds on the number of windows. Windows last as long as a piece between them; more windows make shorter
/// spans at the cost of one sort each.
constexpr double fewest_windows = 64.0;
constexpr double most_windows = 1 << 20;

void include(Box& box, const Vec3& point, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(box.lower[axis], point[axis] - margin);
    box.upper[axis] = std::max(box.upper[axis], point[axis] + margin);
  }
}

/// Includes the four Bernstein coefficients of the position during [begin, end], which enclose it, with a
/// margin for rounding.
void include(Box& box, const Segment& segment, double begin, double end) {
  const double duration = end - begin;
  const State state = segment.state_at(begin);
  const Vec3 slope = state.velocity * (duration / 3.0);
  const Vec3 bend = segment.acceleration_at(begin) * (duration * duration / 6.0);
  const Vec3 twist = segment.jerk * (duration * duration * duration / 6.0);
  const double since = end - segment.begin;
  const double size = norm_one(segment.position) + norm_one(segment.velocity) * since +
                      (norm_one(segment.acceleration) + norm_one(segment.jerk) * since) * since * since;
  const double margin = rounding * size;
  include(box, state.position, margin);
  include(box, state.position + slope, margin);
  include(box, state.position + slope * 2.0 + bend, margin);
  include(box, state.position + slope * 3.0 + bend * 3.0 + twist, margin);
}

bool overlap(const Box& a, const Box& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
         b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

class Search {
 public:
  Search(const std::vector<PresentBody>& bodies, double gap) : bodies_(bodies), gap_(gap) {
    double pieces = 0.0, body_time = 0.0;
    double end = -infinity;
    begin_ = infinity;
    for (std::uint32_t number = 0; number < bodies.size(); ++number) {
      const PresentBody& body = bodies[number];
      if (body.trajectory == nullptr) continue;
      coming_.push_back(number);
      begin_ = std::min(begin_, body.begin);
      end = std::max(end, body.end);
      pieces += static_cast<double>(body.trajectory->size());
      body_time += body.end - body.begin;
    }
    if (coming_.empty()) return;
    std::sort(coming_.begin(), coming_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tie(bodies[a].begin, a) < std::tie(bodies[b].begin, b);
    });
    const double duration = end - begin_;
    // A window lasts about as long as a piece.
    const double wanted = body_time > 0.0 ? std::ceil(pieces / body_time * duration) : 1.0;
    windows_ = static_cast<std::uint32_t>(std::clamp(wanted, fewest_windows, most_windows));
    length_ = duration / windows_;
  }

  std::vector<NearSpan> run(const std::function<void(double)>& on_progress) {
    for (window_ = 0; window_ < windows_; ++window_) {
      if (on_progress) on_progress(static_cast<double>(window_) / windows_);
      enclose();
      sweep();
      join();
    }
    for (const Run& run : open_) close(run);
    std::sort(spans_.begin(), spans_.end(), [](const NearSpan& a, const NearSpan& b) {
      return std::tie(a.first, a.second, a.begin) < std::tie(b.first, b.second, b.begin);
    });
    merge();
    return std::move(spans_);
  }

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  /// Consecutive windows in which two bodies may be near each other, up to the present one.
  struct Run {
    Pair pair;
    std::uint32_t first_window;
  };
  struct Enclosed {
    Box box;
    std::uint32_t body;
  };

  double start_of(std::uint32_t window) const { return begin_ + window * length_; }
  /// Returns the end of a window. The last window is endless, so that it holds the end of all bodies whatever
  /// rounding does.
  double end_of(std::uint32_t window) const {
    return window + 1 == windows_ ? infinity : start_of(window + 1);
  }

  /// Computes the boxes of all bodies that are there during the window.
  void enclose() {
    const double from = start_of(window_), to = end_of(window_);
    while (next_ < coming_.size() && bodies_[coming_[next_]].begin <= to)
      present_.push_back(coming_[next_++]);
    std::erase_if(present_, [&](std::uint32_t number) { return bodies_[number].end < from; });
    enclosed_.clear();
    for (const std::uint32_t number : present_) {
      const PresentBody& body = bodies_[number];
      Box box = box_of(*body.trajectory, std::max(from, body.begin), std::min(to, body.end));
      const double margin = (body.radius + 0.5 * gap_) * (1.0 + rounding);
      box.lower -= {margin, margin, margin};
      box.upper += {margin, margin, margin};
      enclosed_.push_back({box, number});
    }
  }

  int longest_axis() const {
    Vec3 lower{infinity, infinity, infinity};
    Vec3 upper = -lower;
    for (const Enclosed& one : enclosed_)
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], one.box.lower[axis]);
        upper[axis] = std::max(upper[axis], one.box.lower[axis]);
      }
    const Vec3 size = upper - lower;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  void sweep() {
    const int axis = longest_axis();
    std::sort(enclosed_.begin(), enclosed_.end(),
              [axis](const Enclosed& a, const Enclosed& b) { return a.box.lower[axis] < b.box.lower[axis]; });
    near_.clear();
    for (auto one = enclosed_.begin(); one != enclosed_.end(); ++one)
      for (auto other = one + 1; other != enclosed_.end() && other->box.lower[axis] <= one->box.upper[axis];
           ++other)
        if (overlap(one->box, other->box))
          near_.emplace_back(std::min(one->body, other->body), std::max(one->body, other->body));
    std::sort(near_.begin(), near_.end());
  }

  /// Extends the runs of pairs that are near in this window too, begins those of new pairs and closes the
  /// others.
  void join() {
    std::vector<Run> still;
    still.reserve(near_.size());
    auto before = open_.begin();
    for (const Pair& pair : near_) {
      for (; before != open_.end() && before->pair < pair; ++before) close(*before);
      const bool goes_on = before != open_.end() && before->pair == pair;
      still.push_back(goes_on ? *before++ : Run{pair, window_});
    }
    for (; before != open_.end(); ++before) close(*before);
    open_ = std::move(still);
  }

  /// Ends a run with the window before the present one and adds its span, widened to whole pieces.
  void close(const Run& run) {
    const auto [first, second] = run.pair;
    const PresentBody& a = bodies_[first];
    const PresentBody& b = bodies_[second];
    const double together = std::max(a.begin, b.begin);
    const double apart = std::min(a.end, b.end);
    if (!(together <= apart)) return;
    const double from = std::clamp(start_of(run.first_window), together, apart);
    const double to = std::clamp(end_of(window_ - 1), together, apart);
    const double begin =
        std::max({together, segment_at(*a.trajectory, from).begin, segment_at(*b.trajectory, from).begin});
    const double end =
        std::min({apart, segment_at(*a.trajectory, to).end, segment_at(*b.trajectory, to).end});
    spans_.push_back({first, second, begin, std::max(end, to)});
  }

  void merge() {
    std::size_t count = 0;
    for (const NearSpan& span : spans_) {
      if (count > 0 && spans_[count - 1].first == span.first && spans_[count - 1].second == span.second &&
          span.begin <= spans_[count - 1].end) {
        spans_[count - 1].end = std::max(spans_[count - 1].end, span.end);
      } else {
        spans_[count++] = span;
      }
    }
    spans_.resize(count);
  }

  const std::vector<PresentBody>& bodies_;
  double gap_;
  double begin_;
  double length_ = 0.0;
  std::uint32_t windows_ = 0;
  std::uint32_t window_ = 0;
  std::vector<std::uint32_t> coming_;  ///< bodies in order of their begin
  std::size_t next_ = 0;               ///< first entry of coming_ that is not there yet
  std::vector<std::uint32_t> present_;
  std::vector<Enclosed> enclosed_;
  std::vector<Pair> near_;
  std::vector<Run> open_;  ///< sorted by pair
  std::vector<NearSpan> spans_;
};

}  // namespace

Box box_of(const Trajectory& trajectory, double begin, double end) {
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  const Segment* segment = &segment_at(trajectory, begin);
  const Segment* const last = &trajectory.back();
  for (;; ++segment) {
    const bool is_last = segment == last || segment->end >= end;
    include(box, *segment, begin, is_last ? end : segment->end);
    if (is_last) return box;
    begin = segment->end;
  }
}

std::vector<NearSpan> near_spans(const std::vector<PresentBody>& bodies, double gap,
                                 const std::function<void(double)>& on_progress) {
  return Search(bodies, gap).run(on_progress);
}

}  // namespace kinesphere
