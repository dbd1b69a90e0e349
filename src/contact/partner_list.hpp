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

namespace kinesphere {

class HeapCounter;

/// Numbers in insertion order, in an object of 16 bytes. Up to two are stored inline; more are on the heap.
/// Thread safety: different lists may be changed concurrently.
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

  /// Returns all values. Invalidated when the list changes.
  std::span<const std::uint32_t> all() const { return {data(), size_}; }
  void add(std::uint32_t value) {
    if (size_ == capacity_) grow();
    data()[size_++] = value;
  }
  /// Removes every occurrence of `value`.
  void erase(std::uint32_t value) {
    size_ = static_cast<std::uint32_t>(std::remove(data(), data() + size_, value) - data());
  }
  void clear() { size_ = 0; }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    if constexpr (std::same_as<Archive, HeapCounter>) {
      archive(std::vector<std::uint32_t>(self.is_outside() ? self.capacity_ : 0));
    } else {
      std::vector<std::uint32_t> values(self.all().begin(), self.all().end());
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
    std::uint32_t inside[2];
    std::uint32_t* outside;
  };

  bool is_outside() const { return capacity_ > inside; }
  const std::uint32_t* data() const { return is_outside() ? values_.outside : values_.inside; }
  std::uint32_t* data() { return is_outside() ? values_.outside : values_.inside; }
  void assign(std::span<const std::uint32_t> values) {
    for (const std::uint32_t value : values) add(value);
  }
  void grow() {
    auto* const larger = new std::uint32_t[2 * std::size_t{capacity_}];
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
