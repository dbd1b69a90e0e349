#include "lab/monitoring/soak.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <unordered_map>
#include <vector>

#include "kinesphere/world.hpp"

namespace kinesphere {
namespace {

/// Tracks that are within either of two distances of each other, in truth, and what the monitor says.
class Comparison {
 public:
  Comparison(const SoakSettings& settings, const RandomForces& motion)
      // Less than the distance by more than the world's tolerances, and more than it and the tolerance.
      : near_(settings.distance - margin),
        far_(settings.distance + settings.tolerance + margin),
        // Everybody has been heard of then.
        begin_(2.0 * settings.faults.interval + settings.faults.delay),
        motion_(motion.clone()),
        world_(World::create({.contact_tolerance = 1e-4 * margin}).value()) {
    world_.set_sensor(0, {.distances = {far_, near_}}).value();
    for (std::uint32_t track = 0; track < settings.faults.tracks; ++track) {
      BodyDefinition body = motion_->definition(track, 0.0);
      body.radius = 0.0;
      body.solid = false;
      body.user_data = track;
      world_.add(body).value();
    }
  }

  /// What has happened in truth, and what the monitor has told, up to a time; each in order.
  void compare(double until, const std::vector<MonitorEvent>& told) {
    auto next = told.begin();
    const auto take_told = [&](double time) {
      for (; next != told.end() && next->time <= time; ++next) take(*next);
    };
    const auto probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = motion_->state(ids[k].index, time);
    };
    for (const Event& event : world_.events(until, probe)) {
      take_told(event.time);
      take(event);
    }
    take_told(until);
  }

  std::uint64_t approaches = 0;
  std::uint64_t missed = 0;
  std::uint64_t warnings = 0;
  std::uint64_t wrongly_within = 0;

 private:
  static constexpr double margin = 1e-2;

  static std::uint64_t key(std::uint64_t a, std::uint64_t b) { return std::min(a, b) << 32 | std::max(a, b); }

  /// From a pair's coming near on it has to be told of, until it has parted.
  void approach(std::uint64_t pair, double time) {
    if (time < begin_) return;
    ++approaches;
    if (!verdicts_.contains(pair)) ++missed;
  }
  void begin() {
    if (begun_) return;
    begun_ = true;
    for (const std::uint64_t pair : truly_near_) approach(pair, begin_);
  }

  void take(const Event& event) {
    const std::uint64_t pair = key(event.first_user_data, event.second_user_data);
    const bool enters = event.kind == EventKind::sensor_enter;
    if (event.time >= begin_) begin();
    if (event.distance == near_) {
      if (enters) {
        truly_near_.insert(pair);
        approach(pair, event.time);
      } else {
        truly_near_.erase(pair);
      }
    } else if (enters) {
      truly_within_.insert(pair);
    } else {
      truly_within_.erase(pair);
      const auto verdict = verdicts_.find(pair);
      if (verdict != verdicts_.end() && verdict->second == Verdict::within) ++wrongly_within;
    }
  }

  void take(const MonitorEvent& event) {
    if (event.kind != MonitorEventKind::verdict) return;
    const std::uint64_t pair = key(event.first, event.second);
    if (event.before == Verdict::apart) ++warnings;
    if (event.verdict == Verdict::apart) {
      verdicts_.erase(pair);
      if (begun_ && truly_near_.contains(pair)) ++missed;
      return;
    }
    verdicts_[pair] = event.verdict;
    if (event.verdict == Verdict::within && !truly_within_.contains(pair)) ++wrongly_within;
  }

  double near_;
  double far_;
  double begin_;
  bool begun_ = false;
  std::unique_ptr<Motion> motion_;
  World world_;
  std::set<std::uint64_t> truly_near_;
  std::set<std::uint64_t> truly_within_;
  std::unordered_map<std::uint64_t, Verdict> verdicts_;
};

std::uint64_t largest_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

Soak soak(const SoakSettings& settings, const std::function<void(std::uint64_t)>& progress) {
  using Clock = std::chrono::steady_clock;
  FaultyReports reports(settings.faults);
  Comparison comparison(settings, reports.motion());
  Monitor monitor = Monitor::create({.classes = {reports.promise()},
                                     .separations = {{0, 0, {Separation::sphere(settings.distance)}}},
                                     .tolerance = settings.tolerance,
                                     .window = settings.faults.interval,
                                     .silence_after = 10.0 * settings.faults.interval,
                                     .forget_after = 1000.0 * settings.faults.interval})
                        .value();
  Soak result;
  std::vector<MonitorEvent> told;
  constexpr std::uint64_t at_once = 1024;
  std::vector<Delivery> deliveries(at_once);
  for (std::uint64_t taken = 0; taken < settings.reports; taken += at_once) {
    for (Delivery& delivery : deliveries) delivery = reports.next();
    const Clock::time_point begin = Clock::now();
    for (const Delivery& delivery : deliveries) {
      for (const MonitorEvent& event : monitor.events(delivery.time)) told.push_back(event);
      monitor.report(delivery.track, delivery.report).value();
    }
    for (const MonitorEvent& event : monitor.events(monitor.time())) told.push_back(event);
    result.monitor_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    comparison.compare(monitor.time(), told);
    told.clear();
    if (result.memory_early == 0 && 4 * taken >= settings.reports) result.memory_early = largest_memory();
    if (progress && taken % (64 * at_once) == 0) progress(taken);
  }
  result.faults = reports.counts();
  result.counters = monitor.counters();
  result.time = monitor.time();
  result.approaches = comparison.approaches;
  result.missed = comparison.missed;
  result.warnings = comparison.warnings;
  result.wrongly_within = comparison.wrongly_within;
  result.memory = largest_memory();
  result.open = monitor.open_pairs().size();
  return result;
}

}  // namespace kinesphere
