// RememberingSource is a motion source that is asked less often.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <thread>

#include "kinesphere/run.hpp"

namespace kinesphere {

/// Remembers the last states that a motion source gave of one or two bodies. They are those of a contact, for
/// the most part, and the response sets the velocities of the same bodies at the same time.
class RememberingSource final : public MotionSource {
 public:
  explicit RememberingSource(MotionSource& source) : source_(source) {}

  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    // Other threads share questions about many bodies.
    if (ids.size() > ids_.size() || std::this_thread::get_id() != thread_)
      return source_.states(ids, time, states);
    if (knows(ids, time)) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = states_[place_of(ids[k])];
      return;
    }
    forget();
    source_.states(ids, time, states);
    std::copy(ids.begin(), ids.end(), ids_.begin());
    std::copy_n(states.begin(), ids.size(), states_.begin());
    time_ = time;
  }
  MotionOrigin origin(BodyId body) const override { return source_.origin(body); }
  void set_origin(BodyId body, const MotionOrigin& origin) override {
    forget();
    source_.set_origin(body, origin);
  }
  /// Forgets the states: the caller may change the motion of any body now.
  void forget() { ids_ = {no_body, no_body}; }

 private:
  std::size_t place_of(BodyId id) const { return id == ids_[0] ? 0 : id == ids_[1] ? 1 : 2; }
  bool knows(std::span<const BodyId> ids, double time) const {
    return time == time_ &&
           std::all_of(ids.begin(), ids.end(), [this](BodyId id) { return place_of(id) < ids_.size(); });
  }

  MotionSource& source_;
  std::thread::id thread_ = std::this_thread::get_id();
  std::array<BodyId, 2> ids_{no_body, no_body};
  std::array<State, 2> states_{};
  double time_ = 0.0;
};

}  // namespace kinesphere
