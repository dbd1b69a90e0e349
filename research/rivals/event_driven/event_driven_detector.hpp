// The event-driven approach (paper, section 3; Kim, Guibas and Shin 1998): the common part of its detectors.
//
// Each body is registered in the cells of its grid that its bound meets, at most eight. The event tree holds
// what can happen next:
//   entering, leaving    a bound touches a face of its cells, or parts from one
//   resetting            the diameter of a bound reaches the edge of its cells
//   colliding            two linked bounds meet, or a bound meets a wall
// Two bodies are linked if cells of theirs intersect, on whatever grids, or if they are in contact. Invariant
// whenever the clock moves on: a linked pair has a colliding candidate, or nothing happens to it before the
// horizon of one of the two, at which all candidates of that body are renewed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "research/rivals/bound_detector.hpp"
#include "research/rivals/event_driven/event_tree.hpp"
#include "research/rivals/event_driven/grids.hpp"

namespace kinesphere {

/// Returns the first time in [from, horizon] at which two bounds can meet, or +infinity, as
/// earliest_meeting().
using MeetingTime = double (*)(const Bound& a, const Bound& b, double from, double horizon, double distance);

class EventDrivenDetector : public BoundDetector {
 public:
  DetectorCounters counters() const override;

 protected:
  struct Options {
    double cell_edge;  ///< edge of the finest grid (length); 0: the cost model chooses once the first bodies
                       ///< are there
    bool trimming;     ///< leave out late candidates (section 3.3)
    MeetingTime meeting_time;  ///< beyond the contact tolerance; null: as pair_outlook()
  };

  EventDrivenDetector(const WorldDefinition& definition, const Motion& motion, const Options& options)
      : BoundDetector(definition, motion), options_(options), residents_(size()), seen_(size()) {
    events_.resize(size());
  }

  // Virtual functions of the derived detector.
  /// Called when the diameter of the body's bound has reached the edge of its cells.
  virtual void on_outgrown(std::uint32_t number) = 0;
  /// Called when the bounds of two bodies (a body twice: of a body and a wall) have met.
  virtual void on_meeting(std::uint32_t a, std::uint32_t b) = 0;

  // Functions for the derived detector.
  /// Renews the cells and all candidates of these bodies. Precondition: their bounds have been renewed.
  void reset(std::span<const std::uint32_t> numbers);
  /// Predicts the colliding event of the two (a body twice: with walls). Precondition: they have no such
  /// candidate.
  void predict_pair(std::uint32_t a, std::uint32_t b);
  void on_new_course(std::uint32_t number) override;

 private:
  /// Cells and reset time of a body.
  struct Resident {
    CellRange cells;
    double reset_time = infinity;
    bool placed = false;
  };

  /// Chooses the cells, and again whenever the number of bodies has doubled.
  void prepare() override;
  double fit_edge(double edge) const;
  void change_grids(double edge);
  double chosen_cell_edge() const;
  void on_removed(std::uint32_t number) override;
  void on_contact_change(std::uint32_t a, std::uint32_t b) override;
  double next_time() const override { return events_.empty() ? infinity : events_.earliest().time; }
  void handle_next() override;

  void enter(std::uint32_t number, std::uint8_t face);
  void leave(std::uint32_t number, std::uint8_t face);
  void place(std::uint32_t number);
  void move_to(Resident& resident, std::uint32_t number, const CellRange& cells);
  void predict_crossings(std::uint32_t number, std::size_t axis);
  void predict_partners(std::uint32_t number);
  double outlook(std::uint32_t a, std::uint32_t b, double horizon);
  bool linked(std::uint32_t a, std::uint32_t b) const;
  /// Returns the time after which candidates of the body are not inserted: its reset renews them anyway.
  double horizon(std::uint32_t number) const {
    return options_.trimming ? residents_[number].reset_time : infinity;
  }
  void schedule(double time, CandidateKind kind, std::uint32_t first, std::uint32_t second,
                std::uint8_t face = 0);

  Options options_;
  std::optional<Grids> grids_;
  std::size_t bodies_at_choice_ = 0;
  SubspaceTree subspaces_;
  EventTree events_;
  std::vector<Resident> residents_;
  std::vector<std::uint64_t> seen_;  ///< by body: number of the last search that found it
  std::uint64_t search_ = 0;
};

}  // namespace kinesphere
