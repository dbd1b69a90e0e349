#include "monitor/engine.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "bound/rounding.hpp"
#include "engine/while_true.hpp"
#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// In place of the second stamp of a hot pair: it is about an open record.
constexpr std::uint32_t of_open_record = 0xffffffff;

Space space_of(const MonitorDefinition& definition) {
  return Space(WorldDefinition{.dimensions = definition.dimensions});
}

auto order_of(const MonitorEvent& event) {
  return std::tuple(event.kind, event.first, event.second, event.level);
}

}  // namespace

Monitor::Engine::Engine(const MonitorDefinition& definition)
    : definition_(definition),
      levels_(definition),
      tier_(exponent_of(definition.window)),
      time_(definition.start_time),
      windows_(space_of(definition)) {}

// Reports.

Result<void> Monitor::Engine::report(TrackId id, const TrackReport& report) {
  if (Result<void> checked = check(id, report, "report"); !checked) return checked;
  take(id, report, Placing::now);
  judge_open_pairs(*tracks_.find(id));
  return {};
}

Result<void> Monitor::Engine::check(TrackId id, const TrackReport& report, const char* call) const {
  const std::string part = "report of track " + std::to_string(id);
  const auto subject = [&part](std::string_view field) { return Subject{.argument = part, .part = field}; };
  InputCheck check(call);
  check.finite(subject("stamp"), report.stamp)
      .require(std::abs(report.stamp) <= limits::largest_time, ErrorCode::out_of_range, subject("stamp"),
               "must lie within +-", limits::largest_time, report.stamp)
      .within(subject("position"), report.state.position, definition_.tolerance * limits::largest_length)
      .within(subject("velocity"), report.state.velocity, limits::largest_speed)
      .not_negative(subject("stamp_error"), report.stamp_error)
      .require(report.track_class < definition_.classes.size(), ErrorCode::out_of_range,
               subject("track_class"), "must be less than the number of classes", definition_.classes.size(),
               report.track_class);
  const auto spread = [&](std::string_view field, const Spread& value, bool may_be_infinite) {
    for (const double length : {value.horizontal(), value.vertical(), value.total()}) {
      if (may_be_infinite && length == infinity) continue;
      check.not_negative(subject(field), length);
    }
  };
  spread("position_error", report.position_error, false);
  spread("velocity_error", report.velocity_error, true);
  if (report.plan) {
    check.within(subject("plan acceleration"), report.plan->acceleration, limits::largest_acceleration);
    spread("plan acceleration_limit", report.plan->acceleration_limit, false);
    check.require(report.plan->valid_until > report.stamp, ErrorCode::out_of_range,
                  subject("plan valid_until"), "must be later than the stamp", report.plan->valid_until);
  }
  if (check.error()) return *check.error();
  const TrackClass& promise = definition_.classes[report.track_class];
  check.require(
      std::isfinite(promise.largest_speed.total()) || (std::isfinite(report.velocity_error.total())),
      ErrorCode::out_of_range, subject("velocity_error"),
      "must be finite where the class has no largest speed", report.velocity_error.total());
  if (const auto number = tracks_.find(id))
    check.require(tracks_[*number].track_class == report.track_class, ErrorCode::out_of_range,
                  subject("track_class"), "must be that of its first report,", tracks_[*number].track_class,
                  report.track_class);
  return check.result();
}

/// Whoever calls it judges the open pairs of the track afterwards: of several reports, once all are taken.
void Monitor::Engine::take(TrackId id, const TrackReport& report, Placing placing) {
  const TrackClass& promise = definition_.classes[report.track_class];
  const auto known = tracks_.find(id);
  const std::uint32_t number = known ? *known : tracks_.add(id, report.track_class);
  Track& track = tracks_[number];
  TrackReport flat = report;
  if (definition_.dimensions == 2) {
    flat.state.position.z = 0.0;
    flat.state.velocity.z = 0.0;
    flat.position_error = flat.position_error.flat();
    flat.velocity_error = flat.velocity_error.flat();
    if (flat.plan) {
      flat.plan->acceleration.z = 0.0;
      flat.plan->acceleration_limit = flat.plan->acceleration_limit.flat();
    }
  }
  const Knowledge::Learned learned = track.knowledge.learn(flat, promise, time_, power_of_two(tier_));
  if (learned.outcome == Knowledge::Outcome::repeated) {
    ++counters_.repeated;
    return;
  }
  ++counters_.reports;
  if (learned.late) ++counters_.late;
  std::uint32_t slots = 0;
  for (const Hypothesis& hypothesis : track.knowledge.hypotheses()) slots |= 1u << hypothesis.slot;
  track.placed &= slots;
  if (!known) {
    place(number);
    expect_to_hear(number);
    return;
  }
  if (track.silent && time_ - track.knowledge.stamp() < definition_.silence_after) {
    track.silent = false;
    tell({.time = time_, .kind = MonitorEventKind::heard, .first = id});
    expect_to_hear(number);
  }
  if (learned.outcome == Knowledge::Outcome::contradicts) {
    ++counters_.contradictions;
    tell({.time = time_,
          .kind = MonitorEventKind::contradiction,
          .first = id,
          .position_excess = learned.excess.position,
          .velocity_excess = learned.excess.velocity});
    for (const std::uint32_t other : track.open)
      for (LevelState& state : open_.find(number, other)->levels) state.until = -infinity;
    if (placing == Placing::now) place(number);
    return;
  }
  if (learned.outcome == Knowledge::Outcome::resolves)
    tell({.time = time_, .kind = MonitorEventKind::resolved, .first = id});
}

/// A track is new, or may be elsewhere than was thought: its hypotheses get capsules from now on, and the
/// pairs that they find are looked at.
void Monitor::Engine::place(std::uint32_t number) {
  Track& track = tracks_[number];
  const Window now = window();
  for (const Hypothesis& hypothesis : track.knowledge.hypotheses()) {
    if ((track.placed & 1u << hypothesis.slot) != 0) continue;
    track.placed |= 1u << hypothesis.slot;
    const std::uint32_t at = place_of(number, hypothesis);
    const RoomyBound bound = roomy_bound(number, hypothesis, now.end);
    windows_.enter(at, bound, time_, now);
    ++counters_.searches;
    // Finding a pair does not search.
    for (const std::uint32_t near : windows_.near(at, bound, time_, now.end, scratch_))
      find_pair(number, track_at(near));
  }
  judge_open_pairs(number);
}

Result<void> Monitor::Engine::remove(TrackId id) {
  const auto number = tracks_.find(id);
  if (!number)
    return Error{ErrorCode::unknown_body, "id", no_body, "remove: there is no track " + std::to_string(id)};
  leave(*number);
  return {};
}

void Monitor::Engine::leave(std::uint32_t number) {
  Track& track = tracks_[number];
  for (const std::uint32_t other : track.open) {
    open_.remove(number, other);
    std::erase(tracks_[other].open, number);
  }
  tell({.time = time_, .kind = MonitorEventKind::left, .first = track.id});
  for (std::uint32_t slot = 0; slot < Knowledge::slots; ++slot)
    if (const std::uint32_t place = number * Knowledge::slots + slot; windows_.contains(place))
      windows_.leave(place);
  tracks_.remove(number);
}

/// Puts on the agenda when too long nothing will have been heard of a track.
void Monitor::Engine::expect_to_hear(std::uint32_t number) {
  Track& track = tracks_[number];
  const double after =
      track.silent ? definition_.forget_after : std::min(definition_.silence_after, definition_.forget_after);
  const double time = std::max(time_, track.knowledge.stamp() + after);
  ++track.expected;
  if (time < infinity)
    agenda_.add({.time = time,
                 .first = number,
                 .second = HotPair::walls,
                 .first_stamp = track.life,
                 .second_stamp = track.expected});
}

void Monitor::Engine::is_due(std::uint32_t number) {
  Track& track = tracks_[number];
  const double age = track.knowledge.stamp();
  if (age + definition_.forget_after <= time_) return leave(number);
  if (!track.silent && age + definition_.silence_after <= time_) {
    track.silent = true;
    tell({.time = time_, .kind = MonitorEventKind::silent, .first = track.id});
  }
  expect_to_hear(number);
}

// The clock.

bool Monitor::Engine::is_void(const HotPair& pair) const {
  const Track& first = tracks_[pair.first];
  if (!pair.has_second()) return first.life != pair.first_stamp || first.expected != pair.second_stamp;
  if (pair.second_stamp == of_open_record) {
    const OpenRecord* record = open_.find(pair.first, pair.second);
    return record == nullptr || record->version != pair.first_stamp;
  }
  return first.life != pair.first_stamp || tracks_[pair.second].life != pair.second_stamp ||
         open_.find(pair.first, pair.second) != nullptr;
}

Result<std::optional<MonitorEvent>> Monitor::Engine::advance(double until, const Poll* poll) {
  for (;;) {
    agenda_.open([this](const HotPair& pair) { return is_void(pair); });
    const double next = std::min(windows_.next_end(), agenda_.next_time());
    if (events_.empty() ? next > until : next > time_) break;
    time_ = std::max(time_, next);
    const Result<void> done = windows_.next_end() <= time_ ? start_windows(poll) : look(poll);
    if (!done) return done.error();
  }
  if (events_.empty()) {
    time_ = std::max(time_, until);
    return std::optional<MonitorEvent>{};
  }
  const MonitorEvent event = events_.front();
  events_.pop_front();
  return std::optional(event);
}

void Monitor::Engine::tell(MonitorEvent event) {
  const auto at = std::upper_bound(
      events_.begin(), events_.end(), event,
      [](const MonitorEvent& a, const MonitorEvent& b) { return order_of(a) < order_of(b); });
  events_.insert(at, event);
}

/// A plan's parabola lies around the line between its ends more closely than along its first tangent: for
/// d in [0, T],  1/2 g d^2  is within  |g| T^2 / 16  of  1/2 g (T d - T^2 / 8).
RoomyBound Monitor::Engine::roomy_bound(std::uint32_t number, const Hypothesis& hypothesis,
                                        double end) const {
  MovedBound moved(Knowledge::bound(hypothesis, time_, end), time_);
  if (const double duration = end - time_; moved.acceleration != Vec3{} && duration < infinity) {
    const double sixteenth = duration * duration * 0.0625;
    moved.centre -= moved.acceleration * sixteenth;
    moved.velocity += moved.acceleration * (0.5 * duration);
    moved.radius += norm(moved.acceleration) * (sixteenth * (1.0 + 0x1p-47));
    moved.acceleration = {};
  }
  return {moved, levels_.room(tracks_[number].track_class)};
}

Result<void> Monitor::Engine::start_windows(const Poll* poll) {
  const Window next = window();
  // Tracks by number: the places of one follow one another.
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t place : windows_.ended(time_, false))
    if (numbers.empty() || numbers.back() != track_at(place)) numbers.push_back(track_at(place));
  if (poll != nullptr) {
    // Whose plan ends, and who is in a pair that is undecided.
    std::vector<std::uint32_t> asked;
    for (const std::uint32_t number : numbers) {
      const Track& track = tracks_[number];
      if (track.knowledge.stamp() < time_ &&
          (track.knowledge.first_end() < next.end ||
           std::any_of(track.open.begin(), track.open.end(),
                       [&](std::uint32_t other) { return open_.find(number, other)->is_undecided(); })))
        asked.push_back(number);
    }
    if (!asked.empty()) {
      if (Result<void> done = ask(asked, *poll, Placing::later); !done) return done;
      for (const std::uint32_t number : asked) judge_pairs_not_due(number);
    }
  }
  ++counters_.windows;
  windows_.end_windows(time_, false);
  std::vector<Windows::Starter> starters;
  bounds_.resize(std::size_t{tracks_.numbers()} * Knowledge::slots);
  for (const std::uint32_t number : numbers) {
    Track& track = tracks_[number];
    for (const Hypothesis& hypothesis : track.knowledge.hypotheses()) {
      track.placed |= 1u << hypothesis.slot;
      const std::uint32_t place = place_of(number, hypothesis);
      bounds_[place] = roomy_bound(number, hypothesis, next.end);
      starters.push_back({place, Windows::level_of(*bounds_[place], next), next});
    }
  }
  Shift alone;
  const auto bound_of = [&](std::uint32_t place) -> const RoomyBound& { return *bounds_[place]; };
  windows_.start(starters, time_, bound_of, alone);
  counters_.searches += starters.size();
  const std::size_t started = windows_.started();
  constexpr std::size_t at_once = 256;
  for (std::size_t from = 0; from < started; from += at_once)
    for (const auto& [a, b] :
         windows_.near_started(from, std::min(started, from + at_once), time_, bound_of, scratch_))
      find_pair(track_at(a), track_at(b));
  return {};
}

// Pairs.

/// Puts a pair that has no record on the agenda, for when it may not be apart any more: `a` and `b` may come
/// near each other before the window ends.
void Monitor::Engine::find_pair(std::uint32_t a, std::uint32_t b) {
  if (a == b || levels_of(a, b).empty() || open_.find(a, b) != nullptr) return;
  ++counters_.near_pairs;
  const double horizon = window().end;
  const double until = apart_until(a, b, horizon).value_or(time_);
  if (until < horizon) add_hot_pair(a, b, until);
}

bool Monitor::Engine::is_decided(std::uint32_t a, std::uint32_t b) {
  const std::span<const Components> levels = levels_of(a, b);
  counters_.looks += levels.size();
  return std::all_of(levels.begin(), levels.end(), [&](const Components& level) {
    return course(a, b, level, infinity).verdict != Verdict::undecided;
  });
}

/// If they are apart at all levels.
std::optional<double> Monitor::Engine::apart_until(std::uint32_t a, std::uint32_t b, double horizon) {
  double until = infinity;
  for (const Components& level : levels_of(a, b)) {
    ++counters_.looks;
    const Course now = course(a, b, level, horizon);
    if (now.verdict != Verdict::apart) return std::nullopt;
    until = std::min(until, now.until);
  }
  return until;
}

void Monitor::Engine::add_hot_pair(std::uint32_t a, std::uint32_t b, double time) {
  const auto [first, second] = std::minmax(a, b);
  agenda_.add({time, first, second, tracks_[first].life, tracks_[second].life});
}

void Monitor::Engine::judge_open_pairs(std::uint32_t number) {
  const std::vector<std::uint32_t> partners = tracks_[number].open;
  for (const std::uint32_t other : partners) judge(number, other);
}

/// After reports that were asked for. A pair that is due now waits for its turn: with the report of one track
/// alone it may seem undecided.
void Monitor::Engine::judge_pairs_not_due(std::uint32_t number) {
  const std::vector<std::uint32_t> partners = tracks_[number].open;
  for (const std::uint32_t other : partners) {
    const std::vector<LevelState>& levels = open_.find(number, other)->levels;
    const bool is_due = std::any_of(levels.begin(), levels.end(), [this](const LevelState& state) {
      return -infinity < state.until && state.until <= time_;
    });
    if (!is_due) judge(number, other);
  }
}

/// Says what is certain of two tracks now, tells what has changed, and keeps a record if they are not apart.
void Monitor::Engine::judge(std::uint32_t a, std::uint32_t b) {
  OpenRecord* record = open_.find(a, b);
  if (record == nullptr) {
    const double horizon = window().end;
    if (const auto until = apart_until(a, b, horizon)) {
      if (*until < horizon) add_hot_pair(a, b, *until);
      return;
    }
    record = &open_.add(a, b, levels_of(a, b).size());
    tracks_[a].open.push_back(b);
    tracks_[b].open.push_back(a);
  }
  double until = infinity;
  bool apart = true;
  for (std::uint32_t level = 0; level < record->levels.size(); ++level) {
    judge_level(a, b, level, record->levels[level]);
    const LevelState& state = record->levels[level];
    until = std::min(until, state.until);
    apart = apart && state.verdict == Verdict::apart;
  }
  if (apart) {
    open_.remove(a, b);
    std::erase(tracks_[a].open, b);
    std::erase(tracks_[b].open, a);
    if (until < window().end) add_hot_pair(a, b, until);
    return;
  }
  record->version = open_.fresh_version();
  const auto [one, other] = std::minmax(a, b);
  if (until < infinity) agenda_.add({until, one, other, record->version, of_open_record});
}

void Monitor::Engine::judge_level(std::uint32_t a, std::uint32_t b, std::uint32_t level, LevelState& state) {
  ++counters_.looks;
  const Course now = course(a, b, levels_of(a, b)[level], infinity);
  // What was certain stays so, also if later reports alone would leave it open.
  const bool still = state.verdict != Verdict::undecided && state.until > time_;
  if (now.verdict == state.verdict || still) {
    const bool known_longer = still && now.verdict != state.verdict;
    state.until = known_longer ? state.until : still ? std::max(state.until, now.until) : now.until;
    return;
  }
  const auto [first, second] = std::minmax(tracks_[a].id, tracks_[b].id);
  tell({.time = time_,
        .kind = MonitorEventKind::verdict,
        .first = first,
        .second = second,
        .level = level,
        .verdict = now.verdict,
        .before = state.verdict,
        .since = state.since});
  state = {now.verdict, time_, now.until};
}

/// More can be learned from a report of `a` than from one of `b`.
bool Monitor::Engine::is_less_certain(std::uint32_t a, std::uint32_t b) const {
  const double of_a = tracks_[a].knowledge.worth_asking(time_);
  const double of_b = tracks_[b].knowledge.worth_asking(time_);
  return of_a != of_b ? of_a > of_b : tracks_[a].id < tracks_[b].id;
}

/// At what is due first.
Result<void> Monitor::Engine::look(const Poll* poll) {
  const HotPair pair = agenda_.first();
  agenda_.drop_first();
  if (is_void(pair)) return {};
  if (!pair.has_second()) {
    is_due(pair.first);
    return {};
  }
  const OpenRecord* record = open_.find(pair.first, pair.second);
  if (poll != nullptr && (record == nullptr || record->is_expiring(time_))) {
    if (Result<void> asked = ask_about(pair, *poll); !asked) return asked;
    // What was answered may have made it another pair.
    if (is_void(pair)) return {};
  }
  judge(pair.first, pair.second);
  return {};
}

/// Asks one of two tracks and, where its answer leaves open whether they are apart, the other.
Result<void> Monitor::Engine::ask_about(const HotPair& pair, const Poll& poll) {
  const auto [a, b] = std::pair(pair.first, pair.second);
  // The pair stays due if there is no answer.
  struct Unanswered {
    Agenda& agenda;
    const HotPair& pair;
    bool answered = false;
    ~Unanswered() {
      if (!answered) agenda.add(pair);
    }
  } unanswered{agenda_, pair};
  const std::array<std::uint32_t, 2> both = is_less_certain(a, b) ? std::array{a, b} : std::array{b, a};
  for (const std::uint32_t number : both) {
    if (is_void(pair) || is_decided(a, b)) break;
    if (!(tracks_[number].knowledge.stamp() < time_)) continue;
    if (Result<void> asked = ask(std::span(&number, 1), poll, Placing::now); !asked) return asked;
  }
  for (const std::uint32_t number : both) judge_pairs_not_due(number);
  unanswered.answered = true;
  return {};
}

/// Takes the reports that come back.
Result<void> Monitor::Engine::ask(std::span<const std::uint32_t> numbers, const Poll& poll, Placing placing) {
  std::vector<TrackId> ids;
  for (const std::uint32_t number : numbers) ids.push_back(tracks_[number].id);
  std::vector<std::optional<TrackReport>> reports(ids.size());
  {
    const WhileTrue asking(asking_);
    poll(ids, time_, reports);
  }
  counters_.polls += ids.size();
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (reports[k])
      if (Result<void> checked = check(ids[k], *reports[k], "advance"); !checked) return checked;
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (reports[k]) take(ids[k], *reports[k], placing);
  return {};
}

// Answers.

Result<PairAnswer> Monitor::Engine::answer(TrackId first, TrackId second, std::uint32_t level) const {
  for (const TrackId id : {first, second})
    if (!tracks_.find(id))
      return Error{ErrorCode::unknown_body, id == first ? "first" : "second", no_body,
                   "answer: there is no track " + std::to_string(id)};
  if (first == second)
    return Error{ErrorCode::out_of_range, "second", no_body,
                 "answer: second must be another track than first"};
  const std::uint32_t a = *tracks_.find(first), b = *tracks_.find(second);
  const std::span<const Components> levels = levels_of(a, b);
  if (level >= levels.size())
    return Error{ErrorCode::out_of_range, "level", no_body,
                 "answer: level must be less than " + std::to_string(levels.size()) + ", but is " +
                     std::to_string(level)};
  const Track& one = tracks_[a];
  const Track& other = tracks_[b];
  PairAnswer answer;
  const Course now = course(a, b, levels[level], infinity);
  const OpenRecord* record = open_.find(a, b);
  const LevelState state = record != nullptr ? record->levels[level] : LevelState{};
  answer.verdict = record != nullptr ? state.verdict : now.verdict;
  answer.since = state.since;
  answer.until =
      record == nullptr || now.verdict == state.verdict ? std::max(now.until, state.until) : state.until;
  const Component& nearest = *levels[level].begin();
  const DistanceBetween between = distance_between(one.knowledge, other.knowledge, nearest, time_);
  answer.lower = std::max(0.0, between.lower);
  answer.upper = between.upper;

  // As if both went straight on from where they are now.
  const auto ahead = [this](const Track& track) {
    const Claim& claim = Knowledge::tightest(track.knowledge.hypotheses().front(), time_);
    return State{claim.centre_at(time_), claim.velocity_at(time_)};
  };
  const State x = ahead(one), y = ahead(other);
  answer.likely_time = time_;
  double leaves = infinity;
  for (const Component& component : levels[level]) {
    const Vec3 offset = component.part(x.position - y.position);
    const Vec3 velocity = component.part(x.velocity - y.velocity);
    const double v2 = norm_squared(velocity), xv = dot(offset, velocity);
    const double nearest_after = v2 > 0.0 ? std::max(0.0, -xv / v2) : 0.0;
    if (&component == &nearest) {
      answer.closest_time = time_ + nearest_after;
      answer.closest_distance = norm(offset + velocity * nearest_after);
    }
    const double c = norm_squared(offset) - component.limit * component.limit;
    const double discriminant = xv * xv - v2 * c;
    if (c > 0.0 && !(xv < 0.0 && discriminant >= 0.0)) {
      answer.likely_time = infinity;
      continue;
    }
    const double root = std::sqrt(std::max(0.0, discriminant));
    if (c > 0.0) answer.likely_time = std::max(answer.likely_time, time_ + c / (root - xv));
    if (v2 > 0.0) leaves = std::min(leaves, time_ + (root - xv) / v2);
  }
  if (answer.likely_time > leaves) answer.likely_time = infinity;
  answer.ask = is_less_certain(a, b) ? first : second;
  answer.ask_by = answer.verdict == Verdict::undecided ? time_ : answer.until;
  return answer;
}

std::vector<OpenPair> Monitor::Engine::open_pairs() const {
  std::vector<OpenPair> pairs;
  open_.for_each([&](std::uint32_t a, std::uint32_t b, const OpenRecord& record) {
    const auto [first, second] = std::minmax(tracks_[a].id, tracks_[b].id);
    for (std::uint32_t level = 0; level < record.levels.size(); ++level)
      if (const LevelState& state = record.levels[level]; state.verdict != Verdict::apart)
        pairs.push_back({first, second, level, state.verdict, state.since});
  });
  std::sort(pairs.begin(), pairs.end(), [](const OpenPair& p, const OpenPair& q) {
    return std::tie(p.first, p.second, p.level) < std::tie(q.first, q.second, q.level);
  });
  return pairs;
}

std::vector<ReportNeed> Monitor::Engine::needed(double until) const {
  std::vector<ReportNeed> needs;
  agenda_.for_each([&](const HotPair& pair) {
    if (!pair.has_second() || pair.time > until || is_void(pair)) return;
    const auto [asked, other] = is_less_certain(pair.first, pair.second) ? std::pair(pair.first, pair.second)
                                                                         : std::pair(pair.second, pair.first);
    needs.push_back({tracks_[asked].id, std::max(time_, pair.time), tracks_[other].id});
  });
  open_.for_each([&](std::uint32_t a, std::uint32_t b, const OpenRecord& record) {
    if (!record.is_undecided()) return;
    const auto [asked, other] = is_less_certain(a, b) ? std::pair(a, b) : std::pair(b, a);
    needs.push_back({tracks_[asked].id, time_, tracks_[other].id});
  });
  std::sort(needs.begin(), needs.end(), [](const ReportNeed& p, const ReportNeed& q) {
    return std::tie(p.by, p.track, p.other) < std::tie(q.by, q.track, q.other);
  });
  std::set<TrackId> seen;
  std::erase_if(needs, [&](const ReportNeed& need) { return !seen.insert(need.track).second; });
  return needs;
}

}  // namespace kinesphere
