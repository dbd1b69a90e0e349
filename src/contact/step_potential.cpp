#include "kinesphere/step_potential.hpp"

#include <algorithm>
#include <cmath>

#include "contact/contact_rule.hpp"
#include "contact/rebound.hpp"
#include "input/input_check.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// `apart`: distances have to be farther than this from each other (length).
Result<void> check(const StepPotential::Definition& definition, double apart) {
  InputCheck check("StepPotential::create");
  const auto& [distances, energies, outside, restitution] = definition;
  check.require(!distances.empty(), ErrorCode::out_of_range, {"number of distances"}, "must be at least", 1u,
                distances.size());
  double before = 0.0;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const std::string name = "distances[" + std::to_string(k) + "]";
    check.finite({name}, distances[k])
        .require(distances[k] > before + apart, ErrorCode::out_of_range, {name}, "must be more than",
                 before + apart, distances[k]);
    before = distances[k];
  }
  check.require(energies.size() == distances.size(), ErrorCode::out_of_range, {"number of energies"},
                "must be that of distances,", distances.size(), energies.size());
  const auto require_energy = [&](const std::string& name, double energy) {
    check.require(!std::isnan(energy), ErrorCode::not_finite, {name}, "must be a number", energy)
        .require(energy > -infinity, ErrorCode::out_of_range, {name}, "must be more than -infinity", energy);
  };
  for (std::size_t k = 0; k < energies.size(); ++k)
    require_energy("energies[" + std::to_string(k) + "]", energies[k]);
  require_energy("outside", outside);
  check.from_zero_to({"restitution"}, restitution, 1.0);
  return check.result();
}

}  // namespace

Result<StepPotential> StepPotential::create(const Definition& potential, const WorldDefinition& world) {
  const ContactRule rule(world);
  const double crossing = rule.separation_distance() + rule.tolerance();
  if (auto valid = check(potential, 4.0 * crossing); !valid) return valid.error();
  return StepPotential(potential, crossing);
}

double StepPotential::energy(double gap) const {
  const auto& distances = definition_.distances;
  const auto farther = std::upper_bound(distances.begin(), distances.end(), gap) - distances.begin();
  return farther < std::ssize(distances) ? definition_.energies[static_cast<std::size_t>(farther)]
                                         : definition_.outside;
}

Response StepPotential::respond(const Event& event) const {
  if (event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin)
    return response_of(event, bounce(event, definition_.restitution));
  if (!is_of_sensor(event.kind)) return {};
  const auto& distances = definition_.distances;
  const auto place = std::lower_bound(distances.begin(), distances.end(), event.distance);
  if (place == distances.end() || *place != event.distance) return {};
  const bool enters = event.kind == EventKind::sensor_enter;
  const double nearer = energy(0.5 * (event.distance + (place == distances.begin() ? 0.0 : *(place - 1))));
  const double farther = energy(event.distance);
  const double before = enters ? farther : nearer, gained = (enters ? nearer : farther) - before;
  // Two that come from where none can be have been put there. So have those who are far from the distance;
  // but nobody gets to where none can be.
  const bool is_there = std::abs(event.gap - event.distance) <= 2.0 * crossing_;
  if (before == infinity || (!is_there && gained < infinity)) return {};
  // Another event of this instant may have turned them.
  if (enters ? event.approach_speed <= 0.0 : event.approach_speed >= 0.0) return {.turned_back = true};
  const double square =
      event.approach_speed * event.approach_speed - 2.0 * gained * inverse_effective_mass(event);
  const bool passes = square > 0.0;
  const double after =
      passes ? std::copysign(std::sqrt(square), event.approach_speed) : -event.approach_speed;
  Response response =
      response_of(event, rebound(event, event.first_mass, event.second_mass, event.approach_speed - after));
  response.turned_back = !passes;
  return response;
}

}  // namespace kinesphere
