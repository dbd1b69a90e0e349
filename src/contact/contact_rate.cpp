#include "contact/contact_rate.hpp"

#include <algorithm>
#include <cmath>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Contacts of one body at one time from which on further ones are marked as jammed, and from which on none
/// begins. Higher values let longer collision cascades finish at one time (a chain of touching bodies needs a
/// few contacts each); lower ones end an endless cascade earlier.
constexpr std::uint32_t many_at_one_instant = 64;
constexpr std::uint32_t most_at_one_instant = 256;
/// Instants in a row with that many contacts. At each the gap of a body that is crushed shrinks by an eighth
/// of the tolerance; a crowd that has room, however little, finds its velocities sooner.
constexpr std::uint8_t most_full_instants = 64;

}  // namespace

void ContactRate::add(std::uint32_t body, double zeno_interval) {
  if (body >= bodies_.size()) bodies_.resize(body + std::size_t{1});
  bodies_[body] = {};
  set_zeno_interval(body, zeno_interval);
}

void ContactRate::set_zeno_interval(std::uint32_t body, double zeno_interval) {
  bodies_[body].zeno_interval = TruncatedDouble<std::uint32_t>(zeno_interval);
}

ContactRate::Marks ContactRate::note(std::span<const std::uint32_t> bodies, const Begin& begin,
                                     const ContactRule& rule) {
  Marks marks{false, contacts_now(bodies, begin.time) >= many_at_one_instant};
  double passed = infinity;
  double pressure = begin.acceleration;
  for (const std::uint32_t body : bodies) {
    const Body& one = bodies_[body];
    const double since = begin.time - one.last_contact;
    if (!(since < one.zeno_interval.value())) continue;
    passed = std::min(passed, since);
    pressure = std::max(pressure, one.pressure.value());
  }
  const bool is_slow = passed == 0.0 || begin.approach_speed < rule.zeno_speed(pressure);
  marks.repeated = passed < rule.least_zeno_interval() || (passed < infinity && pressure > 0.0 && is_slow);
  for (const std::uint32_t body : bodies) count(bodies_[body], begin.time);
  for (const std::uint32_t body : bodies) bodies_[body].pressure = TruncatedDouble<std::uint16_t>(pressure);
  return marks;
}

/// Counts a contact of one body.
void ContactRate::count(Body& body, double time) {
  if (body.last_contact == time) {
    if (body.further_contacts < most_at_one_instant - 1) ++body.further_contacts;
    return;
  }
  const bool was_full = body.further_contacts == most_at_one_instant - 1;
  const int full = was_full ? std::min(body.full_instants + 1, int{most_full_instants}) : 0;
  body.full_instants = static_cast<std::uint8_t>(full);
  body.further_contacts = 0;
  body.last_contact = time;
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
    least = std::min(least, one.last_contact == time ? one.further_contacts + 1u : 0u);
  }
  return least;
}

bool ContactRate::is_valid() const {
  return std::all_of(bodies_.begin(), bodies_.end(), [](const Body& body) {
    return !std::isnan(body.last_contact) && body.zeno_interval.value() >= 0.0 &&
           body.pressure.value() >= 0.0 && body.full_instants <= most_full_instants;
  });
}

}  // namespace kinesphere
