#include "rank_table.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <ctime>
#include <vector>

#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

using Line = std::array<std::string, 11>;

std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

std::string seconds(double time) { return fmt::format("{:.3f} s", time); }

Line line_of(std::string name, const RankUse& use) {
  const RankFigures& figures = use.figures;
  return {std::move(name),
          grouped(figures.bodies),
          grouped(figures.ghosts),
          megabytes(figures.bytes),
          grouped(figures.messages),
          grouped(figures.batches),
          grouped(figures.rounds),
          seconds(use.processor_seconds),
          seconds(use.processor_seconds - figures.seconds_in_mpi),
          seconds(figures.seconds_in_mpi),
          megabytes(use.largest_memory)};
}

RankUse sum_of(std::span<const RankUse> ranks) {
  RankUse sum;
  for (const RankUse& use : ranks) {
    const RankFigures& figures = use.figures;
    sum.figures.bodies += figures.bodies;
    sum.figures.ghosts += figures.ghosts;
    sum.figures.bytes += figures.bytes;
    sum.figures.messages += figures.messages;
    sum.figures.batches = std::max(sum.figures.batches, figures.batches);
    sum.figures.rounds = std::max(sum.figures.rounds, figures.rounds);
    sum.figures.seconds_in_mpi += figures.seconds_in_mpi;
    sum.processor_seconds += use.processor_seconds;
    sum.largest_memory += use.largest_memory;
  }
  return sum;
}

}  // namespace

double processor_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::uint64_t largest_memory() {
  constexpr std::uint64_t kibibyte = 1024;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return kibibyte * static_cast<std::uint64_t>(usage.ru_maxrss);
}

std::string rank_table(std::span<const RankUse> ranks) {
  std::vector<Line> lines{{"rank", "bodies", "ghosts", "sent", "messages", "slabs", "tries", "processor",
                           "without MPI", "in MPI", "memory"}};
  for (std::size_t rank = 0; rank < ranks.size(); ++rank)
    lines.push_back(line_of(std::to_string(rank), ranks[rank]));
  if (ranks.size() > 1) lines.push_back(line_of("all", sum_of(ranks)));
  std::array<std::size_t, std::tuple_size_v<Line>> widths{};
  for (const Line& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
  std::string text;
  for (const Line& line : lines) {
    for (std::size_t k = 0; k < line.size(); ++k)
      text += fmt::format("{}{:>{}}", k == 0 ? "" : "  ", line[k], widths[k]);
    text += '\n';
  }
  return text;
}

}  // namespace kinesphere::program
