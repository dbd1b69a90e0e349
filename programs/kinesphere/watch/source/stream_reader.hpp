// Reads a stream: the text of a source becomes records, and these the reports of its format.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/streams/report_format.hpp"
#include "formats/tables/record_cutter.hpp"
#include "watch/source/ordered_format.hpp"
#include "watch/source/report_source.hpp"
#include "watch/source/stop_signals.hpp"
#include "watch/watch.hpp"

namespace kinesphere::program {

/// How far a stream has been read, and what its format remembers.
struct ReaderState {
  std::string format;
  StreamPlace place;
  RecordCutter::Line line;  ///< at that place
  std::vector<std::byte> memory;
};

/// Functions throw ProgramError naming the source.
class StreamReader {
 public:
  /// Opens the source, and reads until its text shows the format. The references must outlive the reader.
  /// `from`: where an earlier run was; null: there was none.
  StreamReader(const WatchOptions& options, const StopSignals& stop, const ReaderState* from);

  /// Returns nothing if the program was asked to stop before the text showed it.
  const std::optional<StreamFormat>& format() const { return format_; }
  const ReportSource& source() const { return *source_; }
  /// True if the stream is a file, which can be read again.
  bool is_file() const { return source_->nature() == ReportSource::Nature::recording; }

  /// Puts something around a format.
  using Wrap = std::function<std::unique_ptr<ReportFormat>(std::unique_ptr<ReportFormat> format)>;
  /// Makes the format, with what `wrap` puts around it. Call it once, before the functions behind. `from` as
  /// above. `is_new`: no report of the stream has been taken: those of a file may be sorted. Throws
  /// WrongInput for a memory that is none of this format.
  void begin(StreamFormat format, const Wrap& wrap, const ReaderState* from, bool is_new);
  /// Waits for text, at most `patience` or until the program is asked to stop.
  ReportSource::Outcome next(std::chrono::milliseconds patience);
  /// Returns the next record, also one that a lost connection has cut off; nothing if more text is needed.
  std::optional<Record> record();
  /// Returns the rest of a stream that has ended.
  std::optional<Record> rest() { return cutter_.rest(); }
  /// Passes the reports of a record on. Throws WrongInput for a record, or a part of one, that is malformed.
  void read(const Record& record, ReportSink& sink);
  /// Call it at the end of the stream.
  void finish(ReportSink& sink);

  /// Returns how far records have been cut, as StreamPlace counts, less `behind` bytes of what follows.
  std::uint64_t position(std::size_t behind) const { return source_->position(behind); }
  std::uint64_t position() const { return source_->position(cutter_.waiting().size()); }
  /// Returns the name of the format, or of the kind of recording.
  std::string_view format_name() const;
  /// Returns where a later run has to go on.
  ReaderState state() const;

 private:
  std::optional<StreamFormat> find_format(const std::string& said);

  const WatchOptions& options_;
  const StopSignals& stop_;
  std::unique_ptr<ReportSource> source_;
  RecordCutter cutter_;
  std::optional<StreamFormat> format_;
  std::unique_ptr<ReportFormat> reader_;
  OrderedFormat* ordered_ = nullptr;  ///< the reader of a file that may have to be sorted; else null
  bool is_cut_off_ = false;           ///< a connection was lost, and its last record is still to be read
};

}  // namespace kinesphere::program
