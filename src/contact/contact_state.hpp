// State of an existing contact: whether the next approach of its two partners is an event.
#pragma once

#include <cstdint>

namespace kinesphere {

/// What an approach of two partners in touch means.
enum class ApproachState : std::uint8_t {
  /// The partners do not approach, as far as is known. Their next approach is an event.
  watched,
  /// The present approach has been reported. The partners may pass through each other.
  reported,
  /// As `reported`, but the caller has changed one of the two since: fresh reports decide whether they still
  /// approach.
  turned,
  /// No approach is an event until the partners have separated: responses do not part them
  /// (ContactGraph::note_jam()).
  ignored,
};

/// State of a contact between two bodies, or between a body and a wall.
struct ContactState {
  ApproachState approach = ApproachState::watched;
  /// One more than the number of times that the contact was jammed since a response returned speed at an
  /// event marked as jammed (Event::jammed); 0 if none has.
  std::uint8_t jams = 0;
  /// True if the Zeno guard has reported that the two may overlap by more than the tolerance.
  bool guard_reported = false;

  /// True if there is something to remember until the two have separated, beside the approach.
  bool has_history() const { return jams > 0 || guard_reported; }
  bool is_valid() const { return approach <= ApproachState::ignored; }
  friend bool operator==(const ContactState&, const ContactState&) = default;
};

/// A partner in contact, and the state of that contact.
struct ContactRecord {
  std::uint32_t partner;
  ContactState state{};
  friend bool operator==(const ContactRecord&, const ContactRecord&) = default;
};

}  // namespace kinesphere
