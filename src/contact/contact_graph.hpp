// Who touches whom, and who is within a sensor distance of whom.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/contact_event.hpp"
#include "contact/contact_predictor.hpp"
#include "contact/contact_rate.hpp"
#include "contact/contact_rule.hpp"
#include "contact/overlap_records.hpp"
#include "contact/partner_list.hpp"

namespace kinesphere {

class ContactGraph {
 public:
  explicit ContactGraph(const WorldDefinition& definition)
      : rule_(definition), sensor_rule_(rule_.with_ends()), space_(definition) {}

  /// Of contacts.
  const ContactRule& rule() const { return rule_; }
  const ContactRule& rule_of(const Threshold& threshold) const {
    return threshold.sensed ? sensor_rule_ : rule_;
  }
  const Space& space() const { return space_; }

  /// From now on the numbers of bodies are in the tags of their ids (BodyTable).
  void find_numbers_in_tags() { numbers_in_tags_ = true; }
  std::uint32_t number_of(BodyId id) const { return numbers_in_tags_ ? id.world : id.index; }

  void reserve(std::size_t bodies) {
    flags_.reserve(bodies);
    rate_.reserve(bodies);
  }
  /// A body that touches nothing. `largest_acceleration` sets its Zeno interval.
  void add(std::uint32_t body, double largest_acceleration);
  void set_largest_acceleration(std::uint32_t body, double largest_acceleration) {
    rate_.set_zeno_interval(body, rule_.zeno_interval(largest_acceleration));
  }
  /// Of a fixed body only the others count contacts: many may touch it at once.
  void set_static(std::uint32_t body) { flags_[body].is_static = true; }

  // Who touches whom.

  bool touch(std::uint32_t a, std::uint32_t b) const;
  bool touches_wall(std::uint32_t body, Wall wall) const { return (walls_of(body) & wall_bit(wall)) != 0; }
  /// In the order in which the contacts began (of a fixed body in any order, after several threads have
  /// worked); good until one begins or ends with the body.
  std::span<const std::uint32_t> partners_of(std::uint32_t body) const {
    return body < partners_.size() ? partners_[body].all() : std::span<const std::uint32_t>();
  }
  /// A set of wall_bit().
  std::uint8_t walls_of(std::uint32_t body) const { return flags_[body].walls; }
  /// By partner, of each from the outermost inward; good until the next one.
  OverlapRecords::List overlaps_of(std::uint32_t body) const { return overlaps_.of(body); }
  /// Those of the two, from the outermost inward. Cost: O(log of the body's).
  OverlapRecords::List overlaps_of(std::uint32_t a, std::uint32_t b) const {
    return flags_[a].is_static ? overlaps_.of(b, a) : overlaps_.of(a, b);
  }
  /// Of the bodies, or of the body and the wall, that the event names: their contact or a sensor distance
  /// begins or ends, and nobody is told.
  void set_touching(const Event& contact, bool touching);
  void release_all(std::uint32_t body);

  // Contacts that begin.

  /// Whether a contact that could begin now has to wait for time to move on: each of the two has had so many
  /// at this instant that the caller's answers will not part them.
  bool is_jammed(const Event& current) const;
  /// Marks the begin of a contact if it is a repeated or a jammed one, and remembers it for the next.
  void note_contact(Event& begin);

  /// Of a body that has come from elsewhere: it touches these, and is within these distances of others, and
  /// all of them are told.
  void set_links(std::uint32_t body, std::span<const std::uint32_t> partners,
                 std::vector<OverlapRecord> overlaps);

  // Several threads may change the contacts of different bodies at the same time, between these two calls.
  // The lists of fixed bodies, which all may touch, stay as they are (ContactCheckpoint::update_static).

  void start_side_by_side(bool with_sensors);
  void stop_side_by_side() { fixed_wait_ = false; }

  /// All but the rules and the space, which follow from the world's definition.
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [rule, sensor_rule, space, recent, flags, partners, crossings, wait, in_tags] = self;
    archive(recent, flags, partners, crossings);
  }
  /// For one that was read in a world of this many bodies: true when contacts are mutual. `box` has the walls
  /// that stand.
  bool is_valid(std::size_t bodies, const std::optional<Box>& box) const;

 private:
  friend struct ContactCheckpoint;

  /// What is known of a body beside its lists.
  struct Flags {
    std::uint8_t walls = 0;
    bool is_static = false;

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [touched_walls, is_fixed] = self;
      archive(touched_walls, is_fixed);
    }
  };

  void set_half(std::uint32_t body, std::uint32_t partner, const Event& contact, bool touching);
  bool contacts_are_valid(const std::optional<Box>& box) const;
  std::span<const std::uint32_t> counting(const Event& contact, std::array<std::uint32_t, 2>& margin) const;

  ContactRule rule_;
  ContactRule sensor_rule_;
  Space space_;
  ContactRate rate_;
  std::vector<Flags> flags_;
  std::vector<PartnerList> partners_;  ///< of all bodies up to the last one that ever had one
  OverlapRecords overlaps_;
  bool fixed_wait_ = false;  ///< the lists of fixed bodies are brought up to date later
  bool numbers_in_tags_ = false;
};

}  // namespace kinesphere
