// Contact graph: pairs of bodies in contact, bodies in contact with walls, and pairs within a sensor
// distance.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "contact/contact_event.hpp"
#include "contact/contact_predictor.hpp"
#include "contact/contact_rate.hpp"
#include "contact/contact_rule.hpp"
#include "contact/overlap_records.hpp"
#include "contact/pair_notes.hpp"
#include "contact/partner_list.hpp"

namespace kinesphere {

/// Returns the threshold of the contact of two bodies, of which these events are asked for. `state`: nullptr
/// if they do not touch.
inline Threshold contact_threshold(const ContactState* state, ContactEvents wanted) {
  return {.within = state != nullptr, .wanted = wanted, .state = state != nullptr ? *state : ContactState{}};
}

/// What links two bodies: that they touch, sense each other, or have been turned back at a sensor distance.
struct PairLinks {
  const ContactState* contact;    ///< nullptr if they do not touch
  OverlapRecords::List overlaps;  ///< by falling distance
  double turned_at;               ///< PairNote::turned_at

  bool any() const { return contact != nullptr || !overlaps.empty() || turned_at >= 0.0; }
};

class ContactGraph {
 public:
  explicit ContactGraph(const WorldDefinition& definition) : rule_(definition), space_(definition) {}

  const ContactRule& rule() const { return rule_; }
  const Space& space() const { return space_; }

  /// Switches number_of() to the tags of ids (BodyTable): body numbers are read from BodyId::world from now
  /// on.
  void find_numbers_in_tags() { numbers_in_tags_ = true; }
  std::uint32_t number_of(BodyId id) const { return numbers_in_tags_ ? id.world : id.index; }

  void reserve(std::size_t bodies) {
    flags_.reserve(bodies);
    rate_.reserve(bodies);
  }
  /// Adds a body without contacts. `largest_acceleration` (length / time^2) determines its Zeno interval.
  void add(std::uint32_t body, double largest_acceleration);
  void set_largest_acceleration(std::uint32_t body, double largest_acceleration) {
    rate_.set_zeno_interval(body, rule_.zeno_interval(largest_acceleration));
  }
  /// Marks a body as one with a shape. Only its partners count contacts with it, because many bodies may
  /// touch it at one time.
  void set_shape(std::uint32_t body, bool is_static) {
    flags_[body].form = is_static ? Form::shape_at_rest : Form::carried_shape;
  }

  /// Returns true if set_shape() has been called with these facts, or never for a ball. Call after reading.
  bool has_form_of(std::uint32_t body, bool has_shape, bool is_static) const {
    return flags_[body].form == (is_static   ? Form::shape_at_rest
                                 : has_shape ? Form::carried_shape
                                             : Form::ball);
  }

  // Existing contacts and overlaps.

  bool touch(std::uint32_t a, std::uint32_t b) const { return contact_of(a, b) != nullptr; }
  bool touches_wall(std::uint32_t body, Wall wall) const { return (walls_of(body) & wall_bit(wall)) != 0; }
  /// Returns the partners of a body in the order in which the contacts began. The list of a static body
  /// says nothing of states. Invalidated when a contact of
  /// the body begins, ends or changes.
  std::span<const ContactRecord> partners_of(std::uint32_t body) const {
    return body < partners_.size() ? partners_[body].all() : std::span<const ContactRecord>();
  }
  /// Returns the threshold of a contact between a body and a wall.
  Threshold wall_threshold(std::uint32_t body, Wall wall, ContactEvents wanted) const {
    return {.within = touches_wall(body, wall), .wanted = wanted, .state = wall_state(body, wall)};
  }
  /// Returns the threshold of the contact that the event names.
  Threshold threshold_of(const Event& contact, ContactEvents wanted) const {
    const std::uint32_t first = number_of(contact.first);
    if (contact.wall != Wall::none) return wall_threshold(first, contact.wall, wanted);
    return contact_threshold(contact_of(first, number_of(contact.second)), wanted);
  }
  /// Returns a set of wall_bit() values.
  std::uint8_t walls_of(std::uint32_t body) const { return flags_[body].walls; }
  /// Returns the overlaps of a body, sorted by partner and then by falling distance. Invalidated by any
  /// change of an overlap.
  OverlapRecords::List overlaps_of(std::uint32_t body) const { return overlaps_.of(body); }
  /// Returns the overlaps of one pair, by falling distance. Cost: O(log n) for n overlaps of the body
  /// searched.
  OverlapRecords::List overlaps_of(std::uint32_t a, std::uint32_t b) const {
    return flags_[a].is_static() ? overlaps_.of(b, a) : overlaps_.of(a, b);
  }
  /// Returns what links two bodies, valid until that changes. Cost: that of overlaps_of(a, b).
  PairLinks links_of(std::uint32_t a, std::uint32_t b) const {
    return {contact_of(a, b), overlaps_of(a, b), pairs_.between(a, b).turned_at};
  }
  /// Returns what is remembered of pairs beside.
  const PairNotes& pairs() const { return pairs_; }
  PairNotes& pairs() { return pairs_; }
  /// Begins or ends the contact or overlap that the event names, between two bodies or a body and a wall. No
  /// event is queued.
  void set_touching(const Event& contact, bool touching);
  /// The two of this crossing of a sensor distance, which has taken effect, have been turned back: they are
  /// as if they had not crossed it.
  void turn_back(const Event& crossing);
  /// Sets the state of the contact that the event names. The contact begins if it does not exist.
  void set_state(const Event& contact, const ContactState& state);
  /// Marks all reported approaches of a body as turned, because the caller has given it another velocity,
  /// place or shape.
  void turn_reported(std::uint32_t body) {
    if (touches_any(body)) turn_approaches(body);
  }
  bool touches_any(std::uint32_t body) const { return flags_[body].walls != 0 || !partners_of(body).empty(); }

  // Begins of contacts.

  /// True if a contact that could begin now must be deferred to a later time: each of its counting bodies has
  /// reached the limit of contacts at one time, so the caller's responses will not separate them.
  bool is_jammed(const Event& current) const;
  /// Marks the begin of a contact as repeated or jammed, and counts it for later marks. `acceleration`: see
  /// ContactTerms.
  void note_contact(Event& begin, double acceleration);
  struct Jam {
    /// True if the two are let through from now on until they have separated.
    bool is_last;
    /// True if the caller must be notified: of the last jam, or of an overlap.
    bool is_news;
  };
  /// Counts a jam of the contact. It can be the last one only if responses have returned speed at events
  /// marked as jammed, or one of the two is crushed. `is_deep`: the two may overlap by more than the
  /// tolerance before they are checked again.
  Jam note_jam(const Event& current, const Threshold& threshold, bool is_deep);

  /// Replaces all contacts and overlaps of a body that has arrived from elsewhere. The lists of its former
  /// and new partners are updated too.
  void set_links(std::uint32_t body, std::span<const ContactRecord> partners,
                 std::vector<OverlapRecord> overlaps);

  /// Serializes everything except the rules and the space, which follow from the world's definition.
  static void serialize(auto& self, auto& archive) {
    auto& [rule, space, recent, flags, partners, overlaps, pairs, in_tags] = self;
    archive(recent, flags, partners, overlaps, pairs);
  }
  /// Validates a graph that was read from bytes, for a world of `bodies` bodies: contacts must be mutual,
  /// unique and not with the body itself. `box` holds the existing walls, as from walls_of().
  bool is_valid(std::size_t bodies, const std::optional<Box>& box) const;

 private:
  friend struct ContactsOfBody;

  enum class Form : std::uint8_t { ball, carried_shape, shape_at_rest };
  /// Per-body data other than lists.
  struct Flags {
    std::uint8_t walls = 0;  ///< walls in touch
    Form form = Form::ball;
    std::uint8_t wall_guards = 0;       ///< walls with ContactState::guard_reported
    std::uint8_t wall_jams = 0;         ///< ContactState::jams, of all walls together
    std::uint16_t wall_approaches = 0;  ///< two bits for each wall: ApproachState

    bool is_static() const { return form == Form::shape_at_rest; }
  };

  /// Returns the state of a contact, or nullptr if the two do not touch. The list of a static body has no
  /// states.
  const ContactState* contact_of(std::uint32_t a, std::uint32_t b) const {
    if (flags_[a].is_static()) std::swap(a, b);
    return a < partners_.size() ? partners_[a].find(b) : nullptr;
  }
  void turn_approaches(std::uint32_t body);
  ContactState wall_state(std::uint32_t body, Wall wall) const;
  void set_wall_state(std::uint32_t body, Wall wall, bool touching, const ContactState& state);
  void set_half(std::uint32_t body, std::uint32_t partner, const ContactState* state);
  void set_overlap(std::uint32_t body, std::uint32_t partner, const Event& overlap, bool within);
  bool contacts_are_valid(const std::optional<Box>& box) const;
  std::span<const std::uint32_t> counting(const Event& contact, std::array<std::uint32_t, 2>& buffer) const;

  ContactRule rule_;
  Space space_;
  ContactRate rate_;
  std::vector<Flags> flags_;
  std::vector<PartnerList> partners_;  ///< by body, up to the last body that ever had a partner
  OverlapRecords overlaps_;
  PairNotes pairs_;
  bool numbers_in_tags_ = false;
};

}  // namespace kinesphere
