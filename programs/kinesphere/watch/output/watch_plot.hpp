// A picture of a watch: a map of its tracks, and when which pairs had alerts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/chart.hpp"
#include "watch/output/watch_view.hpp"

namespace kinesphere::program {

/// Takes memory for 400,000 places of tracks and 10,000 pairs with alerts at most: of longer watches it keeps
/// every second place, fourth and so on, and of more pairs the first.
class WatchPlot final : public AlertDesk::Next {
 public:
  /// Passes all alerts on. The view must be of the stages before, and outlive the plot.
  WatchPlot(const WatchView& view, std::unique_ptr<AlertDesk::Next> next)
      : view_(view), next_(std::move(next)) {}

  /// Notes where the tracks are, if enough time has passed since the last call that did so.
  void look();
  /// Returns an SVG picture of 1200 by 520 pixels.
  std::string svg() const;

  void write_event(std::uint64_t share, const MonitorEvent& event, const LeftFor& left_for) override;
  void write_lost(std::uint64_t share, const LostTrack& lost) override;
  void write_one_body(std::uint64_t share, double time, TrackId first, TrackId second) override {
    next_->write_one_body(share, time, first, second);
  }
  void write_group(std::uint64_t share, double time, const std::string& name, std::size_t tracks) override {
    next_->write_group(share, time, name, tracks);
  }
  void write_refused(std::uint64_t share, const AlertPolicy::Refused& refused) override {
    next_->write_refused(share, refused);
  }

 private:
  struct Place {
    double time;
    ChartPoint at;  ///< longitude and latitude, or x and y
  };
  struct Span {
    bool is_within;  ///< certainly within a separation; else predicted
    double from;
    double until;  ///< infinite while it goes on
  };
  struct Pair {
    TrackId first, second;
    std::string names;
    std::uint32_t level;  ///< of its latest alert
    std::vector<Span> spans;
    double closest;  ///< the least distance that was expected, where it was, and when
    ChartPoint closest_at;
    double closest_time;
  };

  Pair* pair_of(TrackId first, TrackId second);
  void begin(Pair& pair, bool is_within, double time);
  static void end(Pair& pair, bool is_within, double time);
  /// Notes the closest approach that is expected now.
  void note_closest(Pair& pair);
  void look_at_encounters();
  std::string name_of_track(TrackId id) const;
  std::string distance_text(double distance) const;
  ChartPoint on_map(const Vec3& place) const;
  std::string map(const std::vector<const Pair*>& shown) const;
  std::string times(const std::vector<const Pair*>& shown) const;

  const WatchView& view_;
  std::unique_ptr<AlertDesk::Next> next_;
  std::unordered_map<TrackId, std::vector<Place>> ways_;
  std::size_t places_ = 0;
  double interval_ = 1.0;  ///< between places of a track (seconds)
  std::optional<double> last_look_;
  std::vector<Pair> pairs_;
  std::map<std::pair<TrackId, TrackId>, std::size_t> numbers_;  ///< of the pairs
};

}  // namespace kinesphere::program
