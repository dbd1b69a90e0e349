#include "contact/contact_rate.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {
namespace {

/// Contacts of one body at one time from which on further ones are marked as jammed, and from which on none
/// begins. Higher values let longer collision cascades finish at one time (a chain of touching bodies needs a
/// few contacts each); lower ones end an endless cascade earlier.
constexpr std::uint32_t many_at_one_instant = 64;
constexpr std::uint32_t most_at_one_instant = 256;
/// Instants in a row with that many contacts. At each the gap of a body that is crushed shrinks by an eighth
/// of the tolerance; a crowd that has room, however little, finds its velocities sooner.
constexpr std::uint16_t most_full_instants = 64;

}  // namespace

void ContactRate::add(std::uint32_t body, double zeno_interval) {
  if (body >= bodies_.size()) bodies_.resize(body + std::size_t{1});
  bodies_[body] = {};
  set_zeno_interval(body, zeno_interval);
}

void ContactRate::set_zeno_interval(std::uint32_t body, double zeno_interval) {
  bodies_[body].zeno_interval = TruncatedDouble(zeno_interval);
}

ContactRate::Marks ContactRate::note(std::span<const std::uint32_t> bodies, double time) {
  Marks marks{false, contacts_now(bodies, time) >= many_at_one_instant};
  for (const std::uint32_t body : bodies) {
    Body& one = bodies_[body];
    marks.repeated = marks.repeated || time - one.last_contact < one.zeno_interval.value();
    if (one.last_contact != time) {
      const bool was_full = one.contacts_then == most_at_one_instant;
      one.full_instants = was_full ? std::min<std::uint16_t>(one.full_instants + 1, most_full_instants) : 0;
      one.contacts_then = 0;
    }
    if (one.contacts_then < most_at_one_instant) ++one.contacts_then;
    one.last_contact = time;
  }
  return marks;
}

bool ContactRate::is_jammed(std::span<const std::uint32_t> bodies, double time) const {
  return contacts_now(bodies, time) >= most_at_one_instant;
}

bool ContactRate::is_crushed(std::span<const std::uint32_t> bodies) const {
  return std::all_of(bodies.begin(), bodies.end(), [this](std::uint32_t body) {
    return bodies_[body].full_instants == most_full_instants;
  });
}

void ContactRate::end_crush(std::span<const std::uint32_t> bodies) {
  for (const std::uint32_t body : bodies) bodies_[body].full_instants = 0;
}

/// Returns the minimum over the bodies of their number of contacts at `time`.
std::uint32_t ContactRate::contacts_now(std::span<const std::uint32_t> bodies, double time) const {
  std::uint32_t least = most_at_one_instant;
  for (const std::uint32_t body : bodies) {
    const Body& one = bodies_[body];
    least = std::min(least, one.last_contact == time ? std::uint32_t{one.contacts_then} : 0);
  }
  return least;
}

bool ContactRate::is_valid() const {
  return std::all_of(bodies_.begin(), bodies_.end(), [](const Body& body) {
    return !std::isnan(body.last_contact) && body.zeno_interval.value() >= 0.0 &&
           body.full_instants <= most_full_instants;
  });
}

}  // namespace kinesphere
