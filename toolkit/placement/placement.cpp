#include "kinesphere/placement.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "input/input_check.hpp"
#include "kinesphere/random.hpp"
#include "placement/relaxation.hpp"
#include "placement/sphere_grid.hpp"
#include "placement/sphere_room.hpp"

namespace kinesphere {
namespace {

/// Tries for one sphere, and for all spheres together beside as many for each, before random placement is
/// given up: fewer give up boxes with room left, more waste time before relax_spheres().
constexpr std::uint64_t most_tries = 200000;
constexpr std::uint64_t tries_each = 200;

Result<void> check_placement(std::span<const double> radii, const SphereRoom& room,
                             const PlacementOptions& options) {
  InputCheck check("place_spheres");
  const int dimensions = options.dimensions;
  check
      .require(dimensions == 2 || dimensions == 3, ErrorCode::out_of_range, {"dimensions"}, "must be 2 or 3",
               static_cast<double>(dimensions))
      .box({"box"}, room.box)
      .within({"box"}, room.box.lower, largest_of_room)
      .within({"box"}, room.box.upper, largest_of_room)
      .require(dimensions == 3 || !options.periodic.z, ErrorCode::out_of_range, {"periodic"},
               "must be x, y or both in two dimensions, where there is no z", std::string_view("z, too"))
      .require(options.packing >= 0.0 && options.packing < 1.0, ErrorCode::out_of_range, {"packing"},
               "must lie in [0, 1)", options.packing)
      .not_negative({"gap"}, options.gap)
      .require(radii.size() < no_body.index, ErrorCode::out_of_range, {"radii"}, "must be fewer than",
               std::size_t{no_body.index}, radii.size());
  for (std::uint32_t sphere = 0; sphere < radii.size() && !check.error(); ++sphere) {
    check.not_negative({"radii", {sphere, 0}}, radii[sphere]);
    for (int axis = 0; axis < dimensions; ++axis) {
      const double most = 0.5 * room.size(axis) - (room.periodic[axis] ? 0.5 : 1.0) * room.gap;
      check.require(radii[sphere] <= most, ErrorCode::out_of_range, {"radii", {sphere, 0}},
                    "must leave room in the box, with", most, radii[sphere]);
    }
  }
  return check.result();
}

/// Returns the part of the box that spheres of these radii, each larger by `margin`, would fill.
double filled_part(std::span<const double> radii, const SphereRoom& room, double margin = 0.0) {
  double filled = 0.0;
  for (const double inner : radii) {
    const double radius = inner + margin;
    filled += room.dimensions == 2 ? 3.1415926535897931 * radius * radius
                                   : 4.1887902047863905 * radius * radius * radius;
  }
  return filled / (room.size(0) * room.size(1) * room.size(2));
}

/// Returns the radii used in turn, as often as they fill no more than `packing`; out_of_range if that is
/// without end.
Result<std::vector<double>> repeated(std::span<const double> radii, const SphereRoom& room, double packing) {
  if (packing == 0.0) return std::vector<double>(radii.begin(), radii.end());
  const double of_each = filled_part(radii, room) / static_cast<double>(radii.size());
  InputCheck check("place_spheres");
  check.require(!radii.empty(), ErrorCode::out_of_range, {"radii"}, "must name at least one for a packing of",
                packing, radii.size());
  check.require(packing < of_each * no_body.index, ErrorCode::out_of_range, {"packing"},
                "must be 0 where this part takes more spheres than", std::size_t{no_body.index}, packing);
  if (check.error()) return *check.error();
  std::vector<double> result;
  for (double filled = 0.0;;) {
    const double radius = radii[result.size() % radii.size()];
    filled += filled_part({&radius, 1}, room);
    if (filled > packing) return result;
    result.push_back(radius);
  }
}

/// Returns whether random placement is likely to fail. Spheres of one size that are placed at random jam at
/// 38 % of a large box, and take long well before that.
bool will_jam(const SphereRoom& room, double filled) {
  const auto [least, largest] = std::minmax_element(room.radii.begin(), room.radii.end());
  return filled > (room.dimensions == 2 || *least < 0.5 * *largest ? 0.4 : 0.28);
}

std::optional<std::vector<Vec3>> place_at_random(const SphereRoom& room, Random random) {
  std::vector<double> ranges;
  for (const double radius : room.radii) ranges.push_back(radius + room.gap);
  SphereGrid grid(room, ranges);
  std::vector<Vec3> centres(room.count());
  std::uint64_t tries = 0;
  const auto place = [&](std::uint32_t sphere) {
    const std::uint64_t most = std::min(tries, tries_each * room.count()) + most_tries;
    while (tries++ < most) {
      const Vec3 centre = centres[sphere] = room.random_centre(sphere, random);
      const auto is_clear = [&](std::uint32_t other) {
        return !room.overlap(sphere, centre, other, centres[other]);
      };
      if (!grid.all_near(sphere, centre, is_clear)) continue;
      grid.enter(sphere, centre);
      return true;
    }
    return false;
  };
  std::vector<std::uint32_t> order(room.count());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return room.radii[a] > room.radii[b]; });
  if (!std::all_of(order.begin(), order.end(), place)) return std::nullopt;
  return centres;
}

}  // namespace

Result<std::vector<Vec3>> place_spheres(std::span<const double> radii, const Box& box,
                                        const PlacementOptions& options) {
  const int dimensions = options.dimensions;
  SphereRoom room{.box = box, .periodic = options.periodic, .dimensions = dimensions, .gap = options.gap};
  if (dimensions == 2) room.box.lower.z = room.box.upper.z = 0.0;
  room.gap = std::max(room.gap, 0x1p-48 * std::max(norm(room.box.lower), norm(room.box.upper)));
  if (dimensions == 2) room.box.upper.z = 1.0;
  if (auto valid = check_placement(radii, room, options); !valid) return valid.error();
  auto all = repeated(radii, room, options.packing);
  if (!all) return all.error();
  if (all->empty()) return std::vector<Vec3>{};
  room.radii = std::move(*all);
  const double filled = filled_part(room.radii, room, 0.5 * room.gap);
  std::optional<std::vector<Vec3>> centres;
  if (!will_jam(room, filled)) centres = place_at_random(room, Random::at(options.seed, 0, 0));
  if (!centres && filled <= 1.0) centres = relax_spheres(room, options.seed);
  if (centres) return *std::move(centres);
  return Error{
      ErrorCode::out_of_range, "radii", no_body,
      "place_spheres: radii must leave room in the box, but no arrangement without overlap was found of " +
          std::to_string(room.count()) + " spheres that fill " + text_of(filled) + " of it"};
}

}  // namespace kinesphere
