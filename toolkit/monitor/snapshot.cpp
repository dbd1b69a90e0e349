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
                                    11,
                                    "monitor",
                                    "Monitor::restore",
                                    "snapshot",
                                    ErrorCode::bad_snapshot};

/// Returns true for an unused track number: its entry is as TrackTable::remove() leaves it.
bool is_blank(const KnownTrack& track) {
  const auto& [id, track_class, present, stale, life, placed, expected, estimate, open] = track;
  return id == 0 && track_class == 0 && !present && !stale && life == 0 && placed == 0 && expected == 0 &&
         estimate.hypotheses().empty() && open.empty();
}

}  // namespace

template <class Self, class Archive>
void Monitor::Engine::serialize(Self& self, Archive& archive) {
  archive(self.time_, self.has_started_, self.window_, self.quiet_windows_, self.sparse_windows_,
          self.reports_before_window_, self.counters_, self.tracks_, self.broad_phase_, self.predictions_);
  std::vector<SavedPair<PairRecord>> records;
  std::vector<MonitorEvent> events;
  std::uint32_t last_revision = 0;
  if constexpr (std::is_const_v<Self>) {
    records = self.pair_records_.sorted();
    events.assign(self.events_.begin(), self.events_.end());
    last_revision = self.pair_records_.last_revision();
    std::vector<PairCertificate> pairs;
    self.queue_.for_each([&](const PairCertificate& pair) {
      if (!self.is_stale(pair)) pairs.push_back(pair);
    });
    std::sort(pairs.begin(), pairs.end());
    archive(records, last_revision, events, pairs);
  } else {
    archive(records, last_revision, events, self.read_pairs_);
    for (const SavedPair<PairRecord>& saved : records)
      self.pair_records_.add(saved.first, saved.second, 0) = saved.record;
    self.pair_records_.start_revisions_at(last_revision);
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
  if (const char* where = engine->tracks_.index() ? engine->first_invalid_part() : "tracks")
    return monitor_envelope.refusal(
        std::string("must hold a monitor that can be, but contradicts itself in its ") + where);
  std::vector<std::optional<Predictions::TrackKey>> keys(engine->tracks_.numbers());
  for (std::uint32_t number = 0; number < keys.size(); ++number)
    if (const KnownTrack& track = engine->tracks_[number]; track.present)
      keys[number] = {track.id, track.track_class};
  if (!engine->predictions_.restore(keys, engine->time_))
    return monitor_envelope.refusal(
        "must hold a monitor that can be, but contradicts itself in its predictions");
  engine->queue_.add_all(engine->read_pairs_);
  return engine;
}

/// Returns true if the window has ended, or if Window::at() gives it for a time since its start.
bool Monitor::Engine::window_is_valid() const {
  if (!(window_.end > time_)) return !std::isnan(window_.end);
  return window_.rung != Window::endless().rung && window_.is_valid() &&
         (Window::at(time_, window_.rung) == window_ ||
          (window_.begin() <= time_ && Window::at(window_.begin(), window_.rung) == window_));
}

const char* Monitor::Engine::first_invalid_part() const {
  if (!std::isfinite(time_) || std::abs(time_) > limits::largest_time) return "time";
  if (!has_started_ && (time_ != 0.0 || definition_.start_time || tracks_.size() > 0)) return "time";
  if (!window_is_valid()) return "windows";
  if (!broad_phase_.is_valid(std::size_t{tracks_.numbers()} * TrackEstimate::slots)) return "windows";
  const auto is_present = [this](std::uint32_t number) {
    return number < tracks_.numbers() && tracks_[number].present;
  };
  std::size_t partners = 0;
  for (std::uint32_t number = 0; number < tracks_.numbers(); ++number) {
    const KnownTrack& track = tracks_[number];
    bool placed = false;
    for (std::uint32_t slot = 0; slot < TrackEstimate::slots; ++slot) {
      const std::uint32_t place = number * TrackEstimate::slots + slot;
      const bool contains = broad_phase_.contains(place);
      placed = placed || contains;
      if ((track.placed & 1u << slot) != 0 && !contains) return "windows";
      // All tracks start together when the first of their windows ends.
      if (contains && broad_phase_.end_of(place) > time_ && broad_phase_.window_of(place) != window_)
        return "windows";
    }
    if (placed != track.present || track.placed >> TrackEstimate::slots != 0) return "windows";
    if (!track.present) {
      // The next track with this number reuses the entry, so it has to be blank.
      if (!is_blank(track)) return "tracks";
      continue;
    }
    if (track.track_class >= definition_.classes.size() || !track.estimate.is_valid(time_)) return "tracks";
    partners += track.open.size();
    for (std::size_t k = 0; k < track.open.size(); ++k) {
      const std::uint32_t other = track.open[k];
      if (!is_present(other) || other == number || pair_records_.find(number, other) == nullptr ||
          std::count(track.open.begin(), track.open.end(), other) != 1 ||
          std::count(tracks_[other].open.begin(), tracks_[other].open.end(), number) != 1)
        return "pairs";
    }
  }
  if (partners != 2 * pair_records_.size()) return "pairs";
  bool valid = true;
  pair_records_.for_each([&](std::uint32_t a, std::uint32_t b, const PairRecord& record) {
    valid = valid && a < b && is_present(a) && is_present(b) &&
            record.revision <= pair_records_.last_revision() &&
            record.levels.size() == levels_of(a, b).size() &&
            std::all_of(record.levels.begin(), record.levels.end(), [](const LevelState& state) {
              return state.verdict <= Verdict::within && !std::isnan(state.since) && !std::isnan(state.until);
            });
  });
  if (!valid) return "pairs";
  const auto is_pair = [&](const PairCertificate& pair) {
    return pair.failure_time < infinity && is_present(pair.first) &&
           (pair.kind() == PairCertificate::Kind::silence ||
            (pair.first < pair.second && is_present(pair.second))) &&
           !is_stale(pair);
  };
  if (!std::all_of(read_pairs_.begin(), read_pairs_.end(), is_pair)) return "certificates";
  const auto is_event = [this](const MonitorEvent& event) {
    return event.time == time_ && event.kind <= MonitorEventKind::reclassified &&
           event.verdict <= Verdict::within && event.before <= Verdict::within;
  };
  return std::all_of(events_.begin(), events_.end(), is_event) ? nullptr : "events";
}

}  // namespace kinesphere
