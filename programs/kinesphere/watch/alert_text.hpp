// Alerts as short lines for people (`--text`).
#pragma once

#include <string>
#include <string_view>

#include "watch/alerts.hpp"

namespace kinesphere::program {

/// Returns the line of an event. The arguments are those of alert_line().
std::string alert_text(const AlertContext& context, const MonitorEvent& event, const LeftFor& left_for);
/// As lost_line(), one_body_line(), refused_line() and group_line().
std::string lost_text(const AlertContext& context, const LostTrack& lost);
std::string one_body_text(const AlertContext& context, double time, TrackId a, TrackId b);
std::string refused_text(const AlertContext& context, const AlertPolicy::Refused& refused);
std::string group_text(const AlertContext& context, double time, const std::string& name, std::size_t tracks);

}  // namespace kinesphere::program
