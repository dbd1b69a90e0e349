// Contact partners of one body: usually none, one or two.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "contact/contact_state.hpp"

namespace kinesphere {

class HeapCounter;

/// Partners in the order in which they were added, in an object of 24 bytes. Up to two are stored inline;
/// more are on the heap. Thread safety: different lists may be changed concurrently.
class PartnerList {
 public:
  PartnerList() = default;
  PartnerList(const PartnerList& other) { assign(other.all()); }
  PartnerList(PartnerList&& other) noexcept
      : size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, inside)),
        values_(other.values_) {}
  PartnerList& operator=(PartnerList other) noexcept {
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    std::swap(values_, other.values_);
    return *this;
  }
  ~PartnerList() {
    if (is_outside()) delete[] values_.outside;
  }

  /// Returns all records. Invalidated when the list changes.
  std::span<const ContactRecord> all() const { return {data(), size_}; }
  std::span<ContactRecord> all() { return {data(), size_}; }
  /// Returns the state of the contact with this partner, or nullptr if there is none.
  const ContactState* find(std::uint32_t partner) const {
    for (const ContactRecord& record : all())
      if (record.partner == partner) return &record.state;
    return nullptr;
  }
  /// Sets the state of the contact with this partner, which is added if there is none.
  void set(const ContactRecord& contact) {
    for (ContactRecord& record : all())
      if (record.partner == contact.partner) {
        record = contact;
        return;
      }
    if (size_ == capacity_) grow();
    data()[size_++] = contact;
  }
  void erase(std::uint32_t partner) {
    const auto is_gone = [=](const ContactRecord& record) { return record.partner == partner; };
    size_ = static_cast<std::uint32_t>(std::remove_if(data(), data() + size_, is_gone) - data());
  }
  void clear() { size_ = 0; }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    if constexpr (std::same_as<Archive, HeapCounter>) {
      archive(std::vector<ContactRecord>(self.is_outside() ? self.capacity_ : 0));
    } else {
      const std::span<const ContactRecord> present = std::as_const(self).all();
      std::vector<ContactRecord> values(present.begin(), present.end());
      archive(values);
      if constexpr (!std::is_const_v<Self>) {
        self.clear();
        self.assign(values);
      }
    }
  }

 private:
  static constexpr std::uint32_t inside = 2;
  union Values {
    ContactRecord inside[2] = {};
    ContactRecord* outside;
  };

  bool is_outside() const { return capacity_ > inside; }
  const ContactRecord* data() const { return is_outside() ? values_.outside : values_.inside; }
  ContactRecord* data() { return is_outside() ? values_.outside : values_.inside; }
  void assign(std::span<const ContactRecord> values) {
    for (const ContactRecord& value : values) set(value);
  }
  void grow() {
    auto* const larger = new ContactRecord[2 * std::size_t{capacity_}];
    std::copy(data(), data() + size_, larger);
    if (is_outside()) delete[] values_.outside;
    values_.outside = larger;
    capacity_ *= 2;
  }

  std::uint32_t size_ = 0;
  std::uint32_t capacity_ = inside;
  Values values_{};
};

}  // namespace kinesphere
