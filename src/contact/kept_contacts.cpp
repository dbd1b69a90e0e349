#include "contact/kept_contacts.hpp"

#include <algorithm>

namespace kinesphere {
namespace {

/// Those of one list that are not in another.
template <class List, class Other>
auto missing(const List& from, const Other& in) {
  auto found = std::vector(from.begin(), from.end());
  std::erase_if(found, [&](const auto& one) { return std::find(in.begin(), in.end(), one) != in.end(); });
  return found;
}

}  // namespace

KeptContacts KeptContacts::of(const ContactBook& book, std::uint32_t body) {
  const Crossings::List crossed = book.crossings_of(body);
  return {book.recent_.of(body),
          book.flags_[body],
          body < book.partners_.size() ? book.partners_[body] : PartnerList(),
          {crossed.begin(), crossed.end()}};
}

void KeptContacts::put_back(ContactBook& book, std::uint32_t body) const {
  put_back_alone(book, body);
  if (body < book.partners_.size()) book.partners_[body] = partners;
  book.crossings_.set(body, crossings);
}

void KeptContacts::put_back_alone(ContactBook& book, std::uint32_t body) const {
  book.recent_.put_back(body, recent);
  book.flags_[body] = flags;
}

void KeptContacts::tell_fixed(ContactBook& book, std::uint32_t body) const {
  const auto is_fixed = [&book](std::uint32_t other) { return book.flags_[other].fixed; };
  for (const std::uint32_t gone : missing(partners.all(), book.partners_of(body)))
    if (is_fixed(gone)) book.partners_[gone].erase(body);
  for (const std::uint32_t come : missing(book.partners_of(body), partners.all()))
    if (is_fixed(come)) book.partners_[come].add(body);
  for (const Crossing& gone : missing(crossings, book.crossings_of(body)))
    if (is_fixed(gone.partner)) book.crossings_.erase(gone.partner, {body, gone.distance, gone.senses});
  for (const Crossing& come : missing(book.crossings_of(body), crossings))
    if (is_fixed(come.partner)) book.crossings_.add(come.partner, {body, come.distance, come.senses});
}

}  // namespace kinesphere
