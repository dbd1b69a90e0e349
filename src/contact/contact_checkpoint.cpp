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

ContactCheckpoint ContactCheckpoint::of(const ContactGraph& book, std::uint32_t body) {
  const OverlapRecords::List crossed = book.overlaps_of(body);
  return {book.rate_.of(body),
          book.flags_[body],
          body < book.partners_.size() ? book.partners_[body] : PartnerList(),
          {crossed.begin(), crossed.end()}};
}

void ContactCheckpoint::restore(ContactGraph& book, std::uint32_t body) const {
  restore_alone(book, body);
  if (body < book.partners_.size()) book.partners_[body] = partners;
  book.overlaps_.set(body, overlaps);
}

void ContactCheckpoint::restore_alone(ContactGraph& book, std::uint32_t body) const {
  book.rate_.restore(body, rate);
  book.flags_[body] = flags;
}

void ContactCheckpoint::update_static(ContactGraph& book, std::uint32_t body) const {
  const auto is_fixed = [&book](std::uint32_t other) { return book.flags_[other].is_static; };
  for (const std::uint32_t gone : missing(partners.all(), book.partners_of(body)))
    if (is_fixed(gone)) book.partners_[gone].erase(body);
  for (const std::uint32_t come : missing(book.partners_of(body), partners.all()))
    if (is_fixed(come)) book.partners_[come].add(body);
  for (const OverlapRecord& gone : missing(overlaps, book.overlaps_of(body)))
    if (is_fixed(gone.partner)) book.overlaps_.erase(gone.partner, {body, gone.distance, gone.senses});
  for (const OverlapRecord& come : missing(book.overlaps_of(body), overlaps))
    if (is_fixed(come.partner)) book.overlaps_.add(come.partner, {body, come.distance, come.senses});
}

}  // namespace kinesphere
