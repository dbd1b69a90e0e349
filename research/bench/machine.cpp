// Description of the machine of a benchmark: hardware, compiler, version, date.
#include "research/bench/machine.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <thread>

#include "kinesphere/version.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

/// Returns the text after the colon in the first line of a /proc file that begins with `label`.
std::string field_of(const char* file, const std::string& label) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(label) || colon == std::string::npos) continue;
    const std::size_t text = line.find_first_not_of(" \t", colon + 1);
    if (text != std::string::npos) return line.substr(text);
  }
  return "unknown";
}

std::string load() {
  std::ifstream stream("/proc/loadavg");
  std::string minute;
  return stream >> minute ? minute : "unknown";
}

#if defined(__clang__)
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

}  // namespace

std::string machine_description() {
  Summary summary;
  summary.row("processor", field_of("/proc/cpuinfo", "model name"));
  summary.row("cores", std::to_string(std::thread::hardware_concurrency()));
  summary.row("memory", field_of("/proc/meminfo", "MemTotal"));
  summary.row("load", load() + " when the benchmark began");
  summary.row("compiler", compiler);
  summary.row("flags", KINESPHERE_FLAGS);
  summary.row("version", fmt::format("kinesphere {}", version));
  summary.row("date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))));
  return summary.text();
}

}  // namespace kinesphere::program
