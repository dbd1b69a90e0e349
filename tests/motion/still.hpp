// A motion with the required functions and no others.
#pragma once

#include <cstdint>
#include <memory>

#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

/// One body, at rest at the origin.
class Still final : public Motion {
 public:
  std::size_t size() const override { return 1; }
  BodyDefinition definition(std::uint32_t, double) const override { return {}; }
  State state(std::uint32_t, double) const override { return {}; }
  Trajectory trajectory(std::uint32_t, double begin, double end) const override {
    return {{.begin = begin, .end = end}};
  }
  Result<void> set_velocity(std::uint32_t, double, const Vec3&) override { return {}; }
  std::unique_ptr<Motion> clone() const override { return std::make_unique<Still>(); }
};

}  // namespace kinesphere
