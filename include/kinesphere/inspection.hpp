// Seeing inside a world: what it takes, where its time goes, and what there is to draw.
//
//   for (const BodyId id : world.bodies()) {
//     const BodyView body = world.body(id).value();
//     draw(body.bound.centre_at(world.time()), body.bound.radius_at(world.time()));
//     draw(body.box);
//   }
//   for (const CellView& cell : world.cells()) draw(cell.box);
//   for (const Certificate& c : world.certificates()) draw(c.first, c.second, c.until - world.time());
//
// All of it is a copy: whatever is done with it, the world stays as it is.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kinesphere/body_id.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Memory by part (bytes): what has been asked of the allocator, used yet or not, and 16 bytes a block, which
/// is what allocators usually take for themselves; a node of a tree counts with four pointers.
struct Memory {
  std::size_t bodies = 0;     ///< definitions and bounds
  std::size_t windows = 0;    ///< until when each body is where, in the cells of layers
  std::size_t pairs = 0;      ///< that may change before a window ends, and when
  std::size_t contacts = 0;   ///< who touches whom, and events on their way
  std::size_t recording = 0;  ///< what has been recorded so far
  std::size_t other = 0;

  std::size_t total() const { return bodies + windows + pairs + contacts + recording + other; }
};

/// Real time spent (seconds) since World::set_profiling(true).
struct Timings {
  std::uint64_t advances = 0;  ///< calls of advance()
  double advance = 0.0;        ///< in advance(), the probes in it too
  double probes = 0.0;         ///< in the caller's probes
};

/// A cell that holds something. Bodies of about one size and speed share a layer, and each layer has cells of
/// its own, which are cubes cut into four slices.
struct CellView {
  Box box{};
  std::size_t bodies = 0;  ///< the middles of whose boxes lie in it
};

/// What is recorded of a pair, or of a body and the walls: whether the two touch or sense each other, or
/// which walls the body touches, does not change before `until`, as long as they keep their promises and
/// nobody changes them. Pairs of which nothing is recorded are apart at least until the box of one of them
/// ends (BodyView::box_end); a body of whose walls nothing is recorded reaches or leaves none until its box
/// ends.
struct Certificate {
  BodyId first;   ///< first < second
  BodyId second;  ///< no_body for the walls
  double until;   ///< may be infinite
};

}  // namespace kinesphere
