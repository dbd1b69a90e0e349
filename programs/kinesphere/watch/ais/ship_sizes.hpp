// The sizes of ships, by their MMSI.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <unordered_map>

namespace kinesphere::program {

/// Keeps the `most` ships that were used last, and at most as many more, however many a sender invents.
class ShipSizes {
 public:
  static constexpr std::size_t most = 65'536;

  void set(std::uint32_t mmsi, double radius);
  /// Returns the radius, in metres, of a disc around the antenna that covers the ship; 0 if it is not known.
  double radius_of(std::uint32_t mmsi);

  nlohmann::json save() const;
  void restore(const nlohmann::json& state);

 private:
  std::unordered_map<std::uint32_t, double> recent_, earlier_;
};

}  // namespace kinesphere::program
