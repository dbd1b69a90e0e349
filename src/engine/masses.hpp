// Masses stores the masses of bodies, for events.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// Static bodies have an infinite mass.
class Masses {
 public:
  double of(std::uint32_t number) const { return number < masses_.size() ? masses_[number] : usual; }
  void keep(std::uint32_t number, double mass) {
    if (mass != usual && number >= masses_.size()) masses_.resize(number + std::size_t{1}, usual);
    if (number < masses_.size()) masses_[number] = mass;
  }

  /// Validates the table after reading, except for the masses themselves.
  bool is_valid(std::size_t bodies) const { return masses_.size() <= bodies; }
  static void serialize(auto& self, auto& archive) {
    auto& [masses] = self;
    archive(masses);
  }

 private:
  static constexpr double usual = BodyDefinition{}.mass;
  std::vector<double> masses_;  ///< by body number, up to the last body whose mass is not the usual one
};

}  // namespace kinesphere
