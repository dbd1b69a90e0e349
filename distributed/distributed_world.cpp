#include "kinesphere/distributed/distributed_world.hpp"

#include <utility>

#include "archive/archive.hpp"
#include "bodies/validation.hpp"
#include "distributed/rank_engine.hpp"

namespace kinesphere {

bool operator<(const OrderedEvent& a, const OrderedEvent& b) {
  if (a.event.time != b.event.time) return a.event.time < b.event.time;
  return a.round != b.round ? a.round < b.round : delivered_before(a.event, b.event);
}

DistributedWorld::DistributedWorld(std::unique_ptr<RankEngine> domain) : engine_(std::move(domain)) {}
DistributedWorld::DistributedWorld(DistributedWorld&&) noexcept = default;
DistributedWorld& DistributedWorld::operator=(DistributedWorld&&) noexcept = default;
DistributedWorld::~DistributedWorld() = default;

Result<DistributedWorld> DistributedWorld::create(const WorldDefinition& definition, Motion& motion,
                                                  std::optional<int> communicator) {
  if (auto usable = Communicator::check(communicator, "create"); !usable) return usable.error();
  const auto valid = [&]() -> Result<void> {
    if (auto checked = check_world(definition); !checked) return checked;
    if (auto checked = check_no_shear(definition, "create"); !checked) return checked;
    if (!definition.allow_overlap)
      return Error{ErrorCode::unsupported, "allow_overlap", no_body,
                   "create: allow_overlap must be true in a distributed world, but is false"};
    return {};
  };
  const auto checked = valid();
  // An invalid definition is replaced by the default one, because the error has to reach all ranks through
  // the engine's communicator.
  auto domain = std::make_unique<RankEngine>(checked ? definition : WorldDefinition{}, motion, communicator);
  if (auto agreed = domain->agree(checked); !agreed) return agreed.error();
  return DistributedWorld(std::move(domain));
}

Result<void> DistributedWorld::add(std::uint32_t index, const BodyDefinition& body,
                                   std::uint32_t number_in_motion) {
  return engine_->add(index, body, number_in_motion);
}

Result<void> DistributedWorld::add_rigid_body(std::uint32_t index, const RigidBody& body,
                                              std::uint32_t number_in_motion) {
  return engine_->add_rigid_body(index, body, number_in_motion);
}

Result<void> DistributedWorld::add_moving_shape(std::uint32_t index, const MovingShape& body,
                                                std::uint32_t number_in_motion) {
  return engine_->add_moving_shape(index, body, number_in_motion);
}

Result<void> DistributedWorld::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  return engine_->set_sensor(sensor_class, sensor);
}

Result<void> DistributedWorld::set_pair_state(std::uint32_t first, std::uint32_t second, std::int32_t state) {
  return engine_->set_pair_state(first, second, state);
}

Result<void> DistributedWorld::run(double until, const ResponseFn& respond, const OrderedEventFn& sink,
                                   Workers* workers) {
  return engine_->run(until, &respond, sink, workers);
}

Result<void> DistributedWorld::run(double until, const OrderedEventFn& sink, Workers* workers) {
  return engine_->run(until, nullptr, sink, workers);
}

Result<std::vector<std::byte>> DistributedWorld::save() { return engine_->save(); }

Result<DistributedWorld> DistributedWorld::restore(std::span<const std::vector<std::byte>> parts,
                                                   Motion& motion, std::optional<int> communicator) {
  if (auto usable = Communicator::check(communicator, "restore"); !usable) return usable.error();
  auto domain = RankEngine::restore(parts, motion, communicator);
  if (!domain) return domain.error();
  return DistributedWorld(std::move(*domain));
}

double DistributedWorld::time() const { return engine_->time(); }
int DistributedWorld::rank() const { return engine_->communicator().rank(); }
int DistributedWorld::ranks() const { return engine_->communicator().ranks(); }
const WorldDefinition& DistributedWorld::definition() const { return engine_->definition(); }

std::uint64_t DistributedWorld::size() const { return engine_->communicator().sum(engine_->own_bodies()); }

Counters DistributedWorld::counters() const {
  ByteWriter writer;
  writer(engine_->counters());
  Counters all;
  for (const auto& bytes : engine_->communicator().gather(writer.bytes())) {
    Counters some;
    ByteReader reader(bytes);
    reader(some);
    all += some;
  }
  return all;
}

EventHash DistributedWorld::hash() const {
  auto parts = engine_->hash().parts();
  engine_->communicator().sum(parts);
  return EventHash::of(parts);
}

RankFigures DistributedWorld::figures() const { return engine_->figures(); }

}  // namespace kinesphere
