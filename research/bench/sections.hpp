// The sections of `kinesphere-bench paper`, each about one claim of the paper.
#pragma once

#include <span>
#include <string_view>

#include "research/bench/report.hpp"
#include "research/bench/settings.hpp"

namespace kinesphere::program {

void bench_figure5(const Report& report, const BenchSettings& settings);
void bench_figure6(const Report& report, const BenchSettings& settings);
void bench_table1(const Report& report, const BenchSettings& settings);
void bench_circulation(const Report& report, const BenchSettings& settings);
void bench_growth(const Report& report, const BenchSettings& settings);
void bench_trimming(const Report& report, const BenchSettings& settings);
void bench_cells(const Report& report, const BenchSettings& settings);

struct Section {
  std::string_view name;  ///< name for --only
  std::string_view title;
  void (*run)(const Report& report, const BenchSettings& settings);
};

/// Returns all sections, in the order of the paper.
std::span<const Section> bench_sections();

}  // namespace kinesphere::program
