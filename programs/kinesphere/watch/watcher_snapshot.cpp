// Saves the state of a watch as JSON, and restores it.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/program_error.hpp"
#include "watch/watcher.hpp"

namespace nlohmann {

template <class Value>
struct adl_serializer<std::optional<Value>> {
  static void to_json(json& to, const std::optional<Value>& value) {
    if (value)
      to = *value;
    else
      to = nullptr;
  }
  static void from_json(const json& from, std::optional<Value>& value) {
    value = from.is_null() ? std::nullopt : std::optional<Value>(from.get<Value>());
  }
};

}  // namespace nlohmann

namespace kinesphere {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Vec3, x, y, z)

namespace program {
namespace {

using Json = nlohmann::json;

/// Returns a text of a declaration that lives as long as the program; there are few.
std::string_view kept(const std::string& text) {
  static std::set<std::string> texts;
  return *texts.insert(text).first;
}

/// An infinite number is null.
Json saved(double number) { return std::isfinite(number) ? Json(number) : Json(); }
double infinite_if_null(const Json& number) {
  return number.is_null() ? std::numeric_limits<double>::infinity() : number.get<double>();
}

}  // namespace

inline void to_json(Json& to, const Sighting& seen) {
  const auto& [state, stamp, velocity_error, first, interval, reports, place, link, later] = seen;
  to = {state.position,
        state.velocity,
        stamp,
        saved(velocity_error),
        first,
        interval,
        reports,
        later,
        {link.former, link.may_go_on, link.is_told, link.alike, link.former_alike, saved(link.due)}};
}
inline void from_json(const Json& from, Sighting& seen) {
  seen.state = {from.at(0), from.at(1)};
  seen.stamp = from.at(2);
  seen.velocity_error = infinite_if_null(from.at(3));
  seen.first = from.at(4);
  seen.interval = from.at(5);
  seen.reports = from.at(6);
  seen.later = from.at(7);
  const Json& link = from.at(8);
  seen.link = {link.at(0), link.at(1), link.at(2), link.at(3), link.at(4), infinite_if_null(link.at(5))};
}
inline void to_json(Json& to, const DeclaredError& error) { to = {error.bound, error.declaration}; }
inline void from_json(const Json& from, DeclaredError& error) { error = {from.at(0), kept(from.at(1))}; }

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FileTime, whole, fraction, rest)
// Without what is valid during a call alone, and what a format adds for recordings.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SourceReport, stamp, arrival, time_kind, geographic, in_metres, position,
                                   has_height, may_have_height, on_ground, velocity, has_climb,
                                   position_error, height_error, velocity_error, climb_error, stamp_error,
                                   velocity_age, velocity_spread, extent, ground_speed, said_status,
                                   said_kind, ruled_class, same_within)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StreamClock::Memory, source, has_begun, now, in_a_row, first_ahead,
                                   latest_ahead, first_id, several_ids, leapt, latest_before_leap,
                                   several_ids_before_leap)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MalformedLine, line, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WatchCounts::Turns, apart, undecided, within)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WatchCounts, repeated, stale, ahead, outside, no_position, on_ground,
                                   no_bound, no_velocity, filtered, superseded, crowded, malformed,
                                   first_malformed, no_height, dropped, alerts, with_velocity, behind, of_own,
                                   lost, handovers, one_bodies, groups, grouped, events, fates, turns)

namespace {

Json saved(const NamedTrack& track) {
  const auto& [text, name, stamp, position, extent, motion_class, class_since, contradicted_rest, position_by,
               height_by, velocity_by, climb_by, seen, rest] = track;
  return {text,
          stamp,
          position,
          position_by,
          height_by,
          velocity_by,
          climb_by,
          extent,
          motion_class,
          class_since,
          contradicted_rest,
          name,
          seen,
          {rest.is_at_rest, saved(rest.slow_since), rest.place}};
}

/// Arrays of tracks are packed into CBOR: as JSON in memory they would take ten times as much.
Json saved(const TrackNames& names) {
  constexpr std::size_t tracks_at_once = 500;
  Json packed = Json::array();
  Json tracks = Json::array();
  const auto pack = [&] {
    packed.push_back(Json::binary(Json::to_cbor(tracks)));
    tracks.clear();
  };
  names.for_each([&](const NamedTrack& track) {
    tracks.push_back(saved(track));
    if (tracks.size() == tracks_at_once) pack();
  });
  if (!tracks.empty()) pack();
  return packed;
}

Json saved(const Monitor& monitor) {
  const std::vector<std::byte> bytes = monitor.save();
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return Json::binary({begin, begin + bytes.size()});
}

}  // namespace

Json Watcher::save() const {
  Json state{{"clock", clock_.memory()},
             {"clock_is_chosen", clock_is_chosen_},
             {"held", Json::array()},
             {"time_kind", times_.kind()},
             {"first", first_},
             {"geographic", is_geographic_},
             {"dimensions", dimensions_},
             {"counts", counts_},
             {"monitor", nullptr},
             {"map", nullptr},
             {"classes", settings_.classes.save()},
             {"policy", policy_.save()},
             {"groups", nullptr},
             {"bodies", nullptr},
             {"next_forgetting", next_forgetting_}};
  for (const HeldReport& held : held_) state["held"].push_back({held.id, held.name, held.report});
  if (monitor_) {
    state["monitor"] = saved(*monitor_);
    state["groups"] = {groups_->save(), group_tracks_};
    if (bodies_) state["bodies"] = bodies_->save();
  }
  state["tracks"] = saved(names_);
  if (frame_) state["map"] = {frame_->latitude(), frame_->longitude()};
  return state;
}

void Watcher::restore(const Json& state) {
  clock_.recall(state.at("clock"));
  clock_is_chosen_ = state.at("clock_is_chosen");
  for (const Json& held : state.at("held"))
    held_.push_back({held.at(0), held.at(1), held.at(2).get<SourceReport>()});
  if (clock_.has_begun()) begin_times(state.at("first"), state.at("time_kind"));
  is_geographic_ = state.at("geographic");
  dimensions_ = state.at("dimensions");
  settings_.classes.restore(state.at("classes"));
  for (const Json& packed : state.at("tracks")) {
    for (const Json& saved : Json::from_cbor(packed.get_binary())) {
      const std::string text = saved.at(0);
      NamedTrack& track = names_.add(track_id_of(text), text);
      track.stamp = saved.at(1);
      track.position = saved.at(2);
      track.position_by = kept(saved.at(3));
      track.height_by = kept(saved.at(4));
      track.velocity_by = kept(saved.at(5));
      track.climb_by = kept(saved.at(6));
      track.extent = saved.at(7);
      track.motion_class = saved.at(8);
      track.class_since = saved.at(9).get<std::optional<FileTime>>();
      track.contradicted_rest = saved.at(10).get<std::optional<FileTime>>();
      if (track.motion_class >= settings_.classes.size())
        throw ProgramError("expected a class of each track in the snapshot");
      track.name = saved.at(11);
      track.seen = saved.at(12);
      const Json& rest = saved.at(13);
      track.rest = {rest.at(0), infinite_if_null(rest.at(1)), rest.at(2)};
    }
  }
  counts_ = state.at("counts");
  policy_.restore(state.at("policy"));
  if (const Json& map = state.at("map"); !map.is_null()) begin_map({map.at(0), map.at(1)});
  if (const Json& monitor = state.at("monitor"); !monitor.is_null()) {
    auto restored = Monitor::restore(std::as_bytes(std::span(monitor.get_binary())));
    if (!restored) throw ProgramError(message_of(restored.error()));
    monitor_.emplace(std::move(*restored));
    begin_areas();
    begin_bodies();
    if (bodies_) bodies_->restore(state.at("bodies"));
    groups_.emplace(cutting());
    groups_->restore(state.at("groups").at(0));
    state.at("groups").at(1).get_to(group_tracks_);
    next_forgetting_ = state.at("next_forgetting");
  }
}

}  // namespace program
}  // namespace kinesphere
