// Reads a stream: the text of a source becomes records, and these the reports of its format.
#include "watch/source/stream_reader.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "watch/nats/nats_streams.hpp"
#include "watch/source/file_source.hpp"
#include "watch/source/stream_kind.hpp"
#include "watch/source/tcp_source.hpp"
#include "watch/source/udp_source.hpp"

namespace kinesphere::program {
namespace {

/// Says how to read from an address of a kind that other programs read.
void refuse_address(const std::string& file) {
  if (file.starts_with("http://") || file.starts_with("https://"))
    throw ProgramError(fmt::format(
        "{}: expected a file, -, or an address tcp://, udp:// or nats://: say while sleep 1; do curl "
        "-s {}; done | kinesphere watch --clock arrival -",
        file, shell_word(file)));
}

std::unique_ptr<ReportSource> open_source(const WatchOptions& options, const StopSignals& stop,
                                          const StreamPlace* from) {
  if (is_udp_address(options.file))
    return make_udp_source(parse_udp_address(options.file), stop, options.quiet);
  if (is_tcp_address(options.file))
    return make_tcp_source(parse_tcp_address(options.file), stop, options.quiet, from);
  if (is_nats_address(options.file))
    return make_nats_source(parse_nats_address(options.file, "FILE"), stop, options.clock == "arrival",
                            options.quiet, from);
  refuse_address(options.file);
  return std::make_unique<FileSource>(options.file, stop, from);
}

/// True for a format whose files may have the reports of one track behind those of another. Reports with
/// times of arrival cannot be in another order.
bool may_be_grouped(StreamFormat format) {
  return format == StreamFormat::csv || format == StreamFormat::ais || format == StreamFormat::json ||
         format == StreamFormat::jsonl;
}

}  // namespace

StreamReader::StreamReader(const WatchOptions& options, const StopSignals& stop, const ReaderState* from)
    : options_(options),
      stop_(stop),
      source_(open_source(options, stop, from != nullptr ? &from->place : nullptr)),
      format_(find_format(from != nullptr ? from->format : options.choices.hints.format)) {}

std::optional<StreamFormat> StreamReader::find_format(const std::string& said) {
  if (!said.empty()) return format_named(said).value();
  StreamKind kind(options_.choices.hints, options_.clock == "arrival", *source_);
  for (bool has_ended = false; !stop_.asked();) {
    if (const auto format = kind.of(cutter_.waiting(), has_ended)) return format;
    const auto outcome = next(std::chrono::milliseconds(1000));
    has_ended = outcome == ReportSource::Outcome::end;
    if (outcome != ReportSource::Outcome::cut) continue;
    cutter_.rest();
    kind.begin_again();
  }
  return std::nullopt;
}

void StreamReader::begin(StreamFormat format, const Wrap& wrap, const ReaderState* from, bool is_new) {
  FormatChoices choices = options_.choices;
  choices.is_stopped = [this] { return stop_.asked(); };
  choices.source = source_->name();
  choices.position_error_is_said = !options_.position_error.empty();
  if (same_name(options_.own, "gps")) choices.own_by_gps = options_.own;
  reader_ = wrap(make_format(format, choices));
  cutter_.set_kind(records_of(format));
  // The begin of another stream differs from the saved one.
  if (from != nullptr && from->place.stream == source_->name()) {
    ByteReader memory(from->memory);
    reader_->restore(memory);
    if (memory.failed() || memory.remaining() != 0) throw WrongInput("expected the state of a format");
    cutter_.begin_at(from->line);
  }
  if (!is_new || !is_file() || !may_be_grouped(format) || options_.clock == "arrival") return;
  auto ordered = make_ordered_format(std::move(reader_), source_->name());
  ordered_ = ordered.get();
  reader_ = std::move(ordered);
}

ReportSource::Outcome StreamReader::next(std::chrono::milliseconds patience) {
  std::string_view text;
  const auto outcome = source_->next(patience, text);
  if (outcome == ReportSource::Outcome::text) cutter_.feed(text);
  is_cut_off_ = outcome == ReportSource::Outcome::cut;
  return outcome;
}

std::optional<Record> StreamReader::record() {
  if (std::exchange(is_cut_off_, false)) {
    auto record = cutter_.rest();
    // A row whose last number lacks digits looks whole; an object shows its end.
    if (record) record->is_whole = record->is_whole && record->text.ends_with('}');
    return record;
  }
  auto record = cutter_.next();
  if (!record && source_->has_whole_records()) record = cutter_.rest();
  return record;
}

void StreamReader::read(const Record& record, ReportSink& sink) {
  try {
    reader_->read(record, sink);
  } catch (const UnusableStream& error) {
    throw ProgramError(fmt::format("{}: {}", source_->name(), error.what()));
  }
}

void StreamReader::finish(ReportSink& sink) {
  try {
    reader_->finish(sink);
  } catch (const UnusableStream& error) {
    throw ProgramError(fmt::format("{}: {}", source_->name(), error.what()));
  }
}

std::string_view StreamReader::format_name() const {
  return reader_->title().empty() ? name_of(*format_) : reader_->title();
}

ReaderState StreamReader::state() const {
  // A later run reads again what is kept back.
  const bool is_at_begin = ordered_ != nullptr && ordered_->keeps_all();
  ByteWriter memory;
  reader_->save(memory);
  return {.format = std::string(name_of(*format_)),
          .place = source_->place(is_at_begin ? source_->position(0) : cutter_.waiting().size()),
          .line = is_at_begin ? RecordCutter::Line{} : cutter_.line(),
          .memory = memory.take()};
}

}  // namespace kinesphere::program
