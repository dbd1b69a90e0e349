// ContactsOfBody is what a contact graph stores about one body, to move it to another graph.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_graph.hpp"

namespace kinesphere {

struct ContactsOfBody {
  ContactRate::Body rate{};
  ContactGraph::Flags flags{};
  PartnerList partners{};
  std::vector<OverlapRecord> overlaps{};

  static ContactsOfBody of(const ContactGraph& graph, std::uint32_t body);
  /// Sets the rate and the flags of the body. Its partners and overlaps stay unchanged
  /// (ContactGraph::set_links()).
  void set(ContactGraph& graph, std::uint32_t body) const;
};

}  // namespace kinesphere
