// Inspection of a world: its memory, its time, and what a debug view can draw.
//
//   for (const BodyId id : world.bodies()) {
//     const BodyView body = world.body(id).value();
//     draw(body.bound.centre_at(world.time()), body.bound.radius_at(world.time()));
//     draw(body.box);
//   }
//   for (const CellView& cell : world.inspection().cells()) draw(cell.box);
//   for (const Certificate& c : world.inspection().certificates())
//     draw(c.first, c.second, c.until - world.time());
//
//   world.set_profiling(true).value();
//   ... // let time pass
//   for (const BusyBody& busy : world.inspection().busiest(10).value()) print(busy.body,
//   name_of(busy.reason));
//
// All results are copies: changing them does not change the world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/body_id.hpp"
#include "kinesphere/vec3.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// Memory by part (bytes): allocated memory, used or not, plus 16 bytes per block, the usual overhead of an
/// allocator; a tree node counts with four pointers.
struct Memory {
  std::size_t bodies = 0;     ///< definitions and bounds
  std::size_t windows = 0;    ///< safe regions of the bodies, and their cells
  std::size_t pairs = 0;      ///< lists of neighbours, and due times
  std::size_t contacts = 0;   ///< contacts, and pending events
  std::size_t recording = 0;  ///< the recording so far
  std::size_t other = 0;

  /// Returns the sum of all parts.
  std::size_t total() const { return bodies + windows + pairs + contacts + recording + other; }

  friend constexpr bool operator==(const Memory&, const Memory&) = default;
};

/// Wall-clock time spent (seconds) since World::set_profiling(true).
struct Timings {
  std::uint64_t advances = 0;  ///< calls of advance()
  double advance = 0.0;        ///< in advance(), including probes
  double probes = 0.0;         ///< in the caller's probes

  friend constexpr bool operator==(const Timings&, const Timings&) = default;
};

/// Main reason for the probes of a body (World::Inspection::busiest()).
enum class ProbeReason : std::uint8_t {
  touching,       ///< it stays in touch, and its acceleration limit would let it leave at any time
  narrow_misses,  ///< it comes near other bodies, walls or sensor distances without touching them
  loose_limit,    ///< its acceleration limit is over 4 times the largest acceleration that reports showed
  contacts,       ///< its contacts begin often, and each needs probes
  travel,         ///< it moves through space, and leaves its safe regions
  changes,        ///< the caller changes it, or its reports violate its bound
  queries,        ///< queries and predictions with a probe ask for it
};

/// Returns the name of a reason, such as "narrow_misses".
std::string_view name_of(ProbeReason reason);
/// Returns two sentences for a person: what the reason means, and what makes such a body cheaper.
std::string_view advice_on(ProbeReason reason);

/// A body that was probed while profiling was on, and why.
struct BusyBody {
  BodyId body;
  ProbeReason reason = ProbeReason::travel;
  /// Probed states of the body; the sum of the next five.
  std::uint64_t probes = 0;
  std::uint64_t touching = 0;  ///< for a body or wall that it touches
  std::uint64_t near = 0;      ///< for a body, wall or sensor distance that it may reach or leave
  std::uint64_t windows = 0;   ///< as it left its safe regions
  std::uint64_t changes = 0;   ///< after changes by the caller and violated bounds
  std::uint64_t queries = 0;   ///< for queries and predictions with a probe
  /// Events contact_begin and wall_begin of the body.
  std::uint64_t contacts = 0;
  double acceleration_limit = 0.0;  ///< now (length / time^2)
  /// Largest deviation from the planned acceleration (length / time^2) that reported velocities prove: the
  /// mean between two reports, less the velocity errors. The true acceleration may have been larger in
  /// between.
  double largest_acceleration = 0.0;

  friend constexpr bool operator==(const BusyBody&, const BusyBody&) = default;
};

/// A non-empty cell of safe regions. Bodies with safe regions of about equal size share a level; each
/// level has its own cells.
struct CellView {
  Box box{};
  std::size_t bodies = 0;  ///< number of bodies with the centre of their safe region in the cell

  friend constexpr bool operator==(const CellView&, const CellView&) = default;
};

/// Certificate of a pair, or of a body and the walls: of each body the one that fails first. Before `until`
/// the pair does not begin or end to touch or to sense each other (a body and the walls: the set of walls
/// that the body touches does not change), while its bodies keep their motion limits and nothing changes
/// them. A pair without a certificate does not change before the earliest BodyView::box_end of the two, nor
/// before a certificate of either fails; a body without a wall certificate reaches or leaves no wall until
/// its box_end.
struct Certificate {
  BodyId first;   ///< first < second
  BodyId second;  ///< no_body for the walls
  double until;   ///< may be infinite

  friend constexpr bool operator==(const Certificate&, const Certificate&) = default;
};

/// First discrepancy that World::Inspection::audit() found.
struct AuditFinding {
  /// One of "registration", "certificate", "contact", "sensor", "wall", "filter", "queue"; "call" if the
  /// audit could not run.
  std::string where;
  std::string what;  ///< the bodies, the recorded value and the expected value

  friend bool operator==(const AuditFinding&, const AuditFinding&) = default;
};

/// What World::inspection() returns: the internal state of one world, as it is at each call. The world must
/// outlive it and keep its address.
class [[nodiscard]] World::Inspection {
 public:
  /// Returns the memory in use, by part. Cost: O(n).
  Memory memory() const;
  /// Returns the non-empty cells of safe regions. Cost: O(n).
  std::vector<CellView> cells() const;
  /// Returns the certificates of pairs, and of bodies and the walls, that may fail before the earliest
  /// box_end of their bodies, in no particular order. Cost: O(certificates).
  std::vector<Certificate> certificates() const;
  /// Returns the time spent while profiling was on (World::set_profiling).
  Timings timings() const;
  /// Returns the bodies that were probed most often while profiling was on, at most `count`, each with the
  /// reason: the most probed first, equally probed ones by index. Bodies without a probe and removed bodies
  /// are left out. Switch profiling off and on to count anew. While no body has been removed, all bodies add
  /// up to the increase of Counters::probes. Unlike timings(), the result is deterministic, and equal for a
  /// loop over advance() and for run(). Errors: not_profiling, if profiling was
  /// never on. Cost: O(n).
  Result<std::vector<BusyBody>> busiest(std::size_t count) const;
  /// True from World::start_recording() to stop_recording().
  bool is_recording() const;

  /// Recomputes from scratch every registration, certificate and contact, and returns the first difference
  /// from the stored ones, or nothing. Intended for tests. Called inside a probe or pair filter of this
  /// world, it only returns a finding that says so. Cost: O(n^2).
  std::optional<AuditFinding> audit() const;

  /// World::inspection() makes it.
  explicit Inspection(const World& world) : world_(&world) {}

 private:
  const World* world_;
};

inline World::Inspection World::inspection() const& { return Inspection(*this); }

}  // namespace kinesphere
