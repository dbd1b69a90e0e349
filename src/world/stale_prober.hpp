// The probe of a facet, if it has one.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "kinesphere/world.hpp"

namespace kinesphere {

/// Probes those of the given bodies whose reports are not from the present time. Returns true if there were
/// any; false without a probe.
class World::StaleProber {
 public:
  StaleProber(const Facet& facet, std::string_view call) : facet_(facet), call_(call) {}

  bool has_probe() const { return facet_.probing != nullptr; }
  Result<bool> operator()(std::span<const std::uint32_t> numbers) const {
    return has_probe() ? facet_.probing->refresh(numbers, facet_.probe, call_) : Result<bool>(false);
  }

 private:
  const Facet& facet_;
  std::string_view call_;
};

}  // namespace kinesphere
