// One run of a watch: its loop, until the stream ends or the program is asked to stop.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

#include "watch/output/alert_output.hpp"
#include "watch/output/state_server.hpp"
#include "watch/output/warnings.hpp"
#include "watch/source/stop_signals.hpp"
#include "watch/source/stream_reader.hpp"
#include "watch/watch_pipeline.hpp"
#include "watch/watch_snapshot.hpp"

namespace kinesphere::program {

/// Joins what is before and behind the pipeline:
///
///     source -> StreamReader -> WatchPipeline -> AlertOutput
///
/// with the snapshot, the warnings and the server of the state. Functions throw ProgramError.
class WatchLoop {
 public:
  /// Continues from the snapshot, if there is one. `options` must outlive the loop.
  explicit WatchLoop(const WatchOptions& options);

  void run();
  /// Stops the server.
  void close() { server_.reset(); }

  const WatchView& view() const { return pipeline_.view(); }
  /// Returns an SVG picture of what was watched. Precondition: the options have --plot.
  std::string plot() const { return pipeline_.plot(); }
  std::vector<Warning> warnings() { return warnings_.all(); }
  bool is_file() const { return reader_.is_file(); }
  /// Returns "unknown" before any text has arrived.
  std::string_view format_name() const { return reader_.format() ? reader_.format_name() : "unknown"; }

 private:
  /// Blocks requests for the state while it lives.
  std::unique_lock<StateServer> guarded();
  void go_on();
  std::unique_ptr<AlertOutput> open_alerts() const;
  void read_all();
  void read(Record record);
  void finish(bool has_ended);
  void pass_time();
  FileTime now() const;
  bool is_time_for_snapshot() const;
  void keep_snapshot();

  const WatchOptions& options_;
  StopSignals stop_;
  std::optional<WatchSnapshot> begun_from_;  ///< until all is there that goes on from it
  StreamReader reader_;
  WatchPipeline pipeline_;
  bool by_machine_;  ///< the clock is that of this machine
  Warnings warnings_;
  std::unique_ptr<StateServer> server_;
  std::chrono::duration<double> snapshot_interval_;
  std::optional<std::chrono::steady_clock::time_point> last_snapshot_;
  /// Opened last, so that no alert file is touched if another option is wrong.
  std::unique_ptr<AlertOutput> alerts_;
};

}  // namespace kinesphere::program
