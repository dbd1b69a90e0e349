// Periodic images of points and boxes.
#include "space/space.hpp"

namespace kinesphere {
namespace {

/// Relative error of a shifted coordinate, with respect to the numbers that go into it; more than its few
/// roundings.
constexpr double shift_margin = 0x1p-50;

}  // namespace

Space::Space(const WorldDefinition& definition) : flat_(definition.dimensions == 2) {
  if (!definition.box) return;
  for (int axis = 0; axis < definition.dimensions; ++axis) {
    if (!definition.periodic[axis]) continue;
    lower_[axis] = definition.box->lower[axis];
    upper_[axis] = definition.box->upper[axis];
    period_[axis] = upper_[axis] - lower_[axis];
    per_period_[axis] = 1.0 / period_[axis];
    repeats_ = true;
  }
  slide_speed_ = definition.shear_rate * period_.y;
  slides_ = slide_speed_ != 0.0;
  start_ = definition.start_time;
}

Space::Wrapped Space::wrapped_from_outside(const Vec3& point, double time) const {
  Wrapped result{point, {}};
  const auto wrap = [&](int axis) {
    double& images = result.images[axis];
    double& position = result.position[axis];
    if (!repeats(axis) || (lower_[axis] <= position && position < upper_[axis])) return;
    const double along = position;
    images = std::floor((along - lower_[axis]) * per_period_[axis]);
    position = along - images * period_[axis];
    // Rounding may have moved the position across the upper border.
    if (position >= upper_[axis]) ++images;
    if (!(lower_[axis] <= position && position < upper_[axis])) position = lower_[axis];
  };
  wrap(1);
  const double rows = result.images.y;
  if (slides() && rows != 0.0) result.position.x -= rows * slide_at(time);
  wrap(0);
  wrap(2);
  if (slides() && rows != 0.0) result.images.x -= rows * turns_at(time);
  return result;
}

namespace {

/// Factors of a product that is exact: it is `product` and `rest`, each rounded.
struct ExactProduct {
  double product, rest;

  ExactProduct(double a, double b) : product(a * b) {
    // Dekker's: of each factor, the upper half and the rest have products that are exact.
    const auto upper = [](double value) {
      const double scaled = 0x1.000002p27 * value;
      return scaled - (scaled - value);
    };
    const double high_a = upper(a), low_a = a - high_a, high_b = upper(b), low_b = b - high_b;
    rest = ((high_a * high_b - product) + high_a * low_b + low_a * high_b) + low_a * low_b;
  }
};

}  // namespace

double Space::slide_at(double time) const {
  const ExactProduct way(slide_speed_, time - start_);
  return std::remainder(way.product, period_.x) + way.rest;
}

/// Returns how many periods of x slide_at() leaves out.
double Space::turns_at(double time) const {
  const double way = slide_speed_ * (time - start_);
  return std::round((way - std::remainder(way, period_.x)) * per_period_.x);
}

Vec3 Space::images_of(const Vec3& shift, double time) const {
  Vec3 images;
  for (int axis = 0; axis < 3; ++axis) images[axis] = std::round(shift[axis] * per_period_[axis]);
  if (slides() && images.y != 0.0)
    images.x = std::round((shift.x - images.y * slide_at(time)) * per_period_.x) - images.y * turns_at(time);
  return images;
}

/// Returns the shift that shift_to_nearest() returns, where images slide.
Vec3 Space::sliding_shift(const Vec3& from, const Vec3& to, double time) const {
  const auto nearest = [&](int axis, double way) {
    return std::floor(way * per_period_[axis] + 0.5) * period_[axis];
  };
  const double rows = std::floor((to.y - from.y) * per_period_.y + 0.5);
  const double slid = rows != 0.0 ? rows * slide_at(time) : 0.0;
  return {slid + nearest(0, to.x - from.x - slid), rows * period_.y, nearest(2, to.z - from.z)};
}

/// Returns the box shifted by `shift`, rounded outward.
Box Space::moved(const Box& box, const Vec3& shift) {
  Box image = box;
  for (int axis = 0; axis < 3; ++axis) {
    if (shift[axis] == 0.0) continue;
    const auto margin = [&](double edge) { return shift_margin * (std::abs(edge) + std::abs(shift[axis])); };
    image.lower[axis] = box.lower[axis] + shift[axis] - margin(box.lower[axis]);
    image.upper[axis] = box.upper[axis] + shift[axis] + margin(box.upper[axis]);
  }
  return image;
}

bool Space::is_narrow(const Box& box) const {
  for (int axis = 0; axis < 3; ++axis)
    if (repeats(axis) && !(box.upper[axis] - box.lower[axis] < 0.5 * period_[axis])) return false;
  return true;
}

/// A box with its centre in the primary box reaches out of it by at most half of its own width. A box that is
/// as wide as the period overlaps an image of each such box.
Space::Images Space::images_near(const Box& box, double largest_extent) const {
  Images images{within(box)};
  const double half_width = 0.5 * largest_extent;
  for (int axis = 0; axis < 3; ++axis) {
    if (!repeats(axis)) continue;
    const double size = std::abs(lower_[axis]) + std::abs(upper_[axis]);
    const double reach = std::min(half_width, 0.5 * period_[axis]) + shift_margin * size;
    const double lower = lower_[axis] - reach;
    const double upper = upper_[axis] + reach;
    // A box far from both borders has only one image that matters.
    if (upper - period_[axis] < box.lower[axis] && box.upper[axis] < lower + period_[axis]) continue;
    if (!(box.upper[axis] - box.lower[axis] < period_[axis])) {
      images.box.lower[axis] = lower;
      images.box.upper[axis] = upper;
      continue;
    }
    const double margin = 4.0 * shift_margin * (size + std::abs(box.lower[axis]) + std::abs(box.upper[axis]));
    images.first[axis] = std::ceil((lower - box.upper[axis] - margin) * per_period_[axis]);
    const double last = std::floor((upper - box.lower[axis] + margin) * per_period_[axis]);
    // At most four images, whatever rounding does to numbers that are beyond any guarantee.
    const double count = last - images.first[axis] + 1.0;
    images.count[static_cast<std::size_t>(axis)] = static_cast<int>(std::clamp(count, 0.0, 4.0));
  }
  return images;
}

}  // namespace kinesphere
