#include "distributed/domain.hpp"

#include <exception>
#include <optional>
#include <string>

#include "distributed/phase_part.hpp"
#include "engine/validation.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

DistributedWorld::Domain::Domain(const WorldDefinition& definition, Motion& motion)
    : agreement_(communicator_),
      local_(definition, communicator_.rank()),
      mover_(motion, local_.roster),
      transit_(motion, local_),
      known_(communicator_.ranks(), communicator_.rank(), local_.bodies().space()),
      distribution_(communicator_, agreement_, local_, transit_, known_),
      starts_(communicator_, agreement_, local_, distribution_) {}

Result<void> DistributedWorld::Domain::check_body_to_add(std::uint32_t name, const BodyDefinition& body,
                                                         std::uint32_t number_in_motion) const {
  auto valid = agreement_.check("add");
  if (valid) valid = check_body(body, definition(), "add");
  if (valid)
    valid = check_reach(local_.bodies().sensors.reach(body.sensor_class), body, no_body, "sensor_class",
                        definition(), "add");
  if (!valid) return valid;
  if (local_.roster.find(name) || name == no_body.index)
    return Error{ErrorCode::out_of_range,
                 "index",
                 {name, 0, 0},
                 "add: index must be that of no other body, but is " + std::to_string(name)};
  if (!mover_.contains(number_in_motion))
    return Error{ErrorCode::unknown_body,
                 "number_in_motion",
                 {name, 0, 0},
                 "add: number_in_motion must be that of a body of the motion, but is " +
                     std::to_string(number_in_motion)};
  return {};
}

Result<void> DistributedWorld::Domain::add(std::uint32_t name, const BodyDefinition& body,
                                           std::uint32_t number_in_motion) {
  auto valid = check_body_to_add(name, body, number_in_motion);
  if (!valid) return valid;
  const std::uint32_t number = local_.bodies().add(body, name);
  local_.tables.book.add(number, 0.0);
  local_.roster.add(name, number, communicator_.rank());
  local_.roster[number].in_motion = number_in_motion;
  names_.add(name);
  Body& added = local_.bodies()[number];
  added.bound = bound_of(body, {body.position, body.velocity}, time());
  added.arrived = true;
  local_.everybody.void_facts(number);
  local_.tables.book.add(number, added.largest_acceleration());
  return {};
}

Result<void> DistributedWorld::Domain::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  auto valid = check_sensor(sensor, definition());
  if (valid && !local_.roster.empty())
    valid = Error{ErrorCode::unsupported, "sensor_class", no_body,
                  "set_sensor: a distributed world must have no bodies yet, but has some"};
  auto agreed = agreement_.first_error(valid);
  if (agreed) local_.bodies().sensors.set(sensor_class, sensor);
  return agreed;
}

RankFigures DistributedWorld::Domain::figures() const {
  const Communicator::Traffic& traffic = communicator_.traffic();
  return {.bodies = own_bodies(),
          .copies = local_.roster.copies().size(),
          .bytes = traffic.bytes,
          .messages = traffic.messages,
          .collectives = traffic.collectives,
          .parts = parts_,
          .rounds = rounds_,
          .partitions = distribution_.partitions(),
          .seconds_in_mpi = traffic.seconds};
}

Result<void> DistributedWorld::Domain::check_run(double until, const Shift& shift) const {
  if (auto valid = agreement_.check("run"); !valid) return valid;
  if (auto time_is_valid = check_time(until, time()); !time_is_valid) {
    Error error = time_is_valid.error();
    if (error.message.rfind("advance:", 0) == 0) error.message.replace(0, 8, "run:");
    return error;
  }
  if (!shift)
    return Error{ErrorCode::workers_busy, "workers", no_body,
                 "run: workers must not be at work in another run, but are"};
  return {};
}

Result<void> DistributedWorld::Domain::run(double until, const Respond* respond, const OrderedSink& sink,
                                           Workers* workers) {
  Shift shift(workers);
  if (auto agreed = agree(check_run(until, shift)); !agreed) return agreed;
  const Probe probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    mover_.states(ids, time, states);
  };
  local_.everybody.reports().ask(probe, "run");
  std::optional<RankAnswerer> answerer;
  if (respond != nullptr) answerer.emplace(*respond, mover_, definition());
  Islands islands(local_.tables, local_.everybody, shift, probe, answerer ? &*answerer : nullptr);
  islands.leave_nothing();
  return go(until, sink, shift, islands);
}

Result<void> DistributedWorld::Domain::go(double until, const OrderedSink& sink, Shift& shift,
                                          Islands& islands) {
  if (auto settled = settle_arrivals(shift, islands); !settled) return settled;
  for (;;) {
    if (local_.everybody.phase_end() <= time()) {
      if (auto started = starts_.start(shift, false, {}); !started) return started;
    }
    const auto stop = run_part(until, infinity, islands);
    if (!stop) return stop.error();
    tell(sink);
    if (*stop > until) break;
  }
  return agreement_.agree_on_noted();
}

/// Bodies that have been added are registered, without time moving on.
Result<void> DistributedWorld::Domain::settle_arrivals(Shift& shift, Islands& islands) {
  const Arrivals arrivals = starts_.count_arrivals();
  if (arrivals.everywhere == 0) return {};
  if (auto unique = agree(names_.check(communicator_)); !unique) return unique;
  if (auto started = starts_.start_with(arrivals, shift); !started) return started;
  if (auto settled = run_part(time(), time(), islands); !settled) return settled.error();
  starts_.begin_phase_of_arrivals();
  return {};
}

/// From now to `until`, or to the end of a part of the phase, or to `latest`: returns where the part ends.
Result<double> DistributedWorld::Domain::run_part(double until, double latest, Islands& islands) {
  const double stop = communicator_.least(islands.take_due(until, latest));
  islands.open(stop);
  ++parts_;
  PhasePart part(communicator_, agreement_, local_, transit_, known_, islands);
  auto done = part.run();
  rounds_ += part.rounds();
  if (done) {
    for (const OrderedEvent& event : part.finish()) {
      hash_.add(event.event);
      events_.push_back(event);
    }
    done = part.renew_copies();
  }
  islands.close();
  if (!done) return done.error();
  return stop;
}

/// What the sink throws ends the run on all ranks.
void DistributedWorld::Domain::tell(const OrderedSink& sink) {
  try {
    while (!events_.empty() && !agreement_.has_noted()) {
      const OrderedEvent event = events_.front();
      events_.pop_front();
      sink(event);
    }
  } catch (const std::exception& thrown) {
    agreement_.note(
        Error{ErrorCode::callback_threw, "sink", no_body, std::string("run: sink: ") + thrown.what()});
  } catch (...) {
    agreement_.note(
        Error{ErrorCode::callback_threw, "sink", no_body, "run: sink threw what is no std::exception"});
  }
}

}  // namespace kinesphere
