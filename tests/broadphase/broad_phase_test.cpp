// Bodies that may meet before a window ends are found: bodies of all sizes and speeds that enter, leave and
// start again, in all kinds of space, compared with a plain check of all pairs.
#include "broadphase/broad_phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "broadphase/neighbour_search.hpp"
#include "broadphase/window_policy.hpp"
#include "kinesphere/random.hpp"
#include "number/powers.hpp"
#include "support/bound_cases.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::broad_phase_test {
namespace {

constexpr std::uint64_t seed = 4501;

/// Sizes and speeds as powers of two of `unit`, a length, and of that in a unit of time. The margin around
/// the smallest exceeds the rounding of its place.
struct Kind {
  const char* name;
  int dimensions = 3;
  Axes periodic{};
  std::array<int, 2> radius{-2, -1};
  std::array<int, 2> speed{-2, 1};
  double standing = 0.1;  ///< part of the bodies
  bool curved = false;
  std::uint32_t bodies = 50;
  double unit = 1.0;
  double start_time = 0.0;
  Vec3 place{};

  friend std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }
};

const std::vector<Kind> kinds{
    {.name = "alike", .standing = 0.0, .bodies = 200},
    {.name = "mixed", .radius = {-8, 2}, .speed = {-10, 6}},
    {.name = "flat", .dimensions = 2, .radius = {-3, 0}, .bodies = 200},
    {.name = "periodic", .periodic = {true, true, true}, .radius = {-5, 0}},
    {.name = "periodic_and_flat", .dimensions = 2, .periodic = {true, true, false}, .radius = {-5, 0}},
    {.name = "periodic_on_one_axis", .periodic = {false, true, false}, .radius = {-5, 0}, .speed = {-10, 6}},
    {.name = "curved", .radius = {-4, 0}, .curved = true},
    {.name = "periodic_and_curved", .periodic = {true, true, true}, .radius = {-4, 0}, .curved = true},
    {.name = "far_away", .start_time = 1e6, .place = {1e7, -1e7, 1e7}},
    {.name = "tiny", .radius = {-8, 2}, .unit = 0x1p-60, .start_time = -3e4, .place = {1e-12, 0, 0}},
    {.name = "immense", .radius = {-8, 2}, .unit = 0x1p90},
    {.name = "of_all_speeds", .speed = {-90, 60}},
    {.name = "of_all_sizes", .radius = {-35, 3}, .speed = {-30, 10}},
    {.name = "standing", .standing = 1.0},
};

/// Half the edge of the box that contains the bodies, in units.
constexpr double half_edge = 8.0;

Space space_of(const Kind& kind) {
  const double half = half_edge * kind.unit;
  const Vec3 corner{half, half, half};
  return Space({.box = Box{kind.place - corner, kind.place + corner},
                .periodic = kind.periodic,
                .dimensions = kind.dimensions});
}

class Playground {
 public:
  Playground(const Kind& kind, Random& random)
      : kind_(kind), random_(random), space_(space_of(kind)), windows_(space_), now_(kind.start_time) {
    room_ = kind.unit * std::ldexp(1.0, kind.radius[0] - 3);
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const Vec3 images{double(x), double(y), double(z)};
          const Vec3 shift = space_.shift_of(images);
          if (shift != Vec3{}) shifts_.push_back(shift);
        }
    std::sort(shifts_.begin(), shifts_.end(),
              [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    shifts_.erase(std::unique(shifts_.begin(), shifts_.end()), shifts_.end());
    shifts_.push_back({});
    bounds_.resize(kind_.bodies);
    registered_.resize(kind_.bodies);
    for (Bound& bound : bounds_) bound = draw();
  }

  void act() {
    const std::uint64_t choice = random_.bits() % 100;
    if (choice < 35) return enter(any());
    if (choice < 42) return leave(any());
    if (choice < 45) return start(true);
    if (choice < 50) return windows_.tidy();
    if (choice < 60) return expect_in_box();
    if (choice < 65) return read_back();
    if (choice < 70) return expect_near(any());
    const double ahead = now_ + random_.uniform();
    if (windows_.next_end() > ahead) {
      now_ = ahead;
    } else {
      now_ = windows_.next_end();
      start(false);
    }
  }

  void expect_sound() {
    EXPECT_TRUE(windows_.is_valid(kind_.bodies));
    std::size_t registered = 0, moving = 0;
    for (std::uint32_t number = 0; number < kind_.bodies; ++number) {
      ASSERT_EQ(windows_.contains(number), registered_[number]) << number;
      if (!registered_[number]) continue;
      ++registered;
      if (windows_.end_of(number) < infinity) ++moving;
      EXPECT_EQ(windows_.check(number), std::nullopt);
      EXPECT_GT(windows_.end_of(number), now_);
      EXPECT_GE(windows_.end_of(number), windows_.next_end());
      expect_in_its_box(number);
    }
    EXPECT_EQ(windows_.size(), registered);
    EXPECT_FALSE(registered > 0 && windows_.is_valid(registered - 1)) << "more are registered than there are";
    EXPECT_EQ(windows_.moving(), moving);
    std::size_t in_cells = 0;
    for (const GridLevel& layer : windows_.levels())
      layer.for_each_cell([&](const Box&, std::size_t count) { in_cells += count; });
    EXPECT_EQ(in_cells, registered);
    if (registered == 0) {
      EXPECT_EQ(windows_.least_width(), infinity);
    } else {
      EXPECT_GT(windows_.least_width(), 0.0);
    }
  }

  std::size_t met() const { return met_; }
  std::size_t apart() const { return apart_; }
  std::size_t starts_with_spare_slots() const { return starts_with_spare_slots_; }

 private:
  Bound draw() {
    const auto centre = [&] { return half_edge * random_.uniform(-1.0, 1.0); };
    const double speed = kind_.unit * log_uniform(random_, kind_.speed[0], kind_.speed[1]);
    Bound bound{.time = now_,
                .position = kind_.place + kind_.unit * Vec3{centre(), centre(), centre()},
                .velocity = speed * random_.unit_vector(),
                .radius = kind_.unit * log_uniform(random_, kind_.radius[0], kind_.radius[1])};
    if (kind_.curved) {
      bound.planned_acceleration = speed * random_.point_in_ball();
      bound.growth_speed = 0.1 * speed * random_.uniform();
      bound.acceleration_limit = 0.5 * speed * random_.uniform();
    }
    if (chance(random_, kind_.standing)) {
      bound.velocity = bound.planned_acceleration = {};
      bound.growth_speed = bound.acceleration_limit = 0.0;
    }
    if (space_.is_flat()) bound.position.z = bound.velocity.z = bound.planned_acceleration.z = 0.0;
    return bound;
  }
  std::uint32_t any() { return static_cast<std::uint32_t>(random_.bits() % kind_.bodies); }
  InflatedBound roomy(std::uint32_t number) const { return {BoundAt(bounds_[number], now_), room_}; }
  static bool stands(const Bound& bound) {
    return bound.velocity == Vec3{} && bound.growth_speed + bound.acceleration_limit == 0.0;
  }

  /// The body goes on as before, possibly with a new report, or is elsewhere.
  void report(std::uint32_t number) {
    Bound& bound = bounds_[number];
    // A bound that has grown for long is too large for a search.
    const bool old = now_ - bound.time > 1.0;
    if (!old && chance(random_, 0.3)) return;
    if (chance(random_, 0.4)) {
      bound = draw();
    } else {
      bound.position = bound.centre_at(now_);
      bound.time = now_;
      if (!stands(bound) && norm_one(bound.position - kind_.place) > 100.0 * half_edge * kind_.unit)
        bound = draw();
    }
  }

  double width(std::uint32_t number, double duration) const {
    const auto [moved, room] = roomy(number);
    const Vec3& v = moved.velocity;
    return 2.0 * (moved.radius_after(duration) + room) +
           std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) * duration;
  }
  /// Like the engine: in periodic space no swept sphere is as wide as half a period.
  Window window_to_start(std::uint32_t number) const {
    if (stands(bounds_[number])) return Window::endless();
    const double speed = norm(bounds_[number].velocity_at(now_)) + bounds_[number].growth_speed;
    const int rung = std::clamp(exponent_of(kind_.unit / speed), -70, 2);
    Window window = Window::at(now_, rung + static_cast<int>(number % 3));
    while (space_.repeats() && width(number, window.end - now_) > 0.9 * half_edge * kind_.unit)
      window = Window::at(now_, window.rung - 1);
    return window;
  }
  void bring_home(std::uint32_t number, double duration) {
    const auto [moved, room] = roomy(number);
    const Vec3 middle = moved.centre + 0.5 * duration * moved.velocity;
    bounds_[number].position -= space_.shift_of(space_.wrapped(middle).images);
  }
  static double duration_until(double end, double now) { return end < infinity ? end - now : 0.0; }

  void enter(std::uint32_t number) {
    report(number);
    Window window = window_to_start(number);
    if (registered_[number] && window.end < infinity && windows_.end_of(number) <= window.end)
      window = windows_.window_of(number);
    bring_home(number, duration_until(window.end, now_));
    windows_.enter(number, roomy(number), now_, window);
    registered_[number] = true;
    EXPECT_EQ(windows_.end_of(number), window.end);
    EXPECT_EQ(windows_.window_of(number).rung, window.rung);
    expect_near(number);
  }
  void leave(std::uint32_t number) {
    if (!registered_[number]) return;
    windows_.leave(number);
    registered_[number] = false;
  }

  /// Returns true if the two bodies, with their margins, truly come together within their windows.
  bool meet(std::uint32_t a, std::uint32_t b) {
    const double until = std::min(windows_.end_of(a), windows_.end_of(b));
    Extended least = infinity;
    for (const Vec3& shift : shifts_)
      least = std::min(least,
                       least_true_gap(bounds_[a], bounds_[b], now_, until < infinity ? until : now_, shift));
    const bool together = least <= Extended{2.0 * room_};
    ++(together ? met_ : apart_);
    return together;
  }
  void expect_near(std::uint32_t number) {
    if (!registered_[number]) return;
    const auto found = search_.near(windows_, number, roomy(number), now_, windows_.end_of(number));
    const std::set<std::uint32_t> near(found.begin(), found.end());
    EXPECT_TRUE(space_.repeats() || near.size() == found.size()) << "found twice";
    EXPECT_FALSE(near.contains(number));
    for (std::uint32_t other = 0; other < kind_.bodies; ++other) {
      if (!registered_[other]) {
        EXPECT_FALSE(near.contains(other));
      } else if (other != number && !near.contains(other)) {
        ASSERT_FALSE(meet(number, other)) << bounds_[number] << "\n" << bounds_[other];
      }
    }
  }

  void start(bool all) {
    std::vector<std::uint32_t> round = windows_.ended(now_, all);
    std::set<std::uint32_t> expected;
    for (std::uint32_t number = 0; number < kind_.bodies; ++number) {
      const double end = registered_[number] ? windows_.end_of(number) : infinity;
      if (all ? end < infinity : end <= now_) expected.insert(number);
    }
    ASSERT_EQ(std::set(round.begin(), round.end()), expected);
    ASSERT_EQ(round.size(), expected.size());
    windows_.end_windows(now_, all);
    for (std::uint32_t number = 0; number < kind_.bodies; ++number)
      ASSERT_EQ(windows_.contains(number), registered_[number] && !expected.contains(number));
    // Some bodies join them.
    for (std::uint32_t number = 0; number < kind_.bodies; ++number)
      if (!registered_[number] && !stands(bounds_[number]) && chance(random_, all ? 0.8 : 0.1))
        round.push_back(number);
    std::set<std::uint32_t> started;
    std::vector<BroadPhase::Starter> starters;
    for (const std::uint32_t number : round) {
      report(number);
      registered_[number] = false;
      const Window suits = window_to_start(number);
      if (suits.end == infinity) continue;
      const Window window = Window::free_at(now_, suits.rung, windows_.held_rungs());
      bring_home(number, window.end - now_);
      starters.push_back({number, SizeClasses::size_class_of(roomy(number), window), window});
      registered_[number] = true;
      started.insert(number);
    }
    PoolLease alone;
    windows_.start(
        starters, now_, [this](std::uint32_t number) { return roomy(number); }, alone);
    for (const auto& [number, level, window] : starters) EXPECT_EQ(windows_.end_of(number), window.end);
    expect_pairs_of(started);
  }
  void expect_pairs_of(const std::set<std::uint32_t>& started) {
    const std::size_t slots = windows_.started_slots();
    ASSERT_GE(slots, started.size());
    ASSERT_LE(slots, started.size() + started.size() / 8);
    if (slots > started.size()) ++starts_with_spare_slots_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> pairs;
    const auto bound_of = [this](std::uint32_t body) { return roomy(body); };
    // Starts the bodies in two parts, like two threads.
    const std::size_t part = slots / 3;
    for (const auto& [from, to] : {std::pair(std::size_t{0}, part), std::pair(part, slots)}) {
      for (const auto& [number, other] : search_.near_started(windows_, from, to, now_, bound_of)) {
        ASSERT_TRUE(started.contains(number));
        ASSERT_TRUE(other < kind_.bodies && registered_[other]);
        ++pairs[std::minmax(number, other)];
      }
    }
    for (const auto& [pair, times] : pairs) {
      EXPECT_NE(pair.first, pair.second);
      EXPECT_TRUE(space_.repeats() || times == 1) << "found twice";
    }
    for (const std::uint32_t a : started)
      for (std::uint32_t b = 0; b < kind_.bodies; ++b) {
        if (a == b || !registered_[b] || (b < a && started.contains(b))) continue;
        if (pairs.contains(std::minmax(a, b))) continue;
        ASSERT_FALSE(meet(a, b)) << bounds_[a] << "\n" << bounds_[b];
      }
  }

  void expect_in_its_box(std::uint32_t number) {
    const Box box = windows_.box_of(number, now_);
    const double duration = duration_until(windows_.end_of(number), now_);
    constexpr int samples = 4;
    for (int k = 0; k <= samples; ++k) {
      const TrueBall ball = true_ball(bounds_[number], Extended{now_} + Extended{duration} * k / samples);
      for (int axis = 0; axis < kind_.dimensions; ++axis) {
        const auto along = static_cast<std::size_t>(axis);
        ASSERT_LE(Extended{box.lower[axis]}, ball.centre[along] - ball.radius) << bounds_[number];
        ASSERT_GE(Extended{box.upper[axis]}, ball.centre[along] + ball.radius) << bounds_[number];
      }
    }
    if (space_.is_flat()) {
      EXPECT_EQ(box.lower.z, 0.0);
      EXPECT_EQ(box.upper.z, 0.0);
    }
  }

  void expect_in_box() {
    const auto half = [&] { return kind_.unit * log_uniform(random_, -4, 4); };
    const Vec3 size{half(), half(), half()};
    const auto centre = [&] { return half_edge * random_.uniform(-2.0, 2.0); };
    Vec3 middle = kind_.place + kind_.unit * Vec3{centre(), centre(), centre()};
    if (space_.is_flat()) middle.z = 0.0;
    const Box box{middle - size, middle + size};
    const auto found = search_.in_box(windows_, box, now_);
    const std::set<std::uint32_t> numbers(found.begin(), found.end());
    for (std::uint32_t number = 0; number < kind_.bodies; ++number) {
      if (!registered_[number]) {
        EXPECT_FALSE(numbers.contains(number));
      } else if (!numbers.contains(number)) {
        ASSERT_FALSE(reaches(number, box)) << bounds_[number];
      }
    }
  }
  /// Returns true if the body reaches the box, in any image.
  bool reaches(std::uint32_t number, const Box& box) const {
    const TrueBall ball = true_ball(bounds_[number], now_);
    Extended square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Extended period = space_.period()[axis];
      Extended least = infinity;
      for (int image = -6; image <= 6; ++image) {
        const Extended at = ball.centre[static_cast<std::size_t>(axis)] + image * period;
        const Extended below = Extended{box.lower[axis]} - at, above = at - Extended{box.upper[axis]};
        least = std::min(least, std::max({below, above, Extended{0}}));
      }
      square += least * least;
    }
    return std::sqrt(square) <= ball.radius;
  }

  /// Replaces the broad phase by one read back from its bytes, which must behave equally from there on.
  void read_back() {
    ByteWriter writer;
    writer(windows_);
    BroadPhase back(space_);
    back.enter(3, roomy(3), now_, Window::endless());  // the earlier content is dropped
    ByteReader reader(writer.bytes());
    reader(back);
    ASSERT_FALSE(reader.failed());
    EXPECT_EQ(reader.remaining(), 0u);
    ASSERT_TRUE(back.is_valid(kind_.bodies));
    ByteWriter again;
    again(back);
    ASSERT_EQ(again.bytes(), writer.bytes());
    for (std::uint32_t number = 0; number < kind_.bodies; ++number) {
      if (!registered_[number]) continue;
      NeighbourSearch search;
      const auto& here = search_.near(windows_, number, roomy(number), now_, windows_.end_of(number));
      const auto& there = search.near(back, number, roomy(number), now_, back.end_of(number));
      ASSERT_TRUE(std::equal(here.begin(), here.end(), there.begin(), there.end()));
    }
    windows_ = back;
  }

  const Kind& kind_;
  Random& random_;
  Space space_;
  BroadPhase windows_;
  NeighbourSearch search_;
  double now_;
  double room_ = 0.0;
  std::vector<Vec3> shifts_;
  std::vector<Bound> bounds_;
  std::vector<bool> registered_;
  std::size_t met_ = 0;
  std::size_t apart_ = 0;
  std::size_t starts_with_spare_slots_ = 0;
};

class WindowsOf : public testing::TestWithParam<Kind> {};

TEST_P(WindowsOf, OverlookNobody) {
  std::size_t apart = 0;
  std::size_t with_spare_slots = 0;
  for (std::uint64_t stream = 0; stream < 3; ++stream) {
    Random random = Random::at(seed, stream, 0);
    Playground playground(GetParam(), random);
    for (int action = 0; action < 250; ++action) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", stream " << stream << ", action " << action);
      playground.act();
      if (action % 10 == 9) playground.expect_sound();
      if (HasFailure()) return;
    }
    apart += playground.apart();
    with_spare_slots += playground.starts_with_spare_slots();
  }
  EXPECT_GT(apart, 0u) << "not all are near all";
  if (std::string_view(GetParam().name) == "alike") {
    EXPECT_GT(with_spare_slots, 0u);
  }
}

std::string kind_name(const testing::TestParamInfo<Kind>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Windows, WindowsOf, testing::ValuesIn(kinds), kind_name);

/// A body that is already in windows suitable for others makes their windows shorter; if there are no shorter
/// ones, there is none.
TEST(BroadPhase, AreFreeWhereNobodyIs) {
  const double now = 3.0;
  BroadPhase windows{Space{WorldDefinition{}}};
  const InflatedBound bound{BoundAt(Bound{.time = now, .radius = 1.0}, now), 0.0};
  const Window shortest = Window::at(now, Window::shortest);
  int rung = 5;
  for (std::uint32_t number = 0;; ++number) {
    const Window free = Window::free_at(now, 5, windows.held_rungs());
    EXPECT_EQ(free.rung, std::max(rung, shortest.rung));
    if (free.end == now) break;
    EXPECT_EQ(free.end, Window::at(now, rung).end);
    ASSERT_LT(number, 100u);
    windows.enter(number, bound, now, free);
    EXPECT_EQ(Window::free_at(now, 6, windows.held_rungs()).rung, 6) << "nobody is in windows of that length";
    rung -= WindowPolicy::powers_between_rungs;
  }
  EXPECT_LE(rung, shortest.rung);
}

TEST(BroadPhase, SearchesLookAtFewOfMany) {
  for (const bool mixed : {false, true}) {
    Random random(seed);
    BroadPhase windows{Space{}};
    std::vector<InflatedBound> bounds;
    std::vector<BroadPhase::Starter> starters;
    constexpr std::uint32_t many = 3000;
    for (std::uint32_t number = 0; number < many; ++number) {
      const Bound bound{.position = 25.0 * random.point_in_ball(),
                        .velocity = random.point_in_ball(),
                        .radius = log_uniform(random, mixed ? -8 : -1, -1)};
      bounds.push_back({BoundAt(bound, 0.0), 0.0});
      const Window window = Window::at(0.0, 0);
      starters.push_back({number, SizeClasses::size_class_of(bounds.back(), window), window});
    }
    const auto bound_of = [&](std::uint32_t number) { return bounds[number]; };
    PoolLease alone;
    windows.start(starters, 0.0, bound_of, alone);
    NeighbourSearch search;
    const std::size_t found = search.near_started(windows, 0, many, 0.0, bound_of).size();
    SweptSphereSearches searches;
    for (const GridLevel& layer : windows.levels())
      for (const InflatedBound& bound : bounds)
        layer.spheres.add_search(layer.query(bound, 0.0, 1.0), searches);
    std::size_t looked_at = 0;
    for (const auto& run : searches.ranges) looked_at += run.end - run.begin;
    EXPECT_LT(looked_at, std::size_t{many} * many / 10) << mixed;
    EXPECT_LT(found, std::size_t{many} * 20) << mixed;
    EXPECT_GT(found, 100u) << mixed;
  }
}

/// Bodies that start together; some of them change velocity, several times each, before they start again.
class KickedBodies {
 public:
  static constexpr std::uint32_t count = 600;
  struct Kick {
    std::uint32_t number;
    double time;
    Bound bound;
  };
  /// The bodies that each starting body finds.
  using Found = std::map<std::uint32_t, std::set<std::uint32_t>>;

  KickedBodies() {
    for (std::uint32_t number = 0; number < count; ++number) {
      bounds_.push_back(draw(number, 0.0));
      if (stands(number)) windows_.enter(number, roomy(number, 0.0), 0.0, Window::endless());
    }
    start(0.0, true);
  }

  Bound draw(std::uint32_t number, double time) {
    const double speed = stands(number) ? 0.0 : is_fast(number) ? 16.0 : 1.0;
    return {.time = time,
            .position = 20.0 * random_.point_in_ball(),
            .velocity = speed * random_.point_in_ball(),
            .radius = log_uniform(random_, number % 5 == 0 ? 1 : -4, number % 5 == 0 ? 2 : -2)};
  }
  void velocity_change(const Kick& update) {
    bounds_[update.number] = update.bound;
    windows_.enter(update.number, roomy(update.number, update.time), update.time,
                   window(update.number, update.time));
  }
  void tidy() { windows_.tidy(); }
  /// Returns the bodies that a body finds after a velocity change.
  std::set<std::uint32_t> near(std::uint32_t number, double time) {
    const auto found = search_.near(windows_, number, roomy(number, time), time, windows_.end_of(number));
    return {found.begin(), found.end()};
  }
  Found start(double time, bool all) {
    std::vector<std::uint32_t> round = windows_.ended(time, all);
    EXPECT_TRUE(std::is_sorted(round.begin(), round.end()));
    if (windows_.moving() == 0) {
      for (std::uint32_t number = 0; number < count; ++number)
        if (!stands(number)) round.push_back(number);
    }
    windows_.end_windows(time, all);
    std::vector<BroadPhase::Starter> starters;
    for (const std::uint32_t number : round)
      starters.push_back({number, SizeClasses::size_class_of(roomy(number, time), window(number, time)),
                          window(number, time)});
    const auto bound_now = [&](std::uint32_t number) { return roomy(number, time); };
    PoolLease alone;
    windows_.start(starters, time, bound_now, alone);
    Found found;
    for (const auto& [number, other] :
         search_.near_started(windows_, 0, windows_.started_slots(), time, bound_now))
      found[std::min(number, other)].insert(std::max(number, other));
    return found;
  }
  static bool stands(std::uint32_t number) { return number % 4 == 3; }
  static bool is_fast(std::uint32_t number) { return number % 4 == 2; }

 private:
  InflatedBound roomy(std::uint32_t number, double time) const {
    return {BoundAt(bounds_[number], time), 0.01};
  }
  static Window window(std::uint32_t number, double time) {
    return stands(number) ? Window::endless() : Window::at(time, is_fast(number) ? -3 : 0);
  }

  Random random_{seed};
  BroadPhase windows_{Space{}};
  NeighbourSearch search_;
  std::vector<Bound> bounds_;
};

TEST(BroadPhase, StartAlikeInWhateverOrderBodiesWereKicked) {
  KickedBodies forward, backward;
  Random random(seed);
  for (int window = 1; window <= 16; ++window) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", window " << window);
    const double begin = 0.125 * (window - 1), end = 0.125 * window;
    // The updates of each body are in order of time; the bodies are in any order.
    std::vector<std::vector<KickedBodies::Kick>> updates;
    const std::size_t redirected = window % 3 == 0 ? 300 : 30;
    for (std::uint32_t number = 0; number < KickedBodies::count; ++number) {
      if (random.bits() % KickedBodies::count >= redirected) continue;
      std::vector<KickedBodies::Kick>& own = updates.emplace_back();
      double time = begin;
      for (std::uint64_t k = random.bits() % 3; k < 3; ++k) {
        time += 0.3 * (end - begin) * random.uniform();
        own.push_back({number, time, forward.draw(number, time)});
      }
    }
    for (const auto& own : updates)
      for (const auto& update : own) forward.velocity_change(update);
    for (std::size_t k = updates.size(); k-- > 0;) {
      for (const auto& update : updates[k]) backward.velocity_change(update);
      if (k % 7 == 0) backward.tidy();
    }
    for (const auto& own : updates) {
      const std::uint32_t number = own.back().number;
      const double late = begin + 0.95 * (end - begin);
      ASSERT_EQ(forward.near(number, late), backward.near(number, late)) << number;
    }
    const auto ahead = forward.start(end, false);
    const auto back = backward.start(end, false);
    ASSERT_EQ(ahead, back);
    EXPECT_FALSE(ahead.empty());
  }
}

}  // namespace
}  // namespace kinesphere::broad_phase_test
