// Kinds of random scenes of bodies and shapes, and which of them touch according to their events.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <set>
#include <utility>

#include "kinesphere/world.hpp"
#include "support/playground.hpp"

namespace kinesphere {

struct ContactScene {
  ContactEvents mode;
  double velocity_error;
  std::uint64_t seed;
};

inline std::ostream& operator<<(std::ostream& out, const ContactScene& kind) {
  return out << (kind.mode == ContactEvents::impacts ? "impacts" : "begin_and_end") << ", velocity error "
             << kind.velocity_error << ", seed " << kind.seed;
}

/// The pairs in touch. There are none where the world tells no ends.
class TouchingPairs {
 public:
  explicit TouchingPairs(ContactEvents mode) : has_ends_(mode != ContactEvents::impacts) {}

  /// Expects that a begin and an end come in turn.
  void note(const Event& event, const World& world) {
    if (!has_ends_) return;
    const auto pair = std::pair(event.first, event.second);
    if (event.kind == EventKind::contact_begin) {
      EXPECT_EQ(pairs_.insert(pair).second, !event.already_touching) << event;
    } else if (event.kind == EventKind::contact_end) {
      // The end of a removed body's contact comes after its removal.
      const bool known = world.contains(event.first) && world.contains(event.second);
      EXPECT_TRUE(pairs_.erase(pair) == 1 || !known) << event;
    }
  }
  void remove(BodyId body) {
    std::erase_if(pairs_, [=](const auto& pair) { return pair.first == body || pair.second == body; });
  }
  bool contains(BodyId a, BodyId b) const { return pairs_.contains(std::minmax(a, b)); }

 private:
  bool has_ends_;
  std::set<std::pair<BodyId, BodyId>> pairs_;
};

}  // namespace kinesphere
