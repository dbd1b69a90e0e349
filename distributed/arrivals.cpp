// Bodies that are added to a rank, and how they begin.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "archive/archive.hpp"
#include "bodies/shaped_body.hpp"
#include "bodies/validation.hpp"
#include "core/first_radii.hpp"
#include "distributed/rank_engine.hpp"
#include "processor/overlaps.hpp"

namespace kinesphere {
namespace {

/// Returns the first record whose name is not less.
auto record_named(auto& records, std::uint32_t name) {
  return std::lower_bound(
      records.begin(), records.end(), name,
      [](const BodyRecord& record, std::uint32_t wanted) { return record.name < wanted; });
}

}  // namespace

/// Checks what bodies of all kinds have in common.
Result<void> DistributedWorld::RankEngine::check_addition(std::uint32_t name, const BodyDefinition& body,
                                                          std::uint32_t number_in_motion,
                                                          std::string_view call) const {
  auto valid =
      check_reach(sensors_.reach(body.sensor_class), body, no_body, "sensor_class", definition(), call);
  if (!valid) return valid;
  // The extents of all depend on it, so all would have to arrive anew.
  const double least = facts_.common_reach < infinity ? facts_.common_reach : 0.0;
  if (const double reach = sensors_.reach(body.sensor_class); reach < least)
    return Error{ErrorCode::unsupported, "sensor_class", no_body,
                 std::string(call) +
                     ": sensor_class must sense at least as far as all bodies of a distributed " +
                     "world that has run, " + text_of(least) + ", but senses up to " + text_of(reach)};
  const auto held = record_named(own_, name);
  const bool is_there = held != own_.end() && held->name == name;
  if (is_there || names_.contains(name) || name == no_body.index)
    return Error{ErrorCode::out_of_range,
                 "index",
                 {name, 0, 0},
                 std::string(call) + ": index must be that of no other body, but is " + std::to_string(name)};
  if (!motion_.contains(number_in_motion))
    return Error{ErrorCode::unknown_body,
                 "number_in_motion",
                 {name, 0, 0},
                 std::string(call) + ": number_in_motion must be that of a body of the motion, but is " +
                     std::to_string(number_in_motion)};
  return {};
}

Result<void> DistributedWorld::RankEngine::add(std::uint32_t name, const BodyDefinition& body,
                                               std::uint32_t number_in_motion) {
  auto valid = consensus_.check("add");
  if (valid) valid = check_body(body, definition(), "add");
  if (valid) valid = check_addition(name, body, number_in_motion, "add");
  if (valid) insert(name, body, number_in_motion);
  return valid;
}

Result<void> DistributedWorld::RankEngine::add_moving_shape(std::uint32_t name, const MovingShape& added,
                                                            std::uint32_t number_in_motion) {
  constexpr std::string_view call = "add_moving_shape";
  if (auto valid = consensus_.check(call); !valid) return valid;
  const auto accepted = accepted_moving_shape(added, definition(), call);
  if (!accepted) return accepted.error();
  const BodyDefinition body = body_of(*accepted, definition());
  auto valid = check_addition(name, body, number_in_motion, call);
  if (!valid) return valid;
  const std::uint32_t number = insert(name, body, number_in_motion);
  arriving_->bodies.give_shape(number, accepted->shape, true);
  arriving_->contacts.set_shape(number, false);
  return {};
}

Result<void> DistributedWorld::RankEngine::add_rigid_body(std::uint32_t name, const RigidBody& added,
                                                          std::uint32_t number_in_motion) {
  constexpr std::string_view call = "add_rigid_body";
  auto valid = consensus_.check(call);
  if (valid) valid = check_new_rigid_body(added, definition(), call);
  if (!valid) return valid;
  if (added.angular_acceleration_limit != 0.0)
    return Error{ErrorCode::unsupported, "angular_acceleration_limit", no_body,
                 std::string(call) + ": angular_acceleration_limit must be 0 in a distributed world, which " +
                     "has no rotation probe, but is " + text_of(added.angular_acceleration_limit)};
  const BodyDefinition body = body_of(added);
  valid = check_addition(name, body, number_in_motion, call);
  if (!valid) return valid;
  const RigidRecord turning = record_of(added, time());
  const Bound bound = bound_now(body, time());
  const Overlaps overlaps(*arriving_, time());
  if (const auto wall = overlaps.of_wall({bound, false, nullptr, body.radius, &turning}, body.filter))
    return wall_error(call, no_body, *wall);
  const std::uint32_t number = insert(name, body, number_in_motion);
  Bodies& bodies = arriving_->bodies;
  bodies.make_rigid(number, turning);
  arriving_->contacts.set_largest_acceleration(number, bodies.largest_acceleration(number));
  return {};
}

/// Adds a body, which is a ball as yet. Returns its number among those that arrive.
std::uint32_t DistributedWorld::RankEngine::insert(std::uint32_t name, const BodyDefinition& body,
                                                   std::uint32_t number_in_motion) {
  Bodies& bodies = arriving_->bodies;
  const std::uint32_t number = bodies.add_named(body, time(), name);
  bodies[number].bound = bound_now(body, time());
  bodies[number].relocated = bodies[number].dirty = true;
  if (bodies.space().repeats()) bodies.wrap_to_primary(number, time());
  arriving_->contacts.add(number, bodies.largest_acceleration(number));
  arriving_in_motion_.push_back(number_in_motion);
  names_.add(name);
  return number;
}

Result<void> DistributedWorld::RankEngine::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  auto valid = check_sensor(sensor, definition());
  if (valid && own_bodies() > 0)
    valid = Error{ErrorCode::unsupported, "sensor_class", no_body,
                  "set_sensor: a distributed world must have no bodies yet, but has some"};
  auto agreed = consensus_.first_error(valid);
  if (agreed) sensors_.set(sensor_class, sensor);
  return agreed;
}

Result<void> DistributedWorld::RankEngine::set_pair_state(std::uint32_t first, std::uint32_t second,
                                                          std::int32_t state) {
  if (auto valid = consensus_.check("set_pair_state"); !valid) return valid;
  if (first == second)
    return Error{ErrorCode::out_of_range,
                 "second",
                 {second, 0, 0},
                 "set_pair_state: second must be another body than first, but is " + std::to_string(second)};
  take_arrivals();
  for (const auto& [name, partner] : {std::pair(first, second), std::pair(second, first)}) {
    const auto held = record_named(own_, name);
    if (held == own_.end() || held->name != name) continue;
    std::vector<PairNote>& notes = held->notes;
    const auto note =
        std::lower_bound(notes.begin(), notes.end(), partner,
                         [](const PairNote& each, std::uint32_t wanted) { return each.partner < wanted; });
    const bool is_there = note != notes.end() && note->partner == partner;
    if (is_there && (state != 0 || note->is_turned()))
      note->state = state;
    else if (is_there)
      notes.erase(note);
    else if (state != 0)
      notes.insert(note, {partner, state});
  }
  return {};
}

/// Makes records of the bodies that have been added.
void DistributedWorld::RankEngine::take_arrivals() {
  const std::uint32_t count = arriving_->bodies.numbers();
  if (count == 0) return;
  own_.reserve(own_.size() + count);
  for (std::uint32_t number = 0; number < count; ++number) {
    BodyRecord& record =
        own_.emplace_back(kinesphere::record_of(arriving_->bodies, arriving_->contacts, number));
    record.owner = communicator_.rank();
    record.in_motion = arriving_in_motion_[number];
    record.is_arriving = true;
  }
  const auto comes_before = [](const BodyRecord& a, const BodyRecord& b) { return a.name < b.name; };
  if (!std::is_sorted(own_.begin(), own_.end(), comes_before))
    std::sort(own_.begin(), own_.end(), comes_before);
  arriving_ = std::make_unique<WorldState>(definition_);
  arriving_in_motion_.clear();
}

/// Agrees on what the bodies that have arrived since the last run change for all.
Result<void> DistributedWorld::RankEngine::start_arrivals() {
  take_arrivals();
  std::vector<BodyRecord*> arrivals;
  double least_reach = facts_.common_reach;
  std::array<std::uint64_t, 6> sums{};
  auto& [arrived, exact, shaped, growing, drifting, all] = sums;
  for (BodyRecord& record : own_) {
    if (!record.is_arriving) continue;
    arrivals.push_back(&record);
    least_reach = std::min(least_reach, sensors_.reach(record.body.sensor_class));
    const Bound& bound = record.body.bound;
    exact += bound.is_exact() ? 1 : 0;
    shaped += record.body.is_shaped() ? 1 : 0;
    growing += bound.is_exact() ? 0 : 1;
    drifting += bound.planned_acceleration != Vec3{} || bound.growth_speed != 0.0 ? 1 : 0;
  }
  arrived = arrivals.size();
  all = own_.size();
  communicator_.sum(sums);
  if (arrived == 0) return {};
  if (exact > 0) facts_.spot_checks.note_arrival(time());
  facts_.has_shapes = facts_.has_shapes || shaped > 0;
  facts_.grows = facts_.grows || growing > 0;
  facts_.drifts = facts_.drifts || drifting > 0;
  if (auto unique = agree(names_.check(communicator_)); !unique) return unique;
  facts_.common_reach = communicator_.least(least_reach);
  measure(all);
  if (arrived > core::single_arrivals) choose_radii(arrivals);
  return {};
}

/// Chooses the radius of the first safe region of a body that arrives alone, as core::Core does.
void DistributedWorld::RankEngine::measure(std::uint64_t bodies) {
  if (facts_.measured <= bodies && bodies < 2 * facts_.measured) return;
  facts_.measured = bodies;
  core::BoundingBox bounds;
  for (const BodyRecord& record : own_)
    bounds.add(record.is_arriving ? record.body.bound.position : record.core.ball.position);
  Box box = bounds.box();
  box.upper = -1.0 * box.upper;
  std::array<double, 6> corners{box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z};
  communicator_.least(corners);
  box = {{corners[0], corners[1], corners[2]}, {-corners[3], -corners[4], -corners[5]}};
  facts_.first_radius = core::first_radius(box, bodies, definition_.contact_tolerance);
}

/// Chooses the radii of the first safe regions of bodies that arrive on all ranks.
void DistributedWorld::RankEngine::choose_radii(std::span<BodyRecord* const> arrivals) {
  ByteWriter writer;
  for (const BodyRecord* const record : arrivals) writer(record->name, record->body.bound.position);
  std::vector<core::Arrival> all;
  for (const Communicator::Bytes& bytes : communicator_.gather(writer.bytes())) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0 && !reader.failed()) {
      core::Arrival& arrival = all.emplace_back();
      reader(arrival.ball, arrival.position);
    }
  }
  core::choose_first_radii(all, definition_.contact_tolerance);
  std::sort(all.begin(), all.end(),
            [](const core::Arrival& a, const core::Arrival& b) { return a.ball < b.ball; });
  auto next = all.begin();
  for (BodyRecord* const record : arrivals) {
    while (next->ball != record->name) ++next;
    record->first_radius = next->radius;
  }
}

}  // namespace kinesphere
