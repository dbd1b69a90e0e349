// Contact rate of each body: which contacts are repeated, and which are jammed at one time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "number/bit_cast.hpp"

namespace kinesphere {

/// Counts the contacts of each body. Callers pass only the bodies that count a contact (not static ones).
class ContactRate {
  /// The upper half of a double: truncated towards zero to 20 fraction bits. Trades precision for 4 bytes per
  /// body; sufficient for an interval that only marks events.
  class TruncatedDouble {
   public:
    TruncatedDouble() = default;
    explicit TruncatedDouble(double value)
        : upper_half_(static_cast<std::uint32_t>(bit_cast<std::uint64_t>(value) >> 32)) {}
    double value() const { return bit_cast<double>(std::uint64_t{upper_half_} << 32); }

    static void serialize(auto& self, auto& archive) { archive(self.upper_half_); }

   private:
    std::uint32_t upper_half_ = 0;
  };

 public:
  /// Rate of one body.
  struct Body {
    double last_contact = -std::numeric_limits<double>::infinity();
    TruncatedDouble zeno_interval;
    /// Contacts at time last_contact. Saturates at the limit of is_jammed().
    std::uint16_t contacts_then = 0;
    /// Instants in a row before last_contact with as many contacts as that limit. Saturates at the limit of
    /// is_crushed().
    std::uint16_t full_instants = 0;
  };
  /// Marks for the begin of a contact.
  struct Marks {
    bool repeated;
    bool jammed;
  };

  std::size_t size() const { return bodies_.size(); }
  void reserve(std::size_t bodies) { bodies_.reserve(bodies); }
  /// Adds or resets a body, which has had no contact yet.
  void add(std::uint32_t body, double zeno_interval);
  /// Sets the interval (time) within which a contact counts as repeated after the body's previous one.
  void set_zeno_interval(std::uint32_t body, double zeno_interval);
  const Body& of(std::uint32_t body) const { return bodies_[body]; }
  void restore(std::uint32_t body, const Body& checkpoint) { bodies_[body] = checkpoint; }

  /// Counts a contact that begins between these bodies, and returns its marks.
  Marks note(std::span<const std::uint32_t> bodies, double time);
  /// True if each of these bodies has reached the limit of contacts at `time`, so that the caller's responses
  /// will not separate them.
  bool is_jammed(std::span<const std::uint32_t> bodies, double time) const;

  /// True if each of these bodies has reached that limit at so many instants in a row that it counts as
  /// crushed: no velocity separates it from all that drives onto it.
  bool is_crushed(std::span<const std::uint32_t> bodies) const;
  /// Counts these instants anew.
  void end_crush(std::span<const std::uint32_t> bodies);

  /// Validates values read from bytes.
  bool is_valid() const;
  static void serialize(auto& self, auto& archive) { archive(self.bodies_); }

 private:
  std::uint32_t contacts_now(std::span<const std::uint32_t> bodies, double time) const;

  std::vector<Body> bodies_;
};

}  // namespace kinesphere
