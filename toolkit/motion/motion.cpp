// Motion: defaults that refuse unsupported changes, and a probe that rejects bodies of another motion; and
// Segment: cubic pieces of motion.
#include "kinesphere/motion/motion.hpp"

#include "input/input_check.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "motion/checks.hpp"

namespace kinesphere {
namespace {

[[noreturn, gnu::cold]] void refuse_probe(BodyId id, std::size_t size) {
  detail::bad_result({ErrorCode::unknown_body, "ids", id,
                      "Motion::probe: ids: " + text_of(id) + " of the world is none of the " + text_of(size) +
                          " bodies that this motion began with: a BodyMap" +
                          " (kinesphere/body_map.hpp) tells which body is which"});
}

}  // namespace

Result<void> Motion::teleport(std::uint32_t body, double, const State&) {
  return cannot_change("teleport", *this, body, "put elsewhere");
}

Result<void> Motion::remove(std::uint32_t body) { return cannot_change("remove", *this, body, "removed"); }

std::optional<Rotation> Motion::rotation(std::uint32_t, double) const { return std::nullopt; }

MotionOrigin Motion::origin(std::uint32_t body) const {
  detail::bad_result(cannot_change("origin", *this, body, "changed"));
}

Result<void> Motion::set_origin(std::uint32_t body, const MotionOrigin&) {
  return cannot_change("set_origin", *this, body, "changed");
}

Result<void> Motion::write_body(std::uint32_t body, std::vector<std::byte>&) const {
  return cannot_change("write_body", *this, body, "written to bytes");
}

Result<std::uint32_t> Motion::read_body(std::span<const std::byte>&) {
  return Error{ErrorCode::unsupported, "bytes", no_body,
               "read_body: bytes: this is a motion that reads no bodies from bytes"};
}

void Motion::require_number(BodyId id, std::size_t size) {
  if (id.generation != 0 || id.index >= size) [[unlikely]]
    refuse_probe(id, size);
}

void SingleMotionSource::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  motion_.probe()(ids, time, states);
}

MotionOrigin SingleMotionSource::origin(BodyId body) const {
  Motion::require_number(body, motion_.size());
  return motion_.origin(body.index);
}

void SingleMotionSource::set_origin(BodyId body, const MotionOrigin& origin) {
  Motion::require_number(body, motion_.size());
  motion_.set_origin(body.index, origin).value();
}

State Segment::state_at(double t) const {
  const double s = t - begin;
  return {.position = position + s * (velocity + s * (0.5 * acceleration + s * (jerk / 6.0))),
          .velocity = velocity + s * (acceleration + s * (0.5 * jerk))};
}

}  // namespace kinesphere
