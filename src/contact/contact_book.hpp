// Who touches whom, and who is within a sensor distance of whom.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/contact_event.hpp"
#include "contact/contact_rule.hpp"
#include "contact/crossings.hpp"
#include "contact/outlook.hpp"
#include "contact/partner_list.hpp"
#include "number/bit_cast.hpp"

namespace kinesphere {

class ContactBook {
 public:
  explicit ContactBook(const WorldDefinition& definition)
      : rule_(definition), sensor_rule_(rule_.with_ends()), space_(definition) {}

  /// Of contacts.
  const ContactRule& rule() const { return rule_; }
  const ContactRule& rule_of(const Threshold& threshold) const {
    return threshold.sensed ? sensor_rule_ : rule_;
  }

  /// From now on the numbers of bodies are in the tags of their ids (BodyTable).
  void find_numbers_in_tags() { numbers_in_tags_ = true; }
  std::uint32_t number_of(BodyId id) const { return numbers_in_tags_ ? id.world : id.index; }

  void reserve(std::size_t bodies) { entries_.reserve(bodies); }
  /// A body that touches nothing. `largest_acceleration` sets its Zeno interval.
  void add(std::uint32_t body, double largest_acceleration);
  void set_largest_acceleration(std::uint32_t body, double largest_acceleration) {
    entries_[body].zeno_interval = Coarse(rule_.zeno_interval(largest_acceleration));
  }

  /// A fixed body has no contacts of its own: whether one is a repeated one, its partner decides.
  void set_fixed(std::uint32_t body) {
    entries_[body].zeno_interval = Coarse();
    entries_[body].fixed = true;
  }

  // Who touches whom.
  bool touch(std::uint32_t a, std::uint32_t b) const;
  bool touches_wall(std::uint32_t body, Wall wall) const { return (walls_of(body) & wall_bit(wall)) != 0; }
  /// In the order in which the contacts began (of a fixed body in any order, after several threads have
  /// worked); good until one begins or ends with the body.
  std::span<const std::uint32_t> partners_of(std::uint32_t body) const {
    return body < partners_.size() ? partners_[body].all() : std::span<const std::uint32_t>();
  }
  /// A set of wall_bit().
  std::uint8_t walls_of(std::uint32_t body) const { return entries_[body].walls; }
  /// By partner, of each from the outermost inward; good until the next one.
  Crossings::List crossings_of(std::uint32_t body) const { return crossings_.of(body); }
  /// Those of the two, from the outermost inward. Cost: O(log of the body's), as of is_within().
  Crossings::List crossings_of(std::uint32_t a, std::uint32_t b) const {
    return entries_[a].fixed ? crossings_.of(b, a) : crossings_.of(a, b);
  }
  bool is_within(std::uint32_t a, std::uint32_t b, double distance) const {
    return crossings_.contains(a, {b, distance});
  }
  /// Of the bodies, or of the body and the wall, that the event names: their contact or a sensor distance
  /// begins or ends, and nobody is told.
  void set_touching(const Event& contact, bool touching);
  void release_all(std::uint32_t body);
  /// What the sensor_enter of the same two and the same distance told.
  Senses senses_of(const Event& leave) const;
  /// The ends of all contacts and crossings of the body, if they were to end now. `sphere(number)` gives a
  /// body as it is.
  template <class SphereNow>
  std::vector<Event> ends_of(std::uint32_t body, double time, SphereNow sphere,
                             const std::optional<Box>& box) const {
    std::vector<Event> found;
    for (const std::uint32_t partner : partners_of(body))
      found.push_back(contact_event(EventKind::contact_end, time, sphere(body), sphere(partner), space_));
    for (const Wall wall : walls)
      if (touches_wall(body, wall))
        found.push_back(wall_event(EventKind::wall_end, time, sphere(body), *box, wall));
    for (const Crossing& crossing : crossings_of(body)) {
      found.push_back(
          contact_event(EventKind::sensor_leave, time, sphere(body), sphere(crossing.partner), space_));
      found.back().distance = crossing.distance;
      found.back().senses = crossing.senses;
    }
    return found;
  }

  // Contacts that begin.
  /// Brings the event up to date with the two as they are now.
  void describe_now(Event& event, const Sphere& first, const Sphere& second,
                    const std::optional<Box>& box) const;
  bool still_begins(const Event& now, const Sphere& first, const Sphere& second) const;
  /// Whether a contact that could begin now has to wait for time to move on: each of the two has had so many
  /// at this instant that the caller's answers will not part them.
  bool is_jammed(const Event& current) const { return contacts_now(current) >= most_at_one_instant; }
  /// Marks the begin of a contact if it is a repeated or a jammed one, and remembers it for the next.
  void note_contact(Event& begin);

  /// Of a body that has come from elsewhere: it touches these, and is within these distances of others, and
  /// all of them are told.
  void set_links(std::uint32_t body, std::span<const std::uint32_t> partners,
                 std::vector<Crossing> crossings);
  // Several threads may change the contacts of different bodies at the same time, between these two calls.
  // The lists of fixed bodies, which all may touch, stay as they are.
  void start_side_by_side(bool with_sensors);
  void stop_side_by_side() { fixed_wait_ = false; }
  /// What is kept of a body, to be put back as it was.
  struct Kept;
  Kept keep(std::uint32_t body) const;
  void put_back(std::uint32_t body, const Kept& kept);
  /// The same but for whom it touches and senses.
  void put_back_alone(std::uint32_t body, const Kept& kept);
  /// Brings the lists of fixed bodies up to date with what has changed about this one.
  void tell_fixed(std::uint32_t body, const Kept& before);

  /// All but the rules and the space, which follow from the world's definition.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [rule, sensor_rule, space, entries, partners, crossings, wait, in_tags] = self;
    archive(entries, partners, crossings);
  }
  /// For one that was read in a world of this many bodies: true when contacts are mutual. `box` has the walls
  /// that stand.
  bool is_sound(std::size_t bodies, const std::optional<Box>& box) const;

 private:
  /// A number rounded to 20 bits after the first: of an interval that only marks events no more is needed.
  class Coarse {
   public:
    Coarse() = default;
    explicit Coarse(double value)
        : upper_half_(static_cast<std::uint32_t>(bit_cast<std::uint64_t>(value) >> 32)) {}
    double value() const { return bit_cast<double>(std::uint64_t{upper_half_} << 32); }

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      archive(self.upper_half_);
    }

   private:
    std::uint32_t upper_half_ = 0;
  };

  struct Entry {
    double last_contact = -std::numeric_limits<double>::infinity();
    Coarse zeno_interval;
    std::uint16_t contacts_then = 0;  ///< at the time of the last one, most_at_one_instant at most
    std::uint8_t walls = 0;
    bool fixed = false;

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [last, interval, count_then, touched_walls, is_fixed] = self;
      archive(last, interval, count_then, touched_walls, is_fixed);
    }
  };

  void set_half(std::uint32_t body, std::uint32_t partner, const Event& contact, bool touching);
  bool contacts_are_sound(const std::optional<Box>& box) const;
  bool is_repeated(const Event& begin, std::uint32_t body) const;
  std::uint32_t contacts_now(const Event& contact) const;
  void note_contact(std::uint32_t body, double time);

  /// A chain of touching bodies passes a push on in some contacts each; these are far more.
  static constexpr std::uint32_t many_at_one_instant = 64;
  static constexpr std::uint32_t most_at_one_instant = 256;

  ContactRule rule_;
  ContactRule sensor_rule_;
  Space space_;
  std::vector<Entry> entries_;
  std::vector<PartnerList> partners_;  ///< of all bodies up to the last one that ever had one
  Crossings crossings_;
  bool fixed_wait_ = false;  ///< the lists of fixed bodies are brought up to date later
  bool numbers_in_tags_ = false;
};

struct ContactBook::Kept {
  Entry entry;
  PartnerList partners;
  std::vector<Crossing> crossings;

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [last, touched, sensed] = self;
    archive(last, touched, sensed);
  }
};

}  // namespace kinesphere
