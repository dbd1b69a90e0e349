#include "distributed/rank_engine.hpp"

#include <exception>
#include <optional>
#include <string>

#include "distributed/batch_exchange.hpp"
#include "engine/validation.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

DistributedWorld::RankEngine::RankEngine(const WorldDefinition& definition, Motion& motion)
    : agreement_(communicator_),
      local_(definition, communicator_.rank()),
      mover_(motion, local_.directory),
      transit_(motion, local_),
      known_(communicator_.ranks(), communicator_.rank(), local_.bodies().space()),
      distribution_(communicator_, agreement_, local_, transit_, known_),
      starts_(communicator_, agreement_, local_, distribution_) {}

Result<void> DistributedWorld::RankEngine::check_body_to_add(std::uint32_t name, const BodyDefinition& body,
                                                             std::uint32_t number_in_motion) const {
  auto valid = agreement_.check("add");
  if (valid) valid = check_body(body, definition(), "add");
  if (valid)
    valid = check_reach(local_.bodies().sensors.reach(body.sensor_class), body, no_body, "sensor_class",
                        definition(), "add");
  if (!valid) return valid;
  if (local_.directory.find(name) || name == no_body.index)
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

Result<void> DistributedWorld::RankEngine::add(std::uint32_t name, const BodyDefinition& body,
                                               std::uint32_t number_in_motion) {
  auto valid = check_body_to_add(name, body, number_in_motion);
  if (!valid) return valid;
  const std::uint32_t number = local_.bodies().add(body, name);
  local_.state.contacts.add(number, 0.0);
  local_.directory.add(name, number, communicator_.rank());
  local_.directory[number].in_motion = number_in_motion;
  names_.add(name);
  Body& added = local_.bodies()[number];
  added.bound = bound_of(body, {body.position, body.velocity}, time());
  added.relocated = true;
  local_.main.invalidate(number);
  local_.state.contacts.add(number, added.largest_acceleration());
  return {};
}

Result<void> DistributedWorld::RankEngine::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  auto valid = check_sensor(sensor, definition());
  if (valid && !local_.directory.empty())
    valid = Error{ErrorCode::unsupported, "sensor_class", no_body,
                  "set_sensor: a distributed world must have no bodies yet, but has some"};
  auto agreed = agreement_.first_error(valid);
  if (agreed) local_.bodies().sensors.set(sensor_class, sensor);
  return agreed;
}

RankFigures DistributedWorld::RankEngine::figures() const {
  const Communicator::Traffic& traffic = communicator_.traffic();
  return {.bodies = own_bodies(),
          .ghosts = local_.directory.ghosts().size(),
          .bytes = traffic.bytes,
          .messages = traffic.messages,
          .collectives = traffic.collectives,
          .batches = parts_,
          .rounds = rounds_,
          .partitions = distribution_.partitions(),
          .seconds_in_mpi = traffic.seconds};
}

Result<void> DistributedWorld::RankEngine::check_run(double until, const PoolLease& shift) const {
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

Result<void> DistributedWorld::RankEngine::run(double until, const ResponseFn* respond,
                                               const OrderedEventFn& sink, Workers* workers) {
  PoolLease shift(workers);
  if (auto agreed = agree(check_run(until, shift)); !agreed) return agreed;
  const Probe probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    mover_.states(ids, time, states);
  };
  local_.main.reports().ask(probe, "run");
  std::optional<RankResponder> handler;
  if (respond != nullptr) handler.emplace(*respond, mover_, definition());
  SpeculativeRunner islands(local_.state, local_.main, shift, probe, handler ? &*handler : nullptr);
  islands.require_speculation();
  return go(until, sink, shift, islands);
}

Result<void> DistributedWorld::RankEngine::go(double until, const OrderedEventFn& sink, PoolLease& shift,
                                              SpeculativeRunner& islands) {
  if (auto settled = settle_arrivals(shift, islands); !settled) return settled;
  for (;;) {
    if (local_.main.epoch_end() <= time()) {
      if (auto started = starts_.start(shift, false, {}); !started) return started;
    }
    const auto stop = run_part(until, infinity, islands);
    if (!stop) return stop.error();
    tell(sink);
    if (*stop > until) break;
  }
  return agreement_.agree_on_noted();
}

/// Recertifies and registers added bodies without advancing time.
Result<void> DistributedWorld::RankEngine::settle_arrivals(PoolLease& shift, SpeculativeRunner& islands) {
  const Arrivals arrivals = starts_.count_arrivals();
  if (arrivals.everywhere == 0) return {};
  if (auto unique = agree(names_.check(communicator_)); !unique) return unique;
  if (auto started = starts_.start_with(arrivals, shift); !started) return started;
  if (auto settled = run_part(time(), time(), islands); !settled) return settled.error();
  starts_.begin_epoch_of_arrivals();
  return {};
}

/// Runs one batch from now to `until`, to the batch end chosen by the sizer, or to `latest`, whichever is
/// first. Returns the end of the batch.
Result<double> DistributedWorld::RankEngine::run_part(double until, double latest,
                                                      SpeculativeRunner& islands) {
  const double stop = communicator_.least(islands.take_due(until, latest));
  islands.begin_batch(stop);
  ++parts_;
  BatchExchange part(communicator_, agreement_, local_, transit_, known_, islands);
  auto done = part.run();
  rounds_ += part.rounds();
  if (done) {
    for (const OrderedEvent& event : part.finish()) {
      hash_.add(event.event);
      events_.push_back(event);
    }
    done = part.renew_ghosts();
  }
  islands.end_batch();
  if (!done) return done.error();
  return stop;
}

/// Passes pending events to the sink. An exception thrown by the sink ends the run on all ranks.
void DistributedWorld::RankEngine::tell(const OrderedEventFn& sink) {
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
