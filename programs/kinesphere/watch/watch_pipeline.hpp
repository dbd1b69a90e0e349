// The stages of a watch, one behind the other: reports in, alerts out.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "watch/clock/report_clock.hpp"
#include "watch/monitor/pair_monitor.hpp"
#include "watch/output/alert_lines.hpp"
#include "watch/output/watch_plot.hpp"
#include "watch/policy/alert_desk.hpp"
#include "watch/tracks/watched_tracks.hpp"

namespace kinesphere::program {

/// Takes the reports of a stream and writes certain alerts:
///
///     format -> ReportClock -> WatchedTracks -> PairMonitor -> AlertDesk -> alerts
///
/// Holds the whole state of a watch, except what a format keeps from earlier lines.
class WatchPipeline final : public ReportSink, private ReportClock::Next {
 public:
  /// With `draws` it notes what plot() draws.
  WatchPipeline(WatchSettings settings, AlertFn alert, bool draws = false);
  WatchPipeline(const WatchPipeline&) = delete;
  WatchPipeline& operator=(const WatchPipeline&) = delete;

  // Functions for formats. They throw ProgramError naming an option that has to be given.
  void take(const SourceReport& report) override;
  void time_is(const FileTime& arrival, TimeKind kind) override { clock_.time_is(arrival, kind); }
  void pass_over(Passed reason) override;
  void warn(const std::string& warning) override { warnings_.push_back(warning); }
  /// Counts a malformed record. Throws ProgramError if there have been too many.
  void refuse(std::size_t line, const std::string& reason) override;
  void refuse(const std::string& reason) override { refuse(line_, reason); }

  /// Sets the line of the stream for all calls until end_record().
  void begin_record(std::size_t line) { line_ = line; }
  /// Writes all alerts that are certain from the input so far.
  void end_record();
  /// Sets the present time of this machine's clock, in seconds since 1970.
  void machine_time_is(const FileTime& now) { clock_.machine_time_is(now); }
  /// Call at the end of the stream.
  void finish();

  /// save() returns the whole state except the settings; restore() puts it into a new pipeline with equal
  /// settings. restore() throws WrongInput if this is not the state of a watch.
  std::vector<std::byte> save() const;
  void restore(std::span<const std::byte> state);

  /// Returns what the stages know. It is valid as long as the pipeline.
  const WatchView& view() const { return view_; }
  /// Returns an SVG picture of the watch. Precondition: it draws.
  std::string plot() const { return plot_->svg(); }
  /// Returns the warnings of the format since the last call.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  // Functions for the clock.
  void go_on() override;
  void deliver(const SourceReport& report) override;
  bool has_several_tracks() const override { return tracks_.names().size() > 1; }

  static void serialize(auto& self, auto& archive) {
    archive(self.counts_, self.clock_, self.tracks_, self.pairs_, self.desk_);
  }

  WatchSettings settings_;
  WatchCounts counts_;
  std::unique_ptr<AlertDesk::Next> alerts_;
  WatchPlot* plot_ = nullptr;  ///< alerts_, if it draws
  ReportClock clock_;
  WatchedTracks tracks_;
  PairMonitor pairs_;
  AlertDesk desk_;
  WatchView view_;
  std::vector<std::string> warnings_;
  std::size_t line_ = 0;
};

}  // namespace kinesphere::program
