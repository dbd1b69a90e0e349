// Figures of `kinesphere bench speed`: cost over the number of bodies, over the rate of steps, over the price
// of a step or probe.
#pragma once

#include <vector>

#include "bench/report.hpp"
#include "bench/speed/contest.hpp"

namespace kinesphere::program {

/// As far as the scenes that they show have been run.
void draw_speed_figures(const Report& report, const std::vector<SpeedScene>& scenes,
                        const SpeedResults& results);

}  // namespace kinesphere::program
