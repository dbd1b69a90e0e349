// Turns bytes into a sky, and compares the monitor with the truth.
#include "stream/any_reports.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <tuple>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::watched_sky {
namespace {

constexpr int segments = 12;

/// Choices from bytes; when they are used up, always the smallest choice.
class Choices {
 public:
  explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool are_used_up() const { return at_ >= bytes_.size(); }
  std::uint32_t byte() { return at_ < bytes_.size() ? bytes_[at_++] : 0; }
  std::uint32_t below(std::uint32_t bound) { return byte() % bound; }
  bool one_in(std::uint32_t n) { return below(n) == n - 1; }
  double part() { return byte() / 255.0; }
  double signed_part() { return 2.0 * part() - 1.0; }
  template <class T>
  T of(std::initializer_list<T> list) {
    return list.begin()[below(static_cast<std::uint32_t>(list.size()))];
  }
  /// Returns a vector in the unit ball.
  Vec3 direction() {
    const Vec3 v{signed_part(), signed_part(), signed_part()};
    const double length = norm(v);
    return length > 1.0 ? v * (0.999 / length) : v * 0.999;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// A place in extended precision.
struct Place {
  long double x = 0, y = 0, z = 0;

  friend Place operator+(const Place& a, const Place& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Place operator*(const Place& a, long double factor) {
    return {a.x * factor, a.y * factor, a.z * factor};
  }
};

Place place_of(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 rounded(const Place& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}
long double length(const Place& p) { return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z); }

struct Piece {
  long double begin;
  Place position, velocity, acceleration;
};

struct FiledPlan {
  double from, until;
  TrackReport::Plan plan;
  bool is_beyond;  ///< beyond the limits of the class
  bool reported = false;
};

struct Truth {
  std::vector<Piece> pieces;
  std::vector<FiledPlan> plans;

  const Piece& at(long double time) const {
    std::size_t k = 0;
    while (k + 1 < pieces.size() && pieces[k + 1].begin <= time) ++k;
    return pieces[k];
  }
  Place position(long double time) const {
    const Piece& piece = at(time);
    const long double s = time - piece.begin;
    return piece.position + (piece.velocity + piece.acceleration * (0.5L * s)) * s;
  }
  Place velocity(long double time) const {
    const Piece& piece = at(time);
    return piece.velocity + piece.acceleration * (time - piece.begin);
  }
};

class Sky {
 public:
  explicit Sky(std::span<const std::uint8_t> bytes) : choices_(bytes) {
    define();
    for (std::uint32_t k = 2 + choices_.below(5); k > 0; --k) add_track();
    definition_.classes[0].largest_speed =
        has_speed_ ? ErrorBound(static_cast<double>(fastest_) * 1.0001 + 1e-9) : ErrorBound(infinity());
    loosen_other_class();
    auto made = Monitor::create(definition_);
    if (!made) throw BadResult(made.error());
    monitor_.emplace(std::move(*made));
  }

  WatchedSky watch() {
    double now = start_;
    const double end = start_ + unit_ * segments;
    while (!watched_.failure && !choices_.are_used_up() && now < end) {
      switch (choices_.below(8)) {
        case 0:
        case 1:
          now = std::min(end, now + unit_ * (0.02 + 0.3 * choices_.part()));
          // The clock leaps, so that tracks become stale.
          if (choices_.one_in(16)) now = std::min(end, now + unit_ * choices_.of({1.0, 3.0}));
          break;
        case 2:
          if (choices_.one_in(4)) restore();
          if (choices_.one_in(8)) remove();
          break;
        case 3:
          file_plan(now);
          break;
        default:
          report(now);
      }
      go_to(now);
      check(now);
    }
    return watched_;
  }

 private:
  static double infinity() { return std::numeric_limits<double>::infinity(); }
  void fail(const std::string& what) {
    if (!watched_.failure) watched_.failure = what;
  }

  void define() {
    unit_ = choices_.of({1.0, 0.01, 100.0});
    start_ = choices_.of({0.0, -7.0, 1000.0, 1e6});
    size_ = choices_.of({20.0, 5.0, 1e4});
    limit_ = choices_.of({2.0, 0.0, 0.3, 20.0}) / (unit_ * unit_);
    has_speed_ = choices_.one_in(2);
    definition_.dimensions = choices_.one_in(4) ? 2 : 3;
    definition_.start_time = start_;
    definition_.tolerance = choices_.of({1e-3, 0.3});
    definition_.time_resolution = choices_.of({1e-3, 1e-5, 0.3}) * unit_;
    definition_.window = choices_.of({1.0, 0.1, 9.0, 1e-6}) * unit_;
    planned_ = choices_.one_in(3) ? choices_.direction() * limit_ : Vec3{};
    definition_.classes = {{.acceleration_limit = limit_, .planned_acceleration = planned_}};
    std::vector<Separation> levels;
    for (std::uint32_t k = 1 + choices_.below(2); k > 0; --k) {
      const double horizontal = 0.5 + 0.3 * size_ * choices_.part(),
                   vertical = horizontal * choices_.of({1.0, 0.1, 4.0, 30.0});
      const double look_ahead = choices_.of({0.0, 1.0, 4.0}) * unit_;
      levels.push_back(choices_.one_in(3)
                           ? Separation::cylinder(horizontal, std::max(0.4, vertical), look_ahead)
                           : Separation::ellipsoid(horizontal, std::max(0.4, vertical), look_ahead));
      if (choices_.one_in(4))
        levels.back() = Separation::well_clear(std::max(0.4, 0.3 * horizontal), std::max(0.4, vertical),
                                               choices_.of({0.5, 0.0, 3.0, 50.0}) * unit_, look_ahead);
    }
    definition_.separations = {{0, 0, levels}};
  }

  /// The other class has looser limits, which the tracks keep, too, and the same separations.
  void loosen_other_class() {
    TrackClass loose = definition_.classes[0];
    loose.acceleration_limit = 2.0 * limit_ + 0.1 / (unit_ * unit_);
    loose.largest_speed = loose.largest_speed * 2.0;
    definition_.classes.push_back(loose);
    const std::vector<Separation> levels = definition_.separations[0].levels;
    definition_.separations.push_back({0, 1, levels});
    definition_.separations.push_back({1, 1, levels});
    if (choices_.one_in(3)) definition_.stale_after = unit_ * choices_.of({0.5, 2.0});
    if (choices_.one_in(3)) definition_.drop_after = unit_ * choices_.of({1.0, 4.0});
  }

  Vec3 flat(Vec3 v) const {
    if (definition_.dimensions == 2) v.z = 0.0;
    return v;
  }

  void add_track() {
    Truth truth;
    Place position = place_of(flat(choices_.direction() * size_));
    Place velocity = place_of(flat(choices_.direction() * (0.3 * size_ / unit_)));
    for (int k = 0; k < segments; ++k) {
      const double begin = start_ + unit_ * k, end = start_ + unit_ * (k + 1);
      Vec3 acceleration = planned_ + choices_.direction() * limit_;
      if (choices_.one_in(4)) {
        const double size = choices_.of({0.0, 0.5, 3.0, 30.0}) / (unit_ * unit_);
        const double limit = choices_.of({0.0, 0.1, 1.0}) * size;
        const Vec3 planned = choices_.direction() * size;
        const bool is_beyond = !(norm(planned - planned_) + limit < 0.999 * limit_);
        // Rounded inward, so that the true motion stays within the limit.
        acceleration = planned + choices_.direction() * (0.999 * limit);
        truth.plans.push_back({begin, end, {planned, limit, end}, is_beyond});
      }
      acceleration = flat(acceleration);
      truth.pieces.push_back({begin, position, velocity, place_of(acceleration)});
      fastest_ = std::max(fastest_, length(velocity));
      position = truth.position(end);
      velocity = truth.velocity(end);
      fastest_ = std::max(fastest_, length(velocity));
    }
    truths_.push_back(std::move(truth));
    since_wrong_.push_back(0);
    latest_.push_back({});
    classes_.push_back(0);
  }

  /// Returns a report that keeps its limits, with a timestamp of `time`.
  TrackReport report_of(std::size_t track, double time) {
    const Truth& truth = truths_[track];
    TrackReport report{.timestamp = time, .track_class = classes_[track]};
    const double error = choices_.of({1e-6, 0.1, 1.0}) * (1.0 + 1e-6 * size_),
                 velocity_error = choices_.of({1e-6, 0.1, 1.0}) / unit_;
    report.position_error = error;
    report.velocity_error = velocity_error;
    report.state.position =
        rounded(truth.position(time) + place_of(flat(choices_.direction() * (0.99 * error))));
    report.state.velocity =
        rounded(truth.velocity(time) + place_of(flat(choices_.direction() * (0.99 * velocity_error))));
    if (choices_.one_in(4)) {
      report.timestamp_error = 0.1 * unit_ * choices_.part();
      report.timestamp += 0.99 * report.timestamp_error * choices_.signed_part();
    }
    if (has_speed_ && choices_.one_in(5)) {
      report.velocity_error = infinity();
      report.state.velocity = {};
    }
    return report;
  }

  /// Adds the plan in force at the time of the report, if the report is to have it.
  void add_plan(std::size_t track, double time, TrackReport& report) {
    for (const FiledPlan& filed : truths_[track].plans)
      if (filed.from <= time && time < filed.until && filed.until > report.timestamp)
        report.plan = filed.plan;
  }

  /// A plan beyond the class must be known before it begins, so all such plans are reported.
  void tell_plans_that_begin(double until) {
    for (std::size_t track = 0; track < truths_.size(); ++track)
      for (FiledPlan& filed : truths_[track].plans) {
        if (filed.reported || filed.from > until) continue;
        filed.reported = true;
        // Only a class without accelerations works without velocities.
        TrackReport report = report_of(track, filed.from);
        report.plan = filed.plan;
        if (filed.until <= report.timestamp) report.timestamp = filed.from;
        take(track, report, filed.is_beyond);
      }
  }

  void file_plan(double now) { tell_plans_that_begin(now + 0.5 * unit_); }

  void report(double now) {
    const std::size_t track = choices_.below(static_cast<std::uint32_t>(truths_.size()));
    if (choices_.one_in(12) && since_wrong_[track] > 3) {
      TrackReport report = report_of(track, now);
      report.velocity_error = report.velocity_error == infinity() ? infinity() : 1e-6;
      report.state.position += Vec3{1e9 + 1e3 * size_, 0, 0};
      since_wrong_[track] = 0;
      ++watched_.wrong;
      return take(track, report, false);
    }
    if (latest_[track] && choices_.one_in(12)) return take(track, *latest_[track], false);
    const double end = start_ + unit_ * segments;
    const double time =
        std::clamp(now + unit_ * choices_.of({0.0, -0.2, -1.3, 0.3}), start_, end - 0.01 * unit_);
    if (choices_.one_in(24)) {
      classes_[track] = 1 - classes_[track];
      start_anew(track);
      ++watched_.reclassified;
    }
    tell_plans_that_begin(time + 0.1 * unit_);
    TrackReport report = report_of(track, time);
    if (choices_.one_in(2)) add_plan(track, time, report);
    take(track, report, false);
    ++since_wrong_[track];
    latest_[track] = report;
  }

  void take(std::size_t track, const TrackReport& report, bool ends_promises) {
    ++watched_.reports;
    if (report.plan && ends_promises) {
      ++watched_.plans;
      std::erase_if(promises_, [&](const auto& entry) {
        return std::get<0>(entry.first) == track || std::get<1>(entry.first) == track;
      });
    }
    known_.insert(track);
    if (const auto taken = monitor_->report(track, report); !taken) fail("report: " + taken.error().message);
  }

  void remove() {
    if (known_.empty()) return;
    const std::vector<std::size_t> known(known_.begin(), known_.end());
    const std::size_t track = known[choices_.below(static_cast<std::uint32_t>(known.size()))];
    monitor_->remove(track).value();
    ++watched_.removed;
    removed_.insert(track);
    start_anew(track);
  }

  /// The monitor forgets the track with its plans.
  void start_anew(std::size_t track) {
    known_.erase(track);
    since_wrong_[track] = 0;
    latest_[track].reset();
    for (FiledPlan& filed : truths_[track].plans) filed.reported = false;
  }

  /// All that was told about the pairs of a track is over.
  void forget_pairs(TrackId track) {
    std::erase_if(told_, [&](const auto& entry) {
      return std::get<0>(entry.first) == track || std::get<1>(entry.first) == track;
    });
  }

  void hear(const MonitorEvent& event) {
    ++watched_.events;
    if (event.kind == MonitorEventKind::dropped || event.kind == MonitorEventKind::reclassified)
      forget_pairs(event.first);
    if (event.kind == MonitorEventKind::dropped) {
      const auto removed = removed_.find(event.first);
      if (removed == removed_.end())
        start_anew(event.first);
      else
        removed_.erase(removed);
    }
    if (event.kind != MonitorEventKind::verdict) return;
    Verdict& verdict = told_[{event.first, event.second, event.level}];
    if (verdict != event.before) return fail("an event tells of another verdict before");
    verdict = event.verdict;
  }

  void restore() {
    const auto snapshot = monitor_->save();
    auto restored = Monitor::restore(snapshot);
    if (!restored) return fail("restore: " + restored.error().message);
    if (restored->save() != snapshot) return fail("restored, it is another one");
    monitor_.emplace(std::move(*restored));
  }

  void go_to(double time) {
    tell_plans_that_begin(time);
    const Poll poll = [this](std::span<const TrackId> ids, double at,
                             std::span<std::optional<TrackReport>> reports) {
      for (std::size_t k = 0; k < ids.size(); ++k)
        if (!choices_.one_in(3)) {
          TrackReport report = report_of(ids[k], std::min(at, start_ + unit_ * segments));
          report.timestamp = std::min(report.timestamp, at);
          reports[k] = report;
        }
    };
    // Reports of undecided pairs are requested once in each window, so short windows would request too many.
    const bool asks = choices_.one_in(4) && definition_.window > 0.01 * unit_;
    for (int left = 100'000;; --left) {
      if (left == 0) return fail("advance does not end");
      auto event = asks ? monitor_->advance(time, poll) : monitor_->advance(time);
      if (!event) return fail("advance: " + event.error().message);
      if (!*event) break;
      hear(**event);
    }
    const MonitorCounters& counters = monitor_->counters();
    if (counters.searches > 200'000 || counters.rechecks > 20'000'000) fail("too many steps");
  }

  /// Returns true if two tracks are within the separation, enlarged by `more`. `way` and `speed` are the
  /// position and velocity of one relative to the other.
  bool is_within(const Separation& separation, const Place& way, const Place& speed, long double more) const {
    const long double flat = std::sqrt(way.x * way.x + way.y * way.y);
    if (separation.shape == Separation::Shape::well_clear) {
      const long double distance = separation.horizontal + more;
      if (definition_.dimensions == 3 && std::abs(way.z) > separation.vertical + more) return false;
      if (flat <= distance) return true;
      const long double closing = way.x * speed.x + way.y * speed.y;
      const long double cross = way.x * speed.y - way.y * speed.x;
      return closing < 0.0L && std::abs(cross) <= distance * std::hypot(speed.x, speed.y) &&
             (distance * distance - flat * flat) / closing <= separation.modified_tau;
    }
    if (definition_.dimensions == 2) return flat <= separation.horizontal + more;
    if (separation.shape == Separation::Shape::cylinder)
      return flat <= separation.horizontal + more && std::abs(way.z) <= separation.vertical + more;
    const long double stretch = static_cast<long double>(separation.horizontal) / separation.vertical;
    return std::sqrt(flat * flat + stretch * stretch * way.z * way.z) <=
           separation.horizontal + more * std::min(1.0L, stretch);
  }

  bool has_plans_beyond(std::size_t track) const {
    const std::vector<FiledPlan>& plans = truths_[track].plans;
    return std::any_of(plans.begin(), plans.end(), [](const FiledPlan& filed) { return filed.is_beyond; });
  }

  void hold(const char* who, Verdict verdict, bool apart_is_wrong, bool within_is_wrong, std::size_t a,
            std::size_t b, double time) {
    if (verdict != Verdict::undecided) ++watched_.certain;
    if ((verdict == Verdict::apart && apart_is_wrong) || (verdict == Verdict::within && within_is_wrong)) {
      std::ostringstream message;
      message << who << ": " << a << " and " << b << " are not " << name_of(verdict) << " at " << time;
      fail(message.str());
    }
  }

  void check(double time) {
    if (watched_.failure) return;
    const auto& levels = definition_.separations[0].levels;
    for (const std::size_t a : known_)
      for (const std::size_t b : known_) {
        if (b <= a) continue;
        const auto is_within_at = [&](double t, const Separation& level, long double more) {
          return is_within(level, truths_[a].position(t) - truths_[b].position(t),
                           truths_[a].velocity(t) - truths_[b].velocity(t), more);
        };
        const Place way = truths_[a].position(time) - truths_[b].position(time);
        for (std::uint32_t level = 0; level < levels.size(); ++level) {
          const long double tolerance = definition_.tolerance * (1.0L + 1e-12L);
          const bool apart_is_wrong = is_within_at(time, levels[level], 0.0L);
          const bool within_is_wrong = !is_within_at(time, levels[level], tolerance);
          const auto at = told_.find({a, b, level});
          const Verdict reported = at == told_.end() ? Verdict::apart : at->second;
          hold("reported", reported, apart_is_wrong, within_is_wrong, a, b, time);
          const auto answer = monitor_->answer(a, b, level);
          if (!answer) return fail("answer: " + answer.error().message);
          if (answer->verdict != reported)
            fail("answer " + std::string(name_of(answer->verdict)) + " after " +
                 std::string(name_of(reported)) + " was reported");
          if (!(answer->until >= time)) fail("an answer ends before now");
          if (!(answer->inevitable_by >= time)) fail("something was inevitable before now");
          // With one hypothesis each, the pair is within at that time. Plans beyond the class may not be
          // known yet.
          const auto is_plain = [&](std::size_t track) {
            return !has_plans_beyond(track) && monitor_->track(track)->places.size() == 1;
          };
          if (answer->inevitable_by <= start_ + unit_ * segments && is_plain(a) && is_plain(b)) {
            ++watched_.inevitable;
            if (!is_within_at(answer->inevitable_by, levels[level], tolerance))
              fail("the inevitable did not come");
          }
          const bool is_space = levels[level].shape == Separation::Shape::ellipsoid &&
                                levels[level].horizontal == levels[level].vertical;
          const long double distance = is_space ? length(way) : std::sqrt(way.x * way.x + way.y * way.y);
          if (is_space || levels[level].shape != Separation::Shape::ellipsoid ||
              definition_.dimensions == 2) {
            if (answer->lower > distance || answer->upper < distance) fail("limits do not hold the distance");
          }
          Promised& promised = promises_[{a, b, level}];
          if (time < promised.until) {
            ++watched_.promised;
            hold("promised", promised.verdict, apart_is_wrong, within_is_wrong, a, b, time);
          } else {
            promised = {answer->verdict, answer->verdict == Verdict::undecided ? -infinity() : answer->until};
          }
        }
      }
    if (monitor_->counters().contradictions > watched_.wrong * 4)
      fail("reports are said to contradict: " + std::to_string(monitor_->counters().contradictions) + " of " +
           std::to_string(watched_.wrong) + " wrong");
  }

  struct Promised {
    Verdict verdict = Verdict::undecided;
    double until = -std::numeric_limits<double>::infinity();
  };

  Choices choices_;
  WatchedSky watched_;
  double unit_ = 1.0, start_ = 0.0, size_ = 1.0, limit_ = 0.0;
  bool has_speed_ = false;
  long double fastest_ = 0.0;
  Vec3 planned_{};
  MonitorDefinition definition_;
  std::vector<Truth> truths_;
  std::vector<int> since_wrong_;
  std::vector<std::optional<TrackReport>> latest_;
  std::set<std::size_t> known_;
  std::multiset<std::size_t> removed_;  ///< the event of whose removal has not come yet
  std::vector<std::size_t> classes_;
  std::optional<Monitor> monitor_;
  std::map<std::tuple<TrackId, TrackId, std::uint32_t>, Verdict> told_;
  std::map<std::tuple<std::size_t, std::size_t, std::uint32_t>, Promised> promises_;
};

}  // namespace

WatchedSky watch_sky(std::span<const std::uint8_t> bytes) { return Sky(bytes).watch(); }

}  // namespace kinesphere::watched_sky
