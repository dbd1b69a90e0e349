#include "contact/contact_checkpoint.hpp"

#include <algorithm>
#include <span>

namespace kinesphere {
namespace {

bool is_of_same_link(const ContactRecord& a, const ContactRecord& b) { return a.partner == b.partner; }
bool is_of_same_link(const OverlapRecord& a, const OverlapRecord& b) { return a == b; }

/// Returns the links of `from` that `in` does not contain. Cost: O(|from| * |in|).
template <class Record>
std::vector<Record> missing(std::span<const Record> from, std::span<const Record> in) {
  std::vector<Record> found(from.begin(), from.end());
  std::erase_if(found, [&](const Record& one) {
    return std::any_of(in.begin(), in.end(),
                       [&](const Record& other) { return is_of_same_link(one, other); });
  });
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
  const auto is_static = [&graph](std::uint32_t other) { return graph.flags_[other].is_static(); };
  for (const ContactRecord& gone : missing(partners.all(), graph.partners_of(body)))
    if (is_static(gone.partner)) graph.partners_[gone.partner].erase(body);
  for (const ContactRecord& come : missing(graph.partners_of(body), partners.all()))
    if (is_static(come.partner)) graph.partners_[come.partner].set({body});
  const OverlapRecords::List before(overlaps);
  for (const OverlapRecord& gone : missing(before, graph.overlaps_of(body)))
    if (is_static(gone.partner)) graph.overlaps_.erase(gone.partner, {body, gone.distance, gone.senses});
  for (const OverlapRecord& come : missing(graph.overlaps_of(body), before))
    if (is_static(come.partner)) graph.overlaps_.add(come.partner, {body, come.distance, come.senses});
}

}  // namespace kinesphere
