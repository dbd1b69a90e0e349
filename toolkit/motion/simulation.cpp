// Simulation: owns a world, its motions and the map between them; clones them together.
#include "kinesphere/simulation.hpp"

#include <string>
#include <typeinfo>

namespace kinesphere {

namespace {

bool is_same_class(const Motion* first, const Motion* second) {
  return second != nullptr && typeid(*first) == typeid(*second);
}

}  // namespace

Simulation::Simulation(World world) : world_(std::move(world)), bodies_(std::make_unique<BodyMap>()) {}

Result<Simulation> Simulation::clone() const {
  if (const auto error = moved_from("clone")) return *error;
  auto world = world_.clone();
  if (!world) return world.error();
  Simulation copy(std::move(*world));
  std::vector<Motion*> from, to;
  for (const auto& motion : motions_) {
    auto cloned = motion->clone();
    from.push_back(motion.get());
    to.push_back(cloned.get());
    copy.motions_.push_back(std::move(cloned));
    if (is_same_class(from.back(), to.back())) continue;
    return Error{ErrorCode::unsupported, "motion", no_body,
                 "Simulation::clone: motion " + std::to_string(from.size() - 1) +
                     " must have a clone() that returns its own class, but its clone() returned " +
                     (to.back() == nullptr ? "null" : "another class")};
  }
  copy.bodies_ = bodies_->with_motions(from, to).value();
  copy.ids_ = ids_;
  return copy;
}

std::uint32_t Simulation::own(std::unique_ptr<Motion> motion) {
  (void)known_bodies("add_motion");
  motions_.push_back(std::move(motion));
  ids_.emplace_back();
  return static_cast<std::uint32_t>(motions_.size() - 1);
}

std::optional<Error> Simulation::moved_from(std::string_view call) const {
  if (bodies_) return std::nullopt;
  return Error{ErrorCode::moved_from, "simulation", no_body,
               "Simulation::" + std::string(call) + ": the simulation has been moved from"};
}

std::optional<Error> Simulation::wrong_motion(std::string_view call, MotionId<> motion) const {
  if (const auto error = moved_from(call)) return error;
  if (motion.index < motions_.size()) return std::nullopt;
  return Error{
      ErrorCode::out_of_range, "motion", no_body,
      "Simulation::" + std::string(call) + ": motion must have been added to this simulation, which has " +
          std::to_string(motions_.size()) + " motions, but is motion " + std::to_string(motion.index)};
}

const Motion& Simulation::known_motion(std::uint32_t index) const {
  if (const auto error = wrong_motion("motion", {index})) [[unlikely]]
    detail::bad_result(*error);
  return *motions_[index];
}

void Simulation::refuse_motion(std::uint32_t index) const {
  detail::bad_result({ErrorCode::out_of_range, "motion", no_body,
                      "Simulation::motion: motion " + std::to_string(index) +
                          " must be of the class of its id, but is of another one: the id is that of another "
                          "simulation"});
}

const BodyMap& Simulation::known_bodies(std::string_view call) const {
  if (const auto error = moved_from(call)) [[unlikely]]
    detail::bad_result(*error);
  return *bodies_;
}

void Simulation::remember(MotionId<> motion, std::span<const BodyId> bodies) {
  std::vector<BodyId>& ids = ids_[motion.index];
  for (const BodyId body : bodies) {
    const std::uint32_t number = bodies_->find(body)->number;
    if (number >= ids.size()) ids.resize(std::size_t{number} + 1, no_body);
    ids[number] = body;
  }
}

Result<BodyId> Simulation::add(MotionId<> motion, std::uint32_t number, const BodyDefinition& like) {
  if (const auto error = wrong_motion("add", motion)) return *error;
  auto body = bodies_->add(world_, *motions_[motion.index], number, like);
  if (body) remember(motion, {&*body, 1});
  return body;
}

Result<std::vector<BodyId>> Simulation::add_all(MotionId<> motion, const BodyDefinition& like) {
  if (const auto error = wrong_motion("add_all", motion)) return *error;
  auto bodies = bodies_->add_all(world_, *motions_[motion.index], like);
  if (bodies) remember(motion, *bodies);
  return bodies;
}

Result<std::vector<BodyId>> Simulation::add_with_radii(MotionId<> motion, std::span<const double> radii,
                                                       const BodyDefinition& like) {
  if (const auto error = wrong_motion("add_all", motion)) return *error;
  auto bodies = bodies_->add_all(world_, *motions_[motion.index], radii, like);
  if (bodies) remember(motion, *bodies);
  return bodies;
}

Result<void> Simulation::set_velocity(BodyId body, const Vec3& velocity) {
  if (const auto error = moved_from("set_velocity")) return *error;
  return bodies_->set_velocity(world_, body, velocity);
}

Result<void> Simulation::teleport(BodyId body, const State& state) {
  if (const auto error = moved_from("teleport")) return *error;
  return bodies_->teleport(world_, body, state);
}

Result<void> Simulation::remove(BodyId body) {
  if (const auto error = moved_from("remove")) return *error;
  const auto moved = find(body);
  auto removed = bodies_->remove(world_, body);
  if (removed && moved && ids_[moved->motion.index][moved->number] == body)
    ids_[moved->motion.index][moved->number] = no_body;
  return removed;
}

Result<void> Simulation::push(MotionId<FrameMotion> frames, std::span<const Vec3> positions,
                              std::optional<double> time) {
  if (const auto error = wrong_motion("push", frames)) return *error;
  return bodies_->push(world_, motion(frames), positions, time);
}

State Simulation::state(BodyId body, double time) const { return known_bodies("state").state(body, time); }

std::optional<SimulatedBody> Simulation::find(BodyId body) const {
  const auto moved = known_bodies("find").find(body);
  if (!moved) return std::nullopt;
  std::uint32_t index = 0;
  while (motions_[index].get() != moved->motion) ++index;
  return SimulatedBody{{index}, moved->number};
}

std::optional<BodyId> Simulation::body_of(MotionId<> motion, std::uint32_t number) const {
  if (const auto error = wrong_motion("body_of", motion)) [[unlikely]]
    detail::bad_result(*error);
  const std::vector<BodyId>& ids = ids_[motion.index];
  if (number >= ids.size() || ids[number] == no_body || !world_.contains(ids[number])) return std::nullopt;
  return ids[number];
}

Result<std::optional<Event>> Simulation::advance(double until) {
  if (const auto error = moved_from("advance")) return *error;
  return world_.advance(until, bodies_->probe());
}

EventRange Simulation::events(double until) & { return world_.events(until, known_bodies("events").probe()); }

Result<void> Simulation::run(double until, const ResponseFn& respond, const EventFn& sink, Workers* workers) {
  if (const auto error = moved_from("run")) return *error;
  BodyMap::MapSource source = bodies_->source();
  const auto receive = [&](const Event& event) {
    bodies_->remove_gone(world_, event, respond).value();
    sink(event);
  };
  return world_.run(until, source, respond, sink ? EventFn(receive) : EventFn(), workers);
}

}  // namespace kinesphere
