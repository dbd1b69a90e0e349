// An archive (archive.hpp) that only counts the heap memory behind a value: what it has requested from the
// allocator.
#pragma once

#include <cstddef>
#include <type_traits>

#include "archive/archive.hpp"

namespace kinesphere {

class HeapCounter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (count(values), ...);
  }
  std::size_t bytes() const { return bytes_; }
  /// Counts bytes that no container shows.
  void add(std::size_t bytes) { bytes_ += bytes; }

 private:
  /// Bytes that allocators usually add to each block.
  static constexpr std::size_t block_overhead = 16;
  static constexpr std::size_t node_overhead = 4 * sizeof(void*);

  template <class T>
  void count(const T& value) {
    if constexpr (detail::Container<T>) {
      count_block(value);
      count_all(value);
    } else if constexpr (!std::is_trivially_copyable_v<T>) {
      detail::serialize_fields(value, *this);
    }
  }
  template <class T>
  void count(const std::optional<T>& value) {
    if (value) count(*value);
  }
  template <class... Ts>
  void count(const std::variant<Ts...>& value) {
    std::visit([this](const auto& held) { this->count(held); }, value);
  }
  template <class A, class B>
  void count(const std::pair<A, B>& value) {
    (*this)(value.first, value.second);
  }
  template <class T, std::size_t size>
  void count(const std::array<T, size>& values) {
    count_all(values);
  }

  /// Counts what a container itself takes: one block of all elements, or a node for each.
  template <class Values>
  void count_block(const Values& values) {
    if constexpr (!requires { values.capacity(); })
      bytes_ += values.size() * (sizeof(typename Values::value_type) + node_overhead + block_overhead);
    else if (values.capacity() > 0)
      bytes_ += values.capacity() * sizeof(typename Values::value_type) + block_overhead;
  }
  template <class Values>
  void count_all(const Values& values) {
    if constexpr (!std::is_trivially_copyable_v<typename Values::value_type>)
      for (const auto& value : values) count(value);
  }

  std::size_t bytes_ = 0;
};

/// Returns the estimated heap memory of all values together, in bytes.
template <class... Values>
std::size_t heap_bytes(const Values&... values) {
  HeapCounter counter;
  counter(values...);
  return counter.bytes();
}

}  // namespace kinesphere
