// Which way the bodies of a recording point.
#include "tracks/headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/program_error.hpp"
#include "formats/tables/column_steps.hpp"
#include "number/infinity.hpp"

namespace kinesphere::program {
namespace {

constexpr double half_turn = 3.14159265358979323846, degree = half_turn / 180.0;

/// A heading of the file, and the direction in which the body then goes (radians from the x axis).
struct Course {
  double heading, direction;
};

/// Returns the headings of bodies that move: on at least half their width from one row to a later one.
std::vector<Course> courses_of(const RawTrackSet& raw, const Coordinates& coordinates) {
  std::vector<Course> courses;
  for (const RawTrack& track : raw.tracks()) {
    const RawSample* from = nullptr;
    for (const RawSample& sample : track.samples) {
      if (from == nullptr || !is_earlier(from->time, sample.time)) {
        from = &sample;
        continue;
      }
      Vec3 way = coordinates.local(sample.position) - coordinates.local(from->position);
      way.z = 0.0;
      if (norm(way) < 0.5 * track.width || norm(way) == 0.0) continue;
      if (from->heading && sample.heading) courses.push_back({*sample.heading, std::atan2(way.y, way.x)});
      from = &sample;
    }
  }
  return courses;
}

/// Returns the angle by which half of the headings differ from the motion, at most.
double misfit(const std::vector<Course>& courses, const HeadingScale& scale) {
  std::vector<double> angles;
  for (const Course& course : courses)
    angles.push_back(
        std::abs(std::remainder(scale.radians(course.heading) - course.direction, 2.0 * half_turn)));
  const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  return *middle;
}

std::string text_of(const HeadingScale& scale) {
  return scale.is_from_north ? "clockwise from north" : "counterclockwise from the x axis";
}

/// Finds out by the motion what headings count from and, unless it is said, their unit.
HeadingScale scale_by_motion(const RawTrackSet& raw, const Coordinates& coordinates, const Column& column,
                             std::optional<HeadingFrom> from, const std::string& name) {
  const std::vector<Course> courses = courses_of(raw, coordinates);
  std::vector<HeadingScale> scales;
  for (const bool is_from_north : {false, true}) {
    if (from && (*from == HeadingFrom::north) != is_from_north) continue;
    for (const double unit : {degree, 1.0})
      if (!column.has_unit || unit == column.unit * degree)
        scales.push_back({.is_of_motion = false, .unit = unit, .is_from_north = is_from_north});
  }
  constexpr double largest_misfit = 20.0 * degree;
  HeadingScale* best = nullptr;
  double least = largest_misfit;
  for (HeadingScale& scale : scales) {
    const double angle = courses.empty() ? infinity : misfit(courses, scale);
    if (angle >= least) continue;
    least = angle;
    best = &scale;
  }
  if (best == nullptr)
    throw ProgramError(fmt::format(
        "{}: {} may count from the x axis counterclockwise or from north clockwise, in degrees or radians, "
        "and "
        "fits the motion of the bodies as none of these: say --heading x-axis or --heading compass, and the "
        "unit, as in --columns ...,heading=...:rad; or --heading motion, for bodies that point where they go",
        raw.head().file, name));
  best->text =
      fmt::format("of {}, {} from {}, as the motion shows", name, best->unit == 1.0 ? "radians" : "degrees",
                  best->is_from_north ? "north, clockwise" : "the x axis, counterclockwise");
  return *best;
}

/// Adds a heading behind others, and makes it the nearest of those that are whole periods from it.
void add_heading(RectangleBody& body, double time, double heading, double period) {
  if (!body.headings.empty())
    heading = body.headings.back() + std::remainder(heading - body.headings.back(), period);
  body.times.push_back(time);
  body.headings.push_back(heading);
}

/// Adds the directions of the motion: on each stretch of half the width of the body that of its chord.
void add_directions(RectangleBody& body, const Piece& piece) {
  const TrackSample* from = &piece.front().sample;
  for (const PlacedSample& placed : piece) {
    Vec3 way = placed.sample.position - from->position;
    way.z = 0.0;
    if (norm(way) < 0.5 * body.width) continue;
    // A rectangle that goes back looks as one that has turned by half.
    add_heading(body, 0.5 * (from->time + placed.sample.time), std::atan2(way.y, way.x), half_turn);
    from = &placed.sample;
  }
}

}  // namespace

double HeadingScale::radians(double heading) const {
  return is_from_north ? 0.5 * half_turn - unit * heading : unit * heading;
}

HeadingScale heading_scale_of(const RawTrackSet& raw, const TrackOptions& options,
                              const Coordinates& coordinates) {
  const TableColumns& columns = raw.columns();
  if (columns.rotation && options.heading_from != HeadingFrom::motion)
    return {
        .is_of_motion = false,
        .text = fmt::format("of the quaternions in {}", column_text(raw.head(), columns.rotation->front()))};
  const auto &heading = columns[Quantity::heading], &course = columns[Quantity::course];
  if (options.heading_from == HeadingFrom::motion || (!heading && !course)) {
    if (options.heading_from && options.heading_from != HeadingFrom::motion)
      throw ProgramError(fmt::format("--heading: expected a column of headings, but {} has {}",
                                     raw.head().file, raw.head().text()));
    return {.text = "those of the motion"};
  }
  const std::string name = column_text(raw.head(), heading ? heading->place : course->place);
  if (!heading || columns.heading_is_from_x) {
    HeadingScale scale{
        .is_of_motion = false, .unit = heading ? heading->unit * degree : degree, .is_from_north = !heading};
    if (options.heading_from) scale.is_from_north = options.heading_from == HeadingFrom::north;
    scale.text = fmt::format("of {}, {}", name, text_of(scale));
    return scale;
  }
  if (heading->has_unit && options.heading_from)
    return {.is_of_motion = false,
            .unit = heading->unit * degree,
            .is_from_north = options.heading_from == HeadingFrom::north,
            .text = fmt::format("of {}, as --heading says", name)};
  return scale_by_motion(raw, coordinates, *heading, options.heading_from, name);
}

RectangleBody rectangle_of(Piece& piece, const RectangleBody& size, const HeadingScale& scale,
                           TableColumns::Place place) {
  const auto [length, width] = std::pair(size.length, size.width);
  RectangleBody body = size;
  if (!(length > 0.0 && width > 0.0)) return {.height = size.height};
  if (scale.is_of_motion) {
    add_directions(body, piece);
  } else {
    for (const PlacedSample& placed : piece)
      if (placed.heading)
        add_heading(body, placed.sample.time, scale.radians(*placed.heading), 2.0 * half_turn);
  }
  for (PlacedSample& placed : piece) {
    Vec3& position = placed.sample.position;
    if (place == TableColumns::Place::upper_left) position += Vec3{0.5 * length, 0.5 * width, 0.0};
    if (place != TableColumns::Place::front || body.times.empty()) continue;
    const double heading = body.heading_at(placed.sample.time);
    position -= Vec3{std::cos(heading), std::sin(heading), 0.0} * (0.5 * length);
  }
  if (body.times.empty()) return {.radius = 0.5 * std::hypot(length, width), .height = size.height};
  return body;
}

}  // namespace kinesphere::program
