// Hubbard's broad phase (1995, 1996) as a detector, as the paper describes it in sections 1.2 and 4.2.
//
// All bodies are probed at one time t0, and each gets a space-time bound, a hypertrapezoid, for the interval
// [t0, t1]. A sweep finds the first time at which two of them meet, or one meets a wall. There, or at t1, all
// space-time bounds are rebuilt; so they are when a body gets a new velocity, appears or vanishes.
//
// The papers leave some points open; this detector decides them so:
//   - Pairs with space-time bounds that overlap from the start. The bounds of two spheres that pass corner to
//     corner overlap while the spheres are apart, and those of spheres that touch or nearly touch overlap in
//     any interval. Hubbard's time advanced in frames, which hid that; an exact time would stand
//     still. Such pairs are handed to the narrow phase, here the exact test of spheres: until the next
//     rebuild they are rechecked when certificates of their time-varying bounds fail, and the sweep ignores
//     them. Bodies with bounds that reach a wall from the start are handled likewise.
//   - The pair with space-time bounds that have met: the narrow phase rechecks it until the next rebuild.
//     That makes every rebuild later than the one before, but for rebuilds that the caller causes (velocity
//     changes).
//   - The end of the sweep. The paper says that it finds the intersections of each set of segments; here it
//     stops at the first meeting, as only that is used.
//   - The length of the interval: twice the running mean of the time from a rebuild to the first meeting.
//     Longer intervals make the bounds wider without need, because the chord of a parabola lies above it in
//     proportion to its length; shorter ones end before anything happens. An interval without a meeting
//     counts as a time of twice its length. Rebuilds that a velocity change causes do not count.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "bound/rounding.hpp"
#include "research/rivals/bound_detector.hpp"
#include "research/rivals/hubbard/hypertrapezoid.hpp"
#include "research/rivals/hubbard/space_time_sweep.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/checked_detector.hpp"

namespace kinesphere {
namespace {

class HubbardDetector final : public BoundDetector {
 public:
  HubbardDetector(const WorldDefinition& definition, const Motion& motion)
      : BoundDetector(definition, motion), sweep_(definition.box, 0.5 * rule().release_gap()) {}

  std::string_view name() const override { return "hubbard"; }

 protected:
  void prepare() override;
  void on_new_course(std::uint32_t number) override;
  void on_removed(std::uint32_t number) override;
  void on_contact_change(std::uint32_t a, std::uint32_t b) override;
  double next_time() const override;
  void handle_next() override;

 private:
  using Meeting = SpaceTimeSweep::Meeting;

  /// A pair (a body twice: the body and its walls) that the narrow phase rechecks at `time`.
  struct Watch {
    double time;
    std::uint32_t a;
    std::uint32_t b;
    friend bool operator>(const Watch& x, const Watch& y) {
      return std::tie(x.time, x.a, x.b) > std::tie(y.time, y.a, y.b);
    }
  };

  void rebuild();
  void learn_interval();
  double duration() const;
  void build_bounds(double duration);
  void hand_over_what_overlaps();
  void hand_over(const Meeting& pair);
  bool is_handed_over(const Meeting& meeting) const;
  void find_first_meeting();
  void watch(std::uint32_t a, std::uint32_t b);
  double outlook(std::uint32_t a, std::uint32_t b);
  void look();

  SpaceTimeSweep sweep_;
  bool rebuild_due_ = false;
  double mean_time_ = 0.0;               ///< running mean of the time from a rebuild to the first meeting
  double start_ = 0.0;                   ///< begin of the interval
  double end_ = infinity;                ///< end of the interval, or its first meeting
  std::optional<Meeting> last_meeting_;  ///< the meeting that ended the interval before this one
  std::optional<Meeting> meeting_;       ///< the meeting that will end this interval
  std::vector<Meeting> handed_over_;
  std::vector<bool> walls_handed_over_;
  std::vector<Watch> watches_;  ///< a heap, earliest time first
};

/// Sets the first guess of the mean time, so short that hardly anything can meet in it.
void HubbardDetector::prepare() {
  if (mean_time_ > 0.0) return;
  const double way = 0x1p10 * definition().contact_tolerance;
  double shortest = infinity;
  for (std::uint32_t number = 0; number < size(); ++number) {
    const Body& b = body(number);
    if (!b.present) continue;
    const double speed = norm(b.bound.velocity) + b.bound.growth_speed;
    shortest = std::min(
        shortest, 2.0 * way / (speed + std::sqrt(speed * speed + 2.0 * b.largest_acceleration() * way)));
  }
  mean_time_ = shortest < infinity ? shortest : 1.0;
}

void HubbardDetector::on_new_course(std::uint32_t number) {
  if (!sweep_.contains(number)) sweep_.insert(number);
  rebuild_due_ = true;
}

void HubbardDetector::on_removed(std::uint32_t number) {
  if (sweep_.contains(number)) sweep_.erase(number);
  rebuild_due_ = true;
}

void HubbardDetector::on_contact_change(std::uint32_t a, std::uint32_t b) {
  if (!rebuild_due_) watch(a, b);
}

double HubbardDetector::next_time() const {
  if (rebuild_due_) return time();
  return watches_.empty() ? end_ : std::min(end_, watches_.front().time);
}

void HubbardDetector::handle_next() {
  if (rebuild_due_ || end_ <= time()) {
    rebuild();
  } else {
    look();
  }
}

void HubbardDetector::rebuild() {
  ++counters_.rebuilds;
  if (end_ <= time()) learn_interval();
  last_meeting_ = end_ <= time() ? meeting_ : std::nullopt;
  rebuild_due_ = false;
  start_ = time();
  const double length = duration();
  end_ = rounding::sum_down(start_, length);
  build_bounds(length);
  hand_over_what_overlaps();
  find_first_meeting();
  watches_.clear();
  for (const Meeting& pair : handed_over_) watch(pair.a, pair.b);
}

/// Updates the mean time from an interval that ended as planned.
void HubbardDetector::learn_interval() {
  const double passed = end_ - start_;
  const double observed = meeting_ ? passed : 2.0 * passed;
  mean_time_ += 0.125 * (observed - mean_time_);
}

/// Returns the length of the next interval (time), at least long enough for the clock to move.
double HubbardDetector::duration() const {
  return std::max(2.0 * mean_time_, 0x1p-48 * std::abs(start_) + std::numeric_limits<double>::min());
}

void HubbardDetector::build_bounds(double duration) {
  for (std::uint32_t number = 0; number < size(); ++number) {
    if (!body(number).present) continue;
    if (!fresh(number)) probe(number);
    // Lasting contacts have to overlap: their gap, as reported, may be as large as the contact rule and the
    // errors of reports allow.
    const double clearance = 0.5 * rule().release_gap() + 2.0 * body(number).definition.position_error;
    sweep_.set(number, enclose(body(number).bound, duration, clearance));
  }
  sweep_.begin(duration);
}

/// Hands pairs that overlap from the start, and the pair that has met, to the narrow phase.
void HubbardDetector::hand_over_what_overlaps() {
  handed_over_.clear();
  walls_handed_over_.assign(size(), false);
  sweep_.for_each_overlap([this](std::uint32_t a, std::uint32_t b) { hand_over({0.0, a, b}); });
  for (std::uint32_t number = 0; number < size(); ++number)
    if (sweep_.contains(number) && sweep_.reaches_wall(number)) hand_over({0.0, number, number});
  if (!last_meeting_ || !sweep_.contains(last_meeting_->a) || !sweep_.contains(last_meeting_->b)) return;
  if (last_meeting_->a == last_meeting_->b) {
    if (!walls_handed_over_[last_meeting_->a]) hand_over(*last_meeting_);
  } else if (!sweep_.overlap(last_meeting_->a, last_meeting_->b)) {
    hand_over(*last_meeting_);
  }
}

void HubbardDetector::hand_over(const Meeting& pair) {
  handed_over_.push_back(pair);
  if (pair.a == pair.b) walls_handed_over_[pair.a] = true;
}

/// Returns true if the narrow phase rechecks the pair of a meeting. Pairs that overlapped in this sweep need
/// no test: they do not meet in it again.
bool HubbardDetector::is_handed_over(const Meeting& meeting) const {
  if (meeting.a == meeting.b) return walls_handed_over_[meeting.a];
  return last_meeting_ && meeting.a == last_meeting_->a && meeting.b == last_meeting_->b;
}

void HubbardDetector::find_first_meeting() {
  while ((meeting_ = sweep_.next_meeting())) {
    if (is_handed_over(*meeting_)) continue;
    const double time = rounding::sum_down(start_, meeting_->time);
    if (time > start_) {
      end_ = std::min(end_, time);
      return;
    }
    hand_over(*meeting_);
  }
}

void HubbardDetector::watch(std::uint32_t a, std::uint32_t b) {
  const double time = outlook(a, b);
  if (time >= end_) return;
  watches_.push_back({time, a, b});
  std::push_heap(watches_.begin(), watches_.end(), std::greater<>{});
}

/// Returns the next time at which the pair has to be rechecked; probes the two if that is needed to know.
double HubbardDetector::outlook(std::uint32_t a, std::uint32_t b) {
  const auto from_bounds = [=, this] { return a == b ? wall_outlook(a, end_) : pair_outlook(a, b, end_); };
  const double time_ahead = from_bounds();
  if (time_ahead > time()) return time_ahead;
  if (!fresh(a)) probe(a);
  if (!fresh(b)) probe(b);
  return from_bounds();
}

void HubbardDetector::look() {
  const Watch due = watches_.front();
  std::pop_heap(watches_.begin(), watches_.end(), std::greater<>{});
  watches_.pop_back();
  ++(due.a == due.b ? counters_.wall_checks : counters_.pair_checks);
  watch(due.a, due.b);
}

}  // namespace

Result<std::unique_ptr<Detector>> make_hubbard_detector(const WorldDefinition& definition,
                                                        const Motion& motion) {
  return make_checked<HubbardDetector>(definition, motion);
}

}  // namespace kinesphere
