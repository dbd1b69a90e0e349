// Contact rate of each body: which contacts are repeated, and which are jammed at one time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "contact/contact_rule.hpp"
#include "number/bit_cast.hpp"

namespace kinesphere {

/// Counts the contacts of each body. Callers pass only the bodies that count a contact (not static ones).
class ContactRate {
  /// The upper bits of a double, truncated towards zero: 20 fraction bits in 4 bytes, or 4 in 2. Trades
  /// precision for memory per body; sufficient for values that only mark events.
  template <class Bits>
  class TruncatedDouble {
   public:
    TruncatedDouble() = default;
    explicit TruncatedDouble(double value)
        : upper_(static_cast<Bits>(bit_cast<std::uint64_t>(value) >> dropped)) {}
    double value() const { return bit_cast<double>(std::uint64_t{upper_} << dropped); }

    static void serialize(auto& self, auto& archive) { archive(self.upper_); }

   private:
    static constexpr int dropped = 64 - std::numeric_limits<Bits>::digits;
    Bits upper_ = 0;
  };

 public:
  /// Rate of one body.
  struct Body {
    double last_contact = -std::numeric_limits<double>::infinity();
    TruncatedDouble<std::uint32_t> zeno_interval;
    /// Acceleration that pressed the body upon its partner at last_contact (length / time^2).
    TruncatedDouble<std::uint16_t> pressure;
    /// Contacts at time last_contact beyond the first. Saturates at the limit of is_jammed().
    std::uint8_t further_contacts = 0;
    /// Instants in a row before last_contact with as many contacts as that limit. Saturates at the limit of
    /// is_crushed().
    std::uint8_t full_instants = 0;
  };
  static_assert(sizeof(Body) == 16);
  /// The begin of a contact.
  struct Begin {
    double time = 0.0;
    double approach_speed = 0.0;  ///< length / time
    double acceleration = 0.0;    ///< ContactTerms::acceleration
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

  /// Counts a contact that begins between these bodies, and returns its marks. It is repeated if it follows
  /// the last contact of a body within the least Zeno interval of the rule. It is also repeated if something
  /// presses the two upon each other, and it follows within the interval of the body, below the Zeno speed of
  /// that acceleration or at the very instant. What presses them is their own relative acceleration or that
  /// of the contact that they follow: so the ground carries all of a stack, and bodies that fall together
  /// press nothing.
  Marks note(std::span<const std::uint32_t> bodies, const Begin& begin, const ContactRule& rule);
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
  static void count(Body& body, double time);
  std::uint32_t contacts_now(std::span<const std::uint32_t> bodies, double time) const;

  std::vector<Body> bodies_;
};

}  // namespace kinesphere
