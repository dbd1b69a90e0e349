// Approaches of rectangles: branch and bound over time.
#include "simulation/tracks/rectangle_approaches.hpp"

#include <algorithm>
#include <cmath>

#include "number/infinity.hpp"
#include "simulation/tracks/rectangle_pair.hpp"

namespace kinesphere {
namespace {

using Piece = RectanglePair::Piece;

struct CloseSpan {
  double begin, end;
};

/// Finds the spans in which two bodies are close.
class CloseSpans {
 public:
  CloseSpans(const RectanglePair& pair, double distance, double tolerance)
      : pair_(pair), distance_(distance), tolerance_(tolerance) {
    for (const Piece& piece : pair.pieces()) divide(piece, piece.begin, piece.end, 0);
  }
  const std::vector<CloseSpan>& found() const { return spans_; }

 private:
  static constexpr int max_depth = 40;

  void divide(const Piece& piece, double from, double to, int depth) {
    const double middle = 0.5 * (from + to), gap = pair_.gap(piece, middle);
    const double change = pair_.fastest(piece, from, to) * 0.5 * (to - from);
    if (gap - change > distance_) return;
    if (gap + change <= distance_) return add(from, to);
    if (change <= 0.5 * tolerance_ || depth == max_depth) {
      if (gap <= distance_) add(from, to);
      return;
    }
    divide(piece, from, middle, depth + 1);
    divide(piece, middle, to, depth + 1);
  }
  void add(double from, double to) {
    if (!spans_.empty() && spans_.back().end == from)
      spans_.back().end = to;
    else
      spans_.push_back({from, to});
  }

  const RectanglePair& pair_;
  double distance_, tolerance_;
  std::vector<CloseSpan> spans_;
};

/// Finds the least distance.
class LeastGap {
 public:
  LeastGap(const RectanglePair& pair, double tolerance) : pair_(pair), tolerance_(tolerance) {
    for (const Piece& piece : pair.pieces()) {
      offer(piece, piece.begin);
      offer(piece, piece.end);
    }
    for (const Piece& piece : pair.pieces()) divide(piece, piece.begin, piece.end);
    refine();
  }
  double least() const { return least_; }
  ClosestApproach closest() const { return pair_.minimum(*piece_, time_).closest; }

 private:
  void offer(const Piece& piece, double t) {
    const double gap = pair_.gap(piece, t);
    if (gap >= least_) return;
    least_ = gap;
    piece_ = &piece;
    time_ = t;
  }
  void divide(const Piece& piece, double from, double to) {
    const double middle = 0.5 * (from + to);
    const double change = pair_.fastest(piece, from, to) * 0.5 * (to - from);
    offer(piece, middle);
    if (change <= tolerance_ || pair_.gap(piece, middle) - change >= least_ - tolerance_) return;
    divide(piece, from, middle);
    divide(piece, middle, to);
  }
  /// Goes down from where the search has come to.
  void refine() {
    const double speed = pair_.fastest(*piece_, piece_->begin, piece_->end);
    if (speed == 0.0) return;
    const double around = 4.0 * tolerance_ / speed;
    const Piece& piece = *piece_;
    offer(piece, RectanglePair::lowest_near([&](double t) { return pair_.gap(piece, t); },
                                            std::max(piece.begin, time_ - around),
                                            std::min(piece.end, time_ + around)));
  }

  const RectanglePair& pair_;
  double tolerance_;
  double least_ = infinity, time_ = 0.0;
  const Piece* piece_ = nullptr;
};

/// A time at which the distance is looked at.
struct Look {
  const Piece* piece;
  double time, gap;
};

std::vector<Look> looks_at(const RectanglePair& pair) {
  std::vector<Look> looks;
  for (const Piece& piece : pair.pieces()) {
    const int parts = pair.parts_of(piece);
    const bool is_last = &piece == &pair.pieces().back();
    for (int part = 0; part < parts + (is_last ? 1 : 0); ++part) {
      const double t = part == parts ? piece.end : piece.begin + (piece.end - piece.begin) * part / parts;
      looks.push_back({&piece, t, pair.gap(piece, t)});
    }
  }
  return looks;
}

/// Returns differences of distances that are rounding alone.
double rounding_of(const Look& look) {
  constexpr double units = 0x1p-40;
  return units * (norm(look.piece->first.pose(look.time).position) +
                  norm(look.piece->second.pose(look.time).position) + std::abs(look.gap));
}

/// Returns the place of the lowest distance between two looks.
DistanceMinimum lowest_between(const RectanglePair& pair, const Look& before, const Look& lowest,
                               const Look& behind) {
  const auto piece_at = [&](double t) { return t < lowest.time ? before.piece : lowest.piece; };
  const double time = RectanglePair::lowest_near([&](double t) { return pair.gap(*piece_at(t), t); },
                                                 before.time, behind.time);
  const bool is_lower = pair.gap(*piece_at(time), time) < lowest.gap;
  return is_lower ? pair.minimum(*piece_at(time), time) : pair.minimum(*lowest.piece, lowest.time);
}

std::vector<DistanceMinimum> minima_of(const RectanglePair& pair, const Approach& approach) {
  const std::vector<Look> looks = looks_at(pair);
  std::vector<DistanceMinimum> minima;
  for (std::size_t k = 0, next = 0; k < looks.size(); k = next) {
    // Of a distance that stays the same the first look counts.
    const double margin = rounding_of(looks[k]);
    const auto is_same = [&](const Look& look) { return std::abs(look.gap - looks[k].gap) <= margin; };
    for (next = k + 1; next < looks.size() && is_same(looks[next]);) ++next;
    const bool is_first = k == 0, is_last = next == looks.size();
    if ((!is_first && looks[k - 1].gap < looks[k].gap) || (!is_last && looks[next].gap < looks[k].gap))
      continue;
    if (is_first || is_last)
      minima.push_back(pair.minimum(*looks[k].piece, looks[k].time));
    else
      minima.push_back(lowest_between(pair, looks[k - 1], looks[k], looks[k + 1]));
    minima.back().is_cut_off =
        (is_first && approach.begins_with_track) || (is_last && approach.ends_with_track);
  }
  return minima;
}

}  // namespace

std::vector<Approach> approaches_of_rectangles(double distance, double tolerance, const Motion& motion,
                                               const std::vector<RectangleBody>& bodies,
                                               const std::vector<Approach>& enclosing,
                                               const PositionErrors& errors) {
  std::vector<Approach> approaches;
  for (const Approach& disc : enclosing) {
    const RectanglePair pair(motion, disc, bodies, errors, RectanglePair::Errors::nearer);
    const CloseSpans close(pair, distance, tolerance);
    for (const CloseSpan& span : close.found()) {
      Approach& approach = approaches.emplace_back(disc);
      approach.begin = span.begin;
      approach.end = span.end;
      approach.begins_with_track = disc.begins_with_track && span.begin == disc.begin;
      approach.ends_with_track = disc.ends_with_track && span.end == disc.end;
      if (!errors.any()) continue;
      const RectanglePair farther(motion, approach, bodies, errors, RectanglePair::Errors::farther);
      approach.is_certain = LeastGap(farther, tolerance).least() <= distance;
    }
  }
  std::ranges::stable_sort(approaches, {}, &Approach::begin);
  return approaches;
}

void find_closest(const Motion& motion, std::vector<Approach>& approaches,
                  const std::vector<RectangleBody>& bodies, double tolerance) {
  for (Approach& approach : approaches)
    approach.closest = LeastGap(RectanglePair(motion, approach, bodies), tolerance).closest();
}

std::vector<DistanceMinimum> minima_in(const Motion& motion, const std::vector<Approach>& approaches,
                                       const std::vector<RectangleBody>& bodies) {
  std::vector<DistanceMinimum> all;
  for (std::size_t k = 0; k < approaches.size(); ++k) {
    for (DistanceMinimum& minimum : minima_of(RectanglePair(motion, approaches[k], bodies), approaches[k])) {
      minimum.approach = k;
      all.push_back(minimum);
    }
  }
  return all;
}

double distance_at(const Motion& motion, const std::vector<RectangleBody>& bodies, std::uint32_t first,
                   std::uint32_t second, double time) {
  const auto pose = [&](std::uint32_t body) -> RectanglePose {
    const State state = motion.state(body, time);
    return {state.position, state.velocity, bodies[body].heading_at(time)};
  };
  return gap_between(bodies[first], pose(first), bodies[second], pose(second));
}

}  // namespace kinesphere
