// The common part of detectors that keep time-varying bounds: bodies, their reports, contacts and event
// delivery. A derived detector decides when each pair is rechecked.
//
// Time stands while advance() delivers the events of an instant; then changed courses and contacts are
// predicted anew, and the clock moves on to the next scheduled time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contact/contact_predictor.hpp"
#include "contact/pending_events.hpp"
#include "kinesphere/bound.hpp"
#include "number/infinity.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

/// Base class of detectors that keep time-varying bounds.
class BoundDetector : public Detector {
 public:
  Result<void> add(std::uint32_t number, const BodyDefinition& definition) override;
  Result<void> remove(std::uint32_t number) override;
  Result<void> set_velocity(std::uint32_t number, const Vec3& velocity) override;
  Result<std::optional<Event>> advance(double until) override;
  double time() const override { return time_; }
  DetectorCounters counters() const override { return counters_; }
  Result<Bound> bound(std::uint32_t number) const override { return bodies_[number].bound; }

 protected:
  struct Body {
    BodyDefinition definition;
    Bound bound;  ///< bound since the last report
    bool present = false;
    bool new_course = false;          ///< no prediction uses the body yet
    std::optional<Vec3> kicked_to{};  ///< velocity set since the last report

    double largest_acceleration() const {
      return definition.acceleration_limit + norm(definition.planned_acceleration);
    }
  };

  BoundDetector(const WorldDefinition& definition, const Motion& motion)
      : definition_(definition),
        motion_(motion),
        contacts_(definition),
        time_(definition.start_time),
        bodies_(motion.size()) {}

  // Virtual functions of the derived detector.
  /// Called after bodies were added, before the clock moves: a chance to choose sizes. May not probe.
  virtual void prepare() {}
  /// Called after the body was added or got a new velocity. Its bound is fresh; all predictions about it are
  /// invalid.
  virtual void on_new_course(std::uint32_t number) = 0;
  /// Called after the body was removed, also if nothing was predicted of it yet.
  virtual void on_removed(std::uint32_t number) = 0;
  /// Called after a contact of two bodies (a body twice: of a body and a wall) began or ended; it has to be
  /// predicted anew.
  virtual void on_contact_change(std::uint32_t a, std::uint32_t b) = 0;
  /// Returns the next scheduled time; +infinity if nothing is scheduled.
  virtual double next_time() const = 0;
  /// Handles the item that is due now.
  virtual void handle_next() = 0;
  /// Returns the state of a body at time(): by a probe, unless overridden.
  virtual State report(std::uint32_t number);

  // Functions for the derived detector.
  std::uint32_t size() const { return static_cast<std::uint32_t>(bodies_.size()); }
  const Body& body(std::uint32_t number) const { return bodies_[number]; }
  /// Returns true if the last report of the body is of time().
  bool fresh(std::uint32_t number) const { return bodies_[number].bound.time == time_; }
  /// Probes the body and renews its bound. Not needed if the body is fresh. A report that violates the bound
  /// is reported as an event, and on_new_course() follows. An invalid report is an error, which advance()
  /// returns from then on; until then the bound is the predicted one.
  void probe(std::uint32_t number);
  /// Returns true if the two are in contact.
  bool touch(std::uint32_t a, std::uint32_t b) const { return contacts_.touch(a, b); }
  /// Returns the partners in contact with the body.
  std::span<const ContactRecord> touching(std::uint32_t number) const {
    return contacts_.partners_of(number);
  }
  const WorldDefinition& definition() const { return definition_; }
  const ContactRule& rule() const { return contacts_.rule(); }

  /// Returns the next time at which the pair has to be rechecked, from the present bounds: the contact cannot
  /// change before. Returns time() if the two have to be probed first. If both are fresh, the contact rule
  /// decides: after a begin or an end an event is queued and the result is +infinity (on_contact_change()
  /// follows its delivery); otherwise the result is later than time(). Returns +infinity also if nothing
  /// happens up to `horizon`.
  double pair_outlook(std::uint32_t a, std::uint32_t b, double horizon = infinity);
  /// Returns what pair_outlook() does, for a body and all walls of the box.
  double wall_outlook(std::uint32_t number, double horizon = infinity);

  DetectorCounters counters_;

 private:
  void move_on_to(double time);
  Sphere sphere(std::uint32_t number) const;
  std::optional<Event> deliver();
  void predict_changes();
  void handle_all_due();
  void begin_new_course(std::uint32_t number);
  template <class Partner>
  double decide(const ContactPredictor<Partner>& predictor, const Threshold& threshold, Event current,
                const RelativeLimits& limits);

  WorldDefinition definition_;
  const Motion& motion_;
  ContactGraph contacts_;
  PendingEvents instant_;
  double time_;
  std::vector<Body> bodies_;
  std::vector<std::uint32_t> new_courses_;
  bool bodies_added_ = false;
  std::optional<Error> error_;  ///< error of an invalid report
};

}  // namespace kinesphere
