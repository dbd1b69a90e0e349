// Streams of reports of tracks that approach each other again and again.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/random.hpp"
#include "watch/tracks/track_names.hpp"

namespace kinesphere::program {

inline const std::string crossing_promises =
    " --separation sphere:12 --separation cylinder:9:1 --acceleration 5";
inline const std::string crossing_errors = " --position-error 0.3 --velocity-error 0.2 ";

constexpr int crossing_tracks = 60;
/// The tracks move on circles that cross each other.
inline State state_at(int track, double time) {
  const double angle = 0.25 * time + 1.7 * track, radius = 20.0 + track % 9, turn = 0.25 * radius;
  return {{radius * std::cos(angle) + 3.0 * (track % 13), radius * std::sin(angle), 0.2 * (track % 5)},
          {-turn * std::sin(angle), turn * std::cos(angle), 0.0}};
}

using LineOf = std::string (*)(int track, double stamp, const State& state, bool is_wrong);

inline std::string json_line(int track, double stamp, const State& state, bool is_wrong) {
  return fmt::format(
      "{{\"id\": \"t{}\", \"stamp\": {:.3f}, \"position\": [{}, {}, {}], \"velocity\": [{}, {}, {}]}}\n",
      track, stamp, state.position.x + (is_wrong ? 50.0 : 0.0), state.position.y, state.position.z,
      state.velocity.x, state.velocity.y, state.velocity.z);
}

/// Each track changes its id every nine seconds, and every fifth one has a second id.
inline std::string changing_line(int track, double stamp, const State& state, bool is_wrong) {
  const auto life = static_cast<int>((stamp + track) / 9.0);
  const bool is_second = track % 5 == 0 && static_cast<int>(1000.0 * stamp) % 2 == 0;
  return fmt::format(
      "{{\"id\": \"t{}-{}{}\", \"stamp\": {:.3f}, \"position\": [{}, {}, {}], \"velocity\": [{}, {}, {}]}}\n",
      track, life, is_second ? "~" : "", stamp, state.position.x + (is_wrong ? 50.0 : 0.0), state.position.y,
      state.position.z, state.velocity.x, state.velocity.y, state.velocity.z);
}

inline std::string csv_line(int track, double stamp, const State& state, bool is_wrong) {
  const auto& [position, velocity] = state;
  return fmt::format("t{},{:.3f},{},{},{},{},{},{}\n", track, stamp, position.x + (is_wrong ? 50.0 : 0.0),
                     position.y, position.z, velocity.x, velocity.y, velocity.z);
}

/// Positions and velocities are in separate messages.
inline std::string sbs_lines(int track, double stamp, const State& state, bool) {
  const auto milliseconds = static_cast<int>(std::lround(1000.0 * stamp));
  const std::string time = fmt::format("2026/03/01,12:{:02}:{:02}.{:03}", milliseconds / 60000,
                                       milliseconds / 1000 % 60, milliseconds % 1000);
  const std::string head = fmt::format("1,1,{:06X},1,{},{},", 0xABC000 + track, time, time);
  return fmt::format("MSG,4,{},,{:.1f},{:.2f},,,0,,,,,\nMSG,3,{},{:.0f},,,{:.6f},{:.6f},,,,,,\n", head,
                     50.0 * norm(state.velocity),
                     90.0 - std::atan2(state.velocity.y, state.velocity.x) * 57.29577951308232, head,
                     30000.0 + 500.0 * state.position.z, 50.0 + state.position.y / 1000.0,
                     8.0 + state.position.x / 1000.0);
}

/// Returns reports, among them late ones, wrong ones, wrong clocks and damaged lines; some tracks become
/// stale and resume.
inline std::string stream_of(LineOf line_of, int reports) {
  Random random(5);
  std::string text;
  for (int k = 0; k < reports; ++k) {
    const double time = 10.0 + 0.004 * k;
    const int track = static_cast<int>(random.uniform(0.0, crossing_tracks));
    if (track % 7 == 0 && std::fmod(time, 40.0) > 15.0) continue;
    double stamp = time - random.uniform(0.0, 0.2);
    const State state = state_at(track, stamp);
    if (k % 501 == 500) stamp += 900.0;
    text += k % 701 == 700 ? "damaged\n" : line_of(track, stamp, state, k % 401 == 400);
  }
  return text;
}

/// Returns the share, from 0, of the pair of an alert.
inline std::uint64_t share_of_alert(const std::string& line, std::uint64_t of) {
  const auto alert = nlohmann::json::parse(line);
  const auto id = [&](const char* key) { return track_id_of(alert[key].get<std::string>()); };
  return (alert.contains("first") ? std::min(id("first"), id("second")) : id("track")) % of;
}

/// Alerts by share, in their order.
using AlertsByShare = std::map<std::uint64_t, std::vector<std::string>>;

inline void add_by_share(const std::string& alerts, std::uint64_t of, AlertsByShare& shares) {
  std::istringstream text(alerts);
  for (std::string line; std::getline(text, line);) shares[share_of_alert(line, of)].push_back(line);
}

}  // namespace kinesphere::program
