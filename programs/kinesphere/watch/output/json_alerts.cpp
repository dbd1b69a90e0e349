// Alerts as JSON lines.
#include <fmt/format.h>

#include <utility>

#include "watch/output/alert_lines.hpp"
#include "watch/output/pair_distance.hpp"

namespace kinesphere::program {
namespace {

/// Returns the sources of the declared bounds of a track.
std::string declarations_of(const NamedTrack& track) {
  std::string text;
  const auto add = [&](const char* what, std::string_view declaration) {
    if (declaration.empty()) return;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", what, declaration);
  };
  const Declared& by = track.declared;
  add("position", by.position_by);
  if (track.extent > 0.0) add("extent", fmt::format("{:.4g}", track.extent));
  add("height", by.height_by);
  add("velocity", by.velocity_by);
  add("climb", by.climb_by);
  return text;
}

class JsonAlerts final : public AlertDesk::Next {
 public:
  JsonAlerts(const WatchView& view, AlertFn write) : view_(view), write_(std::move(write)) {}

  void write_event(std::uint64_t share, const MonitorEvent& event, const LeftFor& left_for) override {
    JsonObject alert = begin(name_of(event.kind), event.time);
    if (is_of_pair(event.kind))
      add_pair_event(alert, event);
    else
      add_track_event(alert, event, left_for);
    write_(share, alert.line());
  }
  void write_lost(std::uint64_t share, const LostTrack& lost) override {
    const auto& [time, track, key, encounter, left_for] = lost;
    JsonObject alert = begin("lost", time);
    alert.add("track", view_.json_id(track));
    add_name(alert, "track_name", track);
    add_reason(alert, left_for);
    add_pair(alert, view_.in_text_order(key.first, key.second), key.level);
    alert.add("predicted", encounter.predicted ? "true" : "false")
        .add("within", encounter.within ? "true" : "false")
        .add("closest_distance", fmt::format("{:.6g}", encounter.loss->closest_distance))
        .add("closest_time", view_.json_time(encounter.loss->closest_time));
    write_(share, alert.line());
  }
  void write_one_body(std::uint64_t share, double time, TrackId a, TrackId b) override {
    const auto [first, second] = view_.in_text_order(a, b);
    JsonObject alert = begin("one_body", time);
    alert.add("first", view_.json_id(first)).add("second", view_.json_id(second));
    add_names(alert, {first, second});
    write_(share, alert.line());
  }
  void write_group(std::uint64_t share, double time, const std::string& name, std::size_t tracks) override {
    write_(share, begin("group", time).text("track", name).count("tracks", tracks).line());
  }
  void write_refused(std::uint64_t share, const AlertPolicy::Refused& refused) override {
    JsonObject alert = begin("held_back", refused.since + 1.0);
    write_(share, alert.add("since", view_.json_time(refused.since)).count("alerts", refused.alerts).line());
  }

 private:
  JsonObject begin(std::string_view event, double time) const {
    JsonObject alert;
    alert.add("event", fmt::format("\"{}\"", event)).add("time", view_.json_time(time));
    return alert;
  }
  /// Adds the name of a track, if the stream has told one.
  void add_name(JsonObject& alert, std::string_view field, TrackId id) const {
    const NamedTrack* const track = view_.track(id);
    if (track != nullptr && !track->name.empty()) alert.text(field, track->name);
  }
  void add_names(JsonObject& alert, const OrderedPair& pair) const {
    add_name(alert, "first_name", pair.first);
    add_name(alert, "second_name", pair.second);
  }
  void add_pair(JsonObject& alert, const OrderedPair& pair, std::uint32_t level) const {
    alert.add("first", view_.json_id(pair.first)).add("second", view_.json_id(pair.second));
    add_names(alert, pair);
    alert.text("separation", view_.separation(level).name).count("level", level);
  }
  /// Adds why a track has left, and the one that goes on as it, if there is one.
  static void add_reason(JsonObject& alert, const LeftFor& left_for) {
    alert.add("reason", fmt::format("\"{}\"", left_for.reason));
    if (!left_for.later.empty()) alert.text("goes_on_as", left_for.later);
  }

  /// Adds the fields of a verdict or a prediction.
  void add_pair_event(JsonObject& alert, const MonitorEvent& event) const {
    const OrderedPair pair = view_.in_text_order(event.first, event.second);
    const auto answer = view_.monitor().answer(event.first, event.second, event.level);
    const auto verdict = [](Verdict value) { return fmt::format("\"{}\"", name_of(value)); };
    add_pair(alert, pair, event.level);
    if (event.kind == MonitorEventKind::verdict)
      alert.add("verdict", verdict(event.verdict)).add("before", verdict(event.before));
    else if (answer)
      alert.add("verdict", verdict(answer->verdict));
    alert.add("since", view_.json_time(event.since));
    if (answer) add_answer(alert, view_, pair, event.level, *answer);
    const NamedTrack *const one = view_.track(pair.first), *const other = view_.track(pair.second);
    if (one == nullptr || other == nullptr) return;
    JsonObject rests_on;
    rests_on.text("first", declarations_of(*one)).text("second", declarations_of(*other));
    rests_on.text("both",
                  view_.tracks.classes().promise(one->declared.motion_class, other->declared.motion_class));
    alert.add("rests_on", rests_on.whole());
  }

  void add_track_event(JsonObject& alert, const MonitorEvent& event, const LeftFor& left_for) const {
    alert.add("track", view_.json_id(event.first));
    add_name(alert, "track_name", event.first);
    if (event.kind == MonitorEventKind::dropped) add_reason(alert, left_for);
    const NamedTrack* const track = view_.track(event.first);
    const std::string promise =
        track != nullptr ? view_.tracks.classes().promise(track->declared.motion_class) : "";
    if (event.kind == MonitorEventKind::contradiction) {
      alert.number("position_excess", event.position_excess);
      alert.number("velocity_excess", event.velocity_excess);
      if (track != nullptr)
        alert.add("rests_on",
                  JsonObject().text("track", declarations_of(*track)).text("both", promise).whole());
    }
    if (event.kind == MonitorEventKind::reclassified && track != nullptr) alert.text("class", promise);
  }

  const WatchView& view_;
  AlertFn write_;
};

}  // namespace

void add_answer(JsonObject& object, const WatchView& view, const OrderedPair& pair, std::uint32_t level,
                const PairAnswer& answer) {
  const PairDistance now =
      distance_now(view.monitor(), view.separation(level).separation, pair.first, pair.second);
  object.limits("distance", answer.lower / view.tracks.map().stretch(), answer.upper);
  object.length("likely_distance", now.likely);
  if (now.vertical)
    object.limits("vertical_distance", now.vertical->lower, now.vertical->upper)
        .length("likely_vertical", now.vertical->likely);
  else
    object.add("vertical_distance", "null").add("likely_vertical", "null");
  object.add("until", view.json_time(answer.until))
      .length("closest_distance", answer.closest_distance)
      .add("closest_time", view.json_time(answer.closest_time))
      .add("likely_time", view.json_time(answer.likely_time))
      .add("ask", view.json_id(answer.ask))
      .add("ask_by", view.json_time(answer.ask_by))
      .length("closest_horizontal", answer.closest_horizontal)
      .length("closest_vertical", answer.closest_vertical)
      .length("relative_speed", answer.relative_speed)
      .add("avoidable_until", view.json_time(answer.avoidable_until))
      .add("inevitable_by", view.json_time(answer.inevitable_by));
}

std::string WatchView::json_time(double time) const {
  if (!std::isfinite(time)) return "null";
  constexpr int decimals = 6;
  const std::string text = clock.times().text(time, decimals);
  return clock.times().is_number() ? text : fmt::format("\"{}\"", text);
}

std::string WatchView::json_id(TrackId id) const { return json_text(tracks.names().text(id)); }

std::unique_ptr<AlertDesk::Next> make_json_alerts(const WatchView& view, AlertFn write) {
  return std::make_unique<JsonAlerts>(view, std::move(write));
}

}  // namespace kinesphere::program
