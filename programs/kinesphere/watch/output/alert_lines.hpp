// Alerts as lines: JSON, or short text for people (--text).
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "watch/output/json_object.hpp"
#include "watch/output/watch_view.hpp"

namespace kinesphere::program {

/// Receives alerts as lines with their ends, in the order of time, with the share of each.
using AlertFn = std::function<void(std::uint64_t share, std::string_view line)>;

/// The view must be of the stages before, and outlive the result.
std::unique_ptr<AlertDesk::Next> make_json_alerts(const WatchView& view, AlertFn write);
std::unique_ptr<AlertDesk::Next> make_text_alerts(const WatchView& view, AlertFn write);

/// Adds the limits of the distance of two tracks and related fields. Precondition: the monitor has both
/// tracks.
void add_answer(JsonObject& object, const WatchView& view, const OrderedPair& pair, std::uint32_t level,
                const PairAnswer& answer);

}  // namespace kinesphere::program
