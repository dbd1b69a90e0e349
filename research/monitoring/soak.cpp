#include "research/monitoring/soak.hpp"

#include <chrono>
#include <vector>

#include "research/measures/peak_memory.hpp"
#include "research/monitoring/verdict_check.hpp"

namespace kinesphere {

Soak soak(const SoakSettings& settings, const std::function<void(std::uint64_t)>& progress) {
  using Clock = std::chrono::steady_clock;
  FaultyReports reports(settings.faults);
  VerdictCheck check(settings.faults, reports.motion(), settings.distance, settings.tolerance);
  Monitor monitor = Monitor::create({.classes = {reports.promise()},
                                     .separations = {{0, 0, {Separation::sphere(settings.distance)}}},
                                     .tolerance = settings.tolerance,
                                     .window = settings.faults.interval,
                                     .stale_after = 10.0 * settings.faults.interval,
                                     .drop_after = 1000.0 * settings.faults.interval})
                        .value();
  Soak result;
  std::vector<MonitorEvent> reported;
  constexpr std::uint64_t at_once = 1024;
  std::vector<Delivery> deliveries(at_once);
  for (std::uint64_t taken = 0; taken < settings.reports; taken += at_once) {
    for (Delivery& delivery : deliveries) delivery = reports.next();
    const Clock::time_point begin = Clock::now();
    for (const Delivery& delivery : deliveries) {
      for (const MonitorEvent& event : monitor.events(delivery.time)) reported.push_back(event);
      monitor.report(delivery.track, delivery.report).value();
    }
    for (const MonitorEvent& event : monitor.events(monitor.time())) reported.push_back(event);
    result.monitor_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    check.compare(monitor.time(), reported);
    reported.clear();
    if (result.memory_early == 0 && 4 * taken >= settings.reports) result.memory_early = peak_memory();
    if (progress && taken % (64 * at_once) == 0) progress(taken);
  }
  result.faults = reports.counts();
  result.counters = monitor.counters();
  result.time = monitor.time();
  result.approaches = check.approaches;
  result.missed = check.missed;
  result.warnings = check.warnings;
  result.wrongly_within = check.wrongly_within;
  result.memory = peak_memory();
  result.open = monitor.open_pairs().size();
  return result;
}

}  // namespace kinesphere
