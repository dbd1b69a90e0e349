// The contacts of a body as they were, for threads that work side by side and may have to go back.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_graph.hpp"

namespace kinesphere {

/// All that a book knows of one body.
struct ContactCheckpoint {
  ContactRate::Body rate{};
  ContactGraph::Flags flags{};
  PartnerList partners{};
  std::vector<OverlapRecord> overlaps{};

  static ContactCheckpoint of(const ContactGraph& book, std::uint32_t body);
  /// As it was; the lists of its partners stay as they are.
  void restore(ContactGraph& book, std::uint32_t body) const;
  /// The same but for whom it touches and senses.
  void restore_alone(ContactGraph& book, std::uint32_t body) const;
  /// Brings the lists of fixed bodies, which stay as they are while threads work side by side, up to date
  /// with what has changed about this one.
  void update_static(ContactGraph& book, std::uint32_t body) const;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [last, marks, touched, sensed] = self;
    archive(last, marks, touched, sensed);
  }
};

}  // namespace kinesphere
