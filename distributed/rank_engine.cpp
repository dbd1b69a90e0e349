#include "distributed/rank_engine.hpp"

#include <array>
#include <exception>
#include <string>
#include <utility>

#include "bodies/shaped_body.hpp"
#include "bodies/validation.hpp"
#include "distributed/batch_exchange.hpp"
#include "distributed/guarded.hpp"
#include "number/infinity.hpp"
#include "processor/overlaps.hpp"

namespace kinesphere {

DistributedWorld::RankEngine::RankEngine(const WorldDefinition& definition, Motion& motion)
    : consensus_(communicator_),
      rank_(definition, communicator_.rank()),
      source_(motion, rank_.directory),
      migration_(motion, rank_),
      known_(communicator_.ranks(), communicator_.rank(), rank_.bodies().space()),
      distribution_(communicator_, consensus_, rank_, migration_, known_),
      starts_(communicator_, consensus_, rank_, distribution_) {}

/// Checks what bodies of all kinds have in common.
Result<void> DistributedWorld::RankEngine::check_addition(std::uint32_t name, const BodyDefinition& body,
                                                          std::uint32_t number_in_motion,
                                                          std::string_view call) const {
  auto valid = check_reach(rank_.bodies().sensors.reach(body.sensor_class), body, no_body, "sensor_class",
                           definition(), call);
  if (!valid) return valid;
  if (rank_.directory.find(name) || name == no_body.index)
    return Error{ErrorCode::out_of_range,
                 "index",
                 {name, 0, 0},
                 std::string(call) + ": index must be that of no other body, but is " + std::to_string(name)};
  if (!source_.contains(number_in_motion))
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
  rank_.bodies().give_shape(number, accepted->shape, true);
  rank_.state.contacts.set_shape(number, false);
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
  const Overlaps overlaps(rank_.state, time());
  if (const auto wall = overlaps.of_wall({bound, false, nullptr, body.radius, &turning}, body.filter))
    return wall_error(call, no_body, *wall);
  const std::uint32_t number = insert(name, body, number_in_motion);
  rank_.bodies().make_rigid(number, turning);
  rank_.state.contacts.set_largest_acceleration(number, rank_.bodies().largest_acceleration(number));
  return {};
}

std::uint32_t DistributedWorld::RankEngine::insert(std::uint32_t name, const BodyDefinition& body,
                                                   std::uint32_t number_in_motion) {
  Bodies& bodies = rank_.bodies();
  const std::uint32_t number = bodies.add_named(body, time(), name);
  rank_.directory.add(name, number, communicator_.rank());
  rank_.directory[number].in_motion = number_in_motion;
  names_.add(name);
  bodies[number].bound = bound_now(body, time());
  bodies[number].relocated = true;
  rank_.main.invalidate(number);
  rank_.state.contacts.add(number, bodies.largest_acceleration(number));
  return number;
}

Result<void> DistributedWorld::RankEngine::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  auto valid = check_sensor(sensor, definition());
  if (valid && !rank_.directory.empty())
    valid = Error{ErrorCode::unsupported, "sensor_class", no_body,
                  "set_sensor: a distributed world must have no bodies yet, but has some"};
  auto agreed = consensus_.first_error(valid);
  if (agreed) rank_.bodies().sensors.set(sensor_class, sensor);
  return agreed;
}

RankFigures DistributedWorld::RankEngine::figures() const {
  const Communicator::Traffic& traffic = communicator_.traffic();
  return {.bodies = own_bodies(),
          .ghosts = rank_.directory.ghosts().size(),
          .bytes = traffic.bytes,
          .messages = traffic.messages,
          .collectives = traffic.collectives,
          .batches = batches_,
          .rounds = rounds_,
          .partitions = distribution_.partitions(),
          .seconds_in_mpi = traffic.seconds};
}

Result<void> DistributedWorld::RankEngine::check_run(double until, const PoolLease& lease) const {
  if (auto valid = consensus_.check("run"); !valid) return valid;
  if (auto time_is_valid = check_time(until, time()); !time_is_valid) {
    Error error = time_is_valid.error();
    if (error.message.rfind("advance:", 0) == 0) error.message.replace(0, 8, "run:");
    return error;
  }
  if (!lease)
    return Error{ErrorCode::workers_busy, "workers", no_body,
                 "run: workers must not be at work in another run, but are"};
  return {};
}

Result<void> DistributedWorld::RankEngine::run(double until, const ResponseFn* respond,
                                               const OrderedEventFn& sink, Workers* workers) {
  PoolLease lease(workers);
  if (auto agreed = agree(check_run(until, lease)); !agreed) return agreed;
  const Probe probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    source_.states(ids, time, states);
  };
  rank_.main.reports().ask(probe, "run");
  std::optional<RankResponder> handler;
  if (respond != nullptr) handler.emplace(*respond, source_, rank_.bodies());
  SpeculativeRunner runner(rank_.state, rank_.main, lease, probe, handler ? &*handler : nullptr);
  runner.require_speculation();
  return go(until, sink, lease, runner);
}

Result<void> DistributedWorld::RankEngine::go(double until, const OrderedEventFn& sink, PoolLease& lease,
                                              SpeculativeRunner& runner) {
  if (auto recertified = start_arrivals(lease, runner); !recertified) return recertified;
  for (;;) {
    if (rank_.main.epoch_end() <= time()) {
      if (auto started = starts_.start(lease, false, {}); !started) return started;
    }
    if (rank_.state.spot_checks.next() <= time()) {
      if (auto checked = spot_check(lease); !checked) return checked;
    }
    const auto stop = run_batch(until, infinity, runner);
    if (!stop) return stop.error();
    deliver(sink);
    if (*stop > until) break;
  }
  return consensus_.agree_on_noted();
}

/// Checks exact bodies, as World::Engine::end_epoch() does.
Result<void> DistributedWorld::RankEngine::spot_check(PoolLease& lease) {
  const std::uint64_t& own_probes = rank_.main.work().counters.probes;
  const std::uint64_t probes = communicator_.sum(own_probes);
  const auto here = guarded([&] { return rank_.main.spot_check_due(rank_.own_bodies(), probes, lease); });
  if (auto agreed = agree(here ? Result<void>() : here.error()); !agreed) return agreed;
  std::array<std::uint64_t, 3> sums{here->any, here->moving, own_probes};
  communicator_.sum(sums);
  const SpotChecks::Census census{sums[0] > 0, sums[1], communicator_.least(here->least_time)};
  rank_.state.spot_checks.note_check(rank_.state.window_policy.main_length(), time(), census, sums[2]);
  return {};
}

/// Recertifies and registers added bodies without advancing time.
Result<void> DistributedWorld::RankEngine::start_arrivals(PoolLease& lease, SpeculativeRunner& runner) {
  const Arrivals arrivals = starts_.count_arrivals();
  if (arrivals.everywhere == 0) return {};
  if (arrivals.has_exact) rank_.state.spot_checks.note_arrival(time());
  if (auto unique = agree(names_.check(communicator_)); !unique) return unique;
  if (auto started = starts_.start_with(arrivals, lease); !started) return started;
  if (auto recertified = run_batch(time(), time(), runner); !recertified) return recertified.error();
  starts_.begin_epoch_of_arrivals();
  return {};
}

/// Runs one batch from now to `until`, to the batch end chosen by the sizer, or to `latest`, whichever is
/// first. Returns the end of the batch.
Result<double> DistributedWorld::RankEngine::run_batch(double until, double latest,
                                                       SpeculativeRunner& runner) {
  const double stop = communicator_.least(runner.take_due(until, latest));
  runner.begin_batch(stop);
  ++batches_;
  BatchExchange exchange(communicator_, consensus_, rank_, migration_, known_, runner);
  auto done = exchange.run();
  rounds_ += exchange.rounds();
  if (done) {
    for (const OrderedEvent& event : exchange.finish()) {
      hash_.add(event.event);
      events_.push_back(event);
    }
    done = exchange.renew_ghosts();
  }
  runner.end_batch();
  if (!done) return done.error();
  return stop;
}

/// Passes pending events to the sink. An exception thrown by the sink ends the run on all ranks.
void DistributedWorld::RankEngine::deliver(const OrderedEventFn& sink) {
  try {
    while (!events_.empty() && !consensus_.has_noted()) {
      const OrderedEvent event = events_.front();
      events_.pop_front();
      sink(event);
    }
  } catch (const std::exception& thrown) {
    consensus_.note(
        Error{ErrorCode::callback_threw, "sink", no_body, std::string("run: sink: ") + thrown.what()});
  } catch (...) {
    consensus_.note(
        Error{ErrorCode::callback_threw, "sink", no_body, "run: sink threw what is no std::exception"});
  }
}

}  // namespace kinesphere
