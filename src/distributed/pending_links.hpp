// Links that lead out of what a rank knows: a known body touches or senses one that is not known here. Once
// the other one comes, the two find each other in the contact book again.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "contact/overlap_records.hpp"

namespace kinesphere {

/// Of known bodies to unknown ones, both by name.
class PendingLinks {
 public:
  /// Of one body.
  struct Links {
    std::vector<std::uint32_t> partners{};  ///< whom it touches
    std::vector<OverlapRecord> overlaps{};  ///< whom it senses

    bool empty() const { return partners.empty() && overlaps.empty(); }
  };

  /// Null for a body that has none.
  const Links* of(std::uint32_t name) const;
  /// In place of those that the body has.
  void set(std::uint32_t name, Links links);
  void add_partner(std::uint32_t name, std::uint32_t partner) { links_[name].partners.push_back(partner); }
  void add_overlap(std::uint32_t name, const OverlapRecord& overlap) {
    links_[name].overlaps.push_back(overlap);
  }
  /// The partner has become known, so the body's links to it do not dangle any longer.
  void remove(std::uint32_t name, std::uint32_t partner);
  /// The body is known no longer.
  void remove(std::uint32_t name) { links_.erase(name); }

 private:
  std::unordered_map<std::uint32_t, Links> links_;  ///< of bodies that have some
};

}  // namespace kinesphere
