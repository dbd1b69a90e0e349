// Which contact events a body asks for.
#pragma once

#include <cstdint>

namespace kinesphere {

/// Which contact events a body asks for (BodyDefinition::contacts, WorldDefinition::contacts). Two bodies
/// report what either asks for. Walls and static bodies ask for nothing themselves.
enum class ContactEvents : std::uint8_t {
  /// A begin whenever the two touch and approach, and no ends: the least, for bodies that only bounce. Two
  /// that touch without an approach have no event. But two that a change of the caller has put into each
  /// other by more than the contact tolerance, as a body that is added at rest inside another, have one begin
  /// at once, although no bounce could part them. WorldDefinition::allow_overlap = false refuses it.
  impacts = 1,
  /// One begin and one end for each contact, for bodies whose contacts are watched and seldom answered. There
  /// is another begin (Event::already_touching) only for the first approach of two that did not approach when
  /// their contact began, or that a response has parted since.
  begin_and_end = 2,
  /// A begin and an end for each contact, and a begin for each further approach in between
  /// (Event::already_touching).
  all = 3,
};
constexpr ContactEvents operator|(ContactEvents a, ContactEvents b) {
  return static_cast<ContactEvents>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
/// True if each begin must have an end.
constexpr bool wants_ends(ContactEvents wanted) {
  return (static_cast<unsigned>(wanted) & static_cast<unsigned>(ContactEvents::begin_and_end)) != 0;
}
/// True if each approach in touch must be reported.
constexpr bool wants_approaches(ContactEvents wanted) {
  return (static_cast<unsigned>(wanted) & static_cast<unsigned>(ContactEvents::impacts)) != 0;
}

}  // namespace kinesphere
