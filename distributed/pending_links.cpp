#include "distributed/pending_links.hpp"

#include <utility>

namespace kinesphere {

const PendingLinks::Links* PendingLinks::of(std::uint32_t name) const {
  const auto found = links_.find(name);
  return found == links_.end() ? nullptr : &found->second;
}

void PendingLinks::set(std::uint32_t name, Links links) {
  if (links.empty()) {
    links_.erase(name);
  } else {
    links_[name] = std::move(links);
  }
}

void PendingLinks::remove(std::uint32_t name, std::uint32_t partner) {
  const auto found = links_.find(name);
  if (found == links_.end()) return;
  std::erase_if(found->second.partners, [=](const ContactRecord& one) { return one.partner == partner; });
  std::erase_if(found->second.overlaps, [&](const OverlapRecord& c) { return c.partner == partner; });
  if (found->second.empty()) links_.erase(found);
}

}  // namespace kinesphere
