// A grid level finds all swept spheres that touch one, wherever they are, after any additions, replacements
// and removals since it was sorted; and none that the plain search among all does not find.
#include "broadphase/swept_sphere_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "support/bound_cases.hpp"
#include "support/read_back.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::swept_sphere_grid_test {
namespace {

constexpr std::uint64_t seed = 4401;

/// A kind of bodies, in units of the frame; the window lasts from 0 to 1.
struct Crowd {
  const char* name;
  Bound (*draw)(Random&);

  friend std::ostream& operator<<(std::ostream& out, const Crowd& crowd) { return out << crowd.name; }
};

Bound ball(const Vec3& centre, double radius) { return {.position = centre, .radius = radius}; }

/// Braces, unlike calls, draw their numbers in one order with all compilers.
const std::vector<Crowd> crowds{
    {"even",
     [](Random& random) {
       const Vec3 centre{random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0)};
       return Bound{
           .position = centre, .velocity = random.point_in_ball(), .radius = 0.3 + 0.2 * random.uniform()};
     }},
    {"flat",
     [](Random& random) {
       const Vec3 centre{random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0), 0.0};
       const double way = random.uniform(-1.0, 1.0);
       return Bound{.position = centre, .velocity = {way, 1.0 - way, 0.0}, .radius = 0.5 * random.uniform()};
     }},
    {"dense_clusters",
     [](Random& random) {
       const Vec3 middle{100.0 * static_cast<double>(random.bits() % 3), 0.0, -50.0};
       return Bound{.position = middle + 0.5 * random.point_in_ball(),
                    .velocity = 0.1 * random.point_in_ball(),
                    .radius = 0.05};
     }},
    {"one_far_away",
     [](Random& random) {
       if (random.bits() % 50 == 0) return ball({0x1p30, -0x1p35, 1.0}, 1.0);
       return Bound{.position = 10.0 * random.point_in_ball(),
                    .velocity = random.point_in_ball(),
                    .radius = 0.5 * random.uniform()};
     }},
    {"at_all_distances",
     [](Random& random) {
       const double distance = log_uniform(random, -30, 50);
       return Bound{.position = distance * random.unit_vector(),
                    .velocity = random.point_in_ball(),
                    .radius = random.uniform()};
     }},
    {"beyond_all_cells",
     [](Random& random) {
       const double far = log_uniform(random, 0, 100);
       return Bound{.position = far * random.point_in_ball(), .radius = far * 0x1p-3 * random.uniform()};
     }},
    {"all_far_away",
     [](Random& random) {
       const Vec3 middle{0x1p60, 0x1p61, -0x1p60};
       return ball(middle + 0x1p60 * random.point_in_ball(), 0x1p58);
     }},
    {"giants", [](Random& random) { return ball(100.0 * random.point_in_ball(), 0x1p30); }},
    {"in_one_point",
     [](Random&) {
       return ball({1.0, 2.0, 3.0}, 0.1);
     }},
    {"points_in_the_base", [](Random&) { return ball({}, 0.0); }},
    {"points", [](Random& random) { return ball(10.0 * random.point_in_ball(), 0.0); }},
    {"on_cell_borders",
     [](Random& random) {
       const auto whole = [&random] { return static_cast<double>(random.bits() % 17) - 8.0; };
       return Bound{
           .position = {whole(), whole(), whole()}, .velocity = {whole() / 8.0, 0.0, 0.0}, .radius = 0.5};
     }},
    {"of_all_sizes",
     [](Random& random) {
       const double speed = log_uniform(random, -20, 4);
       return Bound{.position = 30.0 * random.point_in_ball(),
                    .velocity = speed * random.unit_vector(),
                    .radius = log_uniform(random, -20, 4)};
     }},
    {"fast",
     [](Random& random) {
       return Bound{.position = 30.0 * random.point_in_ball(),
                    .velocity = 40.0 * random.point_in_ball(),
                    .radius = 0.2};
     }},
    {"curved",
     [](Random& random) {
       return Bound{.position = 10.0 * random.point_in_ball(),
                    .velocity = random.point_in_ball(),
                    .planned_acceleration = random.point_in_ball(),
                    .radius = 0.2,
                    .acceleration_limit = random.uniform()};
     }},
    {"some_everywhere",
     [](Random& random) {
       const double speed = random.bits() % 40 == 0 ? 0x1p100 : 1.0;
       return Bound{.position = 10.0 * random.point_in_ball(),
                    .velocity = speed * random.point_in_ball(),
                    .radius = 0.2};
     }},
};

/// A grid level, and its bodies in a plain map by their numbers.
class Mirrored {
 public:
  explicit Mirrored(const SweptSphereFrame& frame, bool has_spare_slots = false)
      : layer(frame), has_spare_slots_(has_spare_slots) {
    layer.set_spare_slots(has_spare_slots);
  }

  SweptSphereGrid layer;
  double now = 0.0;

  SweptSphere capsule(const Bound& bound) const {
    return swept_sphere_of(BoundAt(bound, now), now, 1.0 - now, 0.0, layer.frame());
  }
  void add(Bound bound) {
    bound.position += layer.frame().base;
    bound.time = now;
    const std::uint32_t number = next_number_++;
    bodies_[number] = {bound, layer.add(number, capsule(bound), layer.frame().time(now))};
  }
  void replace(std::uint32_t number, Bound bound) {
    bound.position += layer.frame().base;
    bound.time = now;
    Entry& entry = bodies_.at(number);
    const SweptSphere before = layer.table().swept_sphere_at(entry.place);
    const SweptSphere after = capsule(bound);
    const float from = layer.frame().time(now);
    if (const auto looseness = layer.looseness_at(entry.place, after, from)) {
      SweptSphereGrid::Growth growth;
      layer.replace(entry.place, after, from, *looseness, growth);
      layer.grow(growth);
      EXPECT_EQ(layer.table().swept_sphere_at(entry.place), after);
      entry.bound = bound;
    } else {
      EXPECT_EQ(layer.table().swept_sphere_at(entry.place), before);
      if (!has_spare_slots_) return;
      layer.remove(entry.place);
      entry = {bound, layer.add(number, after, from)};
    }
  }
  void remove(std::uint32_t number) {
    layer.remove(bodies_.at(number).place);
    bodies_.erase(number);
  }
  void sort() {
    std::set<std::uint32_t> reported;
    PoolLease alone;
    layer.sort(alone, [&](std::uint32_t number, std::uint32_t place) {
      EXPECT_TRUE(reported.insert(number).second);
      bodies_.at(number).place = place;
    });
    EXPECT_EQ(reported.size(), bodies_.size());
    EXPECT_EQ(layer.table().slots(), bodies_.size() + (has_spare_slots_ ? bodies_.size() / 8 : 0));
    EXPECT_FALSE(layer.is_untidy());
  }
  std::size_t size() const { return bodies_.size(); }
  std::uint32_t any(Random& random) const {
    auto at = bodies_.lower_bound(static_cast<std::uint32_t>(random.bits() % next_number_));
    return at == bodies_.end() ? bodies_.begin()->first : at->first;
  }

  testing::AssertionResult same_places() const {
    if (!layer.is_valid()) return testing::AssertionFailure() << "not sound";
    if (layer.size() != bodies_.size()) return testing::AssertionFailure() << "size";
    for (const auto& [number, entry] : bodies_) {
      if (layer.table().number_at(entry.place) != number)
        return testing::AssertionFailure() << "place of " << number;
      if (!within_widest(layer.table().swept_sphere_at(entry.place)))
        return testing::AssertionFailure() << number << " is wider than the widest";
    }
    return testing::AssertionSuccess();
  }

  /// Expects that all that touch the bound from now until `until` are found, each once, and none that the
  /// plain search among all does not find.
  testing::AssertionResult same_found(Bound bound, double until) {
    bound.position += layer.frame().base;
    bound.time = now;
    const SweptSphereQuery query{capsule(bound), layer.frame().time(now), layer.frame().time(until)};
    const std::vector<std::uint32_t> found = search(query);
    looked_at += looked_at_last();
    const std::set<std::uint32_t> places(found.begin(), found.end());
    if (places.size() != found.size()) return testing::AssertionFailure() << "found twice";
    if (const auto plain = plain_search(query); !includes(plain, places))
      return testing::AssertionFailure() << "found what is apart";
    for (const auto& [number, entry] : bodies_) {
      if (!(least_true_gap(entry.bound, bound, now, until) <= 0)) continue;
      ++touching;
      if (!places.contains(entry.place))
        return testing::AssertionFailure() << "not found: " << entry.bound << "\nwhich touches " << bound;
    }
    return testing::AssertionSuccess();
  }

  /// Expects that a pass through all slots of a sorted level finds each pair once.
  testing::AssertionResult same_pairs() {
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    searches_.clear();
    for (std::uint32_t place = 0; place < layer.table().slots(); ++place)
      layer.add_search_behind(place, searches_);
    layer.make(searches_);
    bool found_before = false, found_twice = false;
    searches_.for_each_found([&](std::uint32_t place, std::uint32_t other) {
      found_before = found_before || other <= place;
      found_twice = !pairs.insert({place, other}).second || found_twice;
    });
    if (found_before) return testing::AssertionFailure() << "found one before it";
    if (found_twice) return testing::AssertionFailure() << "found twice";
    for (std::uint32_t place = 0; place < layer.table().slots(); ++place) {
      const auto plain = plain_search({layer.table().swept_sphere_at(place), 0.0f, 1.0f});
      for (auto at = pairs.lower_bound({place, 0}); at != pairs.end() && at->first == place; ++at)
        if (!plain.contains(at->second)) return testing::AssertionFailure() << "found what is apart";
    }
    for (auto a = bodies_.begin(); a != bodies_.end(); ++a)
      for (auto b = std::next(a); b != bodies_.end(); ++b) {
        const double from = std::max(a->second.bound.time, b->second.bound.time);
        if (!(least_true_gap(a->second.bound, b->second.bound, from, 1.0) <= 0)) continue;
        if (!pairs.contains(std::minmax(a->second.place, b->second.place)))
          return testing::AssertionFailure()
                 << "not found: " << a->second.bound << " and " << b->second.bound;
      }
    return testing::AssertionSuccess();
  }

  testing::AssertionResult same_cells() const {
    std::size_t count = 0;
    bool is_box = true;
    layer.for_each_cell([&](const Box& box, std::size_t bodies) {
      count += bodies;
      is_box = is_box && bodies > 0 && box.lower.x < box.upper.x && box.lower.y < box.upper.y &&
               box.lower.z < box.upper.z;
    });
    if (count != bodies_.size()) return testing::AssertionFailure() << "counted " << count;
    if (!is_box) return testing::AssertionFailure() << "no box, or nobody in it";
    return testing::AssertionSuccess();
  }

  std::size_t looked_at = 0;
  std::size_t touching = 0;

 private:
  struct Entry {
    Bound bound;
    std::uint32_t place;
  };

  std::size_t looked_at_last() const {
    std::size_t all = 0;
    for (const kinesphere::SlotRange& run : searches_.ranges) all += run.end - run.begin;
    return all;
  }
  static bool includes(const std::set<std::uint32_t>& all, const std::set<std::uint32_t>& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
  }
  bool within_widest(const SweptSphere& sphere) const {
    float widest = 2.0f * sphere.radius;
    for (const float speed : sphere.velocity)
      widest = std::max(widest, 2.0f * sphere.radius + std::abs(speed) * (1.0f - layer.frame().time(now)));
    // A float represents the two sides of a small one far from the base to about 2^-6 of its width.
    return widest <= layer.widest() * 1.05f;
  }
  std::set<std::uint32_t> plain_search(const SweptSphereQuery& query) const {
    const auto places = static_cast<std::uint32_t>(layer.table().slots());
    std::array<std::vector<float>, 7> columns;
    for (std::vector<float>& column : columns) column.resize(places + search_lanes);
    for (std::uint32_t place = 0; place < places; ++place) {
      const SweptSphere sphere = layer.table().swept_sphere_at(place);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        columns[axis][place] = sphere.centre[axis];
        columns[axis + 3][place] = sphere.velocity[axis];
      }
      columns[6][place] = sphere.radius;
    }
    SweptSphereColumns pointers{};
    for (std::size_t k = 0; k < pointers.size(); ++k) pointers[k] = columns[k].data();
    const std::array all{kinesphere::SlotRange{0, places}};
    std::vector<std::uint64_t> words(kinesphere::words_for(all[0]));
    near_swept_spheres_plain(pointers, std::array{query}, all, words.data());
    std::set<std::uint32_t> found;
    kinesphere::for_each_near(all, words.data(),
                              [&](std::uint32_t, std::uint32_t place) { found.insert(place); });
    return found;
  }
  std::vector<std::uint32_t> search(const SweptSphereQuery& query) {
    searches_.clear();
    layer.add_search(query, searches_);
    layer.make(searches_);
    std::vector<std::uint32_t> found;
    searches_.for_each_found([&](std::uint32_t, std::uint32_t place) { found.push_back(place); });
    return found;
  }

  bool has_spare_slots_;
  std::map<std::uint32_t, Entry> bodies_;
  std::uint32_t next_number_ = 0;
  SweptSphereSearches searches_;
};

SweptSphereFrame draw_frame(Random& random) {
  const double unit = std::ldexp(1.0, static_cast<int>(random.bits() % 9) - 4);
  return {.base = 100.0 * random.point_in_ball(), .per_length = unit};
}

void act(Mirrored& mirrored, Random& random, const Crowd& crowd, bool growing) {
  const std::uint64_t choice = random.bits() % 100;
  if (choice < (growing ? 70u : 35u) || mirrored.size() == 0) {
    mirrored.add(crowd.draw(random));
  } else if (choice < 80) {
    const std::uint32_t number = mirrored.any(random);
    mirrored.replace(number, crowd.draw(random));
  } else {
    mirrored.remove(mirrored.any(random));
  }
}

class GridSearch : public testing::TestWithParam<Crowd> {};

TEST_P(GridSearch, FindsAllThatTouchWhateverHappenedBefore) {
  std::size_t touching = 0;
  for (std::uint64_t stream = 0; stream < 4; ++stream) {
    Random random = Random::at(seed, stream, 0);
    Mirrored mirrored(draw_frame(random), stream % 2 == 1);
    for (int action = 0; action < 600; ++action) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", stream " << stream << ", action " << action);
      act(mirrored, random, GetParam(), action < 300);
      if (action % 150 == 149 || mirrored.layer.is_untidy()) mirrored.sort();
      if (action % 100 == 99) mirrored.now += 0.125;
      if (action % 15 != 14) continue;
      ASSERT_TRUE(mirrored.same_places());
      const Bound bound = GetParam().draw(random);
      const double until =
          mirrored.now + (1.0 - mirrored.now) * (chance(random, 0.5) ? 1.0 : random.uniform());
      ASSERT_TRUE(mirrored.same_found(bound, until));
    }
    ASSERT_TRUE(mirrored.same_cells());
    touching += mirrored.touching;
  }
  if (std::string_view(GetParam().name) != "points") {
    EXPECT_GT(touching, 0u);
  }
}

TEST_P(GridSearch, FindsEachPairOnce) {
  for (const int bodies : {1, 2, 31, 33, 100, 400}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << bodies << " bodies");
    Random random = Random::at(seed, static_cast<std::uint64_t>(bodies), 1);
    Mirrored mirrored(draw_frame(random), bodies % 2 == 1 || bodies == 400);
    for (int k = 0; k < bodies; ++k) mirrored.add(GetParam().draw(random));
    mirrored.sort();
    ASSERT_TRUE(mirrored.same_places());
    ASSERT_TRUE(mirrored.same_pairs());
    ASSERT_TRUE(mirrored.same_cells());
    // Another crowd in the grid level after its cells have got a size.
    mirrored.remove(mirrored.any(random));
    mirrored.add(crowds.front().draw(random));
    mirrored.sort();
    ASSERT_TRUE(mirrored.same_places());
    ASSERT_TRUE(mirrored.same_pairs());
  }
}

TEST_P(GridSearch, GoesOnAsBeforeAfterItWasBytes) {
  Random random = Random::at(seed, 0, 2);
  Mirrored mirrored(draw_frame(random), true);
  for (int action = 0; action < 300; ++action) {
    act(mirrored, random, GetParam(), true);
    if (action == 200) mirrored.sort();
  }
  Mirrored back = mirrored;
  back.layer = {};
  back.layer.add(7, {}, 0.0f);  // the earlier content is dropped
  ASSERT_TRUE(read_back(mirrored.layer, back.layer));
  for (const int more : {0, 100, 200}) {
    Random same_random = random;
    for (int action = 0; action < more; ++action) {
      act(mirrored, random, GetParam(), true);
      act(back, same_random, GetParam(), true);
    }
    if (more == 200) {
      mirrored.sort();
      back.sort();
    }
    ASSERT_TRUE(back.same_places());
    const Bound bound = GetParam().draw(random);
    ASSERT_TRUE(mirrored.same_found(bound, 1.0));
    ASSERT_TRUE(back.same_found(bound, 1.0));
    EXPECT_EQ(back.looked_at, mirrored.looked_at);
    ByteWriter one, other;
    one(mirrored.layer);
    other(back.layer);
    ASSERT_EQ(one.bytes(), other.bytes()) << "after " << more << " more";
  }
}

std::string crowd_name(const testing::TestParamInfo<Crowd>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Layer, GridSearch, testing::ValuesIn(crowds), crowd_name);

TEST(SweptSphereGrid, LooksAtFewOfMany) {
  constexpr int bodies = 3000;
  const auto looked_at = [](std::uint64_t crowd, const Bound& outlier) {
    Random random = Random::at(seed, crowd, 3);
    Mirrored mirrored({});
    mirrored.add(outlier);
    for (int k = 1; k < bodies; ++k) mirrored.add(crowds[crowd].draw(random));
    mirrored.sort();
    SweptSphereSearches searches;
    for (std::uint32_t place = 0; place < mirrored.layer.table().slots(); ++place)
      mirrored.layer.add_search({mirrored.layer.table().swept_sphere_at(place), 0.0f, 1.0f}, searches);
    std::size_t all = 0;
    for (const kinesphere::SlotRange& run : searches.ranges) all += run.end - run.begin;
    return static_cast<double>(all) / (double{bodies} * bodies);
  };
  EXPECT_LT(looked_at(0, ball({}, 0.4)), 0.05);
  EXPECT_LT(looked_at(1, ball({}, 0.4)), 0.05);
  EXPECT_LT(looked_at(2, ball({}, 0.05)), 0.4) << "in three clusters";
  EXPECT_LT(looked_at(0, ball({0x1p14, 1.0, -0x1p13}, 0.4)), 0.1) << "and one far away";
}

SweptSphereGrid sorted_crowd(std::uint32_t bodies) {
  Random random(seed);
  SweptSphereGrid layer;
  for (std::uint32_t number = 0; number < bodies; ++number) {
    const Bound bound = crowds.front().draw(random);
    layer.add(number, swept_sphere_of(BoundAt(bound, 0.0), 0.0, 1.0, 0.0, {}), 0.0f);
  }
  PoolLease alone;
  layer.sort(alone, [](std::uint32_t, std::uint32_t) {});
  return layer;
}

TEST(SweptSphereGrid, RefusesACapsuleThatWouldMakeSearchesSlow) {
  SweptSphereGrid layer = sorted_crowd(1000);
  const SweptSphere before = layer.table().swept_sphere_at(5);
  for (const SweptSphere& sphere :
       {SweptSphere{{100.0f, 0.0f, 0.0f}, {}, 0.1f}, SweptSphere{before.centre, {}, 100.0f},
        SweptSphere{before.centre, {0.0f, 100.0f, 0.0f}, 0.1f}, SweptSphere{{NAN, 0.0f, 0.0f}, {}, 0.1f},
        SweptSphere{{}, {}, std::numeric_limits<float>::infinity()}}) {
    EXPECT_FALSE(layer.looseness_at(5, sphere, 0.0f));
    EXPECT_EQ(layer.table().swept_sphere_at(5), before);
  }
  EXPECT_TRUE(layer.looseness_at(5, {before.centre, before.velocity, 0.25f * before.radius}, 0.0f));
}

/// Swept spheres that are added take spare slots of their cells. They make no search read more, but for those
/// that find no such slot and come behind all others.
TEST(SweptSphereGrid, ReadsNoMoreForThoseThatTakeSpareSlots) {
  constexpr std::uint32_t bodies = 4000;
  constexpr std::uint32_t more = bodies / 16;
  SweptSphereGrid layer;
  layer.set_spare_slots(true);
  Random random(seed);
  const auto draw = [&random] {
    return swept_sphere_of(BoundAt(crowds.front().draw(random), 0.0), 0.0, 1.0, 0.0, {});
  };
  for (std::uint32_t number = 0; number < bodies; ++number) layer.add(number, draw(), 0.0f);
  PoolLease alone;
  layer.sort(alone, [](std::uint32_t, std::uint32_t) {});
  ASSERT_EQ(layer.table().slots(), bodies + bodies / 8);
  std::vector<SweptSphere> spheres = layer.table().all().spheres;
  const auto slots_read = [&] {
    SweptSphereSearches searches;
    for (const SweptSphere& sphere : spheres) layer.add_search({sphere, 0.0f, 1.0f}, searches);
    std::size_t all = 0;
    for (const kinesphere::SlotRange& run : searches.ranges) all += run.end - run.begin;
    return all;
  };
  const std::size_t before = slots_read();
  std::uint32_t behind = 0;
  for (std::uint32_t number = bodies; number < bodies + more; ++number)
    if (layer.add(number, draw(), 0.0f) >= layer.sorted_slots()) ++behind;
  EXPECT_LT(behind, 2 * more / 3);
  EXPECT_EQ(layer.table().free_slots(), bodies / 8 - more + behind);
  EXPECT_EQ(slots_read(), before + behind * spheres.size());
}

TEST(SweptSphereGrid, IsEmptyAfterClear) {
  SweptSphereGrid layer = sorted_crowd(100);
  layer.remove(3);
  layer.clear({.per_length = 4.0});
  EXPECT_EQ(layer.size(), 0u);
  EXPECT_EQ(layer.table().slots(), 0u);
  EXPECT_EQ(layer.widest(), 0.0f);
  EXPECT_EQ(layer.frame().per_length, 4.0);
  EXPECT_TRUE(layer.is_valid());
  SweptSphereSearches searches;
  layer.add_search({{}, 0.0f, 1.0f}, searches);
  EXPECT_TRUE(searches.ranges.empty());
  PoolLease alone;
  layer.sort(alone, [](std::uint32_t, std::uint32_t) { FAIL(); });
  EXPECT_TRUE(layer.is_valid());
  layer.add_search({{}, 0.0f, 1.0f}, searches);
  layer.make(searches);
  searches.for_each_found([](std::uint32_t, std::uint32_t) { FAIL(); });
}

TEST(SweptSphereGrid, GetsUntidyWhereManyHaveEnteredOrLeft) {
  SweptSphereGrid layer;
  for (std::uint32_t number = 0; number < 1000; ++number)
    layer.add(number, {{static_cast<float>(number), 0.0f, 0.0f}, {}, 1.0f}, 0.0f);
  EXPECT_TRUE(layer.is_untidy());
  PoolLease alone;
  layer.sort(alone, [](std::uint32_t, std::uint32_t) {});
  EXPECT_FALSE(layer.is_untidy());
  EXPECT_NEAR(layer.density(false) * 8.0, 1.0 / 2.0, 0.45) << "one of width 2 for each unit of a row";
  for (std::uint32_t place = 0; place < 700; ++place) layer.remove(place);
  EXPECT_TRUE(layer.is_untidy());
  layer.sort(alone, [](std::uint32_t, std::uint32_t) {});
  EXPECT_EQ(layer.table().slots(), 300u);
}

}  // namespace
}  // namespace kinesphere::swept_sphere_grid_test
