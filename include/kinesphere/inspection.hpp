// Inspection of a world: its memory, its time, and what a debug view can draw.
//
//   for (const BodyId id : world.bodies()) {
//     const BodyView body = world.body(id).value();
//     draw(body.bound.centre_at(world.time()), body.bound.radius_at(world.time()));
//     draw(body.box);
//   }
//   for (const CellView& cell : world.cells()) draw(cell.box);
//   for (const Certificate& c : world.certificates()) draw(c.first, c.second, c.until - world.time());
//
// All results are copies: changing them does not change the world.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kinesphere/body_id.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Memory by part (bytes): allocated memory, used or not, plus 16 bytes per block, the usual overhead of an
/// allocator; a tree node counts with four pointers.
struct Memory {
  std::size_t bodies = 0;     ///< definitions and bounds
  std::size_t windows = 0;    ///< windows of the bodies, in the cells of the grid levels
  std::size_t pairs = 0;      ///< certificates that fail before a window ends
  std::size_t contacts = 0;   ///< contacts, and pending events
  std::size_t recording = 0;  ///< the recording so far
  std::size_t other = 0;

  std::size_t total() const { return bodies + windows + pairs + contacts + recording + other; }
};

/// Wall-clock time spent (seconds) since World::set_profiling(true).
struct Timings {
  std::uint64_t advances = 0;  ///< calls of advance()
  double advance = 0.0;        ///< in advance(), including probes
  double probes = 0.0;         ///< in the caller's probes
};

/// A non-empty cell of the broad phase. Bodies of about equal size and speed share a grid level; each level
/// has its own cells, which are cubes cut into four slices.
struct CellView {
  Box box{};
  std::size_t bodies = 0;  ///< number of bodies with the centre of their box in the cell
};

/// Certificate of a pair, or of a body and the walls. Before `until` the pair does not begin or end to
/// touch or to sense each other (a body and the walls: the set of walls that the body touches does not
/// change), while its bodies keep their motion limits and nothing changes them. A pair without a
/// certificate is apart at least until the earliest BodyView::box_end of the two; a body without a wall
/// certificate reaches or leaves no wall until its box_end.
struct Certificate {
  BodyId first;   ///< first < second
  BodyId second;  ///< no_body for the walls
  double until;   ///< may be infinite
};

}  // namespace kinesphere
