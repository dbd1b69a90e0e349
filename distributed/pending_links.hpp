// PendingLinks stores links from bodies that a rank holds to bodies that it does not hold: contacts and
// sensor overlaps. When the other body arrives, the link moves to the contact graph.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "contact/contact_state.hpp"
#include "contact/overlap_records.hpp"

namespace kinesphere {

/// Links from held bodies to bodies not held, identified by name.
class PendingLinks {
 public:
  /// Pending links of one body.
  struct Links {
    std::vector<ContactRecord> partners{};  ///< bodies in contact, by name
    std::vector<OverlapRecord> overlaps{};  ///< sensor overlaps

    bool empty() const { return partners.empty() && overlaps.empty(); }
  };

  /// Returns the pending links of the body, or null if it has none. Invalidated by set() and remove() of this
  /// body.
  const Links* of(std::uint32_t name) const;
  /// Replaces the pending links of the body.
  void set(std::uint32_t name, Links links);
  void add_partner(std::uint32_t name, const ContactRecord& partner) {
    links_[name].partners.push_back(partner);
  }
  void add_overlap(std::uint32_t name, const OverlapRecord& overlap) {
    links_[name].overlaps.push_back(overlap);
  }
  /// Removes the body's links to `partner`, which has arrived.
  void remove(std::uint32_t name, std::uint32_t partner);
  /// Removes all links of a body that this rank no longer holds.
  void remove(std::uint32_t name) { links_.erase(name); }

 private:
  std::unordered_map<std::uint32_t, Links> links_;  ///< by name; bodies without pending links have no entry
};

}  // namespace kinesphere
