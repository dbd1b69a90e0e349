// Text of values, for logs and tests: one line each, with numbers in the fewest digits that give them back.
//
//   std::puts(to_string(event).c_str());  // "contact_begin of 3 and 7 at time 1.25"
//   std::puts(to_string(hit).c_str());    // "body 7, certainty possibly, lower 0.5, upper 2"
//
// The text is for people and may change; name_of() gives stable names of enumerators.
#pragma once

#include <string>
#include <string_view>

#include "kinesphere/certificates.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/recording.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Returns "possibly" or "certainly".
std::string_view name_of(Certainty certainty);

/// Return the values of bodies and their definitions, in one line.
std::string to_string(const Vec3& vector);
std::string to_string(const Box& box);
std::string to_string(const State& state);
std::string to_string(const Filter& filter);
std::string to_string(const MotionLimits& limits);
std::string to_string(const BodyDefinition& body);
std::string to_string(const Bound& bound);
std::string to_string(const Shape& shape);
std::string to_string(const BodyView& body);

/// Return what happened, in one line.
std::string to_string(const Event& event);
std::string to_string(const Response& response);
std::string to_string(const ProbedState& report);
std::string to_string(const MonitorEvent& event);
std::string to_string(const PairAnswer& answer);
std::string to_string(const Error& error);

/// Return a certified prediction, in one line.
std::string to_string(const SafeTime& safe);
std::string to_string(const EarliestContact& first);
std::string to_string(const EarliestApproach& first);
std::string to_string(const SafeSeparation& safe);
std::string to_string(const DistanceLimits& limits);

/// Return a result of a query, in one line.
std::string to_string(const OverlapHit& hit);
std::string to_string(const NearestHit& hit);
std::string to_string(const CastHit& hit);
std::string to_string(const SensorOverlap& overlap);

/// Return what there is to see of the internal state, in one line.
std::string to_string(const Counters& counters);
std::string to_string(const Memory& memory);
std::string to_string(const Certificate& certificate);
std::string to_string(const BusyBody& body);
std::string to_string(const AuditFinding& finding);

}  // namespace kinesphere
