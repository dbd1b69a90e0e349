#include "kinesphere/radial_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "input/input_check.hpp"
#include "placement/sphere_grid.hpp"
#include "placement/sphere_room.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t most_bins = 1u << 20;

Result<void> check_question(std::span<const Vec3> centres, const SphereRoom& room, double range,
                            std::size_t bins) {
  InputCheck check("radial_distribution");
  check
      .require(room.dimensions == 2 || room.dimensions == 3, ErrorCode::out_of_range, {"dimensions"},
               "must be 2 or 3", static_cast<double>(room.dimensions))
      .box({"box"}, room.box)
      .within({"box"}, room.box.lower, largest_of_room)
      .within({"box"}, room.box.upper, largest_of_room)
      .require(bins >= 1 && bins <= most_bins, ErrorCode::out_of_range, {"bins"}, "must be from 1 to",
               most_bins, bins)
      .positive({"range"}, range)
      .require(centres.size() >= 2 && centres.size() < no_body.index, ErrorCode::out_of_range, {"centres"},
               "must be at least", std::size_t{2}, centres.size());
  for (int axis = 0; axis < room.dimensions && !check.error(); ++axis)
    check.require(range <= 0.5 * room.size(axis), ErrorCode::out_of_range, {"range"},
                  "must be at most half of each side of the box,", 0.5 * room.size(axis), range);
  for (std::uint32_t point = 0; point < centres.size() && !check.error(); ++point) {
    check.within({"centres", {point, 0}}, centres[point], largest_of_room)
        .require(room.dimensions == 3 || centres[point].z == 0.0, ErrorCode::out_of_range,
                 {"centres", {point, 0}}, "must lie in the plane z = 0", centres[point]);
  }
  return check.result();
}

}  // namespace

Result<std::vector<double>> radial_distribution(std::span<const Vec3> centres, const Box& box, double range,
                                                std::size_t bins, int dimensions) {
  SphereRoom room{
      .box = box, .periodic = {true, true, dimensions == 3}, .dimensions = dimensions, .gap = 0.0};
  if (dimensions == 2) {
    room.box.lower.z = -0.5;
    room.box.upper.z = 0.5;
    room.half_period = SphereRoom{room.box, room.periodic, 2, 0.0}.half_period;
  }
  if (auto valid = check_question(centres, room, range, bins); !valid) return valid.error();
  const std::vector<double> ranges(centres.size(), 0.5 * range);
  SphereGrid grid(room, ranges);
  grid.clear();
  std::vector<Vec3> places;
  for (const Vec3& centre : centres) places.push_back(room.wrapped(centre));
  const double per_length = static_cast<double>(bins) / range;
  std::vector<double> counts(bins);
  for (std::uint32_t point = 0; point < places.size(); ++point) {
    grid.all_near(point, places[point], [&](std::uint32_t other) {
      const double place = norm(room.offset(places[point], places[other])) * per_length;
      if (place < static_cast<double>(bins)) counts[static_cast<std::size_t>(place)] += 1.0;
      return true;
    });
    grid.enter(point, places[point]);
  }
  // Of points at random places, a shell has its part of the box's content.
  const auto content = [dimensions](double radius) {
    return dimensions == 2 ? std::numbers::pi * radius * radius
                           : 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  };
  const auto points = static_cast<double>(centres.size());
  const double pairs = 0.5 * points * (points - 1.0), all = room.size(0) * room.size(1) * room.size(2);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const auto edge = static_cast<double>(bin);
    counts[bin] /= pairs * (content((edge + 1.0) / per_length) - content(edge / per_length)) / all;
  }
  return counts;
}

}  // namespace kinesphere
