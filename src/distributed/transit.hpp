// Bodies come to a rank and go from it: own ones to another owner, copies to those who may meet them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "distributed/agreement.hpp"
#include "distributed/dangling_links.hpp"
#include "distributed/local_world.hpp"
#include "distributed/outbox.hpp"
#include "distributed/parcel.hpp"
#include "engine/islands.hpp"
#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

/// Packs bodies into parcels, and installs those that come.
///
/// While a part of a phase runs, islands have changed bodies that may have to run again from where the part
/// began. So a body that is sent then has to be as it was when the part began, and its hot pairs too.
/// Functions that take `islands` do that; null stands for the time between parts.
class Transit {
 public:
  Transit(Motion& motion, LocalWorld& local) : motion_(motion), local_(local) {}

  /// The body as it is now, but for hot pairs. Throws what Motion::write_body throws, and BadResult with its
  /// errors.
  Parcel pack(std::uint32_t number) const;
  /// The body as it was when the part of the phase began, with events of it that waited to be told then; but
  /// for hot pairs.
  Parcel pack_as_it_began(std::uint32_t number, Islands& islands);
  /// Adds their hot pairs to the parcels of these bodies, numbers[k] to parcels[k]. Cost: O(hot
  /// pairs of the rank).
  void add_due(std::vector<Parcel>& parcels, std::span<const std::uint32_t> numbers, Islands* islands);
  /// Adds those of the pairs that the body has a part in to its parcel.
  void add_due(Parcel& parcel, std::uint32_t number, std::span<const HotPair> pairs) const;

  /// The bodies are known from now on, or as the parcels have them; returns what has to be begun with, of
  /// which the pairs may be due at any time. Errors: those of Motion::read_body.
  Result<Beginning> install(std::vector<Parcel>& parcels, const Islands* islands);
  /// Collective, between parts. Sends the parcels that have been written to the outbox, and installs those
  /// that come, which are returned. Errors, the same on all ranks: what one of them has noted, also of
  /// Motion::read_body.
  Result<std::vector<Parcel>> exchange(Communicator& communicator, Agreement& agreement, Outbox& outbox);
  /// The body is not known here any more.
  void drop(std::uint32_t number);

  // A checkpoint may bring two bodies to different ranks that have a hot pair: neither of them knows both
  // until copies have come. In between the pair is loose, and goes with the own body to where copies of it
  // go. Between parts only.
  void keep_loose_pairs() { loose_.emplace(); }
  void forget_loose_pairs() { loose_.reset(); }

 private:
  Parcel::Due due_of(const HotPair& pair, std::uint32_t number) const;
  HotPair hot_pair(const Parcel::Due& due, std::uint32_t number, std::uint32_t other,
                   const Islands* islands) const;
  std::uint32_t stamp_of(std::uint32_t number, const Islands* islands) const;
  Result<std::uint32_t> install(Parcel& parcel);
  void link(const Parcel& parcel);

  Motion& motion_;
  LocalWorld& local_;
  DanglingLinks dangling_;
  std::optional<std::unordered_map<std::uint32_t, std::vector<Parcel::Due>>> loose_;  ///< by number
  /// By number: of a body whose parcel gets its hot pairs, one more than the parcel's place; 0 of all others.
  std::vector<std::uint32_t> places_;
};

}  // namespace kinesphere
