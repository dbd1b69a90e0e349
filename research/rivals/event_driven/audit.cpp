// The audit of an event-driven detector: cells and candidates as they should be now, rebuilt from the bounds.
#include <cmath>
#include <map>
#include <string>

#include "input/input_check.hpp"
#include "kinesphere/inspection.hpp"
#include "research/rivals/event_driven/event_driven_detector.hpp"

namespace kinesphere {
namespace {

/// Part of the time ahead by which a recorded time may exceed the one computed now. Both are lower bounds of
/// one true time, and each stops its iteration a little early; less would report that as a fault, more would
/// hide late candidates.
constexpr double slack = 1e-3;

bool too_late(double recorded, double computed, double now) {
  return recorded > computed + slack * (computed - now) + 1e-12 * (1.0 + std::abs(computed));
}

}  // namespace

class EventDrivenDetector::Audit {
 public:
  explicit Audit(const EventDrivenDetector& detector) : detector_(detector), now_(detector.time()) {}

  std::optional<AuditFinding> run() {
    check_tree();
    for (std::uint32_t a = 0; a < detector_.size() && !finding_; ++a) {
      if (!settled(a)) continue;
      check_cells(a);
      check_candidates(a);
      for (std::uint32_t b = a + 1; b < detector_.size() && !finding_; ++b)
        if (settled(b)) check_pair(a, b);
    }
    return finding_;
  }

 private:
  void find(std::string where, std::string what) {
    if (!finding_) finding_ = AuditFinding{std::move(where), std::move(what)};
  }
  static std::string name(std::uint32_t number) { return "body " + std::to_string(number); }

  bool settled(std::uint32_t number) const {
    return detector_.body(number).present && !detector_.body(number).new_course;
  }

  /// Checks that the subspace tree holds exactly the residents of each cell.
  void check_tree() {
    std::map<Cell, SubspaceTree::Bodies> expected;
    for (std::uint32_t number = 0; number < detector_.size(); ++number) {
      const Resident& resident = detector_.residents_[number];
      if (!resident.placed) continue;
      resident.cells.for_each_cell([&](const Cell& cell) { expected[cell].push_back(number); });
    }
    const auto& found = detector_.subspaces_.cells();
    if (found.size() != expected.size()) find("registration", "cells in the tree that should not be there");
    for (const auto& [cell, bodies] : expected) {
      const auto at = found.find(cell);
      if (at == found.end() ||
          !std::is_permutation(at->second.begin(), at->second.end(), bodies.begin(), bodies.end()))
        find("registration", "a cell with body " + std::to_string(bodies.front()) + " has the wrong list");
    }
  }

  /// Checks that the body is registered in the cells that its bound meets and, but for rounding, in no other.
  void check_cells(std::uint32_t number) {
    const CellRange& cells = detector_.residents_[number].cells;
    const Vec3 margin = Vec3{1.0, 1.0, 1.0} * (0.25 * detector_.definition().contact_tolerance);
    const Box box = swept_box(detector_.body(number).bound, now_, now_);
    const CellRange inner = detector_.grids_->cells_of(cells.level, {box.lower + margin, box.upper - margin});
    const CellRange outer = detector_.grids_->cells_of(cells.level, {box.lower - margin, box.upper + margin});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cells.last[axis] - cells.first[axis] > 1)
        find("registration", name(number) + " stands in more than eight cells");
      if (inner.first[axis] < cells.first[axis] || inner.last[axis] > cells.last[axis])
        find("registration", name(number) + " has entered a cell unseen");
      if (outer.first[axis] > cells.first[axis] || outer.last[axis] < cells.last[axis])
        find("registration", name(number) + " has left a cell unseen");
    }
  }

  void check_candidates(std::uint32_t number) {
    bool resets = false;
    detector_.events_.for_each(number, [&](const Candidate& candidate) {
      if (candidate.time < now_) find("queue", name(number) + " has a candidate in the past");
      resets = resets || candidate.kind == CandidateKind::resetting;
      if (candidate.kind == CandidateKind::colliding && candidate.concerns_pair() &&
          !detector_.linked(candidate.first, candidate.second))
        find("queue", name(number) + " has a candidate with a body that it is not linked to");
      if (candidate.time > detector_.horizon(number))
        find("queue", name(number) + " has a candidate after its reset");
    });
    if (resets != (detector_.residents_[number].reset_time < infinity))
      find("queue", name(number) + " is never reset");
  }

  void check_pair(std::uint32_t a, std::uint32_t b) {
    int count = 0;
    double recorded = infinity;
    detector_.events_.for_each(a, [&](const Candidate& candidate) {
      if (candidate.kind != CandidateKind::colliding || candidate.first != a || candidate.second != b) return;
      ++count;
      recorded = candidate.time;
    });
    if (count > 1) find("queue", pair(a, b) + " have more than one candidate");
    if (!checkable(a, b)) return;
    const Bound& first = detector_.body(a).bound;
    const Bound& second = detector_.body(b).bound;
    const bool touching = detector_.touch(a, b);
    // Rounding alone makes parallel courses meet in the far future.
    const double horizon = std::min({detector_.horizon(a), detector_.horizon(b), now_ + 0x1p30});
    // The two are apart and not linked, so no cell may hold a part of each.
    if (!detector_.linked(a, b)) {
      if (gap_limits(first, second, now_).upper < 0.0) find("registration", pair(a, b) + " are not linked");
      return;
    }
    const double change =
        touching ? earliest_separation(first, second, now_, horizon, detector_.rule().release_gap())
                 : earliest_meeting(first, second, now_, horizon,
                                    impacts() ? -detector_.definition().contact_tolerance : 0.0);
    if (change < infinity && too_late(recorded, change, now_))
      find("certificate", pair(a, b) + " may change unseen: recorded " + std::to_string(recorded) +
                              ", must not be later than " + std::to_string(change));
  }

  /// Returns false for pairs that cannot be checked: a noisy report may lie outside the earlier bound; within
  /// the tolerance the contact rule decides; and a pair just probed may have an event that is not yet
  /// delivered or handled.
  bool checkable(std::uint32_t a, std::uint32_t b) const {
    const auto exact = [this](std::uint32_t number) {
      const BodyDefinition& body = detector_.body(number).definition;
      return body.position_error == 0.0 && body.velocity_error == 0.0;
    };
    if (!exact(a) || !exact(b)) return false;
    const ContactRule& rule = detector_.rule();
    const GapLimits gap = gap_limits(detector_.body(a).bound, detector_.body(b).bound, now_);
    const bool just_seen = detector_.fresh(a) && detector_.fresh(b);
    const double undecided = just_seen ? rule.release_gap() : rule.tolerance();
    return gap.lower > undecided || (detector_.touch(a, b) && !just_seen);
  }

  bool impacts() const { return !wants_ends(detector_.definition().contacts); }
  static std::string pair(std::uint32_t a, std::uint32_t b) { return name(a) + " and " + name(b); }

  const EventDrivenDetector& detector_;
  double now_;
  std::optional<AuditFinding> finding_;
};

std::optional<AuditFinding> EventDrivenDetector::audit() const { return Audit(*this).run(); }

}  // namespace kinesphere
