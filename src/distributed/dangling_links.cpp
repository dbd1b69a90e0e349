#include "distributed/dangling_links.hpp"

#include <utility>

namespace kinesphere {

const DanglingLinks::Links* DanglingLinks::of(std::uint32_t name) const {
  const auto found = links_.find(name);
  return found == links_.end() ? nullptr : &found->second;
}

void DanglingLinks::set(std::uint32_t name, Links links) {
  if (links.empty()) {
    links_.erase(name);
  } else {
    links_[name] = std::move(links);
  }
}

void DanglingLinks::remove(std::uint32_t name, std::uint32_t partner) {
  const auto found = links_.find(name);
  if (found == links_.end()) return;
  std::erase(found->second.partners, partner);
  std::erase_if(found->second.crossings, [&](const Crossing& c) { return c.partner == partner; });
  if (found->second.empty()) links_.erase(found);
}

}  // namespace kinesphere
