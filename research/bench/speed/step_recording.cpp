#include "research/bench/speed/step_recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/program_error.hpp"
#include "contact/contact_event.hpp"
#include "kinesphere/response.hpp"
#include "research/bench/speed/tuning.hpp"

namespace kinesphere::program {
namespace {

std::vector<State> states_at(const Motion& motion, std::size_t bodies, double time) {
  std::vector<State> states(bodies);
  for (std::uint32_t body = 0; body < bodies; ++body) states[body] = motion.state(body, time);
  return states;
}

/// Returns the bodies in the order of strips, two mean distances wide.
std::vector<std::uint32_t> along_strips(const std::vector<State>& states) {
  std::vector<std::uint32_t> order(states.size());
  std::iota(order.begin(), order.end(), 0u);
  const double edge = 2.0 * mean_distance(states);
  const auto key = [&](std::uint32_t body) {
    const Vec3& at = states[body].position;
    return std::tuple(std::floor(at.z / edge), std::floor(at.y / edge), at.x);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return order;
}

class StepRecorder {
 public:
  StepRecorder(const Scene& scene, double step, SphereTest test, const TouchObserver& observer)
      : scene_(scene), motion_(scene.motion->clone()), observer_(observer) {
    const std::vector<State> start = states_at(*motion_, scene.bodies.size(), scene.world.start_time);
    order_ = along_strips(start);
    recording_.step = step;
    recording_.test = test;
    recording_.box = scene.world.box;
    for (const std::uint32_t body : order_)
      recording_.radii.push_back(static_cast<float>(scene.bodies[body].radius));
    kernel_ = make_grid_kernel(recording_.radii, usual_strips(mean_distance(start)), test);
  }

  StepRecording run(std::size_t steps) {
    look_at(0);
    for (std::size_t step = 1; step <= steps; ++step) {
      look_at(step);
      answer(step);
    }
    return std::move(recording_);
  }

 private:
  double time_of(std::size_t step) const {
    return scene_.world.start_time + static_cast<double>(step) * recording_.step;
  }

  void look_at(std::size_t step) {
    if (observer_ && step >= 2) {
      // Only the last two frames are needed.
      for (auto* const frames : {&recording_.x, &recording_.y, &recording_.z}) (*frames)[step - 2] = {};
    }
    const std::size_t bodies = order_.size();
    for (auto* const frames : {&recording_.x, &recording_.y, &recording_.z}) frames->emplace_back(bodies);
    for (std::size_t at = 0; at < bodies; ++at) {
      const Vec3 position = motion_->state(order_[at], time_of(step)).position;
      recording_.x.back()[at] = static_cast<float>(position.x);
      recording_.y.back()[at] = static_cast<float>(position.y);
      recording_.z.back()[at] = static_cast<float>(position.z);
    }
  }

  void answer(std::size_t step) {
    touching_.clear();
    kernel_->look(recording_.frame(step - 1), recording_.frame(step), touching_);
    // The order of answers matters, and kernels guarantee none.
    std::sort(touching_.begin(), touching_.end(), [](const SpherePair& a, const SpherePair& b) {
      return std::tuple(std::min(a.first, a.second), std::max(a.first, a.second)) <
             std::tuple(std::min(b.first, b.second), std::max(b.first, b.second));
    });
    for (const SpherePair& pair : touching_) answer_pair(step, pair);
    if (!recording_.box) return;
    at_walls_.clear();
    find_at_walls(recording_.frame(step), recording_.radii, *recording_.box, at_walls_);
    for (const std::uint32_t body : at_walls_) answer_walls(step, body);
  }

  Sphere sphere(std::uint32_t body, double time) const {
    return {{body, 0}, scene_.bodies[body].radius, motion_->state(body, time)};
  }

  void answer_pair(std::size_t step, const SpherePair& pair) {
    const std::uint32_t first = order_[pair.first], second = order_[pair.second];
    if (observer_) observer_(step, std::min(first, second), std::max(first, second), Wall::none);
    const double time = time_of(step);
    Sphere a = sphere(first, time), b = sphere(second, time);
    if (recording_.test == SphereTest::swept) {
      // The direction of a bounce is that of the first touch.
      const double fraction = first_touch(pair);
      a.state.position = position_between(step, pair.first, fraction);
      b.state.position = position_between(step, pair.second, fraction);
    }
    answer(contact_event(EventKind::contact_begin, time, a, b));
  }

  void answer_walls(std::size_t step, std::uint32_t at) {
    const std::uint32_t body = order_[at];
    for (const Wall wall : walls) {
      const double time = time_of(step);
      const Event event = wall_event(EventKind::wall_begin, time, sphere(body, time), *recording_.box, wall);
      if (event.gap > 0.0) continue;
      if (observer_) observer_(step, body, body, wall);
      answer(event);
    }
  }

  Vec3 position_between(std::size_t step, std::uint32_t at, double fraction) const {
    const auto place = [&](const Frame& frame) { return Vec3{frame.x[at], frame.y[at], frame.z[at]}; };
    return place(recording_.frame(step - 1)) * (1.0 - fraction) + place(recording_.frame(step)) * fraction;
  }

  /// Returns the fraction of the last step after which the pair first touched.
  double first_touch(const SpherePair& pair) const {
    const std::size_t step = recording_.steps();
    const Vec3 begin = position_between(step, pair.second, 0.0) - position_between(step, pair.first, 0.0);
    const Vec3 end = position_between(step, pair.second, 1.0) - position_between(step, pair.first, 1.0);
    const double reach = static_cast<double>(recording_.radii[pair.first] + recording_.radii[pair.second]);
    const Vec3 way = end - begin;
    const double a = norm_squared(way);
    const double b = dot(begin, way);
    const double c = norm_squared(begin) - reach * reach;
    if (c <= 0.0 || a == 0.0) return 0.0;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    return std::clamp(c / (root - b), 0.0, 1.0);
  }

  void answer(const Event& event) {
    if (scene_.response != SceneResponse::bounce || event.approach_speed <= 0.0) return;
    ++recording_.contacts;
    const bool pair = event.second != no_body;
    const double second_mass = pair ? mass(event.second.index) : 1.0;
    const Bounce after =
        scene_.resting_speed > 0.0
            ? settle(event, mass(event.first.index), second_mass, scene_.restitution, scene_.resting_speed)
            : bounce(event, mass(event.first.index), second_mass, scene_.restitution);
    require(motion_->set_velocity(event.first.index, event.time, after.first_velocity));
    if (pair) require(motion_->set_velocity(event.second.index, event.time, after.second_velocity));
  }

  double mass(std::uint32_t body) const {
    const double radius = scene_.bodies[body].radius;
    return radius * radius * radius;
  }

  const Scene& scene_;
  std::unique_ptr<Motion> motion_;
  const TouchObserver& observer_;
  std::vector<std::uint32_t> order_;  ///< numbers of bodies in the scene
  StepRecording recording_{};
  std::unique_ptr<StepKernel> kernel_;
  std::vector<SpherePair> touching_;
  std::vector<std::uint32_t> at_walls_;
};

}  // namespace

StepRecording record_steps(const Scene& scene, double step, std::size_t steps, SphereTest test,
                           const TouchObserver& observer) {
  return StepRecorder(scene, step, test, observer).run(steps);
}

ContactCounts contacts_at_steps(const Scene& scene, double step, std::size_t steps, SphereTest test) {
  ContactCounts seen;
  std::map<ContactCounts::key_type, std::size_t> last_touch;
  record_steps(scene, step, steps, test,
               [&](std::size_t number, std::uint32_t first, std::uint32_t second, Wall wall) {
                 const ContactCounts::key_type pair{first, second, wall};
                 const auto [last, is_new] = last_touch.try_emplace(pair, number);
                 if (is_new || last->second + 1 < number) ++seen[pair];
                 last->second = number;
               });
  return seen;
}

}  // namespace kinesphere::program
