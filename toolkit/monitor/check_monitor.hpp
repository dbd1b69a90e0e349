// Validation of a MonitorDefinition.
#pragma once

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

Result<void> check_monitor(const MonitorDefinition& definition);

}  // namespace kinesphere
