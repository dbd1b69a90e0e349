#include "research/bench/shapes/turning_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "kinesphere/random.hpp"

namespace kinesphere::program {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int cluster_balls = 8;

/// A point fixed in a body: its place by Rodrigues' formula.
struct CoursePoint {
  CoursePoint(const TurningBody& body, const Vec3& point) : state(body.start) {
    const Vec3 now = rotated(body.rotation.orientation, point);
    speed = norm(body.rotation.angular_velocity);
    const Vec3 axis = speed > 0.0 ? body.rotation.angular_velocity / speed : Vec3{0, 0, 1};
    fixed = axis * dot(axis, now);
    cosine = now - fixed;
    sine = cross(axis, now);
  }

  Vec3 at(double time) const {
    const double angle = speed * time;
    return state.position + state.velocity * time + fixed + cosine * std::cos(angle) + sine * std::sin(angle);
  }

  State state;
  double speed;
  Vec3 fixed, cosine, sine;
};

/// The vector between the points of two segments that are nearest to each other, by comparing the four ends
/// and the two points where both derivatives of the distance are zero.
Vec3 between_segments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto nearest = [](const Vec3& point, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double square = norm_squared(way);
    return from + way * (square > 0.0 ? std::clamp(dot(point - from, way) / square, 0.0, 1.0) : 0.0);
  };
  Vec3 best = nearest(a, c, d) - a;
  for (const Vec3& other : {nearest(b, c, d) - b, c - nearest(c, a, b), d - nearest(d, a, b)})
    if (norm_squared(other) < norm_squared(best)) best = other;
  const Vec3 u = b - a;
  const Vec3 v = d - c;
  const Vec3 across = cross(u, v);
  const double square = norm_squared(across);
  if (square == 0.0) return best;
  const double s = dot(cross(c - a, v), across) / square;
  const double t = dot(cross(c - a, u), across) / square;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return best;
  const Vec3 straight = across * (dot(c - a, across) / square);
  return norm_squared(straight) < norm_squared(best) ? straight : best;
}

/// A box where it is.
struct PlacedBox {
  Vec3 centre;
  std::array<Vec3, 3> axes;
  Vec3 half;

  Vec3 corner(int number) const {
    Vec3 corner = centre;
    for (int axis = 0; axis < 3; ++axis)
      corner += axes[static_cast<std::size_t>(axis)] * ((number >> axis & 1) == 1 ? half[axis] : -half[axis]);
    return corner;
  }
  Vec3 nearest(const Vec3& point) const {
    Vec3 nearest = centre;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3& along = axes[static_cast<std::size_t>(axis)];
      nearest += along * std::clamp(dot(point - centre, along), -half[axis], half[axis]);
    }
    return nearest;
  }
  double reach(const Vec3& direction) const {
    double reach = 0.0;
    for (int axis = 0; axis < 3; ++axis)
      reach += half[axis] * std::abs(dot(direction, axes[static_cast<std::size_t>(axis)]));
    return reach;
  }
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (int number = 0; number < 8; ++number)
      for (int axis = 0; axis < 3; ++axis)
        if ((number >> axis & 1) == 0) visit(corner(number), corner(number | 1 << axis));
  }
};

/// The signed gap of two boxes, and the way from the first to the second: of overlapping ones from the 15
/// directions that may separate two boxes, else from all corners and edges.
std::pair<double, Vec3> between_boxes(const PlacedBox& first, const PlacedBox& second) {
  double widest = -std::numeric_limits<double>::infinity();
  Vec3 best;
  const auto try_direction = [&](const Vec3& direction) {
    const double size = norm(direction);
    if (!(size > 1e-9)) return;
    const Vec3 normal = direction / size;
    const double way = dot(second.centre - first.centre, normal);
    const double gap = std::abs(way) - first.reach(normal) - second.reach(normal);
    if (!(gap > widest)) return;
    widest = gap;
    best = way < 0.0 ? -normal : normal;
  };
  for (const Vec3& a : first.axes) try_direction(a);
  for (const Vec3& b : second.axes) try_direction(b);
  for (const Vec3& a : first.axes)
    for (const Vec3& b : second.axes) try_direction(cross(a, b));
  if (widest < 0.0) return {widest, best};
  Vec3 least = second.centre - first.centre;
  const auto keep = [&](const Vec3& way) {
    if (norm_squared(way) < norm_squared(least)) least = way;
  };
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 own = first.corner(corner);
    const Vec3 other = second.corner(corner);
    keep(second.nearest(own) - own);
    keep(other - first.nearest(other));
  }
  first.for_each_edge([&](const Vec3& a, const Vec3& b) {
    second.for_each_edge([&](const Vec3& c, const Vec3& d) { keep(between_segments(a, b, c, d)); });
  });
  return {norm(least), least};
}

/// The gap of a pair over time, and how fast it can change.
class PairGap {
 public:
  explicit PairGap(const TurningPair& pair)
      : first_(parts_of(pair.first)),
        second_(parts_of(pair.second)),
        first_box_(box_of(pair.first)),
        second_box_(box_of(pair.second)),
        largest_rate_(norm(pair.second.start.velocity - pair.first.start.velocity) +
                      turning_speed(pair.first) + turning_speed(pair.second)) {}

  struct Value {
    double gap = std::numeric_limits<double>::infinity();
    Vec3 way{};  ///< from an axis of the first body to one of the second
  };
  Value at(double time) const {
    if (first_box_) {
      const auto [gap, way] = between_boxes(first_box_->at(time), second_box_->at(time));
      return {gap, way};
    }
    ends_.clear();
    for (const Part& part : second_) ends_.push_back(part.at(time));
    Value least;
    for (const Part& part : first_) {
      const Ends own = part.at(time);
      for (std::size_t k = 0; k < ends_.size(); ++k) {
        const bool are_balls = part.is_ball && second_[k].is_ball;
        const Vec3 way =
            are_balls ? ends_[k].a - own.a : between_segments(own.a, own.b, ends_[k].a, ends_[k].b);
        const double gap = norm(way) - part.radius - second_[k].radius;
        if (gap < least.gap) least = {gap, way};
      }
    }
    return least;
  }

  /// Returns the first contact, or nothing where rounding errors leave open whether there is one.
  std::optional<FirstContact> first_contact() const {
    Search search;
    look(0.0, 1.0, search);
    if (search.contact) return FirstContact{true, search.open.value_or(*search.contact), *search.contact};
    if (search.open) return std::nullopt;
    return FirstContact{};
  }

  /// Returns a time of the least gap found by samples and a golden section around the best of them.
  double nearest_time() const {
    constexpr int samples = 1000;
    int best = 0;
    double least = at(0.0).gap;
    for (int k = 1; k <= samples; ++k) {
      const double gap = at(k / double{samples}).gap;
      if (gap < least) {
        least = gap;
        best = k;
      }
    }
    double lower = std::max(best - 1, 0) / double{samples};
    double upper = std::min(best + 1, samples) / double{samples};
    while (upper - lower > 1e-10) {
      const double left = upper - 0.618 * (upper - lower);
      const double right = lower + 0.618 * (upper - lower);
      if (at(left).gap < at(right).gap)
        upper = right;
      else
        lower = left;
    }
    return 0.5 * (lower + upper);
  }

 private:
  struct Ends {
    Vec3 a, b;
  };
  struct Part {
    CoursePoint a, b;
    double radius;
    bool is_ball;

    Ends at(double time) const {
      const Vec3 end = a.at(time);
      return {end, is_ball ? end : b.at(time)};
    }
  };
  /// A box, its middle and the ends of its unit axes.
  struct BoxCourse {
    std::array<CoursePoint, 4> points;
    Vec3 half;

    PlacedBox at(double time) const {
      const Vec3 centre = points[0].at(time);
      return {centre,
              {points[1].at(time) - centre, points[2].at(time) - centre, points[3].at(time) - centre},
              half};
    }
  };
  struct Search {
    std::optional<double> open{};     ///< start of the first interval that may have a contact
    std::optional<double> contact{};  ///< a time at which the two certainly touch
  };
  /// Below this width an interval is not divided any more, and below this gap two touch.
  static constexpr double narrowest = 1e-13;
  static constexpr double rounding = 1e-14;

  static std::vector<Part> parts_of(const TurningBody& body) {
    std::vector<Part> parts;
    for (const RigidPart& part : body.parts)
      parts.push_back({{body, part.a}, {body, part.b}, part.radius, part.a == part.b});
    return parts;
  }
  static std::optional<BoxCourse> box_of(const TurningBody& body) {
    if (body.parts[0].more.empty()) return std::nullopt;
    return BoxCourse{{CoursePoint(body, {}), CoursePoint(body, {1, 0, 0}), CoursePoint(body, {0, 1, 0}),
                      CoursePoint(body, {0, 0, 1})},
                     half_edges(body.parts[0])};
  }
  static double turning_speed(const TurningBody& body) {
    return reach(body) * norm(body.rotation.angular_velocity);
  }

  /// Looks for the first contact in [from, to], and leaves out intervals that certainly have none.
  void look(double from, double to, Search& search) const {
    const double middle = 0.5 * (from + to);
    const double gap = at(middle).gap;
    if (gap > largest_rate_ * 0.5 * (to - from) + rounding) return;
    if (to - from < narrowest) {
      if (!search.open) search.open = from;
      if (gap < -rounding) search.contact = middle;
      return;
    }
    look(from, middle, search);
    if (search.contact) return;
    if (gap < -rounding) {
      search.contact = middle;
      return;
    }
    look(middle, to, search);
  }

  std::vector<Part> first_, second_;
  std::optional<BoxCourse> first_box_, second_box_;
  double largest_rate_;
  mutable std::vector<Ends> ends_;
};

TurningBody any_body(const PairKind& kind, Random& random) {
  TurningBody body{.start = {random.point_in_ball(), random.point_in_ball()}};
  const double turn = kind.turns_fast ? random.uniform(4.0 * pi, 16.0 * pi) : random.uniform(0.0, 0.5 * pi);
  body.rotation = {rotation_by(pi * random.point_in_ball()), turn * random.unit_vector()};
  if (kind.shape == PairShape::cluster) {
    for (int k = 0; k < cluster_balls; ++k) {
      const Vec3 centre = random.point_in_ball();
      body.parts.push_back({centre, centre, random.uniform(0.1, 0.3)});
    }
    return body;
  }
  if (kind.shape == PairShape::box) {
    Vec3 half;
    for (int axis = 0; axis < 3; ++axis) half[axis] = random.uniform(0.1, 0.7);
    if (random.bits() % 4 == 0) half = {0.001 * half.z, 0.001 * half.z, half.z};
    body.parts.push_back(box_part({-half, half}, 0.0));
    return body;
  }
  const double half = random.uniform(0.3, 1.0);
  const double radius = random.bits() % 4 == 0 ? 0.001 * half : random.uniform(0.05, 0.3);
  body.parts.push_back({{0, 0, -half}, {0, 0, half}, radius});
  return body;
}

/// Moves the second body until the least gap of the two is about `wanted`. Returns whether that succeeded.
bool let_graze(TurningPair& pair, double wanted) {
  for (int round = 0; round < 20; ++round) {
    const PairGap gap(pair);
    const PairGap::Value least = gap.at(gap.nearest_time());
    if (std::abs(least.gap - wanted) < 0.1 * std::abs(wanted)) return true;
    const double distance = norm(least.way);
    if (distance == 0.0) return false;
    pair.second.start.position += least.way * ((wanted - least.gap) / distance);
  }
  return false;
}

/// Returns a pair, or nothing if the draw is of no use.
std::optional<TurningPair> draw_pair(const PairKind& kind, bool grazes, Random& random) {
  TurningPair pair{any_body(kind, random), any_body(kind, random)};
  const Vec3 direction = random.unit_vector();
  const Vec3 velocity = random.uniform(2.0, 6.0) * direction;
  const Vec3 offset = 0.8 * (reach(pair.first) + reach(pair.second)) * random.point_in_ball();
  const State& first = pair.first.start;
  pair.second.start = {first.position + offset - random.uniform(0.2, 0.9) * velocity,
                       first.velocity + velocity};
  const double depth = std::pow(10.0, random.uniform(-6.0, -3.0));
  if (grazes && !let_graze(pair, random.bits() % 2 == 0 ? depth : -depth)) return std::nullopt;
  if (PairGap(pair).at(0.0).gap < 0.01) return std::nullopt;
  const auto truth = true_contact(pair);
  if (!truth || truth->to - truth->from > 1e-9) return std::nullopt;
  pair.truth = *truth;
  return pair;
}

}  // namespace

Vec3 half_edges(const RigidPart& box) { return -box.a; }

double reach(const TurningBody& body) {
  double farthest = 0.0;
  for (const RigidPart& part : body.parts)
    farthest = std::max({farthest, norm(part.a) + part.radius, norm(part.b) + part.radius});
  // All corners of a box are as far away as its first one.
  return farthest;
}

std::optional<FirstContact> true_contact(const TurningPair& pair) { return PairGap(pair).first_contact(); }

double least_gap(const TurningPair& pair) {
  const PairGap gap(pair);
  return gap.at(gap.nearest_time()).gap;
}

std::vector<TurningPair> draw_pairs(const PairKind& kind, std::size_t count, std::uint64_t seed) {
  std::vector<TurningPair> pairs;
  for (std::uint64_t draw = 0; pairs.size() < count; ++draw) {
    Random random = Random::at(seed, draw, 0);
    if (const auto pair = draw_pair(kind, pairs.size() % 3 == 0, random)) pairs.push_back(*pair);
  }
  return pairs;
}

}  // namespace kinesphere::program
