// What the detectors that keep time-varying bounds have in common: bodies, their reports, contacts and their
// delivery. A detector derived from this says when which pair is looked at.
//
// Time stands while advance() delivers the events of an instant; then changed courses and contacts are
// predicted anew, and the clock moves on to what is scheduled next.
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
    Bound bound;  ///< since its last report
    bool present = false;
    bool new_course = false;          ///< nothing is predicted of it
    std::optional<Vec3> kicked_to{};  ///< since its last report

    double largest_acceleration() const {
      return definition.acceleration_limit + norm(definition.planned_acceleration);
    }
  };

  BoundDetector(const WorldDefinition& definition, const Motion& motion)
      : definition_(definition),
        motion_(motion),
        book_(definition),
        time_(definition.start_time),
        bodies_(motion.size()) {}

  // Asked of the derived detector.
  /// Bodies have been added since the clock last moved: a chance to choose sizes. May not probe.
  virtual void prepare() {}
  /// The body has appeared or has been kicked; its bound is fresh. All that was predicted of it is void.
  virtual void on_new_course(std::uint32_t number) = 0;
  /// The body is gone. Called also for one of which nothing has been predicted yet.
  virtual void on_removed(std::uint32_t number) = 0;
  /// The contact of two bodies (a body and itself: with walls) has begun or ended: it has to be predicted
  /// anew.
  virtual void on_contact_change(std::uint32_t a, std::uint32_t b) = 0;
  /// When the next thing is scheduled; +infinity if nothing is.
  virtual double next_time() const = 0;
  /// Does the thing that is due now.
  virtual void handle_next() = 0;
  /// The state of a body now: a probe, unless the detector knows better.
  virtual State report(std::uint32_t number);

  // Offered to it.
  std::uint32_t size() const { return static_cast<std::uint32_t>(bodies_.size()); }
  const Body& body(std::uint32_t number) const { return bodies_[number]; }
  /// True when the body's report is of this instant.
  bool fresh(std::uint32_t number) const { return bodies_[number].bound.time == time_; }
  /// Asks for the body's report and shrinks its bound to it. Not needed when fresh. A report that breaks the
  /// body's promise is announced, and on_new_course follows. One that is not fit is an error, which advance()
  /// answers from then on; until it does, the bound is what was expected.
  void probe(std::uint32_t number);
  /// True when the two are in contact.
  bool touch(std::uint32_t a, std::uint32_t b) const { return book_.touch(a, b); }
  /// Partners in contact.
  std::span<const std::uint32_t> touching(std::uint32_t number) const { return book_.partners_of(number); }
  const WorldDefinition& definition() const { return definition_; }
  const ContactRule& rule() const { return book_.rule(); }

  /// When the two have to be looked at next, from their bounds as they are: whether they touch cannot change
  /// before. time() when both have to be probed first. With both fresh the contact rule decides: a begin or
  /// an end is announced and the answer is +infinity (after its delivery follows on_contact_change);
  /// otherwise the answer is later than time(). +infinity also when nothing happens up to `horizon`.
  double pair_outlook(std::uint32_t a, std::uint32_t b, double horizon = infinity);
  /// The same for a body and all walls of the box.
  double wall_outlook(std::uint32_t number, double horizon = infinity);

  DetectorCounters counters_;

 private:
  void move_on_to(double time);
  Sphere sphere(std::uint32_t number) const;
  std::optional<Event> deliver();
  void settle();
  void handle_all_due();
  void begin_new_course(std::uint32_t number);
  template <class Partner>
  double judge(const ContactPredictor<Partner>& predictor, Event current, const RelativeLimits& promise);

  WorldDefinition definition_;
  const Motion& motion_;
  ContactGraph book_;
  PendingEvents instant_;
  double time_;
  std::vector<Body> bodies_;
  std::vector<std::uint32_t> new_courses_;
  bool bodies_added_ = false;
  std::optional<Error> error_;  ///< of a report
};

}  // namespace kinesphere
