// One run of a watch, until the stream ends or the program is asked to stop.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

#include "formats/tables/record_cutter.hpp"
#include "watch/alert_output.hpp"
#include "watch/ordered_format.hpp"
#include "watch/report_source.hpp"
#include "watch/state_server.hpp"
#include "watch/stop_signals.hpp"
#include "watch/watch.hpp"
#include "watch/watch_snapshot.hpp"
#include "watch/watcher.hpp"

namespace kinesphere::program {

/// Continues from the snapshot, if there is one. Functions throw ProgramError.
class WatchRun {
 public:
  /// `options` must outlive the run.
  explicit WatchRun(const WatchOptions& options);

  void run();
  /// Stops the server.
  void close() { server_.reset(); }

  const Watcher& watcher() const { return watcher_; }
  /// True if the stream is a file, which can be read again.
  bool is_file() const { return source_->nature() == ReportSource::Nature::recording; }
  /// Returns "unknown" before any text has arrived.
  std::string_view format_name() const;

 private:
  /// Blocks requests for the state while it lives.
  std::unique_lock<StateServer> guarded();
  void go_on_from(const WatchSnapshot& snapshot);
  std::unique_ptr<AlertOutput> open_alerts() const;
  /// Processes the text that has arrived.
  void take();
  /// Hands over what a lost connection has cut off.
  void take_cut_off();
  void read(Record record);
  void finish();
  void pass_time();
  FileTime now() const;
  void complain();
  void warn();
  void warn_of_doubtful_reports();
  void warn_of_small_separations();
  void warn_of_own();
  void warn_of_disorder();
  void warn_of_one_track();
  void warn_of_one_moment();
  void warn_of_undecided_bodies();
  void put_in_order();
  void warn_once(bool& has_warned, std::string_view warning);
  bool is_time_for_snapshot() const;
  void keep_snapshot();

  const WatchOptions& options_;
  StopSignals stop_;
  std::optional<WatchSnapshot> begun_from_;  ///< until all is there that goes on from it
  std::unique_ptr<ReportSource> source_;
  RecordCutter cutter_;
  std::optional<StreamFormat> known_format_;  ///< none where the program was asked to stop before
  StreamFormat format_;
  Watcher watcher_;
  std::unique_ptr<ReportFormat> reader_;
  OrderedFormat* ordered_ = nullptr;  ///< the reader of a file that may have to be sorted; else null
  std::unique_ptr<StateServer> server_;
  std::size_t complaints_ = 0;
  bool has_warned_of_crowds_ = false, has_warned_of_unusable_ = false, has_warned_of_heights_ = false;
  bool has_warned_of_small_ = false, has_warned_of_plane_ = false, has_warned_of_own_ = false,
       has_warned_of_clock_ = false, has_warned_of_order_ = false;
  bool has_warned_of_contradictions_ = false, has_warned_of_ahead_ = false, has_warned_of_velocities_ = false;
  std::uint64_t taken_before_ = 0, stale_before_ = 0;  ///< at the last report that was taken
  std::chrono::duration<double> snapshot_interval_;
  std::optional<std::chrono::steady_clock::time_point> last_snapshot_;
  /// Opened last, so that no alert file is touched if another option is wrong.
  std::unique_ptr<AlertOutput> alerts_;
};

}  // namespace kinesphere::program
