// A picture of shaded spheres in a box, as SVG.
#include "research/bench/sphere_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace kinesphere::program {
namespace {

constexpr double width = 480.0, height = 470.0;    ///< pixels
constexpr double azimuth = 0.45, elevation = 0.3;  ///< of the camera (radians)
constexpr double camera_distance = 2.6;            ///< in diagonals of the box
constexpr double zoom = 2.75;  ///< the box's diagonal in the middle, in parts of the width, at distance 1
constexpr int shades = 8;      ///< steps from near to far

struct Projected {
  double x, y, depth;
  double scale;  ///< pixels per length
};

class Camera {
 public:
  explicit Camera(const Box& box)
      : centre_((box.lower + box.upper) * 0.5), size_(norm(box.upper - box.lower)) {
    const double ca = std::cos(azimuth), sa = std::sin(azimuth);
    const double ce = std::cos(elevation), se = std::sin(elevation);
    right_ = {ca, sa, 0.0};
    away_ = {-sa * ce, ca * ce, -se};
    up_ = {-sa * se, ca * se, ce};
  }

  Projected project(const Vec3& point) const {
    const Vec3 p = point - centre_;
    const double depth = dot(p, away_) + camera_distance * size_;
    const double scale = zoom * width / depth;
    return {width / 2 + scale * dot(p, right_), height / 2 - scale * dot(p, up_), depth, scale};
  }

  /// 0 for the nearest points of the box, 1 for the farthest.
  double relative_depth(double depth) const {
    return std::clamp(depth / size_ - camera_distance + 0.5, 0.0, 1.0);
  }

 private:
  Vec3 centre_;
  double size_;
  Vec3 right_, away_, up_;
};

using Colour = std::array<double, 3>;

std::string hex(const Colour& colour, double towards_white) {
  std::string text = "#";
  for (const double part : colour)
    text += fmt::format("{:02x}", static_cast<int>(std::lround(part + towards_white * (255 - part))));
  return text;
}

std::string gradients(SphereStyle style) {
  const bool bodies = style == SphereStyle::bodies;
  const Colour light = bodies ? Colour{208, 228, 255} : Colour{255, 220, 200};
  const Colour middle = bodies ? Colour{70, 120, 200} : Colour{215, 90, 60};
  const Colour dark = bodies ? Colour{18, 40, 92} : Colour{96, 24, 16};
  std::string text = "<defs>\n";
  for (int shade = 0; shade < shades; ++shade) {
    const double haze = 0.65 * shade / (shades - 1);
    text += fmt::format(
        "<radialGradient id='g{}' cx='.5' cy='.5' r='.5' fx='.34' fy='.3'><stop stop-color='{}'/>"
        "<stop offset='.55' stop-color='{}'/><stop offset='1' stop-color='{}'/></radialGradient>\n",
        shade, hex(light, haze), hex(middle, haze), hex(dark, haze));
  }
  return text + "</defs>\n";
}

/// The edges of the box that meet at its farthest corner, or all others.
std::string box_edges(const Camera& camera, const Box& box, bool farthest) {
  const auto corner = [&](int bits) {
    Vec3 point = box.lower;
    for (int axis = 0; axis < 3; ++axis)
      if ((bits >> axis & 1) != 0) point[axis] = box.upper[axis];
    return camera.project(point);
  };
  int hidden = 0;
  for (int bits = 1; bits < 8; ++bits)
    if (corner(bits).depth > corner(hidden).depth) hidden = bits;
  std::string path;
  for (int from = 0; from < 8; ++from) {
    for (int axis = 0; axis < 3; ++axis) {
      const int to = from | 1 << axis;
      if (to == from || (from == hidden || to == hidden) != farthest) continue;
      const Projected a = corner(from), b = corner(to);
      path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y, b.x, b.y);
    }
  }
  return fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='1'/>\n", path,
                     farthest ? "#aaa" : "#555");
}

/// From far to near; spheres of one shade share a group.
std::string painted(const Camera& camera, std::vector<DrawnSphere> spheres) {
  const auto depth = [&](const DrawnSphere& sphere) { return camera.project(sphere.centre).depth; };
  std::stable_sort(spheres.begin(), spheres.end(),
                   [&](const DrawnSphere& a, const DrawnSphere& b) { return depth(a) > depth(b); });
  std::string text;
  int open = -1;
  for (const DrawnSphere& sphere : spheres) {
    const Projected at = camera.project(sphere.centre);
    const int shade = static_cast<int>(std::lround(camera.relative_depth(at.depth) * (shades - 1)));
    if (shade != open) {
      if (open >= 0) text += "</g>\n";
      text += fmt::format("<g fill='url(#g{})'>\n", shade);
      open = shade;
    }
    text +=
        fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{:.1f}'/>\n", at.x, at.y, at.scale * sphere.radius);
  }
  return open >= 0 ? text + "</g>\n" : text;
}

}  // namespace

std::string sphere_picture(std::vector<DrawnSphere> spheres, const Box& box, SphereStyle style,
                           const std::string& caption) {
  const Camera camera(box);
  std::string text = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}'>\n"
      "<rect width='{0}' height='{1}' fill='white'/>\n",
      width, height);
  text += gradients(style);
  text += box_edges(camera, box, true);
  text += painted(camera, std::move(spheres));
  text += box_edges(camera, box, false);
  text += fmt::format(
      "<text x='12' y='{}' font-family='Helvetica,Arial,sans-serif' font-size='14'>{}</text>\n</svg>\n",
      height - 10, caption);
  return text;
}

}  // namespace kinesphere::program
