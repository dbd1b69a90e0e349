// How soon contacts of a body follow each other: which are repeated, and which jam at one instant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "number/bit_cast.hpp"

namespace kinesphere {

/// Counts the contacts of each body. Of a contact those bodies are given that count it.
class ContactRate {
  /// A number rounded to 20 bits after the first: of an interval that only marks events no more is needed.
  class TruncatedDouble {
   public:
    TruncatedDouble() = default;
    explicit TruncatedDouble(double value)
        : upper_half_(static_cast<std::uint32_t>(bit_cast<std::uint64_t>(value) >> 32)) {}
    double value() const { return bit_cast<double>(std::uint64_t{upper_half_} << 32); }

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      archive(self.upper_half_);
    }

   private:
    std::uint32_t upper_half_ = 0;
  };

 public:
  /// What is known of a body.
  struct Body {
    double last_contact = -std::numeric_limits<double>::infinity();
    TruncatedDouble zeno_interval;
    std::uint16_t contacts_then = 0;  ///< at the time of the last one; counted no further than is_jammed()

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [last, interval, count_then] = self;
      archive(last, interval, count_then);
    }
  };
  /// What the begin of a contact is to be marked with.
  struct Marks {
    bool repeated;
    bool jammed;
  };

  std::size_t size() const { return bodies_.size(); }
  void reserve(std::size_t bodies) { bodies_.reserve(bodies); }
  /// A body that has not touched anything yet.
  void add(std::uint32_t body, double zeno_interval);
  /// A contact that begins less than this (time) after the body's last one is a repeated one.
  void set_zeno_interval(std::uint32_t body, double zeno_interval);
  const Body& of(std::uint32_t body) const { return bodies_[body]; }
  void restore(std::uint32_t body, const Body& checkpoint) { bodies_[body] = checkpoint; }

  /// A contact of these begins.
  Marks note(std::span<const std::uint32_t> bodies, double time);
  /// Each of these has had so many contacts at this instant that the caller's answers will not part them.
  bool is_jammed(std::span<const std::uint32_t> bodies, double time) const;

  /// For one that was read.
  bool is_valid() const;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    archive(self.bodies_);
  }

 private:
  std::uint32_t contacts_now(std::span<const std::uint32_t> bodies, double time) const;

  std::vector<Body> bodies_;
};

}  // namespace kinesphere
