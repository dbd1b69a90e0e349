#include "contact/contacts_of_body.hpp"

namespace kinesphere {

ContactsOfBody ContactsOfBody::of(const ContactGraph& graph, std::uint32_t body) {
  const OverlapRecords::List crossed = graph.overlaps_of(body);
  return {graph.rate_.of(body),
          graph.flags_[body],
          body < graph.partners_.size() ? graph.partners_[body] : PartnerList(),
          {crossed.begin(), crossed.end()}};
}

void ContactsOfBody::set(ContactGraph& graph, std::uint32_t body) const {
  graph.rate_.restore(body, rate);
  graph.flags_[body] = flags;
}

}  // namespace kinesphere
