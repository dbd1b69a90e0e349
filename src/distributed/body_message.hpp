// A body on its way from rank to rank, with all that is known of it and the motion that moves it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "archive/fields.hpp"
#include "broadphase/certificate_queue.hpp"
#include "contact/contact_checkpoint.hpp"
#include "engine/world_state.hpp"

namespace kinesphere {

/// Bodies are named by the indices of their ids.
struct BodyMessage {
  /// A hot pair of the body; the other may be PairCertificate::walls or PairCertificate::window_end.
  struct Due {
    double time;
    std::uint32_t other;

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [when, with] = self;
      archive(when, with);
    }
  };

  std::uint32_t name = 0;
  std::int32_t owner = 0;  ///< the rank whose it is
  Body body{};
  PeriodicImage image{};
  Filter filter{};
  ContactCheckpoint contacts{};
  /// Where it is registered, if it is. `enters`: with a new capsule, from now on. `starts`: with all others
  /// whose windows start now.
  bool is_registered = false;
  bool enters = false;
  bool starts = false;
  std::int32_t tier = 0;
  double end = 0.0;
  /// Hot pairs that were known of it before are void.
  bool is_void = false;
  std::vector<Due> due{};
  std::vector<Event> pending{};  ///< news of it that has not been told
  std::vector<std::byte> motion{};

  Window window() const { return {tier, end}; }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [named, whose, itself, at_home, meets, touches, registered, entering, starting, power, until, voids,
           pairs, news, moves] = self;
    archive(named, whose, itself, at_home, meets, touches, registered, entering, starting, power, until,
            voids, pairs, news, moves);
  }
};

}  // namespace kinesphere
