// ProbeProfile counts, for each body, how often it is probed and why, while World::set_profiling() is on.
//
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bodies/bodies.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/inspection.hpp"

namespace kinesphere {

/// What the engine needs a report for.
enum class ProbeCause : std::uint8_t {
  touching,  ///< recheck of a pair in contact, or of a body in contact with a wall
  near,      ///< recheck of another pair, or of a body near a wall
  region,    ///< a safe region, or a spot check
  change,    ///< change by the caller, or violated bound
  query,     ///< call outside advance()
};

class ProbeProfile {
 public:
  void note_probes(const BodyTable& bodies, std::span<const std::uint32_t> numbers, ProbeCause cause);
  void note_event(const BodyTable& bodies, const Event& event);
  /// Notes the acceleration that two successive reports show; `before` and `after` are the bounds made from
  /// them. Precondition: the probe was noted, and the caller has set no velocity in between. Thread-safe for
  /// different bodies.
  void note_report(std::uint32_t number, const Bound& before, const Bound& after);

  /// Returns the live bodies with the most probes, at most `count`, in the order of
  /// World::Inspection::busiest().
  std::vector<BusyBody> busiest(const Bodies& bodies, std::size_t count) const;
  std::size_t bytes() const;

 private:
  static constexpr std::size_t causes = 5;

  struct Record {
    std::uint32_t generation = 0;  ///< of the body; a number may be used again
    std::array<std::uint64_t, causes> probes{};
    std::uint64_t contacts = 0;
    double largest_acceleration = 0.0;

    std::uint64_t of(ProbeCause cause) const { return probes[static_cast<std::size_t>(cause)]; }
  };

  Record& record_of(const BodyTable& bodies, std::uint32_t number);
  static BusyBody busy_body(const Bodies& bodies, std::uint32_t number, const Record& record);

  std::vector<Record> records_;  ///< by body number
};

}  // namespace kinesphere
