// The sizes of ships, by their MMSI.
#include "watch/ais/ship_sizes.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace kinesphere::program {

void ShipSizes::set(std::uint32_t mmsi, double radius) {
  recent_[mmsi] = radius;
  if (recent_.size() < most) return;
  earlier_ = std::move(recent_);
  recent_.clear();
}

double ShipSizes::radius_of(std::uint32_t mmsi) {
  if (const auto at = recent_.find(mmsi); at != recent_.end()) return at->second;
  const auto at = earlier_.find(mmsi);
  if (at == earlier_.end()) return 0.0;
  const double radius = at->second;
  set(mmsi, radius);
  return radius;
}

nlohmann::json ShipSizes::save() const {
  const auto pairs = [](const auto& sizes) {
    auto all = nlohmann::json::array();
    for (const auto& [mmsi, radius] : sizes) all.push_back({mmsi, radius});
    return all;
  };
  return {{"recent", pairs(recent_)}, {"earlier", pairs(earlier_)}};
}

void ShipSizes::restore(const nlohmann::json& state) {
  for (auto& [name, sizes] : {std::pair{"recent", &recent_}, {"earlier", &earlier_}})
    for (const auto& each : state.at(name)) (*sizes)[each.at(0)] = each.at(1);
}

}  // namespace kinesphere::program
