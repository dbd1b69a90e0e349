// Saves the state of a watch as JSON, and restores it.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "program_error.hpp"
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
/// Returns the text with a lifetime longer than the watch.
using KeepText = std::function<std::string_view(const std::string&)>;

}  // namespace

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FileTime, whole, fraction, rest)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StreamClock::Memory, source, has_begun, now, in_a_row, first_ahead,
                                   latest_ahead, first_id, several_ids)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MalformedLine, line, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WatchCounts::Turns, apart, undecided, within)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WatchCounts, repeated, stale, ahead, outside, no_position, on_ground,
                                   no_bound, no_velocity, filtered, superseded, crowded, malformed,
                                   first_malformed, no_height, dropped, alerts, of_own, lost, groups, grouped,
                                   events, fates, turns)

namespace {

Json saved(const std::optional<DeclaredError>& error) {
  if (!error) return nullptr;
  return {error->bound, error->declaration};
}

std::optional<DeclaredError> restored_error(const Json& saved, const KeepText& keep) {
  if (saved.is_null()) return std::nullopt;
  return DeclaredError{saved.at(0), keep(saved.at(1))};
}

Json saved(const SourceReport& report) {
  const auto& [id, name, stamp, arrival, time_kind, geographic, position, has_height, may_have_height,
               on_ground, velocity, has_climb, position_error, height_error, velocity_error, climb_error,
               stamp_error, velocity_age, velocity_spread, extent, ground_speed, said_status, said_kind,
               sayable, ruled_class, row, written, category, craft_type, status, same_within] = report;
  return {{"stamp", stamp},
          {"arrival", arrival},
          {"time_kind", time_kind},
          {"geographic", geographic},
          {"position", position},
          {"has_height", has_height},
          {"may_have_height", may_have_height},
          {"on_ground", on_ground},
          {"velocity", velocity},
          {"has_climb", has_climb},
          {"position_error", saved(position_error)},
          {"height_error", saved(height_error)},
          {"velocity_error", saved(velocity_error)},
          {"climb_error", saved(climb_error)},
          {"stamp_error", stamp_error},
          {"velocity_age", velocity_age},
          {"velocity_spread", velocity_spread},
          {"extent", extent},
          {"ground_speed", ground_speed},
          {"said_status", said_status},
          {"said_kind", said_kind},
          {"ruled_class", ruled_class},
          {"same_within", same_within}};
}

SourceReport restored_report(const Json& saved, const KeepText& keep) {
  return {.stamp = saved.at("stamp"),
          .arrival = saved.at("arrival").get<std::optional<FileTime>>(),
          .time_kind = saved.at("time_kind"),
          .geographic = saved.at("geographic"),
          .position = saved.at("position"),
          .has_height = saved.at("has_height"),
          .may_have_height = saved.at("may_have_height"),
          .on_ground = saved.at("on_ground"),
          .velocity = saved.at("velocity").get<std::optional<Vec3>>(),
          .has_climb = saved.at("has_climb"),
          .position_error = restored_error(saved.at("position_error"), keep),
          .height_error = restored_error(saved.at("height_error"), keep),
          .velocity_error = restored_error(saved.at("velocity_error"), keep),
          .climb_error = restored_error(saved.at("climb_error"), keep),
          .stamp_error = saved.at("stamp_error").get<std::optional<double>>(),
          .velocity_age = saved.at("velocity_age"),
          .velocity_spread = saved.at("velocity_spread"),
          .extent = saved.at("extent"),
          .ground_speed = saved.at("ground_speed").get<std::optional<double>>(),
          .said_status = saved.at("said_status").get<std::optional<MotionPreset>>(),
          .said_kind = saved.at("said_kind").get<std::optional<MotionPreset>>(),
          .ruled_class = saved.at("ruled_class"),
          .same_within = saved.at("same_within")};
}

Json saved(const NamedTrack& track) {
  const auto& [text, name, stamp, position, extent, motion_class, class_since, contradicted_rest, position_by,
               height_by, velocity_by, climb_by] = track;
  return {text,     stamp,  position,     position_by, height_by,         velocity_by,
          climb_by, extent, motion_class, class_since, contradicted_rest, name};
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
             {"next_forgetting", next_forgetting_}};
  for (const HeldReport& held : held_) state["held"].push_back({held.id, held.name, saved(held.report)});
  if (monitor_) {
    state["monitor"] = saved(*monitor_);
    state["groups"] = {groups_->save(), group_tracks_};
  }
  state["tracks"] = saved(names_);
  if (frame_) state["map"] = {frame_->latitude(), frame_->longitude()};
  return state;
}

void Watcher::restore(const Json& state) {
  const KeepText keep = [this](const std::string& text) -> std::string_view {
    return *declarations_.insert(text).first;
  };
  clock_.recall(state.at("clock"));
  clock_is_chosen_ = state.at("clock_is_chosen");
  for (const Json& held : state.at("held"))
    held_.push_back({held.at(0), held.at(1), restored_report(held.at(2), keep)});
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
      track.position_by = keep(saved.at(3));
      track.height_by = keep(saved.at(4));
      track.velocity_by = keep(saved.at(5));
      track.climb_by = keep(saved.at(6));
      track.extent = saved.at(7);
      track.motion_class = saved.at(8);
      track.class_since = saved.at(9).get<std::optional<FileTime>>();
      track.contradicted_rest = saved.at(10).get<std::optional<FileTime>>();
      if (track.motion_class >= settings_.classes.size())
        throw ProgramError("expected a class of each track in the snapshot");
      track.name = saved.at(11);
    }
  }
  counts_ = state.at("counts");
  policy_.restore(state.at("policy"));
  if (const Json& map = state.at("map"); !map.is_null()) begin_map({map.at(0), map.at(1)});
  if (const Json& monitor = state.at("monitor"); !monitor.is_null()) {
    auto restored = Monitor::restore(std::as_bytes(std::span(monitor.get_binary())));
    if (!restored) throw ProgramError(restored.error().message);
    monitor_.emplace(std::move(*restored));
    begin_areas();
    groups_.emplace(cutting());
    groups_->restore(state.at("groups").at(0));
    state.at("groups").at(1).get_to(group_tracks_);
    next_forgetting_ = state.at("next_forgetting");
  }
}

}  // namespace program
}  // namespace kinesphere
