// The list of sections of `kinesphere-bench paper`.
#include "research/bench/sections.hpp"

namespace kinesphere::program {

std::span<const Section> bench_sections() {
  static constexpr Section sections[] = {
      {"cells", "Section 3.2: the cost model's choice of a cell size", bench_cells},
      {"trimming", "Section 3.3: candidates later than the reset left out", bench_trimming},
      {"figure5", "Figure 5: real time per simulated second", bench_figure5},
      {"figure6", "Figure 6: actual events", bench_figure6},
      {"table1", "Table 1: against Hubbard's broad phase, and others", bench_table1},
      {"circulation", "Section 4.3, figures 7 and 8: particles in a velocity field", bench_circulation},
      {"growth", "Section 4.2: O(log n) per event", bench_growth},
  };
  return sections;
}

}  // namespace kinesphere::program
