// Archives convert values to bytes and back, little-endian. The fields of an aggregate are archived in their
// order. A class with private fields, or with some that are not archived, lists them once, for writing and
// reading:
//
//   class Appointment {
//    public:
//     static void serialize(auto& self, auto& archive) {
//       auto& [time, partner] = self;  // names every field: one that is forgotten does not compile
//       archive(time, partner);
//     }
//
//    private:
//     double time_;
//     std::uint32_t partner_;
//   };
//
// `archive` is a ByteWriter (then `self` is const) or a ByteReader. A public struct has a free function
// serialize(self, archive) instead (fields.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "archive/aggregate.hpp"
#include "number/bit_cast.hpp"

namespace kinesphere {

namespace detail {

/// Unsigned integer type with the given size in bytes.
template <std::size_t size>
using Word =
    std::conditional_t<size == 1, std::uint8_t,
                       std::conditional_t<size == 2, std::uint16_t,
                                          std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

/// Type with which archives store a T; std::size_t has 64 bits in every archive.
template <class T>
using WordOf = Word<std::same_as<T, std::size_t> ? 8 : sizeof(T)>;

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// A container of any number of elements: vector, set, map.
template <class T>
concept Container = requires {
  typename T::allocator_type;
};

/// The type of a container's elements, so that one can be read before it is inserted.
template <class T>
struct ElementOf {
  using Type = typename T::value_type;
};
template <class T>
requires requires { typename T::mapped_type; }
struct ElementOf<T> {
  using Type = std::pair<typename T::key_type, typename T::mapped_type>;
};

/// Converts between native and little-endian byte order; its own inverse.
template <class Word>
constexpr Word little_endian(Word word) {
  if constexpr (std::endian::native == std::endian::little) return word;
  auto digits = bit_cast<std::array<std::byte, sizeof(Word)>>(word);
  std::reverse(digits.begin(), digits.end());
  return bit_cast<Word>(digits);
}

template <class T, class Archive>
void serialize_fields(T& value, Archive& archive) {
  using Class = std::remove_const_t<T>;
  if constexpr (requires { Class::serialize(value, archive); }) {
    Class::serialize(value, archive);
  } else if constexpr (requires { serialize(value, archive); }) {
    serialize(value, archive);
  } else {
    visit_fields(value, archive);
  }
}

}  // namespace detail

class ByteWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (write(values), ...);
  }

  void append(std::span<const std::byte> bytes) {
    std::copy(bytes.begin(), bytes.end(), room_for(bytes.size()));
  }
  std::span<const std::byte> bytes() const { return std::span(bytes_).first(end_); }
  std::vector<std::byte> take() {
    bytes_.resize(std::exchange(end_, 0));
    return std::exchange(bytes_, {});
  }
  /// Returns the memory in use (bytes).
  std::size_t capacity() const { return bytes_.capacity(); }
  /// Discards the bytes written, and keeps the memory for reuse.
  void clear() { end_ = 0; }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      write_word(bit_cast<detail::WordOf<T>>(value));
    } else if constexpr (detail::Number<T>) {
      write_word(static_cast<detail::WordOf<T>>(value));
    } else if constexpr (detail::Container<T>) {
      write(value.size());
      for (const auto& element : value) write(element);
    } else {
      detail::serialize_fields(value, *this);
    }
  }
  void write(const std::vector<std::byte>& bytes) {
    write(bytes.size());
    append(bytes);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class A, class B>
  void write(const std::pair<A, B>& value) {
    (*this)(value.first, value.second);
  }
  template <class T, std::size_t size>
  void write(const std::array<T, size>& values) {
    for (const T& value : values) write(value);
  }
  template <class... Ts>
  void write(const std::variant<Ts...>& value) {
    write(static_cast<std::uint8_t>(value.index()));
    std::visit([this](const auto& held) { this->write(held); }, value);
  }

  template <class Word>
  void write_word(Word word) {
    const auto digits = bit_cast<std::array<std::byte, sizeof(Word)>>(detail::little_endian(word));
    std::copy(digits.begin(), digits.end(), room_for(sizeof(Word)));
  }

  /// Returns where so many bytes are to be written, which come next.
  std::byte* room_for(std::size_t size) {
    constexpr std::size_t least_room = 64, most_room = std::size_t{1} << 20;
    if (bytes_.size() - end_ < size)
      bytes_.resize(end_ + std::max(size, std::clamp(end_, least_room, most_room)));
    return bytes_.data() + std::exchange(end_, end_ + size);
  }

  std::vector<std::byte> bytes_;  ///< with room at the end
  std::size_t end_ = 0;           ///< of what has been written
};

/// Reads untrusted bytes. A value that cannot be read sets failed(), and every later read fails too. Memory
/// is allocated only for elements that are present. Numbers are not checked for plausibility; that is up to
/// the caller.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (read(values), ...);
  }

  bool failed() const { return failed_; }
  /// Makes this reading fail, because what was read has not the form that it should have.
  void refuse() { failed_ = true; }
  std::size_t remaining() const { return bytes_.size(); }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (std::same_as<T, bool>) {
      const auto word = read_word<std::uint8_t>();
      if (word > 1) failed_ = true;
      value = word == 1;
    } else if constexpr (std::is_floating_point_v<T>) {
      value = bit_cast<T>(read_word<detail::WordOf<T>>());
    } else if constexpr (detail::Number<T>) {
      value = static_cast<T>(read_word<detail::WordOf<T>>());
    } else if constexpr (detail::Container<T>) {
      value.clear();
      for (auto count = read_word<std::uint64_t>(); count > 0 && !failed_; --count) {
        typename detail::ElementOf<T>::Type element{};
        read(element);
        if (!failed_) value.insert(value.end(), std::move(element));
      }
    } else {
      detail::serialize_fields(value, *this);
    }
  }
  void read(std::vector<std::byte>& bytes) {
    const auto size = read_word<std::uint64_t>();
    failed_ = failed_ || size > bytes_.size();
    const auto part = bytes_.first(failed_ ? 0 : static_cast<std::size_t>(size));
    bytes.assign(part.begin(), part.end());
    bytes_ = bytes_.subspan(part.size());
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool present = false;
    read(present);
    value.reset();
    if (present) read(value.emplace());
  }
  template <class A, class B>
  void read(std::pair<A, B>& value) {
    (*this)(value.first, value.second);
  }
  template <class T, std::size_t size>
  void read(std::array<T, size>& values) {
    for (T& value : values) read(value);
  }
  template <class... Ts>
  void read(std::variant<Ts...>& value) {
    const std::size_t index = read_word<std::uint8_t>();
    if (index >= sizeof...(Ts)) failed_ = true;
    const auto read_as = [&]<std::size_t... k>(std::index_sequence<k...>) {
      (void)((index == k && (read(value.template emplace<k>()), true)) || ...);
    };
    if (!failed_) read_as(std::index_sequence_for<Ts...>());
  }

  template <class Word>
  Word read_word() {
    if (failed_ || bytes_.size() < sizeof(Word)) {
      failed_ = true;
      return 0;
    }
    std::array<std::byte, sizeof(Word)> digits;
    std::copy_n(bytes_.begin(), sizeof(Word), digits.begin());
    bytes_ = bytes_.subspan(sizeof(Word));
    return detail::little_endian(bit_cast<Word>(digits));
  }

  std::span<const std::byte> bytes_;
  bool failed_ = false;
};

}  // namespace kinesphere
