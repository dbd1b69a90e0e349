#include "research/rivals/event_driven/event_driven_detector.hpp"

#include <algorithm>

#include "research/rivals/event_driven/cost_model.hpp"
#include "research/rivals/event_driven/crossing.hpp"

namespace kinesphere {
namespace {

/// Least cell edge, in contact tolerances; it keeps rounding negligible beside cells, at the cost of coarse
/// cells for large tolerances.
constexpr double least_edge_in_tolerances = 0x1p10;

std::uint8_t face_of(std::size_t axis, bool upper) { return static_cast<std::uint8_t>(2 * axis + upper); }
std::size_t axis_of(std::uint8_t face) { return face / 2u; }
bool is_upper(std::uint8_t face) { return face % 2u == 1u; }
std::uint8_t opposite(std::uint8_t face) { return face ^ 1u; }

/// Returns the outermost layer of the cells on the side of a face.
CellRange layer(CellRange cells, std::uint8_t face) {
  const std::size_t axis = axis_of(face);
  (is_upper(face) ? cells.first : cells.last)[axis] = (is_upper(face) ? cells.last : cells.first)[axis];
  return cells;
}

/// Returns the cells with `layers` (1 or -1) more layers on the side of a face.
CellRange grown(CellRange cells, std::uint8_t face, int layers) {
  if (is_upper(face)) {
    cells.last[axis_of(face)] += layers;
  } else {
    cells.first[axis_of(face)] -= layers;
  }
  return cells;
}

}  // namespace

DetectorCounters EventDrivenDetector::counters() const {
  DetectorCounters counters = counters_;
  counters.event_insertions = events_.insertions();
  counters.event_removals = events_.removals();
  counters.largest_queue = events_.largest_size();
  return counters;
}

void EventDrivenDetector::prepare() {
  if (options_.cell_edge > 0.0) {
    if (!grids_) grids_.emplace(fit_edge(options_.cell_edge));
    return;
  }
  std::size_t present = 0;
  for (std::uint32_t number = 0; number < size(); ++number) present += body(number).present ? 1 : 0;
  if (present < 2 * bodies_at_choice_) return;
  bodies_at_choice_ = present;
  change_grids(fit_edge(chosen_cell_edge()));
}

double EventDrivenDetector::fit_edge(double edge) const {
  return std::max(edge, least_edge_in_tolerances * definition().contact_tolerance);
}

/// Replaces the grids and moves all bodies into new cells.
void EventDrivenDetector::change_grids(double edge) {
  std::vector<std::uint32_t> placed;
  for (std::uint32_t number = 0; number < size(); ++number)
    if (residents_[number].placed) placed.push_back(number);
  for (const std::uint32_t number : placed) {
    on_removed(number);
    if (!fresh(number)) probe(number);
  }
  grids_.emplace(edge);
  reset(placed);
}

/// Returns the edge that the cost model chooses for the bodies present, in the box or, without one, in their
/// bounding box.
double EventDrivenDetector::chosen_cell_edge() const {
  std::vector<MovingSphere> spheres;
  Box extent{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (std::uint32_t number = 0; number < size(); ++number) {
    if (!body(number).present) continue;
    const Bound& bound = body(number).bound;
    spheres.push_back({bound.radius, norm(bound.velocity), bound.growth_speed, bound.acceleration_limit});
    for (int axis = 0; axis < 3; ++axis) {
      extent.lower[axis] = std::min(extent.lower[axis], bound.position[axis] - bound.radius);
      extent.upper[axis] = std::max(extent.upper[axis], bound.position[axis] + bound.radius);
    }
  }
  const auto& box = definition().box;
  return CostModel(spheres, box.value_or(extent), box.has_value()).choose_cell_edge();
}

void EventDrivenDetector::on_new_course(std::uint32_t number) { reset(std::span(&number, 1)); }

void EventDrivenDetector::on_removed(std::uint32_t number) {
  events_.remove_all(number);
  Resident& resident = residents_[number];
  if (resident.placed)
    resident.cells.for_each_cell([&](const Cell& cell) { subspaces_.erase(cell, number); });
  resident = Resident{};
}

void EventDrivenDetector::on_contact_change(std::uint32_t a, std::uint32_t b) {
  events_.remove_if(a, [=](const Candidate& candidate) {
    return candidate.kind == CandidateKind::colliding && candidate.first == std::min(a, b) &&
           candidate.second == std::max(a, b);
  });
  predict_pair(a, b);
}

void EventDrivenDetector::handle_next() {
  const Candidate due = events_.pop();
  switch (due.kind) {
    case CandidateKind::resetting:
      ++counters_.resetting;
      return on_outgrown(due.first);
    case CandidateKind::entering:
      return enter(due.first, due.face);
    case CandidateKind::leaving:
      return leave(due.first, due.face);
    case CandidateKind::colliding:
      return on_meeting(due.first, due.second);
  }
}

/// Handles a bound that touches a face: registers it in the cells behind the face, and predicts meetings with
/// the bodies there.
void EventDrivenDetector::enter(std::uint32_t number, std::uint8_t face) {
  ++counters_.entering;
  Resident& resident = residents_[number];
  const std::size_t axis = axis_of(face);
  // No bound reaches from the first of three cells to the third, so it has left the first but for rounding.
  if (resident.cells.first[axis] < resident.cells.last[axis]) leave(number, opposite(face));
  const CellRange before = resident.cells;
  move_to(resident, number, grown(before, face, 1));
  predict_crossings(number, axis);
  ++search_;
  seen_[number] = search_;
  subspaces_.for_each_neighbour(layer(resident.cells, face), [&](std::uint32_t other) {
    if (seen_[other] == search_) return;
    seen_[other] = search_;
    const bool known = intersect(before, residents_[other].cells) || touch(number, other);
    if (!known) predict_pair(number, other);
  });
}

/// Handles a bound that has parted from a face: removes it from the cells behind the face, and its candidates
/// with bodies that are only there.
void EventDrivenDetector::leave(std::uint32_t number, std::uint8_t face) {
  ++counters_.leaving;
  Resident& resident = residents_[number];
  move_to(resident, number, grown(resident.cells, face, -1));
  predict_crossings(number, axis_of(face));
  events_.remove_if(number, [this](const Candidate& candidate) {
    return candidate.kind == CandidateKind::colliding && !linked(candidate.first, candidate.second);
  });
}

void EventDrivenDetector::reset(std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t number : numbers) {
    events_.remove_all(number);
    place(number);
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    ++search_;
    // The searches of earlier bodies have found this one, so pairs with them are skipped.
    for (std::size_t before = 0; before <= k; ++before) seen_[numbers[before]] = search_;
    predict_partners(numbers[k]);
  }
}

/// Registers the body in the cells that its bound meets, and predicts its reset and its crossings.
void EventDrivenDetector::place(std::uint32_t number) {
  Resident& resident = residents_[number];
  const Bound& bound = body(number).bound;
  const int level = grids_->level_for(2.0 * bound.radius);
  move_to(resident, number, grids_->cells_of(level, swept_box(bound, time(), time())));
  // The coarsest cells are endless.
  const bool endless = level == Grids::coarsest_level;
  resident.reset_time =
      endless ? infinity : std::max(outgrowing_time(bound, grids_->edge(level)), just_after(time()));
  schedule(resident.reset_time, CandidateKind::resetting, number, number);
  for (std::size_t axis = 0; axis < 3; ++axis) predict_crossings(number, axis);
}

/// Moves a body to other cells. Cells in both ranges stay untouched.
void EventDrivenDetector::move_to(Resident& resident, std::uint32_t number, const CellRange& cells) {
  const CellRange before = resident.cells;
  if (resident.placed) {
    if (cells == before) return;
    before.for_each_cell([&](const Cell& cell) {
      if (!cells.contains(cell)) subspaces_.erase(cell, number);
    });
  }
  cells.for_each_cell([&](const Cell& cell) {
    if (!resident.placed || !before.contains(cell)) subspaces_.insert(cell, number);
  });
  resident.cells = cells;
  resident.placed = true;
}

/// Replaces the entering and leaving candidates of both sides of an axis.
void EventDrivenDetector::predict_crossings(std::uint32_t number, std::size_t axis) {
  events_.remove_if(number, [=](const Candidate& candidate) {
    return (candidate.kind == CandidateKind::entering || candidate.kind == CandidateKind::leaving) &&
           axis_of(candidate.face) == axis;
  });
  const CellRange& cells = residents_[number].cells;
  const std::int64_t first = cells.first[axis];
  const std::int64_t last = cells.last[axis];
  const auto plane = [&](std::int64_t index) { return grids_->plane(cells.level, index); };
  for (const bool upper : {false, true}) {
    const MovingSide side(body(number).bound, static_cast<int>(axis), upper, time());
    const std::uint8_t face = face_of(axis, upper);
    schedule(side.earliest_entering(plane(upper ? last + 1 : first), horizon(number)),
             CandidateKind::entering, number, number, face);
    if (first < last)
      schedule(side.latest_leaving(plane(upper ? last : first + 1), horizon(number)), CandidateKind::leaving,
               number, number, face);
  }
}

/// Predicts colliding candidates with all linked bodies that this search has not seen yet, and with walls.
void EventDrivenDetector::predict_partners(std::uint32_t number) {
  const auto meet = [&](std::uint32_t other) {
    if (seen_[other] == search_) return;
    seen_[other] = search_;
    predict_pair(number, other);
  };
  subspaces_.for_each_neighbour(residents_[number].cells, meet);
  // The list is copied, as a prediction may end a contact and remove it from the original.
  std::vector<std::uint32_t> partners;
  for (const ContactRecord& contact : touching(number)) partners.push_back(contact.partner);
  while (!partners.empty()) {
    meet(partners.back());
    partners.pop_back();
  }
  predict_pair(number, number);
}

void EventDrivenDetector::predict_pair(std::uint32_t a, std::uint32_t b) {
  if (a == b) return schedule(wall_outlook(a, horizon(a)), CandidateKind::colliding, a, a);
  const double time = outlook(a, b, std::min(horizon(a), horizon(b)));
  if (linked(a, b)) schedule(time, CandidateKind::colliding, std::min(a, b), std::max(a, b));
}

/// Returns what pair_outlook() does. For a pair that is apart and not in contact it uses the chosen
/// meeting-time function, if there is one.
double EventDrivenDetector::outlook(std::uint32_t a, std::uint32_t b, double horizon) {
  const Bound& first = body(a).bound;
  const Bound& second = body(b).bound;
  if (options_.meeting_time == nullptr || touch(a, b) ||
      gap_limits(first, second, time()).lower <= rule().tolerance())
    return pair_outlook(a, b, horizon);
  ++counters_.certificates;
  return std::max(options_.meeting_time(first, second, time(), horizon, 0.0), just_after(time()));
}

bool EventDrivenDetector::linked(std::uint32_t a, std::uint32_t b) const {
  return intersect(residents_[a].cells, residents_[b].cells) || touch(a, b);
}

void EventDrivenDetector::schedule(double time, CandidateKind kind, std::uint32_t first, std::uint32_t second,
                                   std::uint8_t face) {
  if (time < infinity) events_.insert({time, kind, first, second, face});
}

}  // namespace kinesphere
