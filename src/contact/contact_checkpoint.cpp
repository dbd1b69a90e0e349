#include "contact/contact_checkpoint.hpp"

#include <algorithm>

namespace kinesphere {
namespace {

/// Returns the elements of `from` that `in` does not contain. Cost: O(|from| * |in|).
template <class List, class Other>
auto missing(const List& from, const Other& in) {
  auto found = std::vector(from.begin(), from.end());
  std::erase_if(found, [&](const auto& one) { return std::find(in.begin(), in.end(), one) != in.end(); });
  return found;
}

}  // namespace

ContactCheckpoint ContactCheckpoint::of(const ContactGraph& graph, std::uint32_t body) {
  const OverlapRecords::List crossed = graph.overlaps_of(body);
  return {graph.rate_.of(body),
          graph.flags_[body],
          body < graph.partners_.size() ? graph.partners_[body] : PartnerList(),
          {crossed.begin(), crossed.end()}};
}

void ContactCheckpoint::restore(ContactGraph& graph, std::uint32_t body) const {
  restore_alone(graph, body);
  if (body < graph.partners_.size()) graph.partners_[body] = partners;
  graph.overlaps_.set(body, overlaps);
}

void ContactCheckpoint::restore_alone(ContactGraph& graph, std::uint32_t body) const {
  graph.rate_.restore(body, rate);
  graph.flags_[body] = flags;
}

void ContactCheckpoint::update_static(ContactGraph& graph, std::uint32_t body) const {
  const auto is_static = [&graph](std::uint32_t other) { return graph.flags_[other].is_static; };
  for (const std::uint32_t gone : missing(partners.all(), graph.partners_of(body)))
    if (is_static(gone)) graph.partners_[gone].erase(body);
  for (const std::uint32_t come : missing(graph.partners_of(body), partners.all()))
    if (is_static(come)) graph.partners_[come].add(body);
  for (const OverlapRecord& gone : missing(overlaps, graph.overlaps_of(body)))
    if (is_static(gone.partner)) graph.overlaps_.erase(gone.partner, {body, gone.distance, gone.senses});
  for (const OverlapRecord& come : missing(graph.overlaps_of(body), overlaps))
    if (is_static(come.partner)) graph.overlaps_.add(come.partner, {body, come.distance, come.senses});
}

}  // namespace kinesphere
