#include "research/bench/contact_counts.hpp"

#include <algorithm>

#include "base/program_error.hpp"
#include "simulation/run/simulate.hpp"

namespace kinesphere::program {

ContactCounts count_contacts(const Scene& scene, const DetectorMaker& make) {
  ContactCounts counts;
  SimulationObserver observer;
  observer.on_event = [&](const Event& event) {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return;
    const BodyId second = event.second == no_body ? event.first : event.second;
    ++counts[{event.first.index, second.index, event.wall}];
  };
  require(simulate(scene, make, observer));
  return counts;
}

ContactCounts body_contacts(const ContactCounts& counts) {
  ContactCounts found = counts;
  std::erase_if(found, [](const auto& entry) { return std::get<2>(entry.first) != Wall::none; });
  return found;
}

ContactCounts wall_contacts(const ContactCounts& counts) {
  ContactCounts found = counts;
  std::erase_if(found, [](const auto& entry) { return std::get<2>(entry.first) == Wall::none; });
  return found;
}

std::uint64_t total(const ContactCounts& counts) {
  std::uint64_t sum = 0;
  for (const auto& [pair, count] : counts) sum += count;
  return sum;
}

std::uint64_t missed(const ContactCounts& truth, const ContactCounts& seen) {
  std::uint64_t missed = 0;
  for (const auto& [pair, count] : truth) {
    const auto found = seen.find(pair);
    missed += count - std::min(count, found == seen.end() ? 0 : found->second);
  }
  return missed;
}

}  // namespace kinesphere::program
