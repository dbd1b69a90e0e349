// Snapshots of a monitor: its complete state as bytes, and back.
#include <algorithm>
#include <cmath>

#include "archive/archive.hpp"
#include "archive/envelope.hpp"
#include "archive/fields.hpp"
#include "kinesphere/limits.hpp"
#include "monitor/check_monitor.hpp"
#include "monitor/engine.hpp"

namespace kinesphere {
namespace {

/// Raise the version when the fields change, or when the engine would continue differently from equal fields.
constexpr Envelope monitor_envelope{{'K', 'i', 'n', 'M', 'o', 'n', '\r', '\n'},
                                    12,
                                    "monitor",
                                    "Monitor::restore",
                                    "snapshot",
                                    ErrorCode::bad_snapshot};

/// Returns true for an unused track number: its entry is as TrackTable::remove() leaves it.
bool is_blank(const KnownTrack& track) {
  const auto& [id, track_class, present, stale, stay, own, silent_at, estimate, open] = track;
  return id == 0 && track_class == 0 && !present && !stale && stay == 0.0 && own == 0.0 && silent_at == 0.0 &&
         estimate.hypotheses().empty() && open.empty();
}

}  // namespace

template <class Self, class Archive>
void Monitor::Engine::serialize(Self& self, Archive& archive) {
  archive(self.time_, self.has_started_, self.round_, self.quiet_rounds_, self.counters_, self.tracks_,
          self.near_, self.predictions_);
  std::vector<SavedPair<PairRecord>> pairs;
  std::vector<MonitorEvent> events;
  if constexpr (std::is_const_v<Self>) {
    pairs = self.pairs_.sorted();
    events.assign(self.events_.begin(), self.events_.end());
    archive(pairs, events);
  } else {
    archive(pairs, events);
    for (const SavedPair<PairRecord>& saved : pairs)
      self.pairs_.add(saved.first, saved.second) = saved.record;
    self.events_.assign(events.begin(), events.end());
  }
}

std::vector<std::byte> Monitor::Engine::save() const {
  ByteWriter content;
  content(definition_);
  serialize(*this, content);
  return monitor_envelope.seal(content.bytes());
}

Result<std::unique_ptr<Monitor::Engine>> Monitor::Engine::restore(std::span<const std::byte> snapshot) {
  const auto content = monitor_envelope.open(snapshot);
  if (!content) return content.error();
  ByteReader reader(*content);
  MonitorDefinition definition;
  reader(definition);
  if (reader.failed() || !check_monitor(definition))
    return monitor_envelope.refusal("must hold a monitor that can be, but its definition is impossible");
  auto engine = std::make_unique<Engine>(definition);
  serialize(*engine, reader);
  if (reader.failed() || reader.remaining() != 0)
    return monitor_envelope.refusal("must hold a monitor, but its content does not have the form of one");
  if (const char* where = engine->first_invalid_part())
    return monitor_envelope.refusal(
        std::string("must hold a monitor that can be, but contradicts itself in its ") + where);
  std::vector<std::optional<Predictions::TrackKey>> keys(engine->tracks_.numbers());
  for (std::uint32_t number = 0; number < keys.size(); ++number)
    if (const KnownTrack& track = engine->tracks_[number]; track.present)
      keys[number] = {track.id, track.track_class};
  if (!engine->predictions_.restore(keys, engine->time_))
    return monitor_envelope.refusal(
        "must hold a monitor that can be, but contradicts itself in its predictions");
  engine->index_due();
  return engine;
}

/// Finds out what was not read: who is near whom, and the number of open pairs. Returns false if the regions
/// that were read are impossible.
bool Monitor::Engine::rebuild() {
  const auto regions_of = [this](std::uint32_t number) {
    return tracks_[number].estimate.hypotheses().size();
  };
  if (!near_.rebuild(tracks_.numbers(), regions_of, {})) return false;
  bool valid = true;
  pairs_.for_each([&](std::uint32_t a, std::uint32_t b, const PairRecord& pair) {
    valid = valid && (pair.is_open() || near_.are_near(a, b));
    open_pairs_ += pair.is_open() ? 1 : 0;
  });
  return valid;
}

bool Monitor::Engine::is_valid_pair(std::uint32_t a, std::uint32_t b, const PairRecord& pair) const {
  const auto is_present = [this](std::uint32_t number) {
    return number < tracks_.numbers() && tracks_[number].present;
  };
  const auto has_open = [this](std::uint32_t number, std::uint32_t other) {
    return std::count(tracks_[number].open.begin(), tracks_[number].open.end(), other);
  };
  if (!(a < b && is_present(a) && is_present(b)) || levels_of(a, b).empty()) return false;
  const auto opened = pair.is_open() ? 1 : 0;
  return pair.due >= time_ && has_open(a, b) == opened && has_open(b, a) == opened &&
         (!pair.is_open() || pair.levels.size() == levels_of(a, b).size()) &&
         std::all_of(pair.levels.begin(), pair.levels.end(), [](const LevelState& state) {
           return state.verdict <= Verdict::within && !std::isnan(state.since) && !std::isnan(state.until);
         });
}

/// Returns the name of the first part of the tracks that violates an invariant, or nullptr.
const char* Monitor::Engine::first_invalid_track() {
  if (!tracks_.index()) return "tracks";
  std::size_t partners = 0;
  for (std::uint32_t number = 0; number < tracks_.numbers(); ++number) {
    const KnownTrack& track = tracks_[number];
    if (!track.present) {
      // The next track with this number reuses the entry, so it has to be blank.
      if (!is_blank(track)) return "tracks";
      continue;
    }
    if (track.track_class >= definition_.classes.size() || !track.estimate.is_valid(time_)) return "tracks";
    if (!(track.stay > 0.0 && track.own >= time_ && track.silent_at >= time_)) return "regions";
    partners += track.open.size();
  }
  std::size_t opened = 0;
  pairs_.for_each(
      [&](std::uint32_t, std::uint32_t, const PairRecord& pair) { opened += pair.is_open() ? 1 : 0; });
  return partners == 2 * opened ? nullptr : "pairs";
}

const char* Monitor::Engine::first_invalid_part() {
  if (!std::isfinite(time_) || std::abs(time_) > limits::largest_time || std::isnan(round_)) return "time";
  if (!has_started_ && (time_ != 0.0 || definition_.start_time || tracks_.size() > 0)) return "time";
  if (const char* where = first_invalid_track()) return where;
  bool valid = true;
  pairs_.for_each([&](std::uint32_t a, std::uint32_t b, const PairRecord& pair) {
    valid = valid && is_valid_pair(a, b, pair);
  });
  if (!valid) return "pairs";
  if (!rebuild()) return "regions";
  const auto is_event = [this](const MonitorEvent& event) {
    return event.time == time_ && event.kind <= MonitorEventKind::reclassified &&
           event.verdict <= Verdict::within && event.before <= Verdict::within;
  };
  return std::all_of(events_.begin(), events_.end(), is_event) ? nullptr : "events";
}

}  // namespace kinesphere
