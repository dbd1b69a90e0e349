// The contacts of a body as they were, for threads that work side by side and may have to go back.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_book.hpp"

namespace kinesphere {

/// All that a book knows of one body.
struct KeptContacts {
  RecentContacts::Body recent{};
  ContactBook::Flags flags{};
  PartnerList partners{};
  std::vector<Crossing> crossings{};

  static KeptContacts of(const ContactBook& book, std::uint32_t body);
  /// As it was; the lists of its partners stay as they are.
  void put_back(ContactBook& book, std::uint32_t body) const;
  /// The same but for whom it touches and senses.
  void put_back_alone(ContactBook& book, std::uint32_t body) const;
  /// Brings the lists of fixed bodies, which stay as they are while threads work side by side, up to date
  /// with what has changed about this one.
  void tell_fixed(ContactBook& book, std::uint32_t body) const;

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [last, marks, touched, sensed] = self;
    archive(last, marks, touched, sensed);
  }
};

}  // namespace kinesphere
