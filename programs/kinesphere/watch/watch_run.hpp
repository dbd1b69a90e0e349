// One run of a watch: a stream that is read to its end, or until the program is asked to stop.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include "watch.hpp"
#include "watch/alert_output.hpp"
#include "watch/record_cutter.hpp"
#include "watch/report_source.hpp"
#include "watch/state_server.hpp"
#include "watch/stop_signals.hpp"
#include "watch/watch_snapshot.hpp"
#include "watch/watcher.hpp"

namespace kinesphere::program {

/// Goes on from the snapshot, if there is one. Functions throw ProgramError.
class WatchRun {
 public:
  /// `options` must live longer.
  explicit WatchRun(const WatchOptions& options);

  void run();
  /// No more is served.
  void close() { server_.reset(); }

  const Watcher& watcher() const { return watcher_; }
  StreamFormat format() const { return format_; }

 private:
  /// Holds off whoever asks for the state.
  std::unique_lock<StateServer> guarded();
  /// Takes what of the stream has come in.
  void take();
  void read(const Record& record);
  void pass_time();
  FileTime now() const;
  void flush();
  void complain();
  void keep_snapshot();

  const WatchOptions& options_;
  StopSignals stop_;
  std::optional<WatchSnapshot> begun_from_;  ///< until it has been gone on from
  std::unique_ptr<ReportSource> source_;
  RecordCutter cutter_;
  StreamFormat format_;
  std::unique_ptr<AlertOutput> alerts_;
  Watcher watcher_;
  std::unique_ptr<ReportFormat> reader_;
  std::unique_ptr<StateServer> server_;
  std::size_t complaints_ = 0;
  std::chrono::duration<double> snapshot_interval_;
  std::chrono::steady_clock::time_point last_snapshot_ = std::chrono::steady_clock::now();
};

}  // namespace kinesphere::program
