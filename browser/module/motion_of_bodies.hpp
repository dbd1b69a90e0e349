// Whoever answers for the bodies of a world: a motion, a map, or a function of JavaScript.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>

#include "body_map.hpp"
#include "kinesphere/kinesphere.hpp"
#include "motion.hpp"

namespace kinesphere::browser {

/// Calls the package's probe function. If it throws, NaNs remain, which the world refuses; the package
/// rethrows the exception.
void ask_javascript(std::span<const BodyId> ids, double time, std::span<State> states);

/// The bodies of one motion, numbered by the index of their ids, or those of a map. A body without a state
/// gets NaN, which the world refuses, as it does a response if a body cannot be changed. refused() is then
/// the motion's own error.
class MotionOfBodies final : public MotionSource {
 public:
  /// One of the two is null.
  MotionOfBodies(Motion* motion, BodyMap* map) : motion_(motion), map_(map) {}
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      states[k] = {{nan_, nan_, nan_}, {nan_, nan_, nan_}};
      const auto moved = find(ids[k]);
      auto reason = moved ? why_unknown(*moved->motion, moved->number, time) : unknown(ids[k]);
      if (reason) {
        reason->body = ids[k];
        refused_ = std::move(reason);
      } else {
        states[k] = moved->motion->state(moved->number, time);
      }
    }
  }
  MotionOrigin origin(BodyId body) const override {
    const auto moved = find(body);
    return moved ? moved->motion->origin(moved->number) : MotionOrigin{};
  }
  void set_origin(BodyId body, const MotionOrigin& departure) override {
    if (const auto moved = find(body)) (void)moved->motion->set_origin(moved->number, departure);
  }

  /// Returns the response, or NaNs for a body that cannot be changed.
  Response possible(const Event& event, const Response& answer) {
    if (!(answer.first_velocity && is_fixed(event.first)) &&
        !(answer.second_velocity && is_fixed(event.second)))
      return answer;
    refused_ = {ErrorCode::unsupported, "respond", no_body,
                "run: respond: the bodies of this motion go their own way, and cannot be given velocities"};
    return {Vec3{nan_, nan_, nan_}, std::nullopt};
  }

  /// Removes what a response has removed from the world from the map and its motions, too.
  void forget_gone(World& world, const Event& event, const Response& response) {
    if (map_ == nullptr) return;
    (void)map_->remove_gone(world, event, [&](const Event&) { return response; });
  }

  const std::optional<Error>& refused() const { return refused_; }

 private:
  static constexpr double nan_ = std::numeric_limits<double>::quiet_NaN();
  std::optional<MovedBody> find(BodyId body) const {
    return map_ != nullptr ? map_->find(body) : MovedBody{motion_, body.index};
  }
  static std::optional<Error> unknown(BodyId body) {
    return Error{ErrorCode::unknown_body, "body", body,
                 "BodyMap: body " + std::to_string(body.index) +
                     " of the world was not added through this map, or has been removed from it"};
  }
  bool is_fixed(BodyId body) const {
    const auto moved = find(body);
    return moved && !can_be_changed(*moved->motion);
  }

  Motion* motion_;
  BodyMap* map_;
  std::optional<Error> refused_;
};

inline MotionOfBodies bodies_of(const MotionHandle* motion, BodyMapHandle* map) {
  return {motion != nullptr ? motion->motion.get() : nullptr, map != nullptr ? map->map.get() : nullptr};
}

}  // namespace kinesphere::browser
