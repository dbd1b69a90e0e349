#include "distributed/domain.hpp"

#include <algorithm>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include "archive/archive.hpp"
#include "engine/validation.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

DistributedWorld::Domain::Domain(const WorldDefinition& definition, Motion& motion)
    : motion_(motion),
      tables_(definition),
      everybody_(tables_, definition.start_time),
      partition_(communicator_.ranks()),
      known_(ranks()) {
  tables_.book.find_numbers_in_tags();
  everybody_.agenda().order_by(HotPairOrder(bodies().table().names()));
  for (int rank = 0; rank < communicator_.ranks(); ++rank)
    known_[static_cast<std::size_t>(rank)].begin(partition_.region_of(rank));
}

Result<void> DistributedWorld::Domain::agree(const Result<void>& here) {
  auto agreed = first_error(here);
  if (!agreed) failed_ = true;
  return agreed;
}

Result<void> DistributedWorld::Domain::first_error(const Result<void>& here) {
  ByteWriter writer;
  if (!here) {
    const Error& error = here.error();
    writer(error.code, error.body, error.argument.size());
    for (const char c : error.argument) writer(c);
    writer(error.message.size());
    for (const char c : error.message) writer(c);
  }
  const std::vector<Bytes> all = communicator_.gather(writer.bytes());
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    if (all[rank].empty()) continue;
    Error error;
    ByteReader reader(all[rank]);
    std::vector<char> argument;
    std::vector<char> message;
    reader(error.code, error.body, argument, message);
    error.argument.assign(argument.begin(), argument.end());
    error.message = "rank " + std::to_string(rank) + ": " + std::string(message.begin(), message.end());
    return error;
  }
  return {};
}

Result<void> DistributedWorld::Domain::add(std::uint32_t name, const BodyDefinition& body,
                                           std::uint32_t number_in_motion) {
  if (failed_)
    return Error{ErrorCode::rank_failed, "world", no_body, "add: the world cannot go on after an error"};
  auto valid = check_body(body, bodies().definition(), "add");
  if (valid)
    valid = check_reach(bodies().sensors.reach(body.sensor_class), body, no_body, "sensor_class",
                        bodies().definition(), "add");
  if (!valid) return valid;
  if (find(name) || name == no_body.index)
    return Error{ErrorCode::out_of_range,
                 "index",
                 {name, 0, 0},
                 "add: index must be that of no other body, but is " + std::to_string(name)};
  if (!motion_.contains(number_in_motion))
    return Error{ErrorCode::unknown_body,
                 "number_in_motion",
                 {name, 0, 0},
                 "add: number_in_motion must be that of a body of the motion, but is " +
                     std::to_string(number_in_motion)};
  const std::uint32_t number = bodies().add(body, name);
  tables_.book.add(number, 0.0);
  roster_.emplace(name, number);
  entries_.resize(bodies().numbers());
  is_copy_.resize(bodies().numbers());
  entries_[number] = {rank(), number_in_motion, 0.0f, {}};
  new_names_.push_back(name);
  Body& added = bodies()[number];
  added.bound = bound_of(body, {body.position, body.velocity}, time());
  added.arrived = true;
  everybody_.void_facts(number);
  tables_.book.add(number, added.largest_acceleration());
  return {};
}

Result<void> DistributedWorld::Domain::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  auto valid = check_sensor(sensor, bodies().definition());
  if (valid && !roster_.empty())
    valid = Error{ErrorCode::unsupported, "sensor_class", no_body,
                  "set_sensor: a distributed world must have no bodies yet, but has some"};
  auto agreed = first_error(valid);
  if (agreed) tables_.bodies.sensors.set(sensor_class, sensor);
  return agreed;
}

RankFigures DistributedWorld::Domain::figures() const {
  const Communicator::Traffic& traffic = communicator_.traffic();
  return {.bodies = own_bodies(),
          .copies = copies_.size(),
          .bytes = traffic.bytes,
          .messages = traffic.messages,
          .collectives = traffic.collectives,
          .parts = parts_,
          .rounds = rounds_,
          .partitions = partitions_,
          .seconds_in_mpi = traffic.seconds};
}

Result<void> DistributedWorld::Domain::run(double until, const Respond* respond, const OrderedSink& sink,
                                           Workers* workers) {
  Shift shift(workers);
  const auto valid = [&]() -> Result<void> {
    if (failed_)
      return Error{ErrorCode::rank_failed, "world", no_body, "run: the world cannot go on after an error"};
    if (auto time_is_valid = check_time(until, time()); !time_is_valid) {
      Error error = time_is_valid.error();
      if (error.message.rfind("advance:", 0) == 0) error.message.replace(0, 8, "run:");
      return error;
    }
    if (!shift)
      return Error{ErrorCode::workers_busy, "workers", no_body,
                   "run: workers must not be at work in another run, but are"};
    return {};
  };
  if (auto agreed = agree(valid()); !agreed) return agreed;
  respond_ = respond;
  const Probe probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    this->states(ids, time, states);
  };
  everybody_.reports().ask(probe, "run");
  Islands islands(tables_, everybody_, shift, probe, respond != nullptr ? this : nullptr);
  islands.leave_nothing();
  islands_of_run_ = &islands;
  auto done = go(until, sink, shift);
  islands_of_run_ = nullptr;
  return done;
}

Result<void> DistributedWorld::Domain::go(double until, const OrderedSink& sink, Shift& shift) {
  if (auto settled = settle_arrivals(shift); !settled) return settled;
  for (;;) {
    if (everybody_.phase_end() <= time()) {
      if (auto started = start_windows(shift, false, {}); !started) return started;
    }
    const auto stop = run_part(until, infinity);
    if (!stop) return stop.error();
    tell(sink);
    if (*stop > until) break;
  }
  return agree(here_ ? Result<void>(*here_) : Result<void>());
}

/// What the sink throws ends the run on all ranks.
void DistributedWorld::Domain::tell(const OrderedSink& sink) {
  try {
    while (!events_.empty() && !here_) {
      const OrderedEvent event = events_.front();
      events_.pop_front();
      sink(event);
    }
  } catch (const std::exception& thrown) {
    here_ = Error{ErrorCode::callback_threw, "sink", no_body, std::string("run: sink: ") + thrown.what()};
  } catch (...) {
    here_ = Error{ErrorCode::callback_threw, "sink", no_body, "run: sink threw what is no std::exception"};
  }
}

Result<Answer> DistributedWorld::Domain::answer(const Event& event) {
  const Answer answer = (*respond_)(event);
  const auto check = [&](BodyId body, const std::optional<Vec3>& velocity,
                         std::string_view argument) -> Result<void> {
    if (!velocity) return {};
    const std::string call =
        "run: respond: " + std::string(argument) + " at " + std::string(kinesphere::name_of(event.kind));
    if (body == no_body)
      return Error{ErrorCode::unknown_body, std::string(argument), no_body,
                   call + ": there is no such body in this event"};
    auto valid = check_velocity(*velocity, body, bodies().definition(), call);
    if (valid) return valid;
    Error error = valid.error();
    error.argument = argument;
    return error;
  };
  auto valid = check(event.first, answer.first_velocity, "first_velocity");
  if (valid) valid = check(event.second, answer.second_velocity, "second_velocity");
  if (!valid) return valid.error();
  return answer;
}

}  // namespace kinesphere
