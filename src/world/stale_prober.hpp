// A probe for queries outside advance().
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "kinesphere/world.hpp"

namespace kinesphere {

/// Probes those of the given bodies whose reports are not from the present time. Returns true if there were
/// any.
class World::StaleProber {
 public:
  StaleProber(World& world, const Probe& probe, std::string_view call)
      : world_(world), probe_(probe), call_(call) {}

  Result<bool> operator()(std::span<const std::uint32_t> numbers) const {
    return world_.refresh(numbers, probe_, call_);
  }

 private:
  World& world_;
  const Probe& probe_;
  std::string_view call_;
};

/// Stands in for StaleProber in queries without a probe.
struct WithoutProbe {
  Result<bool> operator()(std::span<const std::uint32_t>) const { return false; }
};
inline constexpr WithoutProbe without_probe;

}  // namespace kinesphere
