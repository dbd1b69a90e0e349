#include "watch/source/ordered_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "watch/source/kept_report.hpp"

namespace kinesphere::program {
namespace {

/// Largest numbers of reports that are kept back: of the first track, and of all. Each takes half a kilobyte.
constexpr std::size_t most_of_first = 50'000, most_of_all = 500'000;

class KeepingFormat final : public OrderedFormat, private ReportSink {
 public:
  KeepingFormat(std::unique_ptr<ReportFormat> format, std::string source)
      : format_(std::move(format)), source_(std::move(source)) {
    ByteWriter state;
    format_->save(state);
    begin_ = state.take();
  }

  void read(const Record& record, ReportSink& sink) override {
    if (phase_ == Phase::passes) return format_->read(record, sink);
    sink_ = &sink;
    format_->read(record, *this);
  }
  void finish(ReportSink& sink) override {
    sink_ = &sink;
    format_->finish(*this);
    pass_kept();
  }
  const RowReader* rows() const override { return format_->rows(); }
  std::string_view title() const override { return format_->title(); }
  void save(ByteWriter& state) const override {
    if (keeps_all()) return state.append(begin_);
    format_->save(state);
  }
  void restore(ByteReader& state) override { format_->restore(state); }
  bool keeps_all() const override { return phase_ != Phase::passes; }

 private:
  enum class Phase { first_track, sorts, passes };

  void take(const SourceReport& report) override {
    if (phase_ == Phase::passes) return sink_->take(report);
    if (report.arrival) {
      pass_kept();
      return sink_->take(report);
    }
    const bool is_second = phase_ == Phase::first_track && !kept_.empty() && kept_.front().id != report.id;
    const bool is_grouped = is_second && is_far_behind(report);
    kept_.push_back(KeptReport::of(report));
    if (is_grouped) {
      phase_ = Phase::sorts;
      sink_->warn(
          fmt::format("{}: the reports of one track stand behind those of another: they have to be sorted by "
                      "their times, for which it is read as a whole",
                      source_));
    } else if (is_second || kept_.size() >= (phase_ == Phase::sorts ? most_of_all : most_of_first)) {
      pass_kept();
    }
  }
  void time_is(const FileTime& arrival, TimeKind kind) override {
    pass_kept();
    sink_->time_is(arrival, kind);
  }
  void pass_over(Passed reason) override { sink_->pass_over(reason); }
  void warn(const std::string& warning) override { sink_->warn(warning); }
  void refuse(std::size_t line, const std::string& reason) override { sink_->refuse(line, reason); }

  /// True for a report behind those of the first track that is older than their latest one by more than half
  /// of their time. Reports that are merely late are not as old.
  bool is_far_behind(const SourceReport& report) const {
    constexpr double seconds_of_disorder = 5.0;
    const auto [first, last] = std::minmax_element(
        kept_.begin(), kept_.end(),
        [](const KeptReport& a, const KeptReport& b) { return is_earlier(a.report.stamp, b.report.stamp); });
    const double behind = seconds_between(report.stamp, last->report.stamp);
    const double lasting = seconds_between(first->report.stamp, last->report.stamp);
    return behind > std::max(seconds_of_disorder, 0.5 * lasting);
  }
  /// Passes on all that has been kept back, by time where it has to be sorted, and keeps nothing more.
  void pass_kept() {
    if (phase_ == Phase::sorts)
      std::stable_sort(kept_.begin(), kept_.end(), [](const KeptReport& a, const KeptReport& b) {
        return is_earlier(a.report.stamp, b.report.stamp);
      });
    phase_ = Phase::passes;
    for (KeptReport& kept : std::exchange(kept_, {})) sink_->take(kept.get());
  }

  std::unique_ptr<ReportFormat> format_;
  std::vector<std::byte> begin_;  ///< state of the format before its first record
  std::string source_;
  Phase phase_ = Phase::first_track;
  std::deque<KeptReport> kept_;
  ReportSink* sink_ = nullptr;
};

}  // namespace

std::unique_ptr<OrderedFormat> make_ordered_format(std::unique_ptr<ReportFormat> format,
                                                   const std::string& source) {
  return std::make_unique<KeepingFormat>(std::move(format), source);
}

}  // namespace kinesphere::program
