#include "support/differential_scenes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "kinesphere/motion/piecewise_motion.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/random.hpp"
#include "simulation/scene/make_scene.hpp"

namespace kinesphere::scene_tests {
namespace {

using MotionKind = SceneParameters::MotionKind;

std::uint32_t whole(Random& random, std::uint32_t least, std::uint32_t greatest) {
  return least + static_cast<std::uint32_t>(random.bits() % (greatest - least + 1));
}

double either(Random& random, double a, double b) { return random.bits() % 2 == 0 ? a : b; }

SceneParameters pass_through(Random& random, MotionKind motion) {
  SceneParameters p;
  p.motion = motion;
  p.response = SceneResponse::pass_through;
  p.bodies = whole(random, 2, 60);
  p.seed = random.bits();
  p.seconds = random.uniform(1.0, 6.0);
  p.walls = random.bits() % 2 == 0;
  const double edge = random.uniform(30.0, 200.0);
  p.box = {{0, 0, 0}, {edge, edge, edge}};
  p.radius_max = random.uniform(0.2, 4.0);
  p.radius_min = p.radius_max * random.uniform(0.01, 1.0);
  p.contact_tolerance = either(random, 1e-6, 1e-9);
  return p;
}

Scene random_forces(Random& random) {
  SceneParameters p = pass_through(random, MotionKind::random_forces);
  p.redraw_interval = random.uniform(0.05, 0.6);
  p.limit_min = random.uniform(0.0, 20.0);
  p.limit_max = p.limit_min + random.uniform(0.0, 60.0);
  return make_scene(p).value();
}

Scene velocity_field(Random& random) {
  SceneParameters p = pass_through(random, MotionKind::velocity_field);
  p.redraw_interval = 0.1;
  p.speed_max = random.uniform(5.0, 60.0);
  p.limit_min = p.limit_max = 30.0;
  return make_scene(p).value();
}

Scene ballistic(Random& random) {
  SceneParameters p = pass_through(random, MotionKind::ballistic);
  p.gravity = {0.0, 0.0, either(random, 0.0, -9.81)};
  p.speed_min = either(random, 0.0, p.speed_min);
  p.box.upper = p.box.upper * 0.4;
  p.radius_max = std::min(p.radius_max, 0.05 * p.box.upper.x);
  p.radius_min = std::min(p.radius_min, p.radius_max);
  return make_scene(p).value();
}

Scene mixed_radii(Random& random) {
  SceneParameters p = pass_through(random, MotionKind::random_forces);
  p.bodies = whole(random, 20, 80);
  p.box = {{-100, -100, -100}, {100, 100, 100}};
  p.radius_min = 0.03;
  p.radius_max = 0.1;
  Scene scene = make_scene(p).value();
  // Large bodies may overlap others from the start; these contacts begin at once.
  for (std::uint32_t body = 0; body < 3; ++body) scene.bodies[body].radius = random.uniform(10.0, 30.0);
  return scene;
}

Scene points(Random& random) {
  Scene scene = random_forces(random);
  for (SceneBody& body : scene.bodies)
    if (random.bits() % 3 == 0) body.radius = 0.0;
  return scene;
}

/// Grows the trajectories of all bodies piece by piece.
class Course {
 public:
  explicit Course(std::vector<State> start) : states_(std::move(start)), trajectories_(states_.size()) {}

  const std::vector<State>& states() const { return states_; }
  double time() const { return time_; }

  void go_on(double duration, const std::vector<Vec3>& accelerations) {
    for (std::size_t body = 0; body < states_.size(); ++body) {
      const Segment piece{
          time_, time_ + duration, states_[body].position, states_[body].velocity, accelerations[body], {}};
      trajectories_[body].push_back(piece);
      states_[body] = piece.state_at(piece.end);
    }
    time_ += duration;
  }

  Scene scene(const std::vector<double>& radii) && {
    Scene scene;
    scene.end_time = time_;
    for (const double radius : radii) scene.bodies.push_back({.radius = radius});
    scene.motion =
        std::make_unique<PiecewiseMotion>(PiecewiseMotion::create(std::move(trajectories_)).value());
    return scene;
  }

 private:
  double time_ = 0.0;
  std::vector<State> states_;
  std::vector<Trajectory> trajectories_;
};

std::vector<State> scattered(Random& random, std::uint32_t count, double reach, double speed) {
  std::vector<State> states;
  for (std::uint32_t body = 0; body < count; ++body)
    states.push_back({random.point_in_ball() * reach, random.point_in_ball() * speed});
  return states;
}

std::vector<double> radii_up_to(Random& random, std::uint32_t count, double greatest) {
  std::vector<double> radii;
  for (std::uint32_t body = 0; body < count; ++body)
    radii.push_back(random.uniform(0.01 * greatest, greatest));
  return radii;
}

std::size_t nearest_to(const std::vector<State>& states, std::size_t body) {
  std::size_t nearest = body;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < states.size(); ++other) {
    const double distance = norm_squared(states[other].position - states[body].position);
    if (other == body || distance >= least) continue;
    least = distance;
    nearest = other;
  }
  return nearest;
}

Vec3 direction(const Vec3& vector) {
  const double length = norm(vector);
  return length > 0.0 ? vector / length : Vec3{1, 0, 0};
}

Scene pursuit(Random& random) {
  const std::uint32_t count = whole(random, 2, 30);
  Course course(scattered(random, count, 20.0, either(random, 0.0, 5.0)));
  const double limit = random.uniform(1.0, 40.0);
  const double interval = random.uniform(0.02, 0.3);
  while (course.time() < 4.0) {
    std::vector<Vec3> accelerations;
    for (std::size_t body = 0; body < count; ++body) {
      const std::size_t prey = nearest_to(course.states(), body);
      accelerations.push_back(direction(course.states()[prey].position - course.states()[body].position) *
                              limit);
    }
    course.go_on(interval, accelerations);
  }
  return std::move(course).scene(radii_up_to(random, count, 1.0));
}

Scene bang_bang(Random& random) {
  const std::uint32_t count = 2 * whole(random, 1, 12);
  Course course(scattered(random, count, 25.0, 0.0));
  std::vector<Vec3> towards;
  std::vector<double> limits;
  for (std::size_t body = 0; body < count; ++body) {
    towards.push_back(direction(course.states()[body ^ 1].position - course.states()[body].position));
    limits.push_back(random.uniform(0.1, 30.0));
  }
  double sign = 1.0;
  while (course.time() < 5.0) {
    std::vector<Vec3> accelerations;
    for (std::size_t body = 0; body < count; ++body)
      accelerations.push_back(towards[body] * (sign * limits[body]));
    course.go_on(random.uniform(0.05, 1.0), accelerations);
    sign = -sign;
  }
  return std::move(course).scene(radii_up_to(random, count, 2.0));
}

Scene grazing(Random& random) {
  const std::uint32_t pairs = whole(random, 1, 12);
  std::vector<State> start;
  std::vector<double> radii;
  std::vector<Vec3> accelerations;
  for (std::uint32_t pair = 0; pair < pairs; ++pair) {
    // Two bodies that are nearest at `meeting`, with this gap between them; each pair has a region of its
    // own.
    const Vec3 centre = Vec3{1000.0 * pair, 0, 0} + random.point_in_ball();
    const Vec3 along = random.unit_vector();
    const Vec3 aside =
        direction(along.x * along.x < 0.5 ? Vec3{0, along.z, -along.y} : Vec3{-along.z, 0, along.x});
    const double size = either(random, 1.0, 1e-3);
    double gap = size;
    for (std::uint32_t k = whole(random, 3, 12); k > 0; --k) gap *= 0.1;
    gap = either(random, gap, -gap);
    const double meeting = random.uniform(0.5, 3.5);
    const double speed = random.uniform(0.1, 20.0);
    const double radius_a = random.uniform(0.1, 1.0) * size;
    const double radius_b = random.uniform(0.1, 1.0) * size;
    const Vec3 distance = aside * (radius_a + radius_b + gap);
    // A common acceleration bends both paths and leaves the gap unchanged.
    const Vec3 common = random.point_in_ball() * either(random, 0.0, 10.0);
    start.push_back({centre - along * (speed * meeting), along * speed});
    start.push_back({centre + distance + along * (speed * meeting), along * -speed});
    for (const double radius : {radius_a, radius_b}) {
      radii.push_back(radius);
      accelerations.push_back(common);
    }
  }
  Course course(std::move(start));
  course.go_on(4.0, accelerations);
  Scene scene = std::move(course).scene(radii);
  scene.world.contact_tolerance = either(random, 1e-6, 1e-8);
  return scene;
}

Scene at_rest(Random& random) {
  const std::uint32_t count = whole(random, 5, 50);
  std::vector<State> start = scattered(random, count, 15.0, 0.0);
  std::vector<Vec3> accelerations(count);
  for (std::uint32_t visitor = 0; visitor < 3; ++visitor) {
    start[visitor].velocity =
        direction(start[visitor + 1].position - start[visitor].position) * random.uniform(0.0, 20.0);
    accelerations[visitor] = random.point_in_ball() * either(random, 0.0, 3.0);
  }
  Course course(std::move(start));
  course.go_on(5.0, accelerations);
  return std::move(course).scene(radii_up_to(random, count, 1.5));
}

Scene bullets(Random& random) {
  const std::uint32_t count = whole(random, 10, 60);
  std::vector<State> start = scattered(random, count, 50.0, 1.0);
  for (std::uint32_t bullet = 0; bullet < 5; ++bullet) start[bullet].velocity = random.unit_vector() * 1000.0;
  Course course(std::move(start));
  for (int leg = 0; leg < 10; ++leg) {
    std::vector<Vec3> accelerations;
    for (std::uint32_t body = 0; body < count; ++body) accelerations.push_back(random.point_in_ball() * 2.0);
    course.go_on(0.1, accelerations);
    // Bullets that have passed return towards another body.
    for (std::uint32_t bullet = 0; bullet < 5; ++bullet)
      accelerations[bullet] = course.states()[bullet].velocity * -20.0;
    course.go_on(0.1, accelerations);
  }
  return std::move(course).scene(radii_up_to(random, count, 2.0));
}

Scene tracks(Random& random) {
  const std::uint32_t count = whole(random, 2, 40);
  std::vector<Track> samples(count);
  Scene scene;
  for (Track& track : samples) {
    const double appears = random.uniform(0.0, 3.0);
    const int length = static_cast<int>(whole(random, 2, 20));
    const State state{random.point_in_ball() * 3.0, random.point_in_ball() * 3.0};
    for (int k = 0; k < length; ++k) {
      const double s = 0.2 * k;
      track.push_back({appears + s, state.position + state.velocity * s + random.point_in_ball() * 0.1});
    }
    scene.bodies.push_back(
        {.radius = random.uniform(0.05, 0.5), .appears = track.front().time, .vanishes = track.back().time});
    scene.end_time = std::max(scene.end_time, track.back().time);
  }
  scene.motion = std::make_unique<RecordedTracks>(RecordedTracks::create(samples).value());
  return scene;
}

Scene far_away(Random& random) {
  const std::uint32_t count = whole(random, 4, 40);
  std::vector<State> start = scattered(random, count, 10.0, 10.0);
  for (std::uint32_t body = 0; body < count; body += 2) start[body].position += Vec3{1e6, -1e6, 1e6};
  Course course(std::move(start));
  for (int leg = 0; leg < 8; ++leg) {
    std::vector<Vec3> accelerations;
    for (std::uint32_t body = 0; body < count; ++body) accelerations.push_back(random.point_in_ball() * 30.0);
    course.go_on(0.25, accelerations);
  }
  return std::move(course).scene(radii_up_to(random, count, 1.0));
}

}  // namespace

std::string_view name_of(Family family) {
  static constexpr std::array<std::string_view, static_cast<std::size_t>(Family::count)> names{
      "random_forces", "velocity_field", "ballistic", "mixed_radii", "pursuit", "bang_bang",
      "grazing",       "at_rest",        "bullets",   "points",      "tracks",  "far_away"};
  return names[static_cast<std::size_t>(family)];
}

Scene differential_scene(Family family, std::uint64_t seed) {
  static constexpr std::array<Scene (*)(Random&), static_cast<std::size_t>(Family::count)> makers{
      random_forces, velocity_field, ballistic, mixed_radii, pursuit, bang_bang,
      grazing,       at_rest,        bullets,   points,      tracks,  far_away};
  Random random = Random::at(2005, static_cast<std::uint64_t>(family), seed);
  Scene scene = makers[static_cast<std::size_t>(family)](random);
  scene.name = std::string(name_of(family)) + " " + std::to_string(seed);
  return scene;
}

}  // namespace kinesphere::scene_tests
