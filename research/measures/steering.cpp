#include "research/measures/steering.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "kinesphere/body_map.hpp"
#include "kinesphere/game_world.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/workers.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {
namespace steering {
namespace {

constexpr double radius = 0.5, frames_per_second = 60.0;

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The crowd in its room, which keeps it in by itself.
class Crowd {
 public:
  explicit Crowd(const SteeringSettings& settings) : settings_(settings), random_(settings.seed) {
    const double ball = settings.dimensions == 3
                            ? 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius
                            : 3.14159265358979323846 * radius * radius;
    const double size = settings.bodies * ball / settings.packing;
    edge_ = settings.dimensions == 3 ? std::cbrt(size) : std::sqrt(size);
    const double places =
        std::ceil(settings.dimensions == 3 ? std::cbrt(settings.bodies) : std::sqrt(settings.bodies));
    const auto row = static_cast<std::uint32_t>(places);
    for (std::uint32_t k = 0; k < settings.bodies; ++k) {
      const std::uint32_t plane = settings.dimensions == 3 ? row * row : settings.bodies;
      const Vec3 place{k % row + 0.5, k % plane / row + 0.5, k / plane + 0.5};
      positions_.push_back(place * (edge_ / places));
      velocities_.push_back(5.0 * point());
    }
    if (settings.dimensions == 2)
      for (Vec3& position : positions_) position.z = 0.0;
  }

  double edge() const { return edge_; }
  const std::vector<Vec3>& positions() const { return positions_; }
  const std::vector<Vec3>& velocities() const { return velocities_; }

  /// Chooses new velocities. Who has left the room turns back.
  void steer() {
    for (std::uint32_t k = 0; k < settings_.bodies; ++k) {
      Vec3& velocity = velocities_[k];
      velocity = velocity * 0.95 + point();
      for (int axis = 0; axis < settings_.dimensions; ++axis) {
        if (positions_[k][axis] < 0.0) velocity[axis] = std::abs(velocity[axis]);
        if (positions_[k][axis] > edge_) velocity[axis] = -std::abs(velocity[axis]);
      }
    }
  }
  void move() {
    for (std::uint32_t k = 0; k < settings_.bodies; ++k)
      positions_[k] += velocities_[k] * (1.0 / frames_per_second);
  }

 private:
  Vec3 point() {
    Vec3 point = random_.point_in_ball();
    if (settings_.dimensions == 2) point.z = 0.0;
    return point;
  }

  SteeringSettings settings_;
  Random random_;
  double edge_ = 0.0;
  std::vector<Vec3> positions_, velocities_;
};

void keep_each_once(std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// Hears what the world tells until this time.
void listen(World& world, double until, const Probe& probe, SteeredFrames& steered) {
  for (const Event& event : world.events(until, probe))
    steered.pairs.emplace_back(event.first.index, event.second.index);
}

std::vector<BodyDefinition> bodies_of(const Crowd& crowd) {
  std::vector<BodyDefinition> bodies;
  for (std::size_t k = 0; k < crowd.positions().size(); ++k)
    bodies.push_back({.radius = radius, .position = crowd.positions()[k], .velocity = crowd.velocities()[k]});
  return bodies;
}

SteeredFrames steer_by_velocities(Crowd& crowd, World& world, std::uint32_t frames, int threads) {
  Workers workers = Workers::create(threads).value();
  world.use_workers(&workers, true).value();
  const std::vector<BodyId> ids = world.add_all(bodies_of(crowd)).value();
  double began = 0.0;
  const Probe probe = [&](std::span<const BodyId> asked, double time, std::span<State> states) {
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const Vec3& velocity = crowd.velocities()[asked[k].index];
      states[k] = {crowd.positions()[asked[k].index] + velocity * (time - began), velocity};
    }
  };
  SteeredFrames steered;
  listen(world, 0.0, probe, steered);
  for (std::uint32_t frame = 1; frame <= frames; ++frame) {
    crowd.steer();
    const double begin = cpu_seconds(), wall_begin = wall_seconds();
    world.set_velocities(ids, crowd.velocities()).value();
    listen(world, frame / frames_per_second, probe, steered);
    steered.seconds.push_back(cpu_seconds() - begin);
    steered.wall_seconds.push_back(wall_seconds() - wall_begin);
    crowd.move();
    began = world.time();
  }
  return steered;
}

SteeredFrames steer_by_frames(Crowd& crowd, World& world, std::uint32_t frames) {
  FrameMotion motion =
      FrameMotion::create({.start = crowd.positions(), .velocities = crowd.velocities()}).value();
  BodyMap bodies;
  bodies.add_all(world, motion, {.radius = radius}).value();
  SteeredFrames steered;
  listen(world, 0.0, bodies.probe(), steered);
  for (std::uint32_t frame = 1; frame <= frames; ++frame) {
    crowd.steer();
    crowd.move();
    const double begin = cpu_seconds();
    bodies.push(world, motion, crowd.positions()).value();
    listen(world, motion.latest_time(), bodies.probe(), steered);
    steered.seconds.push_back(cpu_seconds() - begin);
  }
  return steered;
}

SteeredFrames steer_game(Crowd& crowd, const WorldDefinition& world, std::uint32_t frames) {
  GameWorld game = GameWorld::create({.world = world}).value();
  for (const BodyDefinition& body : bodies_of(crowd)) game.add(body).value();
  SteeredFrames steered;
  double latest = 0.0;
  for (std::uint32_t frame = 1; frame <= frames; ++frame) {
    crowd.steer();
    const double begin = cpu_seconds();
    game.set_velocities(crowd.velocities()).value();
    const double next = frame / frames_per_second;
    for (const Event& event : game.step(next - latest).value())
      steered.pairs.emplace_back(event.first.index, event.second.index);
    steered.seconds.push_back(cpu_seconds() - begin);
    latest = next;
    crowd.move();
  }
  return steered;
}

}  // namespace
}  // namespace steering

SteeredFrames steer_world(const SteeringSettings& settings, SteeringBy by) {
  steering::Crowd crowd(settings);
  const WorldDefinition definition{.dimensions = settings.dimensions, .contacts = ContactEvents::impacts};
  World world = World::create(definition).value();
  SteeredFrames steered = by == SteeringBy::velocities
                              ? steering::steer_by_velocities(crowd, world, settings.frames, settings.threads)
                          : by == SteeringBy::frames
                              ? steering::steer_by_frames(crowd, world, settings.frames)
                              : steering::steer_game(crowd, definition, settings.frames);
  steering::keep_each_once(steered.pairs);
  return steered;
}

SteeredFrames steer_grid(const SteeringSettings& settings) {
  steering::Crowd crowd(settings);
  UniformGrid grid(crowd.edge(), settings.dimensions, 2.0 * steering::radius, settings.bodies);
  SteeredFrames steered;
  for (std::uint32_t frame = 0; frame < settings.frames; ++frame) {
    crowd.steer();
    crowd.move();
    const double begin = steering::cpu_seconds();
    grid.find(crowd.positions(), steered.pairs);
    steered.seconds.push_back(steering::cpu_seconds() - begin);
  }
  steering::keep_each_once(steered.pairs);
  return steered;
}

UniformGrid::UniformGrid(double edge, int dimensions, double diameter, std::size_t balls)
    : dimensions_(dimensions), square_(diameter * diameter) {
  // About one ball in a cell, which is no narrower than a ball.
  const double count = static_cast<double>(balls);
  const double wanted = dimensions == 3 ? std::cbrt(count) : std::sqrt(count);
  cells_ = static_cast<std::size_t>(std::max(1.0, std::floor(std::min(wanted, edge / diameter))));
  cells_per_length_ = static_cast<double>(cells_) / edge;
}

/// Cells at the border have all that is beyond them.
std::size_t UniformGrid::cell_along(double coordinate) const {
  const double cell = std::floor(coordinate * cells_per_length_);
  return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells_ - 1)));
}

void UniformGrid::find(std::span<const Vec3> centres,
                       std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  const std::size_t layers = dimensions_ == 3 ? cells_ : 1;
  starts_.assign(cells_ * cells_ * layers + 1, 0);
  cell_of_.resize(centres.size());
  sorted_.resize(centres.size());
  centres_.resize(centres.size());
  for (std::size_t k = 0; k < centres.size(); ++k) {
    const std::size_t layer = dimensions_ == 3 ? cell_along(centres[k].z) : 0;
    cell_of_[k] = (layer * cells_ + cell_along(centres[k].y)) * cells_ + cell_along(centres[k].x);
    ++starts_[cell_of_[k]];
  }
  for (std::size_t cell = 1; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
  for (std::size_t k = centres.size(); k-- > 0;) {
    const std::size_t place = --starts_[cell_of_[k]];
    sorted_[place] = static_cast<std::uint32_t>(k);
    centres_[place] = centres[k];
  }
  const auto meet = [&](std::size_t one, std::size_t other) {
    if (norm_squared(centres_[one] - centres_[other]) < square_)
      pairs.emplace_back(std::minmax(sorted_[one], sorted_[other]));
  };
  for (std::size_t place = 0; place < sorted_.size(); ++place) {
    const std::size_t cell = cell_of_[sorted_[place]];
    const std::size_t x = cell % cells_, y = cell / cells_ % cells_, z = cell / cells_ / cells_;
    // The rest of the row, and the rows behind it.
    const auto row = [&](std::size_t of_y, std::size_t of_z, std::size_t first) {
      const std::size_t begin = (of_z * cells_ + of_y) * cells_;
      for (std::size_t other = first; other < starts_[begin + std::min(x + 2, cells_)]; ++other)
        meet(place, other);
    };
    row(y, z, place + 1);
    const auto from = [&](std::size_t of_y, std::size_t of_z) {
      return starts_[(of_z * cells_ + of_y) * cells_ + (x > 0 ? x - 1 : 0)];
    };
    if (y + 1 < cells_) row(y + 1, z, from(y + 1, z));
    if (z + 1 < layers)
      for (std::size_t near = y > 0 ? y - 1 : 0; near < std::min(y + 2, cells_); ++near)
        row(near, z + 1, from(near, z + 1));
  }
}

}  // namespace kinesphere
