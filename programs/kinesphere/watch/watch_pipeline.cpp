// The stages of a watch, one behind the other: reports in, alerts out.
#include "watch/watch_pipeline.hpp"

#include <fmt/format.h>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/wrong_input.hpp"

namespace kinesphere::program {

namespace {

std::unique_ptr<AlertDesk::Next> alerts_of(const WatchSettings& settings, const WatchView& view,
                                           AlertFn alert, bool draws) {
  auto lines =
      settings.text ? make_text_alerts(view, std::move(alert)) : make_json_alerts(view, std::move(alert));
  if (!draws) return lines;
  return std::make_unique<WatchPlot>(view, std::move(lines));
}

}  // namespace

WatchPipeline::WatchPipeline(WatchSettings settings, AlertFn alert, bool draws)
    : settings_(std::move(settings)),
      alerts_(alerts_of(settings_, view_, std::move(alert), draws)),
      plot_(draws ? static_cast<WatchPlot*>(alerts_.get()) : nullptr),
      clock_(settings_, counts_, *this),
      tracks_(settings_, counts_, clock_, [this](const std::string& reason) { refuse(reason); }),
      pairs_(settings_, counts_, tracks_, desk_),
      desk_(settings_, counts_, tracks_, pairs_, *alerts_),
      view_{settings_, counts_, clock_, tracks_, pairs_, desk_} {}

void WatchPipeline::take(const SourceReport& report) {
  tracks_.begin_classes(report);
  if (settings_.ids.is_empty()) return clock_.take(report);
  const auto body = settings_.ids.name_of(report.id);
  if (!body) return pass_over(Passed::filtered);
  SourceReport of_body = report;
  of_body.id = *body;
  clock_.take(of_body);
}

void WatchPipeline::go_on() {
  if (pairs_.monitor()) pairs_.go_on(clock_.now());
}

void WatchPipeline::deliver(const SourceReport& report) {
  WatchedTracks::Arrival arrival{.report = report};
  if (!tracks_.recognise(arrival)) return tracks_.refuse_without_velocity(view_.counters().reports == 0);
  if (!pairs_.monitor()) {
    tracks_.begin_map(report);
    pairs_.begin(clock_.now());
  }
  const bool is_first = arrival.known == nullptr;
  if (!tracks_.place(arrival, !is_first || pairs_.has_room())) return;
  std::string refusal;
  const PairMonitor::Taken taken = pairs_.take(arrival, refusal);
  if (taken == PairMonitor::Taken::refused) refuse(fmt::format("{}: {}", report.id, refusal));
  if (taken != PairMonitor::Taken::alone) return;
  if (tracks_.remember(arrival)) pairs_.release_later(arrival.id);
  pairs_.compare(arrival, is_first);
  desk_.enter_area(arrival.id);
  pairs_.release_due();
}

void WatchPipeline::pass_over(Passed reason) {
  ++(reason == Passed::no_position ? counts_.no_position
     : reason == Passed::no_bound  ? counts_.no_bound
                                   : counts_.filtered);
}

void WatchPipeline::refuse(std::size_t line, const std::string& reason) {
  constexpr std::size_t most_told = 10;
  ++counts_.malformed;
  const bool is_too_much = counts_.malformed > settings_.most_malformed;
  if (counts_.first_malformed.size() == most_told && !is_too_much) return;
  const std::string text = without_controls(reason);
  if (counts_.first_malformed.size() < most_told) counts_.first_malformed.push_back({line, text});
  if (is_too_much)
    throw ProgramError(fmt::format("{}:{}: {}; that makes {} malformed, and --most-malformed allows {}",
                                   settings_.source, line, text, counts_.malformed,
                                   settings_.most_malformed));
}

void WatchPipeline::end_record() {
  if (pairs_.monitor()) pairs_.settle();
  if (plot_ != nullptr) plot_->look();
}

void WatchPipeline::finish() {
  clock_.finish();
  end_record();
  desk_.finish();
}

std::vector<std::byte> WatchPipeline::save() const {
  ByteWriter state;
  serialize(*this, state);
  return state.take();
}

void WatchPipeline::restore(std::span<const std::byte> state) {
  ByteReader reader(state);
  serialize(*this, reader);
  if (reader.failed() || reader.remaining() != 0) throw WrongInput("expected the state of a watch");
}

}  // namespace kinesphere::program
