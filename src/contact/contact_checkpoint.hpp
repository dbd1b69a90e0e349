// Saved contacts of one body: for rolling back speculative execution and for moving a body between contact
// graphs.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_graph.hpp"

namespace kinesphere {

/// Everything that a ContactGraph stores about one body.
struct ContactCheckpoint {
  ContactRate::Body rate{};
  ContactGraph::Flags flags{};
  PartnerList partners{};
  std::vector<OverlapRecord> overlaps{};

  static ContactCheckpoint of(const ContactGraph& graph, std::uint32_t body);
  /// Restores the body's own rate, flags, partners and overlaps. The lists of its partners stay unchanged.
  void restore(ContactGraph& graph, std::uint32_t body) const;
  /// Restores only the rate and the flags of the body. Its partners and overlaps stay unchanged.
  void restore_alone(ContactGraph& graph, std::uint32_t body) const;
  /// Updates the lists of static bodies with the contacts and overlaps that `body` has gained or lost since
  /// this checkpoint. Those lists are frozen between start_side_by_side() and stop_side_by_side().
  void update_static(ContactGraph& graph, std::uint32_t body) const;
};

}  // namespace kinesphere
