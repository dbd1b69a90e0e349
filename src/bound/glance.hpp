// The engine's quickest look: which of four bounds certainly stay apart from another one for a while?
//
// In single precision, as most neighbours are far from each other by much more than it can tell. A sketch of
// a bound is so much larger than the bound that no rounding matters.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bound/four.hpp"
#include "kinesphere/bound.hpp"

namespace kinesphere {

/// A bound in single precision, in one cache line.
struct alignas(64) Sketch {
  double time = 0.0;  ///< of the report
  double end = 0.0;   ///< nothing is said of later times
  // Rows of four numbers: of the centre, and of the radius.
  std::array<float, 4> place{};
  std::array<float, 4> way{};   ///< velocity and growth speed
  std::array<float, 4> turn{};  ///< planned acceleration and growth acceleration

  /// One that is never apart from anything.
  Sketch() { place[3] = std::numeric_limits<float>::infinity(); }
  /// Until `end_time`. `beside` is the most that may be added to the centre: a period.
  ///
  /// A look at two sketches computes with numbers that are at most the sum of their sizes, in magnitudes of
  /// what goes into them, and all its roundings together come to less than 2^-18 of that.
  Sketch(const Bound& bound, double end_time, double beside)
      : time(bound.time),
        end(end_time),
        place(row(bound.position, 0.0)),
        way(row(bound.velocity, bound.growth_speed)),
        turn(row(bound.planned_acceleration, bound.growth_acceleration)) {
    const double lasts = end_time - bound.time;
    const double acceleration = norm_one(bound.planned_acceleration) + bound.growth_acceleration;
    const double speed = norm_one(bound.velocity) + bound.growth_speed + acceleration * lasts;
    const double size = beside + norm_one(bound.position) + bound.radius + speed * lasts;
    place[3] = static_cast<float>(bound.radius + 0x1p-18 * size);
  }

  friend bool operator==(const Sketch&, const Sketch&) = default;

 private:
  static std::array<float, 4> row(const Vec3& v, double last) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
            static_cast<float>(last)};
  }
};

/// Where space repeats: the body is to be seen in the image in which its home is nearest.
struct Home {
  std::array<float, 4> centre{};  ///< of its box, and 0

  friend bool operator==(const Home&, const Home&) = default;
};

/// From one body at one instant.
template <class Number = Four>
class Glance {
 public:
  Glance(const Sketch& own, double now)
      : now_(now), own_end_(own.end), own_(Row{&own, &own, &own, &own}, now) {}

  using Row = std::array<const Sketch*, lane_count>;
  /// Of the one who looks and of the others.
  struct Homes {
    Vec3 period;  ///< 0 on axes that do not repeat
    const Home* own;
    std::array<const Home*, lane_count> others;
  };

  /// Those of the others with whom no two points of the bodies come within `room`, before `until` or one of
  /// the two ends. `homes` are given where space repeats. On straight lines the least of
  /// |X + V d| is |X|, its value at the end, or |X x V| / |V|: no root, no division. Radii count as they are
  /// at the end, and half of what the centres turn by then is added to them.
  [[gnu::always_inline]] Lanes apart(const Row& others, double until, double room, const Homes* homes) const {
    Moved other(others, now_);
    if (homes) other.shift(*homes);
    const Number duration = spans(others, std::min(until, own_end_));
    const Number x = own_.x - other.x, y = own_.y - other.y, z = own_.z - other.z;
    const Number u = own_.u - other.u, v = own_.v - other.v, w = own_.w - other.w;
    const Number turning = abs(own_.a - other.a) + abs(own_.b - other.b) + abs(own_.c - other.c);
    const Number radii =
        own_.radius + other.radius + Number(static_cast<float>(room * (1.0 + 0x1p-20))) +
        (own_.speed + other.speed + Number(0.5f) * (own_.growth + other.growth + turning) * duration) *
            duration;
    const Number limit = radii * radii;
    const Number distance = x * x + y * y + z * z;
    const Number approach = Number(0.0f) - (x * u + y * v + z * w);
    const Number speed = u * u + v * v + w * w;
    const Number xe = x + u * duration, ye = y + v * duration, ze = z + w * duration;
    const Number xc = y * w - z * v, yc = z * u - x * w, zc = x * v - y * u;
    const Number bar = limit * speed;
    // Nothing is known where squares underflow.
    const Lanes now = (distance > limit) & (distance > Number(0x1p-60f)) & (Number(0x1p20f) > duration);
    const Lanes leaving = Number(0.0f) > approach;
    const Lanes passing = speed * duration > approach;
    const Lanes at_the_end = xe * xe + ye * ye + ze * ze > limit;
    const Lanes beside = (xc * xc + yc * yc + zc * zc > bar) & (bar > Number(0x1p-110f));
    return now & (leaving | (passing & beside) | (~passing & at_the_end));
  }

 private:
  /// Four sketches, moved on.
  struct Moved {
    using Columns = std::array<Number, 4>;
    Number x, y, z, radius, u, v, w, speed, a, b, c, growth;

    [[gnu::always_inline]] Moved(const Row& sketches, double to)
        : Moved(columns(sketches, [](const Sketch& one) { return one.place.data(); }),
                columns(sketches, [](const Sketch& one) { return one.way.data(); }),
                columns(sketches, [](const Sketch& one) { return one.turn.data(); }),
                Number({age(sketches[0], to), age(sketches[1], to), age(sketches[2], to),
                        age(sketches[3], to)})) {}

    void shift(const Homes& homes) {
      const Columns theirs =
          Number::columns({homes.others[0]->centre.data(), homes.others[1]->centre.data(),
                           homes.others[2]->centre.data(), homes.others[3]->centre.data()});
      const auto to_nearest = [&](std::size_t axis, double period) {
        const Number length(static_cast<float>(period));
        const Number half(period > 0.0 ? static_cast<float>(0.5 * period)
                                       : std::numeric_limits<float>::infinity());
        const Number zero(0.0f);
        const Number way = theirs[axis] - Number(homes.own->centre[axis]);
        return if_greater(zero - half, way, length) - if_greater(way, half, length);
      };
      x = x + to_nearest(0, homes.period.x);
      y = y + to_nearest(1, homes.period.y);
      z = z + to_nearest(2, homes.period.z);
    }

   private:
    template <class Part>
    [[gnu::always_inline]] static Columns columns(const Row& sketches, Part part) {
      return Number::columns(
          {part(*sketches[0]), part(*sketches[1]), part(*sketches[2]), part(*sketches[3])});
    }
    static float age(const Sketch* sketch, double to) { return static_cast<float>(to - sketch->time); }

    [[gnu::always_inline]] Moved(const Columns& place, const Columns& way, const Columns& turn, Number s)
        : x(place[0] + (way[0] + turn[0] * (Number(0.5f) * s)) * s),
          y(place[1] + (way[1] + turn[1] * (Number(0.5f) * s)) * s),
          z(place[2] + (way[2] + turn[2] * (Number(0.5f) * s)) * s),
          radius(place[3] + (way[3] + turn[3] * (Number(0.5f) * s)) * s),
          u(way[0] + turn[0] * s),
          v(way[1] + turn[1] * s),
          w(way[2] + turn[2] * s),
          speed(way[3] + turn[3] * s),
          a(turn[0]),
          b(turn[1]),
          c(turn[2]),
          growth(turn[3]) {}
  };

  /// How long to look at each of the others.
  Number spans(const Row& others, double until) const {
    const auto span = [&](const Sketch* other) {
      return static_cast<float>(std::min(until, other->end) - now_);
    };
    return Number({span(others[0]), span(others[1]), span(others[2]), span(others[3])});
  }

  double now_;
  double own_end_;
  Moved own_;
};

}  // namespace kinesphere
