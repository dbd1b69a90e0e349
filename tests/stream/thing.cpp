#include "stream/thing.hpp"

#include <tuple>

namespace kinesphere::stream {
namespace {

std::vector<Vec3> corners_of(const Shape& shape) {
  if (const auto* triangle = std::get_if<Triangle>(&shape)) return {triangle->a, triangle->b, triangle->c};
  if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    std::vector<Vec3> corners;
    for (std::size_t k = 0; k < mesh->size(); ++k) {
      const auto [a, b, c] = mesh->triangle(k);
      corners.insert(corners.end(), {a, b, c});
    }
    return corners;
  }
  const auto* box = std::get_if<Box>(&shape);
  if (!box) return {};
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back({k & 1 ? box->upper.x : box->lower.x, k & 2 ? box->upper.y : box->lower.y,
                       k & 4 ? box->upper.z : box->lower.z});
  const auto coordinates = [](const Vec3& v) { return std::tie(v.x, v.y, v.z); };
  std::ranges::sort(corners, {}, coordinates);
  const auto same = std::unique(corners.begin(), corners.end());
  corners.erase(same, corners.end());
  return corners;
}

}  // namespace

void Thing::set_parts(const std::vector<RigidPart>& given, double unit_length) {
  parts = given;
  for (const RigidPart& part : parts) {
    std::vector<Vec3> scaled = points_of(part);
    for (Vec3& point : scaled) {
      reach = std::max(reach, norm(point) + part.radius);
      point = point / unit_length;
    }
    hulls.emplace_back(scaled);
  }
}

void Thing::set_shape(const Shape& given, double now, double unit_length, bool flat) {
  shape = given;
  if (auto* box = std::get_if<Box>(&shape); box && flat) {
    box->lower.z = -100.0 * unit_length;
    box->upper.z = 100.0 * unit_length;
  }
  corners = corners_of(shape);
  hulls.clear();
  reach = 0.0;
  const std::size_t size = std::holds_alternative<Mesh>(shape) ? 3 : corners.size();
  for (std::size_t from = 0; from < corners.size(); from += size) {
    std::vector<Vec3> scaled;
    for (std::size_t k = from; k < from + size; ++k)
      scaled.push_back((corners[k] - corners[0]) / unit_length);
    hulls.emplace_back(scaled);
  }
  const auto* ball = std::get_if<Ball>(&shape);
  if (!ball) return;
  path = {now, vector(ball->centre), {}, {}};
  radius = {now, ball->radius, 0};
}

}  // namespace kinesphere::stream
