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
  std::array<double, 2> span{};  ///< from the time of the report to the end of what is known
  // Rows of four numbers: of the centre, and of the radius.
  std::array<float, 4> place{};
  std::array<float, 4> way{};   ///< velocity and growth speed
  std::array<float, 4> turn{};  ///< planned acceleration and growth acceleration

  /// One that is never apart from anything.
  Sketch() { place[3] = std::numeric_limits<float>::infinity(); }
  /// Until `end_time`. `beside` is the most that may be added to the centre: a period.
  ///
  /// A look at two sketches computes with numbers that are at most the sum of their sizes, in magnitudes of
  /// what goes into them, and all its roundings together come to less than 2^-18 of that. One that is too
  /// fast is never apart from anything.
  Sketch(const Bound& bound, double end_time, double beside)
      : span{bound.time, end_time},
        place(row(bound.position, 0.0)),
        way(row(bound.velocity, bound.growth_speed)),
        turn(row(bound.planned_acceleration, bound.growth_acceleration)) {
    const double lasts = end_time - bound.time;
    const double acceleration = norm_one(bound.planned_acceleration) + bound.growth_acceleration;
    const double speed = norm_one(bound.velocity) + bound.growth_speed + acceleration * lasts;
    const double size = beside + norm_one(bound.position) + bound.radius + speed * lasts;
    place[3] = speed < fastest ? static_cast<float>(bound.radius + 0x1p-18 * size)
                               : std::numeric_limits<float>::infinity();
  }

  friend bool operator==(const Sketch&, const Sketch&) = default;

 private:
  /// The squares of greater speeds may be too large for single precision.
  static constexpr double fastest = 0x1p58;

  static std::array<float, 4> row(const Vec3& v, double last) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
            static_cast<float>(last)};
  }
};

/// Where space repeats: the body is to be seen in the image in which its home is nearest.
struct Home {
  /// Of its box, as seen from the lower corner of the primary box, and 0. On each axis that repeats it is
  /// about a period at most, so it errs by less than 2^-23 of a period, wherever the primary box lies.
  std::array<float, 4> centre{};

  Home() = default;
  explicit Home(const Vec3& from_corner)
      : centre{static_cast<float>(from_corner.x), static_cast<float>(from_corner.y),
               static_cast<float>(from_corner.z), 0.0f} {}
  friend bool operator==(const Home&, const Home&) = default;
};

/// What Glance::Images adds to the place of a body with home `from`, seen by one with home `to`.
inline Vec3 shift_at_a_glance(const Home& from, const Home& to, const Vec3& period) {
  Vec3 shift;
  for (int axis = 0; axis < 3; ++axis) {
    const float way = from.centre[static_cast<std::size_t>(axis)] - to.centre[static_cast<std::size_t>(axis)];
    const auto half = static_cast<float>(0.5 * period[axis]);
    if (period[axis] > 0.0) shift[axis] = way > half ? -period[axis] : way < -half ? period[axis] : 0.0;
  }
  return shift;
}

/// From one body at one instant.
template <class Number = Four>
class Glance {
 public:
  using Row = std::array<const Sketch*, lane_count>;
  using HomeRow = std::array<const Home*, lane_count>;

  /// Others in the images that are nearest to the one who looks. `period` is 0 on axes that do not repeat.
  class Images {
   public:
    Images(const Home& own, const Vec3& period)
        : axes_{Axis(own.centre[0], period.x), Axis(own.centre[1], period.y), Axis(own.centre[2], period.z)} {
    }

   private:
    friend class Glance;
    struct Axis {
      Axis(float own, double period)
          : home(own),
            length(static_cast<float>(period)),
            half(period > 0.0 ? static_cast<float>(0.5 * period) : std::numeric_limits<float>::infinity()),
            minus_half(Number(0.0f) - half) {}
      Number shift(const Number& other) const {
        const Number way = other - home;
        return if_greater(minus_half, way, length) - if_greater(way, half, length);
      }
      Number home, length, half, minus_half;
    };
    std::array<Axis, 3> axes_;
  };

  /// For those with whom no two points of the bodies may come within `room`.
  Glance(const Sketch& own, double now, double room)
      : now_(now),
        own_end_(own.span[1]),
        room_(static_cast<float>(room * (1.0 + 0x1p-20))),
        own_(Row{&own, &own, &own, &own}, now_, Precise(own.span[0])) {}

  /// Those of the others with whom that holds until `until` or one of the two ends.
  [[gnu::always_inline]] Lanes apart(const Row& others, double until) const {
    const auto [reports, ends] = Precise::columns(times(others));
    return apart(Moved(others, now_, reports), duration(until, ends));
  }
  /// Where space repeats.
  [[gnu::always_inline]] Lanes apart(const Row& others, double until, const Images& images,
                                     const HomeRow& homes) const {
    const auto [reports, ends] = Precise::columns(times(others));
    Moved moved(others, now_, reports);
    moved.shift(images, homes);
    return apart(moved, duration(until, ends));
  }

 private:
  using Precise = typename Number::Precise;

  static std::array<const double*, lane_count> times(const Row& sketches) {
    return {sketches[0]->span.data(), sketches[1]->span.data(), sketches[2]->span.data(),
            sketches[3]->span.data()};
  }

  /// Four sketches, moved on.
  struct Moved {
    using Columns = std::array<Number, 4>;
    Number x, y, z, radius, u, v, w, speed, a, b, c, growth;

    [[gnu::always_inline]] Moved(const Row& sketches, const Precise& to, const Precise& reports)
        : Moved(columns(sketches, [](const Sketch& one) { return one.place.data(); }),
                columns(sketches, [](const Sketch& one) { return one.way.data(); }),
                columns(sketches, [](const Sketch& one) { return one.turn.data(); }), Number(to - reports)) {}

    [[gnu::always_inline]] void shift(const Images& images, const HomeRow& homes) {
      const Columns theirs = Number::columns({homes[0]->centre.data(), homes[1]->centre.data(),
                                              homes[2]->centre.data(), homes[3]->centre.data()});
      x = x + images.axes_[0].shift(theirs[0]);
      y = y + images.axes_[1].shift(theirs[1]);
      z = z + images.axes_[2].shift(theirs[2]);
    }

   private:
    template <class Part>
    [[gnu::always_inline]] static Columns columns(const Row& sketches, Part part) {
      return Number::columns(
          {part(*sketches[0]), part(*sketches[1]), part(*sketches[2]), part(*sketches[3])});
    }

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
  Number duration(double until, const Precise& ends) const {
    return Number(min(ends, Precise(std::min(until, own_end_))) - now_);
  }

  /// On straight lines the square of the distance is a quadratic, least now, at the end, or between: no root,
  /// no division. Radii count as they are at the end, and half of what the centres turn by then is added to
  /// them.
  [[gnu::always_inline]] Lanes apart(const Moved& other, const Number& duration) const {
    const Number x = own_.x - other.x, y = own_.y - other.y, z = own_.z - other.z;
    const Number u = own_.u - other.u, v = own_.v - other.v, w = own_.w - other.w;
    const Number turning = abs(own_.a - other.a) + abs(own_.b - other.b) + abs(own_.c - other.c);
    const Number radii =
        own_.radius + other.radius + room_ +
        (own_.speed + other.speed + Number(0.5f) * (own_.growth + other.growth + turning) * duration) *
            duration;
    const Number distance = x * x + y * y + z * z;
    const Number approach = Number(0.0f) - (x * u + y * v + z * w);
    const Number speed = u * u + v * v + w * w;
    // What the square of the distance has beyond that of the radii, less than all roundings below can make.
    const Number excess = distance * Number(1.0f - 0x1p-18f) - radii * radii;
    const Number way = speed * duration;
    using Mask = typename Number::Mask;
    // Nothing is known where squares underflow or overflow.
    const Mask now =
        (excess > Number(0x1p-60f)) & (Number(0x1p120f) > distance) & (Number(0x1p20f) > duration);
    const Mask leaving = Number(0.0f) > approach;
    const Mask beside = (way > approach) & (excess * speed > approach * approach);
    const Mask before = (approach >= way) & (excess + (way - approach - approach) * duration > Number(0.0f));
    return now & (leaving | beside | before);
  }

  Precise now_;
  double own_end_;
  Number room_;
  Moved own_;
};

}  // namespace kinesphere
